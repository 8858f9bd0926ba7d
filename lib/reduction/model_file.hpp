#pragma once

#include <string>

#include "reduction/reduced_model.hpp"

namespace dovetail::reduction {

/// Reads a reduced model file (HDF5, format `dovetail-reduced-model`, version 1). Everything is checked;
/// throws InputError with one sentence for each thing wrong (file, data set, value, what is allowed).
/// Missing optional data sets: position and group stay empty, slip_origin is zero.
[[nodiscard]] ReducedModel read_model(const std::string& path);

/// Writes `model` to a temporary file beside `path` and renames it, so that `path` is never half written.
/// What read_model returns afterwards is equal to the last bit. Throws InputError when the model is not
/// valid (see violations) or the file cannot be written.
void write_model(const std::string& path, const ReducedModel& model);

}  // namespace dovetail::reduction
