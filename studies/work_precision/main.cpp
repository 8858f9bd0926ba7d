// Seconds against error over every setting of the program, as tables and a page: studies/speed_vs_error runs it.
#include "studies/ready_study/program.hpp"
#include "studies/work_precision/diagrams.hpp"
#include "studies/work_precision/results.hpp"

namespace {

using namespace dovetail::work_precision;

std::vector<std::string> run(const dovetail::ready_study::Call& call) {
  const DiagramOptions options{
      .study_file = call.study_file, .quick = call.quick, .progress = [&](const std::string& what) { call.say(what); }};
  Results results;
  results.made = circumstances();
  results.made.commit = call.commit;
  results.made.quick = call.quick;
  results.diagrams.push_back(patch_diagram(options));
  results.diagrams.push_back(scene_diagram(options));
  results.growth = measure_growth(options.quick, options.progress);
  results.made.seconds = call.passed();
  write(call.folder, results);
  return {};
}

}  // namespace

int main(int argc, char** argv) {
  return dovetail::ready_study::run(argc, argv,
                                    {.page = "index.html",
                                     .about = "Seconds on one core against true error of the contact engine.",
                                     .files = "table.csv, growth.csv, table.json and index.html",
                                     .quick = "Small models and few settings, in seconds: a look at the page",
                                     .run = run});
}
