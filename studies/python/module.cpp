// The Python module: what the program does, as functions.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "core/errors.hpp"
#include "numerics/process.hpp"
#include "studies/program/answers/json.hpp"
#include "studies/program/answers/teller.hpp"
#include "studies/program/answers/version.hpp"
#include "studies/program/commands/commands.hpp"
#include "studies/program/engine/interrupt.hpp"
#include "studies/program/study_file/refusal.hpp"
#include "studies/python/answer.hpp"
#include "studies/python/keywords.hpp"
#include "studies/python/model.hpp"
#include "studies/python/study.hpp"

namespace dovetail::python {
namespace {

namespace py = pybind11;
using studies::Streams;

/// What is computed with: a study, a model in memory, or the file of either.
struct Input {
  std::string name;
  std::vector<std::string> set;
  Model model;  ///< null: the file of that name
};

Input input_of(const py::object& given) {
  if (py::isinstance<StudyFile>(given)) {
    const auto& study = given.cast<const StudyFile&>();
    return {.name = study.path(), .set = study.assignments(), .model = {}};
  }
  if (py::isinstance<reduction::ReducedModel>(given))
    return {.name = "the model", .set = {}, .model = given.cast<Model>()};
  return {.name = py::str(given).cast<std::string>(), .set = {}, .model = {}};
}

Answer response(const py::object& given, const py::object& frequencies, const py::kwargs& keywords) {
  const Input input = input_of(given);
  studies::ResponseOptions options;
  options.input = input.name;
  options.set = input.set;
  options.json = "-";
  std::vector<double> hz;
  if (py::isinstance<py::float_>(frequencies) || py::isinstance<py::int_>(frequencies))
    hz = {frequencies.cast<double>()};
  else
    for (const py::handle one : frequencies) {
      if (!PyNumber_Check(one.ptr())) throw py::type_error("frequencies must be a number or numbers, in Hz");
      hz.push_back(one.cast<double>());
    }
  if (hz.empty()) studies::refuse("frequencies", "must be at least one, in Hz");
  studies::Complaints wrong;
  for (const double one : hz) wrong.require("frequencies", one, studies::kFrequencies);
  wrong.raise();
  options.from_hz = hz.front();
  options.to_hz = hz.back();
  options.points = static_cast<int>(hz.size());
  take_keywords(options, keywords, "response", {"--from", "--to", "--points"});
  if (options.arclength && options.from_hz == options.to_hz)
    studies::refuse("frequencies", "must begin and end an interval with arclength");
  return answer_of("response", options.tell,
                   [&, model = input.model ? *input.model : reduction::ReducedModel()](studies::Teller& teller,
                                                                                       const Streams& streams) {
                     if (!input.model) return studies::answer_response(options, hz, teller, streams);
                     return studies::answer_response(
                         options, hz, studies::take_model(input.name, model, options.solver), teller, streams);
                   });
}

Answer wear(const py::object& given, const py::kwargs& keywords) {
  const Input input = input_of(given);
  studies::WearOptions options;
  options.input = input.name;
  options.set = input.set;
  options.json = "-";
  take_keywords(options, keywords, "wear");
  return answer_of("wear", options.tell,
                   [&, model = input.model ? *input.model : reduction::ReducedModel()](studies::Teller& teller,
                                                                                       const Streams& streams) {
                     if (!input.model) return studies::run_wear(options, teller, streams);
                     return studies::answer_wear(options, studies::take_model(input.name, model, options.solver),
                                                 teller, streams);
                   });
}

/// Tells a function of Python of each candidate; false from it ends the run in order.
std::function<void(const optimizer::Progress&)> told(const py::object& callback) {
  if (callback.is_none()) return {};
  return [&callback](const optimizer::Progress& at) {
    const py::gil_scoped_acquire held;
    const Answer evaluation{.values = parsed(studies::evaluation_json(at.candidate.evaluation)),
                            .remarks = py::list(),
                            .converged = at.candidate.evaluation.converged()};
    const py::object best = at.best ? py::object(py::int_(*at.best + 1)) : py::none();
    const py::object result = callback(at.index + 1, evaluation, best);
    if (!result.is_none() && !result.cast<bool>()) studies::request_interrupt();
  };
}

py::dict run(const StudyFile& file, const py::object& directory, const py::object& callback,
             const py::kwargs& keywords) {
  studies::RunOptions options{.study = file.path(), .directory = py::str(directory).cast<std::string>()};
  take_keywords(options, keywords, "run");
  const studies::Study study = file.rewritten();
  std::ostringstream out, err;
  int status = studies::kDone;
  compute(
      [&] {
        status = studies::run_study(study, options, {.out = out, .err = err}, studies::study_engine, studies::processes,
                                    told(callback));
      },
      Ending::in_order);
  const std::filesystem::path best = std::filesystem::path(options.directory) / "best.toml";
  const char* words = status == studies::kDone          ? "done"
                      : status == studies::kInterrupted ? "interrupted"
                                                        : "not_converged";
  py::dict answer;
  answer["status"] = words;
  answer["converged"] = status == studies::kDone;
  answer["best"] = std::filesystem::exists(best) ? py::object(py::str(best.string())) : py::none();
  answer["summary"] = out.str();
  answer["remarks"] = remarks_of(err.str());
  return answer;
}

/// OpenBLAS takes its kernels when it is loaded, which is before this.
void warn_of_kernels(bool old) {
  if (!old) return;
  const char* words =
      "OpenBLAS does not know this processor and is several times as slow as it could be; set "
      "OPENBLAS_CORETYPE=Haswell "
      "in the environment before Python starts";
  if (PyErr_WarnEx(PyExc_RuntimeWarning, words, 1) != 0) throw py::error_already_set();
}

}  // namespace
}  // namespace dovetail::python

