#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace dovetail::studies {

/// Typed for a number that is chosen by refinement.
inline constexpr std::string_view kAutomatic = "auto";

/// Settings of the contact computation as typed; empty ones keep the file's or the default.
struct SolverChoice {
  std::string harmonics, samples;  ///< or kAutomatic
  std::string tolerance, pseudo_penalty, pseudo_penalty_normal, solver;
  std::optional<double> accuracy;  ///< of what is chosen automatically

  [[nodiscard]] bool automatic() const { return harmonics == kAutomatic || samples == kAutomatic; }
};

/// A key of [solver] that is an option, too: name and help follow from the table of SolverSettings.
struct SolverKey {
  std::string_view key;
  std::string SolverChoice::*member;
  std::string_view type;
  bool automatic = false;  ///< may be kAutomatic

  [[nodiscard]] std::string option() const;  ///< "--pseudo-penalty"
};
[[nodiscard]] std::span<const SolverKey> solver_keys();

}  // namespace dovetail::studies
