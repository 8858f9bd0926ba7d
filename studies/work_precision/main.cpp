// Seconds against error over every setting of the program, as tables and a page: studies/speed_vs_error runs it.
#include <filesystem>

#include "studies/ready_study/program.hpp"
#include "studies/work_precision/diagrams.hpp"
#include "studies/work_precision/evaluations/measured_scenes.hpp"
#include "studies/work_precision/results.hpp"

namespace {

using namespace dovetail::work_precision;

/// What is measured; none chosen: engine and section.
struct Parts {
  bool engine = false;   ///< the contact engine alone
  bool section = false;  ///< whole evaluations of the section
  bool sector = false;   ///< and of the sector in space

  [[nodiscard]] bool none() const { return !engine && !section && !sector; }
};

class Study {
 public:
  Study(const dovetail::ready_study::Call& call, const Parts& parts) : call_(call), parts_(parts) {
    results_.made = circumstances();
    results_.made.commit = call.commit;
    results_.made.quick = call.quick;
  }

  void run() {
    if (parts_.engine || parts_.none()) engine();
    if (parts_.section || parts_.none())
      results_.evaluations = measure_section(call_.study_file, call_.quick, progress(), [&](const auto& so_far) {
        results_.evaluations = so_far;
        keep();
      });
    if (parts_.sector) sector();
    keep();
  }

 private:
  [[nodiscard]] std::function<void(const std::string&)> progress() const {
    return [this](const std::string& what) { call_.say(what); };
  }

  /// What there is so far stays when the rest is interrupted.
  void keep() {
    results_.made.seconds = call_.passed();
    write(call_.folder, results_);
  }

  void engine() {
    const DiagramOptions options{.study_file = call_.study_file, .quick = call_.quick, .progress = progress()};
    results_.diagrams.push_back(patch_diagram(options));
    keep();
    results_.diagrams.push_back(scene_diagram(options));
    keep();
    results_.growth = measure_growth(options.quick, options.progress);
    keep();
  }

  void sector() {
    const auto file =
        std::filesystem::path(call_.study_file).parent_path().parent_path() / "bladed_disk_2009" / "study.toml";
    const std::vector<WholeDiagram> before = results_.evaluations;
    const auto beside = [&](const WholeDiagram& diagram) {
      results_.evaluations = before;
      results_.evaluations.push_back(diagram);
      keep();
    };
    beside(measure_sector(file.string(), call_.quick, {.progress = progress(), .more = beside}));
  }

  const dovetail::ready_study::Call& call_;
  Parts parts_;
  Results results_;
};

}  // namespace

int main(int argc, char** argv) {
  Parts parts;
  return dovetail::ready_study::run(
      argc, argv,
      {.page = "index.html",
       .about = "Seconds on one core against true error, of the contact engine and of whole evaluations.",
       .files = "table.csv, growth.csv, evaluations.csv, table.json and index.html",
       .quick = "Small models and few settings: a look at the page",
       .flags = {{"--engine", "The contact engine alone", &parts.engine},
                 {"--section", "Whole evaluations of the section; with none of the three, as with the first two",
                  &parts.section},
                 {"--sector", "Whole evaluations of the sector in space", &parts.sector}},
       .run = [&](const dovetail::ready_study::Call& call) -> std::vector<std::string> {
         Study(call, parts).run();
         return {};
       }});
}
