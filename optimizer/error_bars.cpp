#include "optimizer/error_bars.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "geometry/flank_form.hpp"
#include "optimizer/evaluator.hpp"
#include "optimizer/responses.hpp"
#include "optimizer/worn_zones.hpp"
#include "paths/resonance.hpp"
#include "quality/truncation.hpp"
#include "wear/drift.hpp"
#include "wear/measures.hpp"

namespace dovetail::optimizer {

namespace {

constexpr double kGridRatio = 1.5;
constexpr double kSectionRatio = 1 / 1.5;  // of the finer section in space

/// How much of the change of a response by other settings may be left as its error.
using Factor = std::function<double(const std::string& response)>;

/// The design at other settings, and what its distance from the reference says.
struct Companion {
  const Evaluation* evaluation;
  Factor factor;
};

Factor share(double factor) {
  return [factor](const std::string&) { return factor; };
}

/// With an error of order p, d to settings `ratio` times as coarse (as fine below 1) leaves d / |ratio^p - 1|.
double left_over(double order, double ratio) {
  return 1 / std::abs(std::pow(ratio, order) - 1);
}

// The orders were chosen while looking at random designs against meshes four times as fine (studies/error_bars, seeds
// 1 and 2; in space seed 3).
double mesh_order(const std::string& response, bool in_space) {
  const bool fillet = response.ends_with("_fillet_stress_pa");
  if (in_space) {
    // Two or three elements on a fillet are too few for the order of finer meshes.
    if (fillet || response == "contact_pressure_mean_pa" || response == "neck_tension_pa") return 1.5;
    if (response == "glued_frequency_hz" || response.ends_with("resonance_hz")) return 2.5;
  }
  // Forces that follow from equilibrium know of the mesh only through its quadratic arcs.
  if (response == "contact_pressure_mean_pa" || response == "neck_tension_pa") return 2;
  // Stresses of fillets, for which what the free surface says of them counts besides.
  if (fillet) return 2.8;
  if (response == "peak_stress_pa") return 1.3;
  // Most of the worn joint bears on its inner parts.
  if (response == "resonance_drift") return 2.5;
  if (response == "asymptotic_wear_depth_max_m") return 2;
  // Slip next to the sharp ends of flanks, and the wear that comes of it.
  if (response == "dissipated_energy_j" || response == "initial_wear_rate_m3_per_cycle" ||
      response == "peak_amplitude_m")
    return 1.6;
  // Frequencies, worn amplitude and volume.
  return 1.5;
}

/// Of what nodes 1.5 times as long on the same mesh change. `again`: the part that counts of it.
Factor grid_factor(double again) {
  return [again](const std::string& response) {
    const bool worn = response == "worn_peak_amplitude_m" || response == "resonance_drift";
    return again * left_over(worn ? 7.0 / 3 : 5.0 / 3, kGridRatio);
  };
}

class Bars {
 public:
  explicit Bars(CandidateResult& result) : evaluation_(result.evaluation) {}

  /// The largest that the companions say against `reference`, for every response of the evaluation; of those that ended
  /// early, for what they had come to. Where none has an answer the evaluation is not finished.
  void add(const char* source, const std::vector<Companion>& companions, const Evaluation& reference) {
    for (const Companion& companion : companions)
      if (!companion.evaluation->converged())
        evaluation_.messages.push_back(std::string("A design computed for the error by ") + source + " ended with \"" +
                                       companion.evaluation->status + "\".");
    for (const auto& [name, value] : evaluation_.responses) {
      bool known = false;
      double bar = 0;
      for (const Companion& companion : companions) {
        const auto other = companion.evaluation->responses.find(name);
        if (other == companion.evaluation->responses.end()) continue;
        known = true;
        bar = std::max(bar, companion.factor(name) * std::abs(other->second - reference.responses.at(name)));
      }
      if (known) {
        add(source, name, bar);
      } else if (!companions.back().evaluation->converged()) {  // else it was not asked
        leave_open(name);
        missing_ = companions.back().evaluation->status;
      }
    }
  }
  void add(const char* source, const std::string& response, double bar) {
    evaluation_.error_sources[response][source] += bar;
  }
  void leave_open(const std::string& response) { open_.insert(response); }

