#include "studies/work_precision/evaluations/compute.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>
#include <utility>

#include "optimizer/responses/response_table.hpp"
#include "optimizer/search/random_stream.hpp"
#include "quality/truncation.hpp"
#include "studies/work_precision/evaluations/automatic.hpp"
#include "studies/work_precision/evaluations/paper.hpp"

namespace dovetail::work_precision {
namespace {

constexpr double kCheaper = 0.98;  // seconds over those before from which a setting of the descent counts as cheaper

/// Samples that alias the harmonics are no setting.
bool sensible(const WholeSetting& setting) {
  return quality::samples_for(setting.harmonics, setting.samples) == setting.samples;
}

/// The next smaller or larger value of a ladder; the same where there is none.
template <class T>
T neighbour(const std::vector<T>& ladder, T value, bool smaller) {
  T best = value;
  for (const T rung : ladder)
    if (smaller ? rung < value && (best == value || rung > best) : rung > value && (best == value || rung < best))
      best = rung;
  return best;
}

enum class Way { coarser, finer };
/// Which errors count: those of the setting, or those of known finer ones, too.
enum class Errors { own, steady };

class Measurement {
 public:
  Measurement(const std::string& file, const EvaluationPlan& plan, WholeDiagram named,
              const EvaluationListener& listener)
      : plan_(plan),
        listener_(listener),
        diagram_(std::move(named)),
        design_(load_coarser(file, plan.coarser), diagram_.variables) {
    const studies::Study& study = design_.study();
    diagram_.edges_of_file = design_.edges_of_file();
    own_ = whole_setting(study.scene);
    diagram_.judged = optimizer::responses_of(study.problem);
    diagram_.judged_by_study = !diagram_.judged.empty();
  }

  WholeDiagram run() {
    say("reference");
    reference();
    alone();
    paper();
    automatic();
    combinations();
    for (const double asked : plan_.asked)
      for (const Errors errors : {Errors::own, Errors::steady}) descend(asked, errors);
    say("repetitions");
    repeat();
    return std::move(diagram_);
  }

 private:
  void say(const std::string& what) const {
    if (listener_.progress) listener_.progress(diagram_.title + ": " + what);
  }
  void tell() const {
    if (listener_.more) listener_.more(diagram_);
  }
  void add(WholeLine& line, const std::string& label, const WholeRun& run) {
    line.points.push_back(judged_point(diagram_, label, run));
  }

  void reference() {
    diagram_.reference.finest = {.label = "finest", .run = design_(plan_.finest)};
    diagram_.reference.check = {.label = "check", .run = design_(plan_.check)};
    if (!diagram_.judged_by_study)
      for (const optimizer::Response& response : optimizer::responses())
        if (response.has_limit(design_.study().scene)) diagram_.judged.emplace_back(response.name);
    // Of a joint without wear, or what a failed run leaves out, there is no relative error.
    const auto& truth = diagram_.reference.finest.run.responses;
    std::erase_if(diagram_.judged, [&](const std::string& name) {
      const auto found = truth.find(name);
      return found != truth.end() && found->second == 0;
    });
    judge(diagram_);
    tell();
  }

  template <class T, class Label>
  void line(WholeSweep key, const std::vector<T>& values, T WholeSetting::*knob, Label&& label) {
    if (values.empty()) return;
    say(std::string(to_string(key)));
    diagram_.lines.push_back({.key = key});
    for (const T value : values) {
      WholeSetting setting = own_;
      setting.*knob = value;
      add(diagram_.lines.back(), label(setting), design_(setting));
    }
    tell();
  }

  void alone() {
    const Ladders& alone = plan_.alone;
    line(WholeSweep::mesh, alone.mesh, &WholeSetting::mesh,
         [&](const WholeSetting& s) { return fmt::format("{} edges", edges(s, diagram_.edges_of_file)); });
    line(WholeSweep::beside, alone.beside, &WholeSetting::beside, beside_words);
    line(WholeSweep::harmonics, alone.harmonics, &WholeSetting::harmonics,
         [](const WholeSetting& s) { return fmt::format("H = {}", s.harmonics); });
    line(WholeSweep::samples, alone.samples, &WholeSetting::samples,
         [](const WholeSetting& s) { return fmt::format("N = {}", s.samples); });
    line(WholeSweep::modes, alone.modes, &WholeSetting::modes,
         [](const WholeSetting& s) { return fmt::format("{} modes", s.modes); });
    line(WholeSweep::resonance_tolerance, alone.resonance_tolerance, &WholeSetting::resonance_tolerance,
         [](const WholeSetting& s) { return fmt::format("resonance to {:g}", s.resonance_tolerance); });
    line(WholeSweep::tolerance, alone.tolerance, &WholeSetting::tolerance,
         [](const WholeSetting& s) { return fmt::format("residual to {:g}", s.tolerance); });
  }

  void paper() {
    say("the paper's settings");
    diagram_.lines.push_back({.key = WholeSweep::paper});
    WholeLine& line = diagram_.lines.back();
    add(line, "paper, worn state directly", design_(paper_setting(design_.study().scene)));
    const auto& truth = diagram_.reference.finest.run.responses;
    const auto depth = truth.find(std::string(optimizer::kWornDepth.name));
    if (depth != truth.end() && depth->second > 0)
      add(line, "paper, wear in steps", paper_history(design_, depth->second, plan_.wear_steps));
    tell();
  }

  void automatic() {
    for (const double asked : plan_.asked) {
      say(fmt::format("automatic choice for {:g} %", 100 * asked));
      diagram_.automatic.push_back(choose(design_, asked, plan_.choice_limit));
      judge(diagram_);
      tell();
    }
  }

