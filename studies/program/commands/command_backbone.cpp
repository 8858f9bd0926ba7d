#include "paths/backbone.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ostream>

#include "studies/program/answers/teller.hpp"
#include "studies/program/answers/version.hpp"
#include "studies/program/commands/commands.hpp"
#include "studies/program/engine/interrupt.hpp"
#include "studies/program/engine/json_values.hpp"
#include "studies/program/engine/loaded_model.hpp"
#include "studies/program/engine/number_constants.hpp"
#include "studies/program/study_file/refusal.hpp"

namespace dovetail::studies {
namespace {

std::vector<double> parameters(const BackboneOptions& options) {
  std::vector<double> values = evenly_spaced(options.from, options.to, options.points);
  for (std::size_t i = 1; options.logarithmic && i + 1 < values.size(); ++i)
    values[i] = options.from * std::pow(options.to / options.from, static_cast<double>(i) / (options.points - 1));
  return values;
}

int output_index(const BackboneOptions& options, const LoadedModel& loaded) {
  const std::vector<std::string>& names = loaded.model.output_names;
  if (names.empty()) refuse(options.input, "has no output whose resonance could be followed");
  if (options.output.empty()) return 0;
  const auto found = std::find(names.begin(), names.end(), options.output);
  if (found == names.end()) {
    const std::string near = nearest(options.output, names);
    refuse("--output", "is no output of the model" + (near.empty() ? "" : "; did you mean " + near + "?"),
           options.output);
  }
  return static_cast<int>(found - names.begin());
}

/// Wear whose largest depth is the parameter, in proportion to the rates of the unworn resonance.
paths::BackboneFamily worn_family(const steady::Joint& joint, double omega, const paths::ResonanceOptions& search,
                                  const BackboneOptions& options) {
  const paths::Resonance unworn = paths::resonance(joint, omega, search);
  const double largest =
      unworn.status == Status::converged && unworn.state.wear_rate.size() > 0 ? unworn.state.wear_rate.maxCoeff() : 0;
  if (largest <= 0)
    refuse(options.input, unworn.status == Status::converged
                              ? "does not wear at its unworn resonance"
                              : "its unworn resonance was not found: " + std::string(to_string(unworn.status)) +
                                    "; give --frequency HZ near it");
  return paths::wear_levels(joint, unworn.state.wear_rate / largest);
}

std::string backbone_json(const BackboneOptions& options, const LoadedModel& loaded, int output,
                          const paths::Backbone& found) {
  Json json{{"version", kAnswerVersion}};
  json["over"] = json_of(options.over);
  json["output"] = loaded.model.output_names[static_cast<std::size_t>(output)];
  using Point = paths::BackbonePoint;
  const auto known = [](const auto& value) {
    return [=](const Point& point) {
      return point.status == Status::converged ? std::invoke(value, point) : std::nan("");
    };
  };
  add_columns(json, found.points, Column("parameter", &Point::parameter), Column("status", &Point::status),
              Column("frequency_hz", known([](const Point& point) { return point.omega / kTurn; })),
              Column("amplitude", known(&Point::amplitude)), Column("frequency_error", known(&Point::error)),
              Column("dissipated_energy_j", known([](const Point& point) { return point.state.friction_energy; })),
              Column("searched", &Point::searched), Column("jumped", &Point::jumped),
              Column("checked", &Point::checked), Column("jacobians", &Point::jacobians));
  json["settings"] = json_of(loaded.joint.options);
  return text(json);
}

std::string table(const BackboneOptions& options, const paths::Backbone& found) {
  std::string text =
      fmt::format("{:>16} {:>16} {:>16} {:>16}\n", options.over == BackboneOver::wear ? "depth_m" : "force factor",
                  "status", "frequency_hz", "amplitude");
  for (const paths::BackbonePoint& point : found.points) {
    text += fmt::format("{:>16.9g} {:>16}", point.parameter, to_string(point.status));
    if (point.status == Status::converged)
      text += fmt::format(" {:>16.10g} {:>16.8g}{}", point.omega / kTurn, point.amplitude,
                          point.checked ? "" : "  a maximum, perhaps not the largest");
    text += "\n";
  }
  return text;
}

}  // namespace

int run_backbone(const BackboneOptions& options, Teller& teller, const Streams& streams) {
  const std::vector<double> values = parameters(options);
  if (options.solver.automatic()) refuse("--harmonics, --samples", "must be whole numbers for a backbone", "auto");
  LoadedModel loaded = told_model(options.input, options.set, options.solver, teller);
  if (!loaded.failure.empty()) return not_converged(options.input, "not converged: " + loaded.failure, streams);
  paths::BackboneOptions settings;
  const int output = output_index(options, loaded);
  settings.resonance.output = output;
  const double omega = options.frequency_hz ? kTurn * *options.frequency_hz : loaded.glued_omega;
  if (omega <= 0) refuse(options.input, "has no natural frequency to start from; give --frequency HZ");

  const OrderlyInterrupt interrupt;
  steady::Joint joint = loaded.joint;
  joint.options.linearise = false;
  const paths::BackboneFamily family = options.over == BackboneOver::wear
                                           ? worn_family(joint, omega, settings.resonance, options)
                                           : paths::excitation_levels(joint);
  teller.begin("resonances", 0, options.points);
  int done = 0;
  const paths::Backbone found = paths::backbone(family, values, omega, settings, [&](const paths::BackbonePoint&) {
    teller.step(++done);
    return !interrupt.requested();
  });
  teller.end();
  deliver_json(options.json, backbone_json(options, loaded, output, found), streams);
  if (options.json.empty()) streams.out << table(options, found);
  if (interrupt.requested()) return interrupted(fmt::format("{} of {} levels", done, options.points), streams);
  const auto failed = std::count_if(found.points.begin(), found.points.end(),
                                    [](const auto& point) { return point.status != Status::converged; });
  if (failed == 0) return kDone;
  return not_converged(options.input, fmt::format("{} of {} resonances were not found", failed, found.points.size()),
                       streams);
}

}  // namespace dovetail::studies
