#include <algorithm>
#include <cstdlib>
#include <random>

#include "tests/hard_cases/structure.hpp"

namespace dovetail::hard_cases {
namespace {

// A few nodes, one or two tangential directions, everything else as in Recipe.
Recipe small(Random& random) {
  Recipe recipe;
  recipe.directions = random.integer(2, 3);
  recipe.nodes = random.integer(1, 8);
  recipe.masses = random.integer(1, 5);
  recipe.harmonics = random.integer(1, 9);
  recipe.proportional = random.chance(0.7);
  return recipe;
}

// Whole bodies only: every mass needs a contact node when nothing else holds it.
Recipe held_by_contact(Random& random) {
  Recipe recipe = small(random);
  recipe.ground = 0;
  recipe.nodes = std::max(recipe.nodes, recipe.directions);
  recipe.masses = std::min(recipe.masses, recipe.nodes);
  return recipe;
}

// One of the families below, from random numbers of its own for every `stream`.
struct Maker {
  std::string stream;
  int divisor = 1;

  Family operator()(const char* name, int count, void (*specialise)(Recipe&, Random&, int)) const {
    const auto make = [numbers = name + stream, specialise](int index) {
      Random random(numbers, index);
      Recipe recipe = small(random);
      specialise(recipe, random, index);
      Problem problem = build(recipe, random);
      // Both rules, whatever the default.
      problem.options.slip_return =
          index % 2 == 0 ? contact::SlipReturn::second_order : contact::SlipReturn::first_order;
      return problem;
    };
    return {.name = name, .count = count / divisor, .fresh = !stream.empty(), .make = make};
  }
};

std::vector<Family> made_by(const Maker& family) {
  return {
      family("slip_one_direction", 80, [](Recipe& r, Random&, int) { r.directions = 2; }),
      family("slip_two_directions", 80, [](Recipe& r, Random&, int) { r.directions = 3; }),
      family("many_nodes", 40,
             [](Recipe& r, Random& random, int) {
               r.nodes = random.integer(15, 100);
               r.masses = random.integer(5, 30);
               r.harmonics = r.nodes > 40 ? random.integer(1, 2) : random.integer(1, 5);
               r.coupling = random.chance(0.5) ? 0.3 : 0;
             }),
      family("many_harmonics", 80,
             [](Recipe& r, Random& random, int) {
               r.harmonics = random.integer(10, 31);
               r.nodes = random.integer(1, r.directions == 3 ? 4 : 6);
               r.samples = 256;
             }),
      family("resonance_near_sliding", 80,
             [](Recipe& r, Random& random, int) {
               r.detuning = {0.999, 1.001};
               r.reach = {0.9, 1.4};
               r.damping_ratio = {1e-4, 1e-2};
               r.forcing_harmonics = random.integer(1, 2);
             }),
      family("resonance_full_sliding", 80,
             [](Recipe& r, Random&, int) {
               r.modes = Modes::sliding;
               r.detuning = {0.99, 1.01};
               r.reach = {3, 100};
               r.damping_ratio = {1e-4, 1e-2};
             }),
      family("lift_off", 120,
             [](Recipe& r, Random&, int) {
               r.measure = Measure::lift;
               r.reach = {1.1, 30};
             }),
      family("zero_damping", 80,
             [](Recipe& r, Random& random, int) {
               r.damping_ratio = {0, 0};
               r.measure = random.chance(0.5) ? Measure::slip : Measure::lift;
               r.detuning = random.chance(0.5) ? Range{0.5, 0.95} : Range{1.05, 1.6};
             }),
      family("gaps", 80,
             [](Recipe& r, Random& random, int) {
               r.unloaded = 1;
               r.gap = {0.05, 0.5};
               r.modes = random.chance(0.5) ? Modes::free : Modes::glued;
               r.measure = Measure::gap;
               r.reach = {0.8, 10};
               r.damping_ratio = {0.005, 0.1};
             }),
      family("interference", 80,
             [](Recipe& r, Random& random, int) {
               r.unloaded = random.chance(0.5) ? 1 : 0.5;
               r.gap = {-2, random.chance(0.5) ? 0.0 : 0.2};
               r.measure = Measure::load;
               r.reach = {0.03, 3};
             }),
      family("unloaded_nodes", 80,
             [](Recipe& r, Random& random, int) {
               r.unloaded = random.between(0.2, 1);
               r.coupling = random.chance(0.5) ? 0.3 : 0;
               r.measure = Measure::load;
               r.reach = {0.1, 10};
             }),
      family("load_decades", 80,
             [](Recipe& r, Random& random, int) {
               r.measure = random.chance(0.5) ? Measure::slip : Measure::lift;
               r.reach = {1e-3, 1e3};
               r.preload = {1e-2, 1e2};
             }),
      family("stiffness_decades", 80,
             [](Recipe& r, Random& random, int) {
               r.contact_stiffness = {1e-3, 1e3};
               r.mass = {0.1, 10};
               r.measure = random.chance(0.7) ? Measure::slip : Measure::lift;
             }),
      family("quasi_static", 80,
             [](Recipe& r, Random& random, int) {
               r.quasi_static = true;
               r.measure = random.chance(0.7) ? Measure::slip : Measure::lift;
               r.reach = {0.5, 10};
             }),
      family("held_by_contact", 80,
             [](Recipe& r, Random& random, int index) {
               const Recipe own = held_by_contact(random);
               r = own;
               r.quasi_static = index % 4 == 0;
               r.preload = {3, 10};
               r.reach = {0.5, 1.5};
               r.friction = {0.1, 1.5};
             }),
      family("several_harmonics", 80,
             [](Recipe& r, Random& random, int) {
               r.forcing_harmonics = random.integer(2, 5);
               r.harmonics = random.integer(5, 12);
               r.measure = random.chance(0.5) ? Measure::slip : Measure::lift;
             }),
      family("contact_mass_slip", 60,
             [](Recipe& r, Random& random, int) {
               r.contact_mass = random.decades(1e-3, 0.3);
               r.reach = {0.5, 3};
             }),
      family("contact_mass_lift_off", 60,
             [](Recipe& r, Random& random, int) {
               r.contact_mass = random.decades(1e-3, 0.3);
               r.measure = Measure::lift;
               r.reach = {1.1, 5};
             }),
  };
}

}  // namespace

std::vector<Family> random_families() {
  return made_by({});
}

std::vector<Family> fresh_families(std::uint64_t seed) {
  std::vector<Family> families = made_by({.stream = "/" + std::to_string(seed), .divisor = 5});
  for (Family& family : families) family.name = "fresh_" + family.name;
  return families;
}

std::uint64_t seed_of_run() {
  static const std::uint64_t seed = [] {
    const char* const given = std::getenv("DOVETAIL_SEED");
    return given != nullptr ? std::strtoull(given, nullptr, 10) : std::uint64_t{std::random_device{}()};
  }();
  return seed;
}

}  // namespace dovetail::hard_cases
