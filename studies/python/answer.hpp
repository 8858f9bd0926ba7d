#pragma once

#include <pybind11/pybind11.h>

#include <functional>
#include <string>

#include "studies/program/commands/commands.hpp"
#include "studies/python/computation.hpp"

namespace dovetail::python {

/// What a command of the program answers: the mapping that its JSON is, and what it says on standard error.
struct Answer {
  pybind11::dict values;
  pybind11::list remarks;
  bool converged = true;  ///< its exit status is 0, not 3
};

/// JSON as Python has it: the same numbers to the last bit, null is None.
[[nodiscard]] pybind11::object parsed(const std::string& json);

/// Computes what a command of that name does, which writes its JSON to `out`, and takes its answer.
[[nodiscard]] Answer answer_of(const std::string& name, const studies::TellChoice& tell,
                               const std::function<int(studies::Teller&, const studies::Streams&)>& command);

/// "dovetail: a sentence" -> "a sentence", line by line.
[[nodiscard]] pybind11::list remarks_of(const std::string& text);

void bind_answer(pybind11::module_& module);

}  // namespace dovetail::python
