#include "studies/python/study.hpp"

#include <pybind11/stl.h>

#include <memory>
#include <utility>

#include "studies/program/commands/commands.hpp"
#include "studies/program/engine/loaded_model.hpp"
#include "studies/program/engine/run_folder.hpp"
#include "studies/program/study_file/best_file.hpp"
#include "studies/python/answer.hpp"
#include "studies/python/keywords.hpp"
#include "studies/python/model.hpp"

namespace dovetail::python {

namespace py = pybind11;

namespace {

/// A value as --set reads it.
std::string toml_text(const py::handle& value) {
  if (py::isinstance<py::bool_>(value)) return value.cast<bool>() ? "true" : "false";
  if (py::isinstance<py::list>(value) || py::isinstance<py::tuple>(value)) {
    std::string text;
    for (const py::handle item : value)
      text += (text.empty() ? "" : ", ") + (py::isinstance<py::str>(item)
                                                ? py::module_::import("json").attr("dumps")(item).cast<std::string>()
                                                : toml_text(item));
    return "[" + text + "]";
  }
  // A number of numpy is written like one of Python.
  return py::str(py::hasattr(value, "item") ? py::object(value.attr("item")())
                                            : py::reinterpret_borrow<py::object>(value))
      .cast<std::string>();
}

Model reduced(const StudyFile& study) {
  studies::LoadedModel loaded;
  compute([&] { loaded = studies::load_model(study.path(), study.assignments(), {}); });
  // A model that is missing has no other way to say so.
  if (!loaded.failure.empty()) throw std::runtime_error(study.path() + ": not converged: " + loaded.failure);
  return std::make_shared<reduction::ReducedModel>(std::move(loaded.model));
}

}  // namespace

StudyFile::StudyFile(const std::string& path) : path_(studies::study_or_best(path, nullptr)) {
  (void)read();
}

void StudyFile::set(const std::string& key, const py::handle& value) {
  StudyFile changed = *this;
  changed.set_.push_back(key + "=" + toml_text(value));
  (void)changed.read();
  *this = std::move(changed);
}

studies::Study StudyFile::read() const {
  return studies::load_study(path_, studies::overrides(set_));
}

studies::Study StudyFile::rewritten() const {
  return studies::load_rewritten_study(path_, studies::overrides(set_));
}

void bind_study(py::module_& module) {
  py::class_<StudyFile>(
      module, "Study",
      R"(A study file (TOML): the joint, what may change, what counts; or the best design of a run, by its
directory.

Raises InputError, a sentence for each thing that is wrong.)")
      .def(py::init([](const py::object& path) { return StudyFile(py::str(path).cast<std::string>()); }),
           py::arg("path"),
           "__init__(self, path)\n--\n\nReads the study file, or best.toml in the directory of a run. Raises "
           "InputError.")
      .def("set", &StudyFile::set, py::arg("key"), py::arg("value"), R"(set(self, key, value)
--

Replaces a value of the study, in the unit that its key names: set("geometry.flank_mismatch_um", 5).

Raises InputError, and then the study is as before.)")
      .def_property_readonly("path", &StudyFile::path, "The file that is computed with.")
      .def(
          "warnings", [](const StudyFile& self) { return studies::warnings(self.read()); }, R"(warnings(self)
--

What the study asks for that it had better not: list[str], as `dovetail check` says it.)")
      .def(
          "evaluate",
          [](const StudyFile& self, const py::kwargs& keywords) {
            studies::EvaluateOptions options{
                .study = self.path(), .set = self.assignments(), .solver = {}, .json = "-"};
            take_keywords(options, keywords, "evaluate");
            return answer_of("evaluate", options.tell, [&](studies::Teller& teller, const studies::Streams& streams) {
              return studies::run_evaluate(options, teller, streams);
            });
          },
          documented<studies::EvaluateOptions>("evaluate", "self", R"(Computes one design: `dovetail evaluate`.

Answers `status` and `feasible`, and by name `parameters` (in the units of the file), `responses` and their
`error_estimates` (SI; the unit is the end of the name: worn volume in m^3, drift relative), `error_sources`,
`constraints` (kept when <= 0), `model`, `timings_s`; of a study with cases also `cases`.
Raises InputError, also for a design that breaks a geometric rule.)")
              .c_str())
      .def("reduce", &reduced, R"(reduce(self)
--

The reduced model of the design: `dovetail reduce`.

Raises InputError; RuntimeError where there is no model because something did not converge.)");
}

}  // namespace dovetail::python
