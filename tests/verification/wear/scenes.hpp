#pragma once

#include "reduction/reduced_model.hpp"

namespace dovetail::wear::scenes {

/// Den Hartog's oscillator m = k = F0 = 1 under cos(b t), rubbing with N = static normal load on a normal
/// spring k_n: wear unloads it, p_N = N_0 - k_n W. Coordinates: 0 normal, 1 tangential.
[[nodiscard]] reduction::ReducedModel den_hartog(double friction, double normal_load, double normal_stiffness,
                                                 double wear_coefficient);

/// Oscillator m = k = 1, damping c, under cos(w t) / 10 with a massless rubbing node behind a spring k_t. As in
/// den_hartog() wear unloads the node, here until it is free. Coordinates: normal, tangential, mass.
[[nodiscard]] reduction::ReducedModel rubbing_oscillator(double normal_load, double normal_stiffness,
                                                         double tangential_stiffness, double damping);

/// A parabolic punch of relative curvature 1/R pressed by P on an elastic half-plane and rubbed by +-Q.
struct Punch {
  int nodes = 81;                           ///< contact nodes, odd: one in the middle
  double half_length = 1.5;                 ///< nodes from -L to L; must exceed the half-width of contact
  double modulus = 1.0;                     ///< composite E*
  double radius = 1.0;                      ///< R
  double normal_load = 0.7853981633974483;  ///< P; pi/4 makes the Hertz half-width a = sqrt(4PR/(pi E*)) = 1
  double friction = 0.5;
  double tangential_load = 0.2;  ///< Q
  double wear_coefficient = 1e-3;
  double offset = 0.0;  ///< the punch's middle, in x
  double tilt = 0.0;    ///< slope of the gap
};

/// Massless model: contact displacements and the two rigid approaches of the punch. Nodal forces act as
/// piecewise-linear pressures, whose influence follows from -(2/(pi E*)) int p ln|x - s| ds.
[[nodiscard]] reduction::ReducedModel punch(const Punch& data);

/// A paraboloid punch on an elastic half-space, a grid of side * side contact nodes with two tangential directions
/// each.
struct SpacePunch {
  int side = 9;
  double half_length = 1.5;        ///< nodes from -L to L both ways
  double modulus = 1.0;            ///< composite E*
  double radius = 1.0;             ///< R
  double normal_load = 4.0 / 3.0;  ///< makes the Hertz radius a = cbrt(3 P R / (4 E*)) = 1
  double friction = 0.5;
  double first_load = 0.3;         ///< amplitude of the cosine force along the first direction
  double second_load = 0.0;        ///< of the sine force along the second: an elliptic orbit
  double breathing_load = 0.0;     ///< amplitude of the sine normal force
  double tangential_spring = 0.0;  ///< on the punch, both ways
  double wear_coefficient = 1e-3;
  double offset = 0.0;  ///< of the punch's middle, along the first direction
};

/// Massless model: contact displacements (normal, first, second) of every node and the three rigid approaches of the
/// punch. A node's force is a uniform pressure on its square where it acts itself, a point force elsewhere,
/// u = F / (pi E* r); tangential flexibility is 1.2 times the normal one and not coupled to it.
[[nodiscard]] reduction::ReducedModel space_punch(const SpacePunch& data);

/// An elastic block (plane strain, bilinear quadrilaterals, E = 1) on a rigid floor.
struct Block {
  double length = 1.0, height = 0.5;
  int columns = 20, rows = 6;
  double friction = 0.5;
  double normal_load = 1e-3, eccentricity = 0.0;  ///< on the top face; eccentricity / length
  double tangential_load = 2.5e-4;                ///< amplitude of the cosine force on the top face
  double couple = 1.0;    ///< share of the tangential load's moment that a cosine pressure takes back
  double coupling = 1.0;  ///< factor on the stiffness between normal and tangential; 0: floor of equal elasticity
  double tangential_spring = 0.0;  ///< to the ground, in all: holds a block that slides
  double normal_spring = 0.0;      ///< to the ground, in all: holds a block that lifts off or is pressed by its gap
  double interference = 0.0;       ///< taken off the gap
  double breathing_load = 0.0;     ///< amplitude of the sine normal force on the top face
  double crown = 0.0, tilt = 0.0;  ///< gap g = crown s^2 + tilt (s + 1), s in [-1, 1]
  double wear_coefficient = 1.0;
};

/// Quasi-static model of the block's floor nodes, everything else statically condensed.
[[nodiscard]] reduction::ReducedModel block(const Block& data);

/// Block number 0..5 of a fixed random family in which the floor slips partly.
[[nodiscard]] Block random_block(unsigned number);

}  // namespace dovetail::wear::scenes
