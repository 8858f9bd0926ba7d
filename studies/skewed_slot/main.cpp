// A straight slot against a skewed one in space, as a page, tables and JSON: studies/skewed_slot/run runs it.
#include <fmt/format.h>

#include "studies/program/study_file/study.hpp"
#include "studies/ready_study/program.hpp"
#include "studies/skewed_slot/compute.hpp"

namespace {

using namespace dovetail;

std::vector<std::string> run(const ready_study::Call& call) {
  skewed_slot::ComputeOptions options;
  options.progress = [&](const std::string& what) { call.say(what); };
  studies::Study study = studies::load_study(call.study_file);
  if (call.quick) {
    study.scene.mesh.flank_elements = 6;
    study.scene.solid_mesh.slot_elements = 4;
    study.scene.solid_mesh.contact_slot_elements = 0;
    study.scene.mesh.aerofoil_elements = 6;
    study.scene.mesh.bulk_size = 8e-3;
    options.skew_deg = {0, 20};
    options.wear = false;
  }
  skewed_slot::Results results = skewed_slot::compute(study.scene, options);
  results.made = call.made(study.text);
  skewed_slot::write(call.folder, results);
  std::vector<std::string> failures;
  for (const skewed_slot::Joint& joint : results.joints)
    if (!optimizer::converged(joint.status))
      failures.push_back(fmt::format("{:g} degrees: {}", joint.skew_deg, joint.status));
  for (const skewed_slot::Wear& wear : results.wear)
    if (!optimizer::converged(wear.status))
      failures.push_back(fmt::format("wear with {:g} degrees: {}", wear.skew_deg, wear.status));
  return failures;
}

}  // namespace

int main(int argc, char** argv) {
  return ready_study::run(argc, argv,
                          {.page = "report.html",
                           .about = "Pressure and slip in a straight and in a skewed dovetail slot.",
                           .files = "report.html, the CSV files and results.json",
                           .quick = "A coarse mesh, two angles, no wear: a look at the page",
                           .run = run});
}
