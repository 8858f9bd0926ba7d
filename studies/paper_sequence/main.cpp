// The sequence of the reference for a scene, as figures, tables and a page: studies/paper_section/run runs it.
#include "studies/paper_sequence/compute.hpp"
#include "studies/paper_sequence/page.hpp"
#include "studies/paper_sequence/scene_words.hpp"
#include "studies/program/study_file/study.hpp"
#include "studies/ready_study/program.hpp"

namespace {

using namespace dovetail;

std::vector<std::string> run(const ready_study::Call& call, bool converge) {
  studies::Study study = studies::load_study(call.study_file);
  const paper_sequence::SceneWords& words = paper_sequence::scene_words(study.scene);
  paper_sequence::ComputeOptions options = words.options;
  options.progress = [&](const std::string& what) { call.say(what); };
  if (call.quick) {
    study.scene.mesh.flank_elements = words.quick_flank_elements;
    study.scene.mesh.aerofoil_elements = words.quick_aerofoil_elements;
    study.scene.mesh.bulk_size *= 1.6;
    study.scene.solid_mesh.slot_elements = 4;
    study.scene.solid_mesh.contact_slot_elements = 0;
    options.curve_points = 21;
    options.history_steps = 16;
    options.curve_states = 4;
    options.nodal_diameter_modes = 2;
  }
  paper_sequence::Results results = paper_sequence::compute(study.scene, options);
  results.made = call.made(study.text);
  paper_sequence::write(call.folder, results);
  if (converge) {
    paper_sequence::ConvergenceOptions levels;
    if (call.quick) levels = {.mesh_factors = {1.25, 1}, .modes = {20}, .harmonics = {1, 3}, .samples = {64, 128}};
    levels.progress = options.progress;
    results.convergence = paper_sequence::convergence(study.scene, levels);
    results.made = call.made(study.text);
    paper_sequence::write(call.folder, results);
  }
  return results.failures;
}

}  // namespace

int main(int argc, char** argv) {
  bool converge = false;
  return ready_study::run(
      argc, argv,
      {.page = "report.html",
       .about = "Vibration and fretting wear of a bladed disk, in a plane section or in space, figure by figure.",
       .files = "report.html, the CSV files and the JSON files",
       .quick = "A coarse mesh and few steps, in seconds: a look at the page",
       .flags = {{"--convergence", "Also over mesh, modes, harmonics and samples: a table", &converge}},
       .run = [&](const ready_study::Call& call) { return run(call, converge); }});
}