  void combinations() {
    if (plan_.combinations == 0) return;
    say("combinations");
    optimizer::RandomStream random(static_cast<std::uint64_t>(plan_.seed));
    const auto pick = [&random](const auto& ladder) { return ladder[random.below(ladder.size())]; };
    diagram_.lines.push_back({.key = WholeSweep::combinations});
    std::set<WholeSetting> drawn;
    // A joint ladder may hold fewer combinations than are asked for.
    for (int tries = 0; tries < 50 * plan_.combinations && std::ssize(drawn) < plan_.combinations; ++tries) {
      WholeSetting setting = own_;
      setting.mesh = pick(plan_.joint.mesh);
      setting.beside = pick(plan_.joint.beside);
      setting.harmonics = pick(plan_.joint.harmonics);
      setting.samples = pick(plan_.joint.samples);
      setting.modes = pick(plan_.joint.modes);
      setting.resonance_tolerance = pick(plan_.joint.resonance_tolerance);
      setting.tolerance = pick(plan_.joint.tolerance);
      if (sensible(setting) && drawn.insert(setting).second)
        add(diagram_.lines.back(), setting_words(setting, diagram_.edges_of_file), design_(setting));
    }
    tell();
  }

  [[nodiscard]] std::array<WholeSetting, 7> neighbours(const WholeSetting& at, Way way) const {
    std::array<WholeSetting, 7> next;
    next.fill(at);
    const Ladders& joint = plan_.joint;
    const bool down = way == Way::coarser;
    next[0].mesh = neighbour(joint.mesh, at.mesh, down);
    next[1].harmonics = neighbour(joint.harmonics, at.harmonics, down);
    next[2].samples = neighbour(joint.samples, at.samples, down);
    next[3].modes = neighbour(joint.modes, at.modes, down);
    next[4].resonance_tolerance = neighbour(joint.resonance_tolerance, at.resonance_tolerance, !down);
    next[5].tolerance = neighbour(joint.tolerance, at.tolerance, !down);
    next[6].beside = neighbour(joint.beside, at.beside, down);
    return next;
  }

  /// A point of the descent; null for a setting that is none or was tried.
  const WholePoint* try_out(const WholeSetting& setting, std::set<WholeSetting>& tried) {
    if (!sensible(setting) || !tried.insert(setting).second) return nullptr;
    std::vector<WholePoint>& points = diagram_.lines.back().points;
    points.push_back(judged_point(diagram_, setting_words(setting, diagram_.edges_of_file), design_(setting)));
    return &points.back();
  }

  /// From the cheapest setting known that is accurate enough, knob by knob to coarser ones while they are, too: else
  /// the front would be as good as the luck of the combinations. Where finer neighbours have to be accurate, too, they
  /// are computed.
  void descend(double asked, Errors errors) {
    const bool steady = errors == Errors::steady;
    const auto best_known = [&] {
      return steady ? cheapest_steady(diagram_, asked) : cheapest(diagram_, kWorst, asked);
    };
    if (best_known() == nullptr || plan_.descent == 0) return;
    say(fmt::format("cheaper settings for {:g} %{}", 100 * asked, steady ? ", with finer neighbours" : ""));
    diagram_.lines.push_back({.key = WholeSweep::descent});
    std::set<WholeSetting> tried;
    int left = plan_.descent;
    for (bool moved = true; moved && left > 0;) {
      moved = false;
      const WholePoint best = *best_known();
      if (steady) {
        for (const WholeSetting& finer : neighbours(best.run.setting, Way::finer)) try_out(finer, tried);
        moved = best_known() == nullptr || best_known()->run.setting != best.run.setting;
        if (best_known() == nullptr) break;
      }
      for (const WholeSetting& setting : neighbours(best.run.setting, Way::coarser)) {
        if (moved || left == 0) break;
        const WholePoint* point = try_out(setting, tried);
        if (point == nullptr) continue;
        --left;
        const double error = steady ? steady_error(diagram_, *point) : point->worst;
        moved = error <= asked && point->run.seconds <= kCheaper * best.run.seconds;
      }
      --left;
    }
    tell();
  }

  /// Once more what the comparison rests on: the choices, what they are compared with, and the paper's.
  void repeat() {
    std::set<WholeSetting> settings;
    if (const WholePoint* paper = diagram_.paper()) settings.insert(paper->run.setting);
    for (const AutomaticChoice& choice : diagram_.automatic) {
      settings.insert(choice.point.run.setting);
      const Comparison comparison = compare(diagram_, choice);
      if (comparison.for_asked) settings.insert(comparison.for_asked->run.setting);
      if (comparison.steady) settings.insert(comparison.steady->run.setting);
      if (comparison.for_error) settings.insert(comparison.for_error->run.setting);
    }
    for (int i = 1; i < plan_.repetitions; ++i)
      for (const WholeSetting& setting : settings) design_.repeat(setting);
    const auto renew = [&](WholePoint& point) {
      if (settings.contains(point.run.setting) && !point.run.in_steps) point.run = design_(point.run.setting);
    };
    for (WholeLine& line : diagram_.lines)
      for (WholePoint& point : line.points) renew(point);
    for (AutomaticChoice& choice : diagram_.automatic) renew(choice.point);
    tell();
  }

  const EvaluationPlan& plan_;
  const EvaluationListener& listener_;
  WholeDiagram diagram_;
  MeasuredDesign design_;
  WholeSetting own_;
};

}  // namespace

WholeDiagram measure_design(const std::string& study_file, const EvaluationPlan& plan, WholeDiagram named,
                            const EvaluationListener& listener) {
  return Measurement(study_file, plan, std::move(named), listener).run();
}

}  // namespace dovetail::work_precision
