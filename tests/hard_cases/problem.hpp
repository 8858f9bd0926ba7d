#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "reduction/reduced_model.hpp"
#include "steady/joint.hpp"
#include "steady/options.hpp"

namespace dovetail::hard_cases {

/// One steady state to compute, and what is known about it by construction.
struct Problem {
  reduction::ReducedModel model;
  double omega = 1;
  steady::Condition condition = {};
  steady::Options options = {};
  bool contact_mass = false;   ///< some contact dof carries mass
  std::string no_answer = {};  ///< the proof that no steady state exists; empty otherwise
};

/// Problems of one kind. `make(i)` is the same in every run, but for fresh ones with another seed.
struct Family {
  std::string name;
  int count = 0;
  bool fresh = false;  ///< drawn for this run: nothing was ever tuned on them
  std::function<Problem(int index)> make;
};

/// All families of the suite, random ones first.
[[nodiscard]] std::vector<Family> families();
[[nodiscard]] std::vector<Family> random_families();
/// A fifth as many problems of the same recipes from other random numbers.
[[nodiscard]] std::vector<Family> fresh_families(std::uint64_t seed);
/// The seed of this run: DOVETAIL_SEED if that is set, else a new one in every run.
[[nodiscard]] std::uint64_t seed_of_run();
[[nodiscard]] std::vector<Family> hand_made_families();
[[nodiscard]] std::vector<Family> families_without_answer();

}  // namespace dovetail::hard_cases
