#include "paths/backbone.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <ostream>

#include "studies/program/commands.hpp"
#include "studies/program/engine.hpp"
#include "studies/program/interrupt.hpp"
#include "studies/program/json_values.hpp"
#include "studies/program/progress.hpp"

namespace dovetail::studies {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

[[noreturn]] void refuse(const std::string& key, const std::string& value, const std::string& allowed) {
  throw InputError(Violation{.file = {}, .key = key, .value = value, .allowed = allowed});
}

std::vector<double> parameters(const BackboneOptions& options) {
  const bool wear = options.over == "wear";
  const Range& range = wear ? kNonNegative : kPositive;
  std::vector<Violation> found;
  const auto require = [&](const char* option, double value, const Range& within) {
    if (!within.contains(value))
      found.push_back({.file = {}, .key = option, .value = shortest(value), .allowed = within.phrase()});
  };
  require("--from", options.from, range);
  require("--to", options.to, range);
  require("--points", options.points, {.lower = 1, .upper = 100000});
  if (options.frequency_hz) require("--frequency", *options.frequency_hz, kFrequencies);
  if (options.logarithmic && (options.from <= 0 || options.to <= 0))
    found.push_back({.file = {}, .key = "--logarithmic", .value = {}, .allowed = "needs --from > 0 and --to > 0"});
  if (!found.empty()) throw InputError(std::move(found));
  std::vector<double> values;
  for (int i = 0; i < options.points; ++i) {
    // Both ends exactly as asked for.
    const double t = options.points == 1 ? 0 : static_cast<double>(i) / (options.points - 1);
    const double between = options.logarithmic ? options.from * std::pow(options.to / options.from, t)
                                               : options.from + t * (options.to - options.from);
    values.push_back(i == 0 ? options.from : i == options.points - 1 ? options.to : between);
  }
  return values;
}

int output_index(const BackboneOptions& options, const LoadedModel& loaded) {
  const std::vector<std::string>& names = loaded.model.output_names;
  if (names.empty()) refuse(options.input, "", "has no output whose resonance could be followed");
  if (!options.output) return 0;
  const auto found = std::find(names.begin(), names.end(), *options.output);
  if (found == names.end()) {
    const std::string near = nearest(*options.output, names);
    refuse("--output", *options.output,
           "is no output of the model" + (near.empty() ? std::string() : "; did you mean " + near + "?"));
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
    refuse(options.input, "",
           unworn.status == Status::converged
               ? "does not wear at its unworn resonance"
               : "its unworn resonance was not found: " + std::string(to_string(unworn.status)) +
                     "; give --frequency HZ near it");
  return paths::wear_levels(joint, unworn.state.wear_rate / largest);
}

std::string backbone_json(const BackboneOptions& options, const LoadedModel& loaded, int output,
                          const paths::Backbone& found) {
  Json json;
  json["over"] = options.over;
  json["output"] = loaded.model.output_names[static_cast<std::size_t>(output)];
  for (const char* key : {"parameter", "status", "frequency_hz", "amplitude", "frequency_error", "dissipated_energy_j",
                          "searched", "jumped", "checked", "jacobians"})
    json[key] = Json::array();
  for (const paths::BackbonePoint& point : found.points) {
    const bool valid = point.status == Status::converged;
    const auto known = [&](double value) { return valid ? number(value) : Json(nullptr); };
    json["parameter"].push_back(number(point.parameter));
    json["status"].push_back(std::string(to_string(point.status)));
    json["frequency_hz"].push_back(known(point.omega / kTurn));
    json["amplitude"].push_back(known(point.amplitude));
    json["frequency_error"].push_back(known(point.error));
    json["dissipated_energy_j"].push_back(known(point.state.friction_energy));
    json["searched"].push_back(point.searched);
    json["jumped"].push_back(point.jumped);
    json["checked"].push_back(point.checked);
    json["jacobians"].push_back(point.jacobians);
  }
  json["settings"] = Json{{"harmonics", loaded.joint.options.harmonics},
                          {"samples", loaded.joint.options.samples},
                          {"tolerance", loaded.joint.options.tolerance},
                          {"solver", loaded.joint.options.solver}};
  return text(json);
}

std::string table(const BackboneOptions& options, const paths::Backbone& found) {
  std::string text = fmt::format("{:>16} {:>16} {:>16} {:>16}\n", options.over == "wear" ? "depth_m" : "force factor",
                                 "status", "frequency_hz", "amplitude");
  for (const paths::BackbonePoint& point : found.points) {
    text += fmt::format("{:>16.9g} {:>16}", point.parameter, to_string(point.status));
    if (point.status == Status::converged)
      text += fmt::format(" {:>16.10g} {:>16.8g}", point.omega / kTurn, point.amplitude);
    text += "\n";
  }
  return text;
}

}  // namespace

int run_backbone(const BackboneOptions& options, const Streams& streams) {
  const std::vector<double> values = parameters(options);
  if (options.solver.automatic()) refuse("--harmonics, --samples", "auto", "must be whole numbers for a backbone");
  LoadedModel loaded = load_model(options.input, options.overrides, options.solver);
  if (!loaded.failure.empty()) {
    streams.err << "dovetail: " << options.input << ": not converged: " << loaded.failure << "\n";
    return kNotConverged;
  }
  paths::BackboneOptions settings;
  const int output = output_index(options, loaded);
  settings.resonance.output = output;
  const double omega = options.frequency_hz ? kTurn * *options.frequency_hz : loaded.glued_omega;
  if (omega <= 0) refuse(options.input, "", "has no natural frequency to start from; give --frequency HZ");

  const OrderlyInterrupt interrupt;
  steady::Joint joint = loaded.joint;
  joint.options.linearise = false;
  const paths::BackboneFamily family =
      options.over == "wear" ? worn_family(joint, omega, settings.resonance, options) : paths::excitation_levels(joint);
  const bool terminal = error_is_terminal();
  const paths::Backbone found =
      paths::backbone(family, values, omega, settings, [&](const paths::BackbonePoint& point) {
        if (terminal) streams.err << fmt::format("\r\033[K{:.6g}", point.parameter) << std::flush;
        return !interrupt.requested();
      });
  if (terminal) streams.err << "\r\033[K" << std::flush;
  deliver_json(options.json, backbone_json(options, loaded, output, found), streams);
  if (options.json.empty()) streams.out << table(options, found);
  if (interrupt.requested()) return kInterrupted;
  const auto failed = std::count_if(found.points.begin(), found.points.end(),
                                    [](const auto& point) { return point.status != Status::converged; });
  if (failed == 0) return kDone;
  streams.err << fmt::format("dovetail: {}: {} of {} resonances were not found\n", options.input, failed,
                             found.points.size());
  return kNotConverged;
}

}  // namespace dovetail::studies
