#include "studies/skewed_slot/compute.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "optimizer/candidate/stopwatch.hpp"
#include "optimizer/evaluator.hpp"
#include "studies/report/record/design_record.hpp"

namespace dovetail::skewed_slot {
namespace {

constexpr const char* kSkew = "geometry.skew_angle_deg";

optimizer::Scene skewed(optimizer::Scene scene, double degrees) {
  optimizer::set_parameter(scene, kSkew, degrees);
  return scene;
}

void summarise(const optimizer::CandidateModel& model, Joint& joint) {
  double force = 0, area = 0;
  std::size_t k = 0;
  for (const fem::FlankCells& flank : model.cells.flanks)
    for (std::size_t strip = 0; strip < flank.across.size(); ++strip)
      for (std::size_t cell = 0; cell + 1 < flank.across[strip].size(); ++cell, ++k) {
        const bool inside = strip > 0 && strip + 1 < flank.across.size() && cell > 0 &&
                            cell + 2 < flank.across[strip].size();  // not on the border of the flank
        const double pressure = joint.contact.preload_pressure_pa[k];
        force += pressure * joint.contact.area_m2[k];
        area += joint.contact.area_m2[k];
        joint.pressure_max_pa = std::max(joint.pressure_max_pa, pressure);
        if (inside) joint.interior_pressure_max_pa = std::max(joint.interior_pressure_max_pa, pressure);
        joint.slip_max_m = std::max(joint.slip_max_m, joint.slip_m[k]);
      }
  joint.pressure_mean_pa = force / area;
}

Joint spun_up(const optimizer::ModelBuilder& builder, const optimizer::Scene& scene, double degrees) {
  optimizer::Stopwatch watch;
  Joint joint{.skew_deg = degrees};
  optimizer::CandidateResult candidate;
  candidate.model = builder.build(skewed(scene, degrees));
  joint.status = candidate.model.status;
  if (candidate.model.converged()) {
    joint.contact = report::contact_record(candidate);
    const Eigen::VectorXd slip = candidate.model.preload.slip_origin.rowwise().norm();
    joint.slip_m.assign(slip.data(), slip.data() + slip.size());
    summarise(candidate.model, joint);
  }
  joint.seconds = watch.lap();
  return joint;
}

Wear worn(const optimizer::SceneEvaluator& evaluator, const optimizer::Scene& scene, double degrees) {
  optimizer::Stopwatch watch;
  const optimizer::Evaluation found = evaluator.evaluate(skewed(scene, degrees), optimizer::kSearch).evaluation;
  const auto response = [&](const char* name) {
    const auto entry = found.responses.find(name);
    return entry == found.responses.end() ? std::nan("") : entry->second;
  };
  return {.skew_deg = degrees,
          .status = found.status,
          .resonance_hz = response("resonance_hz"),
          .peak_amplitude_m = response("peak_amplitude_m"),
          .volume_m3 = response("asymptotic_wear_volume_m3"),
          .depth_m = response("asymptotic_wear_depth_max_m"),
          .seconds = watch.lap()};
}

}  // namespace

Results compute(const optimizer::Scene& scene, const ComputeOptions& options) {
  Results results;
  results.scene = scene;
  const auto say = [&](const std::string& what) {
    if (options.progress) options.progress(what);
  };
  const optimizer::SceneEvaluator evaluator(skewed(scene, options.skew_deg.front()));
  for (const double degrees : options.skew_deg) {
    say(fmt::format("spin-up with {:g} degrees", degrees));
    results.joints.push_back(spun_up(evaluator.builder(), scene, degrees));
  }
  if (options.wear)
    for (const double degrees : {options.skew_deg.front(), options.skew_deg.back()}) {
      say(fmt::format("wear with {:g} degrees", degrees));
      results.wear.push_back(worn(evaluator, scene, degrees));
    }
  return results;
}

}  // namespace dovetail::skewed_slot
