// Start, nominal and robust optimum of one study side by side, as a page, a table and JSON: studies/robust/run runs it.
#include "studies/ready_study/program.hpp"
#include "studies/robust/compute.hpp"

namespace {

using namespace dovetail;

std::vector<std::string> run(const ready_study::Call& call) {
  robust::ComputeOptions options;
  options.progress = [&](const std::string& what) { call.say(what); };
  if (call.quick) {
    options.samples = 4;
    options.forces_n = {1, 5};
    options.bars = false;
    options.evaluations = 6;
  }
  robust::Results results = robust::compute(call.study_file, call.folder, options);
  results.made = call.made(results.study.text);
  robust::write(call.folder, results);
  std::vector<std::string> failures;
  for (const robust::Design& design : results.designs)
    for (const auto* of : {&design.corners, &design.samples})
      if (!of->converged()) failures.push_back(design.name + ": " + of->status);
  return failures;
}

}  // namespace

int main(int argc, char** argv) {
  return ready_study::run(argc, argv,
                          {.page = "report.html",
                           .about = "A joint that hardly wears, whatever friction, force and fit.",
                           .files = "report.html, designs.csv, results.json and the two searches",
                           .quick = "Few evaluations, no bars: a look at the page",
                           .run = run});
}
