#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <ostream>

#include "response/frequency_response.hpp"
#include "studies/program/commands.hpp"
#include "studies/program/engine.hpp"
#include "studies/program/interrupt.hpp"
#include "studies/program/json.hpp"
#include "studies/program/progress.hpp"

namespace dovetail::studies {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

std::vector<double> frequencies(const ResponseOptions& options) {
  std::vector<Violation> found;
  const auto require = [&](const char* option, double value) {
    if (!kFrequencies.contains(value))
      found.push_back({.file = {}, .key = option, .value = shortest(value), .allowed = kFrequencies.phrase()});
  };
  require("--from", options.from_hz);
  require("--to", options.to_hz);
  if (options.points < 1 || options.points > 1000000)
    found.push_back({.file = {},
                     .key = "--points",
                     .value = std::to_string(options.points),
                     .allowed = "must be >= 1 and <= 1000000"});
  if (!found.empty()) throw InputError(std::move(found));
  std::vector<double> hz;
  for (int i = 0; i < options.points; ++i) {
    // Both ends exactly as asked for.
    const double t = options.points == 1 ? 0 : static_cast<double>(i) / (options.points - 1);
    hz.push_back(i > 0 && i == options.points - 1 ? options.to_hz
                                                  : options.from_hz + t * (options.to_hz - options.from_hz));
  }
  return hz;
}

std::string table(const std::vector<double>& hz, const std::vector<response::SteadyState>& states,
                  const std::vector<std::string>& outputs) {
  std::string text = fmt::format("{:>16} {:>16}", "frequency_hz", "status");
  for (const std::string& name : outputs) text += fmt::format(" {:>16}", name);
  text += "\n";
  for (std::size_t i = 0; i < states.size(); ++i) {
    text += fmt::format("{:>16.9g} {:>16}", hz[i], to_string(states[i].status));
    if (states[i].status == Status::converged)
      for (const double amplitude : states[i].amplitudes) text += fmt::format(" {:>16.8g}", amplitude);
    text += "\n";
  }
  return text;
}

}  // namespace

int run_response(const ResponseOptions& options, const Streams& streams) {
  const std::vector<double> hz = frequencies(options);
  const LoadedModel loaded = load_model(options.input, options.overrides, options.solver);
  if (!loaded.failure.empty()) {
    streams.err << "dovetail: " << options.input << ": not converged: " << loaded.failure << "\n";
    return kNotConverged;
  }
  std::vector<double> omega;
  for (const double f : hz) omega.push_back(kTurn * f);

  const OrderlyInterrupt interrupt;
  const bool terminal = error_is_terminal();
  const auto watch = [&](std::size_t point, const response::SteadyState&) {
    if (terminal) streams.err << fmt::format("\r\033[Kfrequency {}/{}", point + 1, hz.size()) << std::flush;
    return !interrupt.requested();
  };
  const std::vector<response::SteadyState> states =
      response::frequency_response(loaded.condensed, omega, {}, loaded.steady, watch);
  if (terminal) streams.err << "\r\033[K" << std::flush;

  deliver_json(options.json, response_json(hz, states, loaded.model.output_names), streams);
  if (options.json.empty()) streams.out << table(hz, states, loaded.model.output_names);
  std::size_t failed = 0;
  for (const response::SteadyState& state : states)
    if (state.status != Status::converged) ++failed;
  if (interrupt.requested()) return kInterrupted;
  if (failed == 0) return kDone;
  streams.err << fmt::format("dovetail: {}: {} of {} frequencies did not converge\n", options.input, failed, hz.size());
  return kNotConverged;
}

}  // namespace dovetail::studies
