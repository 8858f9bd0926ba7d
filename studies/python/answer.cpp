#include "studies/python/answer.hpp"

#include <sstream>

#include "studies/program/commands/told.hpp"

namespace dovetail::python {

namespace py = pybind11;

py::object parsed(const std::string& json) {
  return py::module_::import("json").attr("loads")(json);
}

py::list remarks_of(const std::string& text) {
  constexpr std::string_view kName = "dovetail: ";
  py::list remarks;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    if (!line.empty()) remarks.append(line.starts_with(kName) ? line.substr(kName.size()) : line);
  return remarks;
}

Answer answer_of(const std::string& name, const studies::TellChoice& tell,
                 const std::function<int(studies::Teller&, const studies::Streams&)>& command) {
  std::ostringstream out, err;
  int status = studies::kDone;
  const studies::Streams streams{.out = out, .err = err};
  compute([&] {
    status =
        studies::told({.name = name}, tell, streams, [&](studies::Teller& teller) { return command(teller, streams); });
  });
  const std::string json = out.str();
  return {.values = json.empty() ? py::dict() : py::dict(parsed(json)),
          .remarks = remarks_of(err.str()),
          .converged = status == studies::kDone};
}

void bind_answer(py::module_& module) {
  py::class_<Answer> answer(module, "Answer", R"(What a computation came to: a mapping.

It has the names and the numbers, to the last bit, of the JSON that the program `dovetail` writes for the same
question; null is None. Every name is an attribute, too: answer.responses is answer["responses"]. Numbers are SI but
for `parameters`, which are in the units that their keys name. What did not converge says so in its status.)");
  answer
      .def(
          "__getitem__", [](const Answer& self, const py::object& key) { return py::object(self.values[key]); },
          "The value under a name of the JSON.")
      .def(
          "__getattr__",
          [](const Answer& self, const std::string& name) {
            if (!self.values.contains(name)) throw py::attribute_error("the answer has no " + name);
            return py::object(self.values[name.c_str()]);
          },
          "The value under a name of the JSON.")
      .def("__iter__", [](const Answer& self) { return py::iter(self.values); })
      .def("__len__", [](const Answer& self) { return self.values.size(); })
      .def("__contains__", [](const Answer& self, const py::object& key) { return self.values.contains(key); })
      .def(
          "keys", [](const Answer& self) { return self.values.attr("keys")(); }, "keys(self)\n--\n\nThe names.")
      .def(
          "items", [](const Answer& self) { return self.values.attr("items")(); },
          "items(self)\n--\n\nNames and values.")
      .def(
          "values", [](const Answer& self) { return self.values.attr("values")(); }, "values(self)\n--\n\nThe values.")
      .def(
          "get",
          [](const Answer& self, const py::object& key, const py::object& other) {
            return self.values.attr("get")(key, other);
          },
          py::arg("key"), py::arg("default") = py::none(),
          "get(self, key, default=None)\n--\n\nThe value under a name, or `default`.")
      .def("__dir__",
           [](const py::object& self) {
             py::list names = py::module_::import("builtins").attr("object").attr("__dir__")(self);
             for (const auto& [name, value] : self.cast<const Answer&>().values) names.append(name);
             return names;
           })
      .def("__repr__",
           [](const Answer& self) {
             return "<dovetail.Answer with " +
                    std::string(py::str(", ").attr("join")(self.values).cast<std::string>()) + ">";
           })
      .def_readonly("remarks", &Answer::remarks, "What the program says on standard error, a sentence each: list[str].")
      .def_readonly("converged", &Answer::converged,
                    "Whether all of it converged: the program's exit status is 0 (True) or 3 (False).");
  py::module_::import("collections.abc").attr("Mapping").attr("register")(answer);
}

}  // namespace dovetail::python
