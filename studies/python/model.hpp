#pragma once

#include <pybind11/pybind11.h>

#include <memory>

#include "reduction/reduced_model.hpp"

namespace dovetail::python {

/// A reduced model, shared with the arrays that show it.
using Model = std::shared_ptr<reduction::ReducedModel>;

void bind_model(pybind11::module_& module);

}  // namespace dovetail::python
