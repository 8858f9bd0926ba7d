#pragma once

#include <map>
#include <string>
#include <vector>

#include "studies/program/study_file/study.hpp"
#include "studies/work_precision/evaluations/setting.hpp"

namespace dovetail::work_precision {

/// One whole evaluation without bars, as a search asks for it, up to the last response.
struct WholeRun {
  WholeSetting setting;
  std::string status;        ///< of the evaluation
  double seconds = 0;        ///< processor time of the evaluation, median where it was repeated
  double setup_seconds = 0;  ///< of what a search does once for all its designs: the topology of the mesh
  int repetitions = 1;       ///< evaluations that `seconds` is of
  double dofs = 0;           ///< unknowns of the mesh
  int contact_nodes = 0;     ///< at the end
  bool in_steps = false;     ///< worn by the paper's history and not by the direct method
  std::map<std::string, double> timings_s = {};  ///< by stage, wall clock, of the first evaluation
  std::map<std::string, double> responses = {};  ///< of the stages come through

  [[nodiscard]] bool converged() const { return optimizer::converged(status); }
};

/// A design of a study whose evaluations are measured. All runs are kept: asked for again they cost nothing.
class MeasuredDesign {
 public:
  /// The file's own design, or the one whose variables have these values.
  explicit MeasuredDesign(studies::Study study, const std::map<std::string, double>& variables = {});

  const WholeRun& operator()(const WholeSetting& setting);
  /// Once more, for a better number of seconds.
  void repeat(const WholeSetting& setting);

  [[nodiscard]] const studies::Study& study() const { return study_; }
  /// What fixes the topology of the mesh.
  [[nodiscard]] const optimizer::Scene& reference() const { return reference_; }
  [[nodiscard]] int edges_of_file() const { return study_.scene.mesh.flank_elements; }

 private:
  studies::Study study_;
  optimizer::Scene reference_;
  struct Kept {
    WholeRun run;
    std::vector<double> seconds;
  };
  std::map<WholeSetting, Kept> kept_;
};

/// The study of a file with all elements of its mesh so much larger.
[[nodiscard]] studies::Study load_coarser(const std::string& file, double coarser);

/// Designs from the box of the study's variables at random, by seed: the first `count` of them that wear, by an
/// evaluation at the file's settings. Values of the variables by key.
[[nodiscard]] std::vector<std::map<std::string, double>> random_designs(const studies::Study& study, int count,
                                                                        int seed);

}  // namespace dovetail::work_precision
