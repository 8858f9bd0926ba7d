#pragma once

#include <vector>

#include "studies/report/plots/figure.hpp"
#include "studies/report/record/run_record.hpp"

namespace dovetail::report {

/// Largest finite magnitude, 0 when there is none.
[[nodiscard]] double largest(const Numbers& values);
/// Values in a unit of `si`.
[[nodiscard]] Numbers scaled(const Numbers& values, double si);
/// A plot whose y are SI values in a unit fit for reading, with zero in its range.
[[nodiscard]] Plot readable(Plot plot, std::string_view si_unit);

/// Values of contact nodes on one line along a flank, in mm from its neck side.
[[nodiscard]] Series along_line(const Numbers& along_m, const Numbers& values, const std::vector<std::size_t>& nodes,
                                Series look);
inline const PlotAxis kAlongFlank{.label = "along the flank, from its neck side", .unit = "mm"};

/// The two designs a figure compares; `before` null: only one design is shown. `after` is never null.
struct Comparison {
  const DesignRecord* before = nullptr;
  const DesignRecord* after = nullptr;
};

/// A quantity of the contact nodes, flank by flank, for a map.
[[nodiscard]] std::vector<FlankPanel> flank_panels(const ContactRecord& contact, const Numbers& values);

/// The contact nodes spread along the slot too.
[[nodiscard]] bool in_space(const ContactRecord& contact);
/// Wear depth, pressure and slip over the flanks of a joint in space, start and best with one scale and the largest
/// value of each in words; none in the plane.
[[nodiscard]] std::vector<Figure> contact_maps(const Comparison& designs);

// Each figure is empty when the designs do not hold what it shows. Colours tell before from after; line
// strokes tell the rest.
/// Wear depth, pressure and form of the flanks; largest stress over a period along the fillets, of the side where it is
/// larger.
/// Of a design that came through without one of these, as its study does not ask for it, that figure is left out.
[[nodiscard]] std::vector<Figure> contact_plots(const Comparison& designs);
[[nodiscard]] Plot response_plot(const Comparison& designs);
[[nodiscard]] Plot nodal_diameter_plot(const DesignRecord& design);
/// The same around the resonance, with the engine orders: a multiple of the speed of rotation excites the nodal
/// diameter it comes to on so many blades, and meets a mode where its mark stands on a line. As wide as the engine
/// order nearest to the resonance asks for. Empty without a resonance or speed.
[[nodiscard]] Plot engine_order_plot(const DesignRecord& design);
/// What wear histories come to over their cycles: worn volume, largest depth, amplitude, profiles.
[[nodiscard]] std::vector<Figure> history_plots(const Comparison& designs);

/// Worn profiles of a verified design over each other: history, direct method, search.
[[nodiscard]] Plot verification_plot(const VerificationRecord& record);

/// Objective over evaluations: feasible, infeasible and best so far.
[[nodiscard]] Plot objective_plot(const RunRecord& record);
/// The (first) objective over each design variable, of all candidates.
[[nodiscard]] std::vector<Figure> variable_plots(const RunRecord& record);
/// All candidates over variables, objectives and limited responses: parallel coordinates, a scatter of any two, and the
/// numbers of those that are chosen. Empty without candidates.
[[nodiscard]] std::string candidates_chart(const RunRecord& record);
/// The first objective of a front against every other one, with what a point is when pointed at; none without a front.
[[nodiscard]] std::vector<Figure> front_plots(const RunRecord& record);
/// How the hypervolume grew over the search, by what it came to.
[[nodiscard]] Plot hypervolume_plot(const RunRecord& record);
/// One plot for each response that has limits: its value over evaluations with the limits as lines.
[[nodiscard]] std::vector<Figure> limit_plots(const RunRecord& record);

}  // namespace dovetail::report
