#pragma once

#include <string>
#include <utility>
#include <vector>

#include "studies/paper_sequence/results.hpp"
#include "studies/report/plots/figure.hpp"

namespace dovetail::paper_sequence {

/// A plot, or in space a map over the flanks.
using report::Figure;

[[nodiscard]] Figure nodal_diameter_figure(const Results& results);
[[nodiscard]] Figure pressure_figure(const Results& results);
[[nodiscard]] Figure damping_figure(const Results& results);
[[nodiscard]] Figure power_figure(const Results& results);
[[nodiscard]] Figure first_rate_figure(const Results& results);
[[nodiscard]] Figure depth_course_figure(const Results& results);
[[nodiscard]] Figure rate_course_figure(const Results& results);
[[nodiscard]] Figure profile_figure(const Results& results);
[[nodiscard]] Figure volume_figure(const Results& results);
[[nodiscard]] Figure wearing_response_figure(const Results& results);
[[nodiscard]] Figure wearing_power_figure(const Results& results);
[[nodiscard]] Figure amplitude_course_figure(const Results& results);
[[nodiscard]] Figure drift_figure(const Results& results);

/// All of them in the reference's order, each with the name of the file of its numbers.
[[nodiscard]] std::vector<std::pair<std::string, Figure>> figures(const Results& results);

}  // namespace dovetail::paper_sequence