  void total() {
    for (const auto& [response, sources] : evaluation_.error_sources) {
      if (open_.contains(response)) continue;
      double sum = 0;
      for (const auto& [source, bar] : sources) sum += bar;
      evaluation_.error_estimates[response] = sum;
    }
    for (const char* amount : {"asymptotic_wear_volume_m3", "initial_wear_rate_m3_per_cycle", "dissipated_energy_j"}) {
      const auto bar = evaluation_.error_estimates.find(amount);
      if (bar == evaluation_.error_estimates.end()) continue;
      if (const double value = evaluation_.responses.at(amount); value > 0 && bar->second > value)
        evaluation_.messages.push_back(
            std::string("The error bar of ") + amount +
            " is larger than its value: there may be next to nothing, or more than twice as much.");
    }
    evaluation_.unbounded.assign(open_.begin(), open_.end());
    if (!missing_.empty()) evaluation_.status = "error_estimates: " + missing_.substr(missing_.rfind(' ') + 1);
  }

 private:
  Evaluation& evaluation_;
  std::set<std::string> open_;
  std::string missing_;  ///< how the companion ended that has no answer for a response
};

/// Whole nodes are worn off or bear: where wear of a history comes to rest the end of a zone lies somewhere within a
/// node, and a history on shorter ones may end a part of it from there.
WornChange within_nodes(const fem::ContactCells& cells, const wear::Asymptote& asymptote) {
  // Of a node, from histories on nodes a quarter as long. Where another order of release ends elsewhere, or nodes that
  // stick have little to spare, a history depends on its nodes much more than where some touch at times only.
  const double part = asymptote.doubt == wear::Doubt::lift_off ? 0.055 : 0.25;
  // Of a history that decided nodes may touch that it has worn: they carry what is left there.
  const std::vector<bool> worn =
      asymptote.decided_by == wear::FoundBy::history ? wear::worn_nodes(asymptote.depth) : asymptote.released;
  return ends_moved_by(part, cells, worn, asymptote.depth);
}

/// The other state at rest that a history which came to an end leaves possible: its own, or that of the direct method
/// where the history decided. The direct method knows nothing of nodes that come to rest in slip.
const wear::OtherState* rival(const wear::Asymptote& asymptote) {
  if (!asymptote.confirmed_by_history || asymptote.doubt == wear::Doubt::threshold) return nullptr;
  const wear::FoundBy other =
      asymptote.decided_by == wear::FoundBy::history ? wear::FoundBy::release : wear::FoundBy::history;
  const auto found = std::ranges::find(asymptote.other_states, other, &wear::OtherState::found_by);
  return found == asymptote.other_states.end() ? nullptr : &*found;
}

/// What a doubt of the direct worn state leaves open: by how much a history that decided ends elsewhere; where it ends
/// in the same state, or nothing else was there to compare with, what its nodes leave open; and without a history that
/// ends it may be anything.
WornChange left_in_doubt(const fem::ContactCells& cells, const wear::Asymptote& asymptote) {
  if (asymptote.doubt == wear::Doubt::none) return {};
  if (!asymptote.confirmed_by_history) return {.volume = asymptote.worn_volume, .depth = asymptote.largest_depth};
  if (const wear::OtherState* other = rival(asymptote))
    return {.volume = std::abs(other->worn_volume - asymptote.worn_volume),
            .depth = std::abs(other->largest_depth - asymptote.largest_depth)};
  return within_nodes(cells, asymptote);
}

/// A contact node at an end of what bears of a flank.
struct EndNode {
  std::size_t node = 0;
  double half_length = 0;  ///< along the flank, m
};

std::vector<EndNode> end_nodes(const Scene& scene, const CandidateResult& result) {
  const fem::ContactCells& cells = result.model.cells;
  const std::vector<steady::NodeSummary>& nodes = result.unworn->state.nodes;
  std::vector<EndNode> found;
  std::size_t first = 0;
  for (const fem::FlankCells& flank : cells.flanks) {
    const bool on_the_left = &flank == &cells.flanks.front();
    const double length = on_the_left ? scene.geometry.left.length : scene.geometry.right.length;
    for (const std::vector<double>& ends : flank.across) {
      std::size_t low = 0, high = ends.size() - 2;
      while (low < high && !nodes[first + low].carries_load) ++low;
      while (low < high && !nodes[first + high].carries_load) --high;
      for (const std::size_t end : {low, high})
        found.push_back({.node = first + end, .half_length = (ends[end + 1] - ends[end]) * length / 2});
      first += ends.size() - 1;
    }
  }
  return found;
}

struct Unseen {
  double volume = 0, depth = 0, energy = 0;  ///< m^3, m, J per cycle
};

/// Zones narrower than half a node at the ends of the contact are not seen. Such a one of width w wears until the load
/// that compresses it has gone: its end is as deep as p w / E under the pressure p, as the pressure peaks there, and on
/// rough flanks by what p compresses their asperities besides; its volume is that of a wedge. Until then it slips by
/// what the change of the pressure in a period compresses it, at its end there and back, in the mean half of that, and
/// in the mean under half the pressure. Where the pressure changes little only a part of it slips, which grows with
/// that change.
Unseen unseen(const Scene& scene, const CandidateResult& result) {
  // Of 90 joints without wear (studies/error_bars, seeds 2 and 3) finer meshes found a tenth of that energy in three,
  // 0.4 and all of it in one each, where other parts of the bar were larger than it, and next to none in the others:
  // none where no node at an end of a flank lifts off. All of the zone counts from a change by a quarter of the
  // pressure on.
  constexpr double kSlipping = 0.3, kAllOfIt = 0.25;
  const double modulus = std::min(scene.blade.youngs_modulus, scene.disk.youngs_modulus);
  const double roughness = scene.contact.normal_stiffness;
  Unseen left;
  for (const auto& [i, width] : end_nodes(scene, result)) {
    const steady::NodeSummary& node = result.unworn->state.nodes[i];
    const double area = result.model.cells.area[static_cast<Eigen::Index>(i)] / 2;
    const double asperities = roughness > 0 ? node.max_pressure / roughness : 0;
    const double wedge = node.max_pressure * width / modulus;
    const double change = node.max_pressure - node.min_pressure;
    const double part = change > 0 ? std::min(1.0, change / (kAllOfIt * node.max_pressure)) : 0;
    const double slip = change * part * width / modulus;
    left.depth = std::max(left.depth, asperities + wedge);
    left.volume += (asperities + wedge) * area / 2;
    left.energy += kSlipping * scene.contact.friction * node.max_pressure / 2 * part * area * slip;
  }
  return left;
}

/// By how much the joint would vibrate otherwise if those zones were worn off, where there are any: what a zone bears
/// goes to the rest, and stiffness is lost in proportion to its width. So of what changes where the whole nodes bear
/// nothing a half is left.
struct UnseenDrift {
  double drift = 0, amplitude = 0;  ///< relative; of the output
};
std::optional<UnseenDrift> unseen_drift(const Scene& scene, const CandidateResult& result) {
  steady::Joint joint{.model = result.model.condensed, .options = steady_options(scene.solver)};
  joint.options.budget = new_budget(scene.solver, result.model);
  joint.condition.released.assign(result.unworn->state.nodes.size(), 0);
  for (const EndNode& end : end_nodes(scene, result)) joint.condition.released[end.node] = 1;
  const wear::Drift found = wear::resonance_drift(joint, *result.unworn, {});
  if (found.worn.status != Status::converged) return {};
  return UnseenDrift{.drift = std::abs(found.drift) / 2,
                     .amplitude = std::abs(found.worn.amplitude - result.unworn->amplitude) / 2};
}

/// What the nodes at the ends of slipping zones leave open of the friction energy, J per cycle.
double slip_at_zone_ends(const CandidateResult& result) {
  const std::vector<steady::NodeSummary>& nodes = result.unworn->state.nodes;
  Eigen::VectorXd energy(static_cast<Eigen::Index>(nodes.size()));
  std::vector<bool> loaded(nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    energy[static_cast<Eigen::Index>(i)] = nodes[i].dissipated_energy;
    loaded[i] = nodes[i].carries_load;
  }
  return energy_left_open(result.model.cells, energy, loaded);
}

void set_within_range(Scene& scene, const char* key, double value) {
  const Range& range = find_parameter(key)->range;
  set_parameter(scene, key, std::clamp(value, range.lower, range.upper));
}

/// The design on a mesh whose elements in the section, but for those along the flanks, are `ratio` times as large.
Scene resized_section(Scene scene, double ratio) {
  for (const char* key : {"mesh.fillet_fraction", "mesh.blend_fraction", "mesh.bulk_size_mm"})
    set_within_range(scene, key, ratio * parameter(scene, key));
  return scene;
}

/// Hardly anything bears, and on other nodes nothing does: that is no worn state.
void refuse_worn_state(const std::string& status, Evaluation& evaluation) {
  evaluation.status = status;
  evaluation.error_sources.clear();
  for (const char* name : {"asymptotic_wear_volume_m3", "asymptotic_wear_depth_max_m", "resonance_drift",
                           "worn_resonance_hz", "worn_peak_amplitude_m"})
    evaluation.responses.erase(name);
  evaluation.messages.push_back(
      "A worn state was found in which hardly anything bears; on another mesh or longer contact nodes there is "
      "none.");
}

/// What the length of the contact node at the peak of pressure may take from it, as a part of the peak; 0 where the
/// peak is not at an end of a flank. A sharp end of rigid flanks has p = K/sqrt(x). A radius R ends that at the length
/// d where the flank has fallen behind by what such a pressure compresses, d^(3/2) = K R/E* (2 E* = E/(1 - nu^2) of
/// equal bodies): a node of length c beside it has p = 2 K/sqrt(c) and c/d = E* c/(R p/2). Springs of stiffness k
/// between rough flanks end it at E*/k. Peaks on 24 and 48 edges of the quickstart and of hollow and crowned flanks
/// with radii of 5 to 100 mm are 0.009 (c/d)^2 in the median off those on 160, and 0.017 (c/d)^2 at most. On rough
/// flanks of 1e13 to 3e14 N/m^3 peaks on 24 edges are at most 0.25 c k/E* below what 24, 48 and 96 edges come to.
double node_at_peak(const Scene& scene, const CandidateResult& result) {
  constexpr double kOfRounding = 0.01, kOfRoughness = 0.3;  // the first beside what meshes and other nodes say
  constexpr double kBeside = 1.5;  // the peak is no farther from the end of the flank, by the length that rounds it off
  const auto plane = [](const fem::Material& of) {
    return (1 - of.poisson_ratio * of.poisson_ratio) / of.youngs_modulus;
  };
  const double compliance = plane(scene.blade) + plane(scene.disk);  // 1/E*
  const double roughness = scene.contact.normal_stiffness;
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  Eigen::Index node = 0;
  const double peak = result.model.preload.pressure.maxCoeff(&node);
  Eigen::Index first = 0;
  for (const fem::FlankCells& flank : result.model.cells.flanks) {
    const geometry::FlankParameters& form =
        &flank == &result.model.cells.flanks.front() ? scene.geometry.left : scene.geometry.right;
    const double rounded =
        std::max(geometry::rounded_length(form.edge_radius), roughness > 0 ? 1 / (roughness * compliance) : 0);
    const double beside = kBeside * rounded / form.length;
    for (const std::vector<double>& ends : flank.across)
      for (std::size_t k = 0; k + 1 < ends.size(); ++k, ++first) {
        if (first != node || (ends[k] > beside && ends[k + 1] < 1 - beside)) continue;
        const double length = (ends[k + 1] - ends[k]) * form.length;
        const double radii = form.edge_radius > 0 ? length / (form.edge_radius * peak * compliance / 2) : kInfinite;
        const double springs = roughness > 0 ? length * roughness * compliance : kInfinite;
        return std::min(kOfRounding * radii * radii, kOfRoughness * springs);
      }
  }
  return 0;
}

/// The bar of the peak of pressure at ends of flanks that are round or rough. Meshes that do not resolve it may agree
/// by accident, so the length of the node counts beside them. Where crowned flanks have their peak inside, it is up to
/// 0.4 % off. A bar of more than a quarter of the peak is none: shapes that these figures know nothing of, as reliefs,
/// have been seen 1.2 of their bar off where it was 0.47 of the peak.
void add_peak_pressure(const Scene& scene, CandidateResult& result, Bars& bars) {
  constexpr double kAnywhere = 0.004, kNone = 0.25;
  const char* name = "contact_pressure_max_pa";
  const double peak = result.evaluation.responses.at(name);
  bars.add("contact_grid", name, (kAnywhere + node_at_peak(scene, result)) * peak);
  double sum = 0;
  for (const auto& [source, bar] : result.evaluation.error_sources.at(name)) sum += bar;
  if (sum <= kNone * peak) return;
  bars.leave_open(name);
  result.evaluation.messages.push_back(
      "The mesh does not resolve the pressure at the ends of the flanks: more mesh.flank_elements would.");
}

}  // namespace

Scene resized(Scene scene, double ratio) {
  const auto fewer = [&](const char* key) {
    const double count = parameter(scene, key);
    if (count > 0)
      set_within_range(scene, key, std::max(2.0, std::round(count / ratio)));  // 0: as many as the mesh has
  };
  fewer("mesh.flank_elements");
  fewer("mesh.aerofoil_elements");
  if (!scene.in_space()) return resized_section(std::move(scene), ratio);
  for (const char* key : {"mesh.slot_elements", "mesh.contact_slot_elements", "mesh.contact_flank_elements"})
    fewer(key);
  return scene;
}

OtherMeshes::OtherMeshes(const Scene& reference) {
  const std::vector<double> ratios =
      reference.in_space() ? std::vector<double>{1.5, 2} : std::vector<double>{1 / 1.5, 1.5};
  for (const double ratio : ratios)
    meshes_.push_back({.ratio = ratio, .builder = ModelBuilder(resized(reference, ratio))});
  if (reference.in_space()) finer_section_.emplace(resized_section(reference, kSectionRatio));
}

void add_error_bars(const Scene& scene, const ModelBuilder& builder, const OtherMeshes& others,
                    CandidateResult& result) {
  Bars bars(result);
  const auto companion = [](const Scene& of, CandidateModel on, const Computation& how) {
    if (on.converged()) renew_budget(of.solver, on);
    return computed(of, std::move(on), how).evaluation;
  };
  // Where the history decided, it does so for the companions.
  Computation as_here;
  as_here.history = result.asymptote->decided_by == wear::FoundBy::history;
  const auto cells = [&as_here](double longer) {
    Computation how = as_here;
    how.contact.lengths.finest *= longer;
    how.contact.lengths.coarsest *= longer;
    return how;
  };
  std::vector<Evaluation> answers;
  std::vector<Companion> meshes;
  answers.reserve(others.meshes().size());
  bool finer = false;
  for (const auto& [sizes, on_it] : others.meshes()) {
    const Scene resized_scene = resized(scene, sizes);
    // The coarsest meshes there are end the way down.
    const double ratio = static_cast<double>(scene.mesh.flank_elements) / resized_scene.mesh.flank_elements;
    answers.push_back(companion(resized_scene, on_it.build(resized_scene), as_here));
    if (finer || ratio == 1) continue;  // 1: a mesh that is as large as meshes may be
    meshes.push_back({&answers.back(), [ratio, in_space = scene.in_space()](const std::string& response) {
                        return left_over(mesh_order(response, in_space), ratio);
                      }});
    finer = ratio < 1 && answers.back().converged();
  }
  bars.add("mesh", meshes, result.evaluation);
  if (const ModelBuilder* on_it = others.finer_section()) {
    Computation how;
    how.wear = false;
    const Evaluation finer_section = companion(scene, on_it->build(resized_section(scene, kSectionRatio)), how);
    bars.add("mesh",
             {{&finer_section,
               [](const std::string& response) { return left_over(mesh_order(response, true), kSectionRatio); }}},
             result.evaluation);
  }
  const Evaluation longer = companion(scene, result.model, cells(kGridRatio));
  const std::string slides = "asymptote: " + std::string(to_string(Status::gross_sliding));
  if (result.asymptote->bearing.doubtful() &&
      (longer.status == slides ||
       std::ranges::any_of(answers, [&](const Evaluation& answer) { return answer.status == slides; })))
    return refuse_worn_state(slides, result.evaluation);
  // A finer mesh has shorter nodes, too: a part of what longer ones change remains beside it. Of what the ends of worn
  // zones decide the larger of the two counts whole, as two meshes may by accident agree.
  constexpr double kAgain = 0.25;
  bars.add("contact_grid", {{&longer, grid_factor(finer ? kAgain : 1)}}, result.evaluation);
  if (finer)
    for (const char* name : {"asymptotic_wear_volume_m3", "asymptotic_wear_depth_max_m", "resonance_drift"}) {
      std::map<std::string, double>& of = result.evaluation.error_sources[name];
      bars.add("contact_grid", name, (1 - kAgain) * std::max(0.0, of["contact_grid"] / kAgain - of["mesh"]));
    }
  double slip_left_open = slip_at_zone_ends(result);  // J per cycle
  const dynamics::CondensedModel& condensed = *result.model.condensed;
  const double volume_per_energy = condensed.wear_law().volume_per_energy(condensed.wear_node(0));
  // Worn zones narrower than the contact nodes are not seen.
  if (result.asymptote->worn_volume == 0 && volume_per_energy > 0) {
    const Evaluation shorter = companion(scene, result.model, cells(0.5));
    bars.add("contact_grid", {{&shorter, share(2)}}, result.evaluation);
    const Unseen zone = unseen(scene, result);
    bars.add("contact_grid", "asymptotic_wear_volume_m3", zone.volume);
    bars.add("contact_grid", "asymptotic_wear_depth_max_m", zone.depth);
    if (const std::optional<UnseenDrift> drift = unseen_drift(scene, result)) {
      bars.add("contact_grid", "resonance_drift", drift->drift);
      bars.add("contact_grid", "worn_resonance_hz", drift->drift * result.evaluation.responses.at("resonance_hz"));
      bars.add("contact_grid", "worn_peak_amplitude_m", drift->amplitude);
    } else {
      for (const char* name : {"resonance_drift", "worn_resonance_hz", "worn_peak_amplitude_m"}) bars.leave_open(name);
    }
    slip_left_open += zone.energy;
    if (zone.energy > result.evaluation.responses.at("dissipated_energy_j"))
      result.evaluation.messages.push_back(
          "Slip at the ends of the flanks in zones narrower than half a contact node is not seen: the energy may be as "
          "large as its error bar.");
  }
  bars.add("contact_grid", "dissipated_energy_j", slip_left_open);
  // What friction takes from a vibration is a part of what the load brings, and the amplitude changes by that part.
  bars.add("contact_grid", "peak_amplitude_m",
           result.unworn->amplitude * slip_left_open / result.unworn->state.input_energy);
  bars.add("contact_grid", "initial_wear_rate_m3_per_cycle", volume_per_energy * slip_left_open);

  // What the other settings leave hardly depends on the mesh: it is asked where a design costs least, and where that
  // has no answer on a finer one. In space a coarser mesh has two or three cells in a worn zone, which come and go with
  // the harmonics.
  struct Base {
    const ModelBuilder* builder;
    Scene scene;
    const Evaluation* answer;
    std::optional<CandidateModel> model;
  };
  std::vector<Base> bases;
  for (std::size_t i = 0; i < answers.size(); ++i)
    if (const auto& [ratio, on_it] = others.meshes()[i]; ratio > 1 && answers[i].converged() && !scene.in_space())
      bases.push_back({&on_it, resized(scene, ratio), &answers[i], {}});
  bases.push_back({&builder, scene, &result.evaluation, result.model});
  using Change = std::function<void(Scene&, Computation&)>;
  const auto ask = [&](const char* source, double factor, const std::vector<Change>& changes) {
    Evaluation answer;
    for (Base& base : bases)
      for (const Change& change : changes) {
        Scene changed = base.scene;
        Computation how = as_here;
        change(changed, how);
        if (!base.model) base.model = base.builder->build(base.scene);
        const bool same = changed.solver.modes == base.scene.solver.modes;
        answer = companion(changed, same ? *base.model : base.builder->build(changed), how);
        if (answer.converged()) return bars.add(source, {{&answer, share(factor)}}, *base.answer);
      }
    bars.add(source, {{&answer, share(factor)}}, result.evaluation);
  };
  const int harmonics = scene.solver.harmonics, more_harmonics = 2 * harmonics + 1;
  // Contact nodes of a study have no mass.
  const quality::TruncationFactors factors = quality::truncation_factors(true);
  ask("harmonics", factors.harmonics, {[&](Scene& changed, Computation&) {
        changed.solver.harmonics = more_harmonics;
        changed.solver.samples = quality::samples_for(changed.solver.harmonics, changed.solver.samples);
      }});
  ask("samples", factors.samples, {[](Scene& changed, Computation&) { changed.solver.samples *= 2; }});
  ask("pseudo_penalty", factors.penalty,
      {[](Scene&, Computation& how) { how.penalty_scale = 0.5; },
       [](Scene&, Computation& how) { how.penalty_scale = 2; }});
  ask("modes", 1.5, {[](Scene& changed, Computation&) {
        constexpr int kMore = 10;  // one more may be one that the load does not move
        changed.solver.modes = std::max(2 * changed.solver.modes, changed.solver.modes + kMore);
      }});

  bars.add("mesh", "blade_fillet_stress_pa", result.blade_fillet->aggregate_error);
  bars.add("mesh", "disk_fillet_stress_pa", result.disk_fillet->aggregate_error);
  bars.add("mesh", "peak_stress_pa", std::max(result.blade_fillet->maximum_error, result.disk_fillet->maximum_error));
  const double tolerance = paths::ResonanceOptions{}.frequency_tolerance;
  for (const char* name : {"resonance_hz", "worn_resonance_hz"})
    bars.add("search", name, tolerance * result.evaluation.responses.at(name));
  bars.add("search", "resonance_drift", 2 * tolerance);
  const std::map<std::string, double>& responses = result.evaluation.responses;
  const double volume = responses.at("asymptotic_wear_volume_m3");
  // What wear changes, it changes in proportion to the volume.
  const auto worn_otherwise = [&](const char* source, const WornChange& doubt, bool ends_alone) {
    bars.add(source, "asymptotic_wear_volume_m3", doubt.volume);
    bars.add(source, "asymptotic_wear_depth_max_m", doubt.depth);
    const double share = volume > 0 ? doubt.volume / volume : 0;
    const double drift = std::abs(responses.at("resonance_drift"));
    bars.add(source, "resonance_drift", share * drift);
    bars.add(source, "worn_resonance_hz", share * drift * responses.at("resonance_hz"));
    // On what the ends of worn zones bear the amplitude hardly depends.
    if (ends_alone) return;
    bars.add(source, "worn_peak_amplitude_m",
             share * std::abs(responses.at("worn_peak_amplitude_m") - responses.at("peak_amplitude_m")));
  };
  // Of a zone of width w the depth grows like its power 3/2, the volume like 5/2.
  if (const double moved = result.evaluation.model.at("contact_edges_moved_share"); moved > 0)
    worn_otherwise("edge",
                   {.volume = std::min(1.0, 2.5 * moved) * volume,
                    .depth = std::min(1.0, 1.5 * moved) * responses.at("asymptotic_wear_depth_max_m")},
                   result.evaluation.model.at("contact_edges_moved_share") < 1);
  if (const WornChange doubt = left_in_doubt(result.model.cells, *result.asymptote); doubt.volume > 0)
    worn_otherwise("history", doubt, result.asymptote->confirmed_by_history);
  if (const wear::OtherState* other = rival(*result.asymptote)) {
    // On what the ends of worn zones bear the amplitude hardly depends; on a whole other state it may.
    steady::Joint joint{.model = result.model.condensed, .options = steady_options(scene.solver)};
    joint.options.budget = new_budget(scene.solver, result.model);
    const wear::Drift elsewhere = wear::resonance_drift(joint.worn(other->depth), *result.worn, {});
    const double worn = responses.at("worn_peak_amplitude_m");
    bars.add("history", "worn_peak_amplitude_m",
             std::abs(worn - (elsewhere.worn.status == Status::converged ? elsewhere.worn.amplitude
                                                                         : responses.at("peak_amplitude_m"))));
  }
  // A joint that does not wear vibrates as it did.
  if (result.asymptote->worn_volume == 0)
    for (const auto& [worn, same] :
         {std::pair{"worn_resonance_hz", "resonance_hz"}, std::pair{"worn_peak_amplitude_m", "peak_amplitude_m"}})
      for (const auto& [source, bar] : result.evaluation.error_sources.at(same)) {
        double& of_worn = result.evaluation.error_sources[worn][source];
        of_worn = std::max(of_worn, bar);
      }
  const std::vector<std::string> endless = responses_without_limit(scene);
  for (const std::string& name : endless) bars.leave_open(name);
  if (endless.empty()) add_peak_pressure(scene, result, bars);
  bars.total();
}

}  // namespace dovetail::optimizer
