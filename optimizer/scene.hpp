#pragma once

#include <string>

#include "fem/material.hpp"
#include "geometry/parameters.hpp"

namespace dovetail::optimizer {

/// Contact law of the flanks.
struct ContactProperties {
  double friction = 0.5;            ///< mu
  double wear_coefficient = 1e-13;  ///< k_w, 1/Pa
};

/// What acts on the sector.
struct Loading {
  double speed = 1047.1975511965977;  ///< Omega, rad/s
  double tip_force = 2.0;             ///< amplitude of the tangential force at the aerofoil tip, N
  double damping_ratio = 1e-3;        ///< modal damping of the glued modes
  int nodal_diameter = 0;
  int mode = 1;                       ///< glued mode whose resonance is followed, from 1
};

/// Sizes and tolerances of the contact computation.
struct SolverSettings {
  int harmonics = 3;
  int samples = 128;
  int modes = 20;                  ///< free-interface modes kept
  double tolerance = 1e-9;         ///< relative residual of the steady state
  std::string solver = "auto";     ///< auto | newton | powell
};

/// One fully specified candidate: everything the evaluator needs, in SI.
struct Scene {
  std::string type = "section";
  geometry::ProfileParameters geometry;
  geometry::FeasibilityLimits limits;
  fem::Material blade, disk;
  ContactProperties contact;
  Loading loading;
  geometry::MeshSizes mesh;
  SolverSettings solver;
};

}  // namespace dovetail::optimizer
