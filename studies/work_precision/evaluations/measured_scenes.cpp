#include "studies/work_precision/evaluations/measured_scenes.hpp"

#include <fmt/format.h>

namespace dovetail::work_precision {
namespace {

constexpr int kDesignSeed = 2009;  // of the designs that are drawn
constexpr int kDesigns = 2;        // of these

}  // namespace

std::vector<WholeDiagram> measure_section(const std::string& study_file, bool quick,
                                          const std::function<void(const std::string&)>& progress,
                                          const std::function<void(const std::vector<WholeDiagram>&)>& more) {
  std::vector<WholeDiagram> all;
  const EvaluationListener listener{.progress = progress, .more = [&](const WholeDiagram& diagram) {
                                      std::vector<WholeDiagram> so_far = all;
                                      so_far.push_back(diagram);
                                      if (more) more(so_far);
                                    }};
  const EvaluationPlan own = section_plan(quick, true), other = section_plan(quick, false);
  all.push_back(measure_design(study_file, own,
                               {.key = "section",
                                .title = "Section: the quickstart's design",
                                .description = "The design of studies/quickstart/study.toml as it stands."},
                               listener));
  int number = 0;
  for (const auto& variables : random_designs(load_coarser(study_file, other.coarser), kDesigns, kDesignSeed)) {
    ++number;
    all.push_back(measure_design(
        study_file, other,
        {.key = fmt::format("section_{}", number + 1),
         .title = fmt::format("Section: drawn design {}", number),
         .description = fmt::format("Drawn from the box of the study's variables (seed {}): nothing was tuned on it.",
                                    kDesignSeed),
         .variables = variables},
        listener));
  }
  return all;
}

WholeDiagram measure_sector(const std::string& study_file, bool quick, const EvaluationListener& listener) {
  return measure_design(study_file, sector_plan(quick),
                        {.key = "sector",
                         .title = "Sector in space",
                         .description = "The sector of studies/bladed_disk_2009/study.toml. In space the finest mesh "
                                        "that fits is not much finer than the file's: true errors by the mesh are "
                                        "known to no more than the two references agree to."},
                        listener);
}

}  // namespace dovetail::work_precision
