#pragma once

#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/enum_names.hpp"
#include "optimizer/accuracy/choice.hpp"
#include "studies/work_precision/evaluations/design.hpp"

namespace dovetail::work_precision {

inline constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

/// A setting, computed and held against the reference.
struct WholePoint {
  std::string label;  ///< "H = 3"
  WholeRun run;
  std::map<std::string, double> error = {};  ///< of every response the reference has, relative; NaN where there is none
  double worst = kUnknown;                   ///< the largest over the responses that are judged
};

/// What a line of points varies.
enum class WholeSweep {
  mesh,
  beside,  ///< the mesh beside the flanks
  harmonics,
  samples,
  modes,
  resonance_tolerance,
  tolerance,
  combinations,  ///< of all, at random
  descent,       ///< from the cheapest known setting to coarser ones
  paper
};
constexpr EnumNames<WholeSweep, 10> enum_names(WholeSweep) {
  return {{{WholeSweep::mesh, "mesh"},
           {WholeSweep::beside, "beside"},
           {WholeSweep::harmonics, "harmonics"},
           {WholeSweep::samples, "samples"},
           {WholeSweep::modes, "modes"},
           {WholeSweep::resonance_tolerance, "resonance_tolerance"},
           {WholeSweep::tolerance, "tolerance"},
           {WholeSweep::combinations, "combinations"},
           {WholeSweep::descent, "descent"},
           {WholeSweep::paper, "paper"}}};
}
[[nodiscard]] constexpr std::string_view to_string(WholeSweep sweep) {
  return name_of(sweep);
}

struct WholeLine {
  WholeSweep key = WholeSweep::mesh;
  std::vector<WholePoint> points = {};
};

/// Two evaluations, each fine in its own way: by what they differ true errors are uncertain.
struct WholeReference {
  WholePoint finest, check;  ///< errors are those against `finest`
};

/// What the program chooses for an accuracy.
struct AutomaticChoice {
  double asked = 0;
  std::string status = {};         ///< of the choice, or why it was given up
  std::string most_by = {};        ///< "RESPONSE by SOURCE": what leaves most of the bar
  double relative_bar = kUnknown;  ///< that bar over the value, of what settings buy
  std::vector<optimizer::SettingsTried> rounds = {};
  double seconds = 0;  ///< processor time of all rounds
  WholePoint point = {};
};

/// Everything of one design.
struct WholeDiagram {
  std::string key = {}, title = {}, description = {};
  int edges_of_file = 0;
  std::map<std::string, double> variables = {};  ///< values by key, of a design that is not the file's
  std::vector<std::string> judged = {};          ///< responses of which the worst counts
  bool judged_by_study = true;                   ///< its objective and limits name them; else those that have a limit
  WholeReference reference = {};
  std::vector<WholeLine> lines = {};
  std::vector<AutomaticChoice> automatic = {};

  /// The largest difference of the two references over the judged responses.
  [[nodiscard]] double agreement() const { return reference.check.worst; }
  /// Points of all lines and choices, failed ones too. No reference.
  [[nodiscard]] std::vector<const WholePoint*> points() const;
  [[nodiscard]] const WholePoint* paper() const;
};

/// Name of the largest error over the judged responses, where an error of a response is asked for.
inline constexpr const char* kWorst = "";

/// Of a response, or the worst one.
[[nodiscard]] double error_of(const WholePoint& point, const std::string& response);

/// Fills errors of all points, and of the check, against the finest run.
void judge(WholeDiagram& diagram);
/// The same of a run.
[[nodiscard]] WholePoint judged_point(const WholeDiagram& diagram, const std::string& label, const WholeRun& run);

/// Points that no other one beats in both, by rising seconds and falling error.
[[nodiscard]] std::vector<const WholePoint*> front(const WholeDiagram& diagram, const std::string& response);

/// The cheapest point that errs by at most `error`; null: none.
[[nodiscard]] const WholePoint* cheapest(const WholeDiagram& diagram, const std::string& response, double error);

/// The largest of the worst errors of a point and of all known ones that are as fine or finer in every knob: what is
/// left when its own errors cancel by chance. NaN where its own error is not known.
[[nodiscard]] double steady_error(const WholeDiagram& diagram, const WholePoint& point);

/// The cheapest point whose steady error is at most `error`; null: none.
[[nodiscard]] const WholePoint* cheapest_steady(const WholeDiagram& diagram, double error);

/// A choice beside the cheapest settings known, by the worst response.
struct Comparison {
  const WholePoint* for_asked = nullptr;  ///< that err by at most what was asked for
  const WholePoint* for_error = nullptr;  ///< that err by at most what the choice errs, or by less than is resolved
  const WholePoint* steady = nullptr;     ///< that err by at most what was asked for, and known finer ones, too
  double factor_asked = kUnknown, factor_error = kUnknown, factor_steady = kUnknown;  ///< its seconds over theirs
};
[[nodiscard]] Comparison compare(const WholeDiagram& diagram, const AutomaticChoice& choice);

}  // namespace dovetail::work_precision
