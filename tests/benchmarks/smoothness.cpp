// How smooth the responses are along each design variable of a study, through its start design:
//   build/tests/benchmarks/smoothness STUDY.toml [POINTS=41] [PAGE.html]
// Prints, per variable and response, the largest jump, and writes the lines as a page of plots.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

#include "core/errors.hpp"
#include "numerics/process.hpp"
#include "optimizer/evaluator.hpp"
#include "studies/program/engine/engine.hpp"
#include "studies/program/study_file/study.hpp"
#include "studies/report/pages/page.hpp"
#include "studies/report/plots/figure.hpp"
#include "studies/report/words/html.hpp"
#include "tests/benchmarks/largest_jump.hpp"

namespace dovetail {
namespace {

const std::vector<std::string> kResponses{"resonance_hz",
                                          "peak_amplitude_m",
                                          "blade_fillet_stress_pa",
                                          "disk_fillet_stress_pa",
                                          "contact_pressure_max_pa",
                                          "initial_wear_rate_m3_per_cycle",
                                          "asymptotic_wear_volume_m3",
                                          "asymptotic_wear_depth_max_m",
                                          "resonance_drift"};

int run(const std::string& file, int points, const std::string& page) {
  const studies::Study study = studies::load_study(file);
  const auto evaluator = studies::scene_evaluator(study);
  std::string body = "<h1>Responses along lines through the start design</h1>";
  for (const optimizer::DesignVariable& variable : study.problem.space.variables()) {
    std::vector<double> x;
    std::vector<std::vector<double>> y(kResponses.size());
    int failed = 0;
    for (int i = 0; i < points; ++i) {
      optimizer::Scene scene = study.scene;
      const double value = variable.lower + (variable.upper - variable.lower) * i / (points - 1);
      optimizer::set_parameter(scene, variable.key, value);
      const optimizer::Evaluation evaluation = evaluator->evaluate(scene, optimizer::kSearch).evaluation;
      std::fprintf(stderr, "%s = %g: %s\n", variable.key.c_str(), value, evaluation.status.c_str());
      if (!evaluation.converged()) {
        ++failed;
        continue;
      }
      x.push_back(value);
      for (std::size_t r = 0; r < kResponses.size(); ++r) y[r].push_back(evaluation.responses.at(kResponses[r]));
    }
    body += "<h2>" + report::escape(variable.key) + "</h2>";
    std::vector<report::Figure> figures;
    for (std::size_t r = 0; r < kResponses.size(); ++r) {
      std::printf("%-34s %-32s largest jump %.2e%s\n", variable.key.c_str(), kResponses[r].c_str(), largest_jump(y[r]),
                  failed > 0 ? "  (points missing)" : "");
      figures.emplace_back(report::Plot{.title = kResponses[r],
                                        .x = {.label = variable.key},
                                        .series = {{.x = x, .y = y[r], .mark = report::Mark::dot}}});
    }
    body += report::figures_html(figures);
    std::fflush(stdout);
  }
  std::ofstream out(page);
  out << report::page("Smoothness", "", body);
  return out ? 0 : 1;
}

}  // namespace
}  // namespace dovetail

int main(int argc, char** argv) {
  if (argc < 2) {
    std::cerr << "usage: smoothness STUDY.toml [POINTS] [PAGE.html]\n";
    return 2;
  }
  dovetail::numerics::prepare_process(argv);
  try {
    return dovetail::run(argv[1], argc > 2 ? std::max(4, std::atoi(argv[2])) : 41,
                         argc > 3 ? argv[3] : "smoothness.html");
  } catch (const dovetail::InputError& error) {
    std::cerr << error.what() << '\n';
    return 2;
  }
}
