// A straight slot against a skewed one in space, as a page, tables and JSON: studies/skewed_slot/run runs it.
#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <string>

#include "core/errors.hpp"
#include "numerics/blas.hpp"
#include "studies/program/study_file/study.hpp"
#include "studies/skewed_slot/compute.hpp"

int main(int argc, char** argv) try {
  dovetail::numerics::prepare_blas(argv);
  using namespace dovetail;
  CLI::App app{"Pressure and slip in a straight and in a skewed dovetail slot."};
  std::string folder, study_file, commit = "unknown";
  bool quick = false;
  app.add_option("folder", folder, "Folder of report.html, the CSV files and results.json")->required();
  app.add_option("--study", study_file, "Study file of the scene")->required();
  app.add_option("--commit", commit, "Commit of the sources, to be recorded");
  app.add_flag("--quick", quick, "A coarse mesh, two angles, no wear: a look at the page");
  CLI11_PARSE(app, argc, argv);
  const auto begin = std::chrono::steady_clock::now();
  const auto passed = [&] { return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(); };
  skewed_slot::ComputeOptions options;
  options.progress = [&](const std::string& what) {
    std::printf("%6.1f s  %s\n", passed(), what.c_str());
    std::fflush(stdout);
  };
  studies::Study study = studies::load_study(study_file);
  if (quick) {
    study.scene.mesh.flank_elements = 6;
    study.scene.solid_mesh.slot_elements = 4;
    study.scene.solid_mesh.contact_slot_elements = 0;
    study.scene.mesh.aerofoil_elements = 6;
    study.scene.mesh.bulk_size = 8e-3;
    options.skew_deg = {0, 20};
    options.wear = false;
  }
  skewed_slot::Results results = skewed_slot::compute(study.scene, options);
  results.quick = quick;
  results.study_text = study.text;
  results.commit = commit;
  results.seconds = passed();
  skewed_slot::write(folder, results);
  options.progress("done: " + folder + "/report.html");
  int status = 0;
  for (const skewed_slot::Joint& joint : results.joints)
    if (joint.status != "converged") {
      std::fprintf(stderr, "%g degrees: %s\n", joint.skew_deg, joint.status.c_str());
      status = 3;
    }
  for (const skewed_slot::Wear& wear : results.wear)
    if (wear.status != "converged") {
      std::fprintf(stderr, "wear with %g degrees: %s\n", wear.skew_deg, wear.status.c_str());
      status = 3;
    }
  return status;
} catch (const dovetail::InputError& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
