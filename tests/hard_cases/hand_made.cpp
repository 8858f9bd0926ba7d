#include <numbers>

#include "tests/hard_cases/problem.hpp"
#include "tests/hard_cases/random.hpp"
#include "tests/verification/steady/rod.hpp"

namespace dovetail::hard_cases {
namespace {

// One mass (m = k = 1) with a massless node behind a spring; its normal direction is a spring of its own.
reduction::ReducedModel slider(double contact_stiffness, double limit, double damping, double force) {
  reduction::ReducedModel model = verification::empty_model(3, 1, 1);
  model.mass(0, 0) = 1;
  model.damping(0, 0) = damping;
  model.stiffness(0, 0) = 1 + contact_stiffness;
  model.stiffness(1, 1) = contact_stiffness;
  model.stiffness(0, 1) = model.stiffness(1, 0) = -contact_stiffness;
  model.stiffness(2, 2) = 1;
  model.static_force(2) = 1;
  model.cosine_force(0, 0) = force;
  model.contact.tangential << 1;
  model.contact.normal << 2;
  model.contact.friction << limit;
  return model;
}

// A mass between stops: one massless node behind a spring in front of it, tangential direction idle.
reduction::ReducedModel stop(double contact_stiffness, double gap, double damping, double force, double press) {
  reduction::ReducedModel model = verification::empty_model(3, 1, 1);
  model.mass(0, 0) = 1;
  model.damping(0, 0) = damping;
  model.stiffness(0, 0) = 1 + contact_stiffness;
  model.stiffness(1, 1) = contact_stiffness;
  model.stiffness(0, 1) = model.stiffness(1, 0) = -contact_stiffness;
  model.stiffness(2, 2) = 1;
  model.static_force(0) = press;
  model.cosine_force(0, 0) = force;
  model.contact.normal << 1;
  model.contact.tangential << 2;
  model.contact.friction << 0.3;
  model.contact.gap << gap;
  return model;
}

Problem with(reduction::ReducedModel model, double omega, int harmonics = 7, int samples = 256) {
  Problem problem;
  problem.model = std::move(model);
  problem.omega = omega;
  problem.options.harmonics = harmonics;
  problem.options.samples = samples;
  return problem;
}

Problem rod_at(int index) {
  const int sizes[] = {1, 2, 5, 10, 20, 50};
  const double frequencies[] = {1.0, 1.6, 2.5, 2.9, 4.0};
  return with(verification::rod(sizes[index % 6]), frequencies[index / 6], 3, 128);
}

Problem slider_at(int index) {
  const double stiffness[] = {1e-3, 0.1, 1, 10, 1e3};
  const double limit[] = {1e-3, 0.1, 0.4, 0.7, 1, 5};
  const double omega[] = {0.1, 0.5, 0.99, 1.2, 3};
  return with(slider(stiffness[index % 5], limit[index / 5 % 6], index % 2 == 0 ? 0.01 : 0, 1), omega[index / 30],
              1 + index % 15);
}

Problem stop_at(int index) {
  const double stiffness[] = {0.01, 0.5, 5, 100, 1e4};
  const double gap[] = {-1, -0.1, 0, 0.3, 2};
  const double omega[] = {0.4, 0.95, 1.3, 2.1};
  return with(stop(stiffness[index % 5], gap[index / 5 % 5], 0.05, 1, index % 3 == 0 ? 0.5 : 0), omega[index / 25 % 4],
              1 + index % 11);
}

// Mass on the contact dof: m = k = 1 on rigid friction [Den Hartog 1931].
Problem den_hartog_at(int index) {
  const double ratio[] = {0.3, 0.5, 0.8, 0.95, 1.05, 1.2, 1.6, 2};
  const double limit[] = {0.1, 0.4, 0.6, 0.75};
  Problem problem = with(verification::den_hartog(limit[index / 8]), ratio[index % 8], 15, 1024);
  problem.contact_mass = true;
  return problem;
}

Problem special_at(int index) {
  switch (index) {
    case 0:
      return with(verification::single_node(), 1.1, 31, 4096);
    case 1:
      return with(slider(10, 0, 0.05, 1), 1.3);  // no friction at all
    case 2:
      return with(slider(10, 1e9, 0.05, 1), 1.3);  // never slides
    case 3:
      return with(slider(10, 0.4, 0.05, 0), 1.3);  // no excitation
    case 4: {                                      // nothing presses and nothing pulls
      reduction::ReducedModel model = slider(10, 0.4, 0.05, 1);
      model.static_force.setZero();
      return with(model, 1.3);
    }
    case 5:
      return with(stop(1, 0, 0.05, 0, 0), 1.3);  // touches, no force anywhere
    case 6:
      return with(stop(1, 0, 0.05, 1, 1), 0.01);  // just touches at the quasi-static turning point
    case 7: {                                     // sixteen equal nodes on one mass
      reduction::ReducedModel model = verification::empty_model(33, 16, 1);
      model.mass(0, 0) = 1;
      model.damping(0, 0) = 0.05;
      model.stiffness(0, 0) = 1 + 16;
      for (int i = 0; i < 16; ++i) {
        model.stiffness(1 + i, 1 + i) = 1;
        model.stiffness(0, 1 + i) = model.stiffness(1 + i, 0) = -1;
        model.stiffness(17 + i, 17 + i) = 1;
        model.static_force(17 + i) = 1;
        model.contact.tangential(i, 0) = 1 + i;
        model.contact.normal(i) = 17 + i;
        model.contact.friction(i) = 0.05;
      }
      model.cosine_force(0, 0) = 1;
      return with(model, 1.3);
    }
    case 8: {  // the limit of friction is met exactly at the turning points of a quasi-static cycle
      reduction::ReducedModel model = slider(1, 0.5, 0, 1);
      model.mass.setZero();
      return with(model, 1);
    }
    case 9: {  // excited at harmonic 3 only
      reduction::ReducedModel model = slider(10, 0.4, 0.05, 1);
      const Eigen::RowVectorXd load = model.cosine_force.row(0);
      model.cosine_force = model.sine_force = Eigen::MatrixXd::Zero(3, 3);
      model.cosine_force.row(2) = load;
      return with(model, 0.4);
    }
    case 10: {  // forces of 1e-12 N on stiffnesses of 1e9 N/m
      reduction::ReducedModel model = slider(10, 0.4, 0.05, 1);
      model.stiffness *= 1e9;
      model.damping *= 1e9;
      model.mass *= 1e9;
      model.static_force *= 1e-12;
      model.cosine_force *= 1e-12;
      return with(model, 1.3);
    }
    default: {  // the normal force swings at half and the tangential one at the full frequency
      reduction::ReducedModel model = slider(10, 0.4, 0.05, 1);
      model.cosine_force = model.sine_force = Eigen::MatrixXd::Zero(2, 3);
      model.cosine_force(1, 0) = 1;
      model.sine_force(0, 2) = 0.9 + 0.2 * (index - 11);
      return with(model, 0.6, 9);
    }
  }
}

}  // namespace

std::vector<Family> hand_made_families() {
  return {
      {.name = "rod", .count = 30, .make = rod_at},
      {.name = "slider", .count = 150, .make = slider_at},
      {.name = "stop", .count = 100, .make = stop_at},
      {.name = "special", .count = 14, .make = special_at},
      {.name = "den_hartog", .count = 32, .make = den_hartog_at},
  };
}

std::vector<Family> families_without_answer() {
  // Work of the friction force in phase with the load is bounded, and nothing else takes any.
  const auto undamped = [](int index) {
    Random random("no_answer_resonance", index);
    const double stiffness = random.decades(0.1, 100), limit = random.decades(0.01, 1.5);
    Problem problem =
        with(slider(stiffness, limit, 0, limit * 4 / std::numbers::pi * random.decades(1.1, 100)), 1, 1 + index % 9);
    problem.no_answer =
        "undamped, driven at the frequency of free sliding by more than 4/pi of the limit of friction: the first "
        "harmonic of the friction force would have to balance the load";
    return problem;
  };
  // The mean contact force would have to pull.
  const auto pulled = [](int index) {
    Random random("no_answer_pulled", index);
    Problem problem = with(stop(random.decades(0.1, 100), random.between(-0.5, 0.5), random.decades(0.01, 0.1),
                                random.decades(0.1, 10), -random.decades(0.01, 10)),
                           random.between(0.3, 2), 1 + index % 9);
    problem.model.stiffness(0, 0) -= 1;
    problem.no_answer = "a body held by unilateral contact alone is pulled away from it on average";
    return problem;
  };
  return {{.name = "no_answer_resonance", .count = 20, .make = undamped},
          {.name = "no_answer_pulled", .count = 20, .make = pulled}};
}

std::vector<Family> families() {
  std::vector<Family> all = random_families();
  for (Family& family : hand_made_families()) all.push_back(std::move(family));
  for (Family& family : families_without_answer()) all.push_back(std::move(family));
  return all;
}

}  // namespace dovetail::hard_cases
