#include "studies/program/questions/solver_choice.hpp"

#include <algorithm>
#include <array>

namespace dovetail::studies {

std::span<const SolverKey> solver_keys() {
  using S = SolverChoice;
  static constexpr std::array<SolverKey, 6> keys{{{"harmonics", &S::harmonics, "H|auto", true},
                                                  {"samples", &S::samples, "N|auto", true},
                                                  {"tolerance", &S::tolerance, "T"},
                                                  {"pseudo_penalty_n_per_m", &S::pseudo_penalty, "E"},
                                                  {"pseudo_penalty_normal_n_per_m", &S::pseudo_penalty_normal, "E"},
                                                  {"solver", &S::solver, "NAME"}}};
  return keys;
}

std::string SolverKey::option() const {
  std::string name(key.substr(0, key.find("_n_per_m")));
  std::replace(name.begin(), name.end(), '_', '-');
  return "--" + name;
}

}  // namespace dovetail::studies
