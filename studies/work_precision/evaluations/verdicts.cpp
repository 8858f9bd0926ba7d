#include "studies/work_precision/evaluations/verdicts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "studies/report/words/units.hpp"

namespace dovetail::work_precision {
namespace {

constexpr double kGoalFactor = 1.5;  // of seconds, that a choice may take more than the cheapest setting known

std::string words_of(const WholeDiagram& diagram, const WholePoint& point) {
  return setting_words(point.run.setting, diagram.edges_of_file);
}

/// What differs between two settings, knob by knob: "finer: N = 192 (128)".
std::string differences(const WholeDiagram& diagram, const WholeSetting& chosen, const WholeSetting& cheap) {
  std::vector<std::string> finer, coarser;
  const auto add = [&](bool is_finer, std::string text) { (is_finer ? finer : coarser).push_back(std::move(text)); };
  if (chosen.mesh != cheap.mesh)
    add(chosen.mesh > cheap.mesh,
        fmt::format("{} edges ({})", edges(chosen, diagram.edges_of_file), edges(cheap, diagram.edges_of_file)));
  if (chosen.beside != cheap.beside)
    add(chosen.beside > cheap.beside,
        fmt::format("{:.2g} times as many beside the flanks ({:.2g})", chosen.beside, cheap.beside));
  if (chosen.harmonics != cheap.harmonics)
    add(chosen.harmonics > cheap.harmonics, fmt::format("H = {} ({})", chosen.harmonics, cheap.harmonics));
  if (chosen.samples != cheap.samples)
    add(chosen.samples > cheap.samples, fmt::format("N = {} ({})", chosen.samples, cheap.samples));
  if (chosen.modes != cheap.modes)
    add(chosen.modes > cheap.modes, fmt::format("{} modes ({})", chosen.modes, cheap.modes));
  if (chosen.resonance_tolerance != cheap.resonance_tolerance)
    add(chosen.resonance_tolerance < cheap.resonance_tolerance,
        fmt::format("resonance to {:g} ({:g})", chosen.resonance_tolerance, cheap.resonance_tolerance));
  if (chosen.tolerance != cheap.tolerance)
    add(chosen.tolerance < cheap.tolerance, fmt::format("residual to {:g} ({:g})", chosen.tolerance, cheap.tolerance));
  std::string text;
  if (!finer.empty()) text += fmt::format(" Finer than there: {}.", fmt::join(finer, ", "));
  if (!coarser.empty()) text += fmt::format(" Coarser: {}.", fmt::join(coarser, ", "));
  return text;
}

/// The judged response that errs most.
std::string worst_response(const WholeDiagram& diagram, const WholePoint& point) {
  std::string worst;
  double largest = -1;
  for (const std::string& name : diagram.judged)
    if (const double error = error_of(point, name); error > largest) {
      largest = error;
      worst = name;
    }
  return report::words(worst);
}

}  // namespace

std::string error_words(double error) {
  if (std::isnan(error)) return "\u2013";
  if (error == 0) return "0";
  return error < 1e-6 ? "less than 0.0001 %" : fmt::format("{:.2g} %", 100 * error);
}

std::string choice_verdict(const WholeDiagram& diagram, const AutomaticChoice& choice) {
  const WholePoint& chosen = choice.point;
  std::string text =
      fmt::format("Asked for {:g} %, the program chooses {}", 100 * choice.asked, words_of(diagram, chosen));
  text += fmt::format(" in {} rounds and {:.3g} s ({}).", choice.rounds.size(), choice.seconds, choice.status);
  if (!chosen.run.converged()) return text + " The evaluation there fails: " + chosen.run.status + ".";
  if (std::isnan(chosen.worst)) return text + " Its true error is not known.";
  text += fmt::format(" An evaluation there takes {:.3g} s and errs by {}, most in {}{}.", chosen.run.seconds,
                      error_words(chosen.worst), worst_response(diagram, chosen),
                      chosen.worst < diagram.agreement() ? ", less than the references resolve" : "");
  if (chosen.worst > choice.asked) text += " That is more than was asked for.";
  const Comparison comparison = compare(diagram, choice);
  if (comparison.for_asked == nullptr) return text + " No setting known errs by less than was asked for.";
  text += fmt::format(
      " The cheapest setting known that errs by at most {:g} % takes {:.3g} s ({}): a factor of {:.2f}, {} "
      "the {:g} aimed at.",
      100 * choice.asked, comparison.for_asked->run.seconds, words_of(diagram, *comparison.for_asked),
      comparison.factor_asked, comparison.factor_asked <= kGoalFactor ? "within" : "beyond", kGoalFactor);
  text += differences(diagram, chosen.run.setting, comparison.for_asked->run.setting);
  if (comparison.steady != nullptr && comparison.steady->run.setting != comparison.for_asked->run.setting)
    text += fmt::format(
        " Where known finer settings have to err by no more, too, so that no errors cancel by chance, the cheapest "
        "takes "
        "{:.3g} s ({}): a factor of {:.2f}.{}",
        comparison.steady->run.seconds, words_of(diagram, *comparison.steady), comparison.factor_steady,
        differences(diagram, chosen.run.setting, comparison.steady->run.setting));
  return text + fmt::format(" At the choice's own error the factor is {:.2f}.", comparison.factor_error);
}

std::string paper_verdict(const WholeDiagram& diagram) {
  const WholePoint* paper = diagram.paper();
  if (paper == nullptr) return "The paper's settings were not computed.";
  std::string text = "At the paper's settings (" + words_of(diagram, *paper) + ")";
  if (!paper->run.converged()) return text + " the evaluation fails: " + paper->run.status + ".";
  text += fmt::format(" an evaluation takes {:.3g} s and errs by {}, most in {}.", paper->run.seconds,
                      error_words(paper->worst), worst_response(diagram, *paper));
  const WholePoint* as_good = cheapest(diagram, kWorst, std::max(paper->worst, diagram.agreement()));
  if (as_good != nullptr)
    text += fmt::format(
        " The cheapest setting known that errs no more takes {:.3g} s ({}), the paper's {:.2g} times as "
        "long.",
        as_good->run.seconds, words_of(diagram, *as_good), paper->run.seconds / as_good->run.seconds);
  for (const AutomaticChoice& choice : diagram.automatic)
    if (!std::isnan(choice.point.worst))
      text += fmt::format(" The choice for {:g} % takes {:.2g} times the paper's seconds and errs by {}.",
                          100 * choice.asked, choice.point.run.seconds / paper->run.seconds,
                          error_words(choice.point.worst));
  return text;
}

std::string reference_verdict(const WholeDiagram& diagram) {
  const WholeReference& reference = diagram.reference;
  for (const WholePoint* point : {&reference.finest, &reference.check})
    if (!point->run.converged())
      return fmt::format("The reference at {} failed ({}): there are no true errors.", words_of(diagram, *point),
                         point->run.status);
  const std::vector<const WholePoint*> points = diagram.points();
  const auto failed = std::ranges::count_if(points, [](const WholePoint* point) { return !point->run.converged(); });
  return fmt::format(
      "The reference has {} ({:.3g} s), the second one {} ({:.3g} s). They differ by at most {} over the judged "
      "responses, most in {}: smaller errors are not resolved. {} of {} evaluations failed.",
      words_of(diagram, reference.finest), reference.finest.run.seconds, words_of(diagram, reference.check),
      reference.check.run.seconds, error_words(diagram.agreement()), worst_response(diagram, reference.check), failed,
      points.size());
}

}  // namespace dovetail::work_precision
