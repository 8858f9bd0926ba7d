#pragma once

#include <functional>
#include <string>
#include <vector>

#include "reduction/reduced_model.hpp"
#include "response/options.hpp"
#include "response/residual.hpp"

namespace dovetail::hard_cases {

/// One steady state to compute, and what is known about it by construction.
struct Problem {
  reduction::ReducedModel model;
  double omega = 1;
  response::ContactCondition condition = {};
  response::SteadyOptions options = {};
  bool contact_mass = false;   ///< some contact dof carries mass
  std::string no_answer = {};  ///< the proof that no steady state exists; empty otherwise
};

/// Problems of one kind. `make(i)` is the same in every run.
struct Family {
  std::string name;
  int count = 0;
  std::function<Problem(int index)> make;
};

/// All families of the suite, random ones first.
[[nodiscard]] std::vector<Family> families();
[[nodiscard]] std::vector<Family> random_families();
[[nodiscard]] std::vector<Family> hand_made_families();
[[nodiscard]] std::vector<Family> families_without_answer();

}  // namespace dovetail::hard_cases
