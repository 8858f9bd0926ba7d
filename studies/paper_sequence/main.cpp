// The sequence of the reference for a scene, as figures, tables and a page: studies/paper_sequence/run runs it.
#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <string>

#include "core/errors.hpp"
#include "numerics/blas.hpp"
#include "studies/paper_sequence/compute.hpp"
#include "studies/paper_sequence/page.hpp"
#include "studies/paper_sequence/scene_words.hpp"
#include "studies/program/study_file/study.hpp"

int main(int argc, char** argv) try {
  dovetail::numerics::prepare_blas(argv);
  using namespace dovetail;
  CLI::App app{"Vibration and fretting wear of a bladed disk, in a plane section or in space, figure by figure."};
  std::string folder, study_file, commit = "unknown";
  bool quick = false, converge = false;
  app.add_option("folder", folder, "Folder of report.html, the CSV files and the JSON files")->required();
  app.add_option("--study", study_file, "Study file of the scene")->required();
  app.add_option("--commit", commit, "Commit of the sources, to be recorded");
  app.add_flag("--quick", quick, "A coarse mesh and few steps, in seconds: a look at the page");
  app.add_flag("--convergence", converge, "Also over mesh, modes, harmonics and samples: a table");
  CLI11_PARSE(app, argc, argv);
  const auto begin = std::chrono::steady_clock::now();
  const auto passed = [&] { return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(); };
  studies::Study study = studies::load_study(study_file);
  const paper_sequence::SceneWords& words = paper_sequence::scene_words(study.scene);
  paper_sequence::ComputeOptions options = words.options;
  options.progress = [&](const std::string& what) {
    std::printf("%6.1f s  %s\n", passed(), what.c_str());
    std::fflush(stdout);
  };
  if (quick) {
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
  results.quick = quick;
  results.study_text = study.text;
  results.commit = commit;
  results.seconds = passed();
  paper_sequence::write(folder, results);
  if (converge) {
    paper_sequence::ConvergenceOptions levels;
    if (quick) levels = {.mesh_factors = {1.25, 1}, .modes = {20}, .harmonics = {1, 3}, .samples = {64, 128}};
    levels.progress = options.progress;
    results.convergence = paper_sequence::convergence(study.scene, levels);
    results.seconds = passed();
    paper_sequence::write(folder, results);
  }
  options.progress("done: " + folder + "/report.html");
  for (const std::string& failure : results.failures) std::fprintf(stderr, "%s\n", failure.c_str());
  return results.failures.empty() ? 0 : 3;
} catch (const dovetail::InputError& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
