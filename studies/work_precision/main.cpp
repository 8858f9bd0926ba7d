// Seconds against error over every setting of the program, as tables and a page: studies/speed_vs_error runs it.
#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <string>

#include "core/errors.hpp"
#include "numerics/blas.hpp"
#include "studies/work_precision/diagrams.hpp"
#include "studies/work_precision/results.hpp"

int main(int argc, char** argv) try {
  dovetail::numerics::prepare_blas(argv);
  using namespace dovetail;
  using namespace dovetail::work_precision;
  CLI::App app{"Seconds on one core against true error of the contact engine."};
  std::string folder, commit = "unknown";
  DiagramOptions options;
  app.add_option("folder", folder, "Folder of table.csv, growth.csv, table.json and index.html")->required();
  app.add_option("--study", options.study_file, "Study file of the scene")->required();
  app.add_option("--commit", commit, "Commit of the sources, to be recorded");
  app.add_flag("--quick", options.quick, "Small models and few settings, in seconds: a look at the page");
  CLI11_PARSE(app, argc, argv);
  const auto begin = std::chrono::steady_clock::now();
  options.progress = [&](const std::string& what) {
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - begin;
    std::printf("%6.1f s  %s\n", passed.count(), what.c_str());
    std::fflush(stdout);
  };
  Results results;
  results.made = circumstances();
  results.made.commit = commit;
  results.made.quick = options.quick;
  results.diagrams.push_back(patch_diagram(options));
  results.diagrams.push_back(scene_diagram(options));
  results.growth = measure_growth(options.quick, options.progress);
  results.made.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  write(folder, results);
  options.progress("done: " + folder + "/index.html");
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