PYBIND11_MODULE(dovetail, module) {
  using namespace dovetail::python;
  namespace studies = dovetail::studies;
  py::options signatures;
  signatures.disable_function_signatures();
  module.doc() =
      "Optimises dovetail profiles against fretting wear: the program `dovetail` as functions.\n\n"
      "Answers are mappings with the names and numbers of the program's JSON, SI; wrong input raises InputError;\n"
      "what does not converge says so in its status. Ctrl-C ends the computation of the main thread; several\n"
      "threads may compute at once, and what ends one of them is nothing to the others.\n"
      "Importing the module sets OpenBLAS, which numpy may use, too, to one thread.";
  module.attr("__version__") = studies::version();
  warn_of_kernels(dovetail::numerics::prepare_library());
  py::register_exception<dovetail::InputError>(module, "InputError", PyExc_ValueError).attr("__doc__") =
      "The input is wrong: a sentence for each thing, as the program says it.";
  bind_answer(module);
  bind_model(module);
  bind_study(module);
  module.def("response", &response, py::arg("input"), py::arg("frequencies"),
             documented<studies::ResponseOptions>("response", "input, frequencies",
                                                  R"(Frequency response with friction: `dovetail response`.

`input` is a Model, a Study or the file of either; `frequencies` are in Hz, in the order in which they are gone
through (with arclength the first and the last are the ends). Answers lists over the F frequencies: `frequency_hz`,
`status`, `outputs` by name with `amplitude` [F], `cosine` and `sine` [F][H+1] in m, `dissipated_energy_j`,
`wear_rate_m_per_cycle` [F][Nc]. Raises InputError.)",
                                                  {"--from", "--to", "--points"})
                 .c_str());
  module.def("wear", &wear, py::arg("input"),
             documented<studies::WearOptions>("wear", "input", R"(The worn state: `dovetail wear`.

`input` is a Model, a Study or the file of either. Answers `status`, `frequency_hz`, `cycles`, `worn_volume_m3` [S],
`depth_m` [Nc], `final_wear_rate_m_per_cycle` [Nc]; of a history also its S states. Raises InputError.)")
                 .c_str());
  module.def(
      "run", &run, py::arg("study"), py::arg("directory"), py::arg("callback") = py::none(),
      documented<studies::RunOptions>("run", "study, directory, callback=None", R"(Optimises a study: `dovetail run`.

The directory gets results.h5, report.html, best.toml and the exports of the study. After every evaluation of the search
`callback(number, evaluation, best)` is called, if it is given: the number from 1, an Answer, the number of the best
feasible design so far or None; False from it ends the run in order, an exception at once. Answers a dict: `status`
("done", "not_converged", "interrupted"), `best` (the file, or None), `summary`, `remarks`. Ctrl-C ends the run in order
and raises KeyboardInterrupt; resume=True goes on. Raises InputError.)")
          .c_str());
}
