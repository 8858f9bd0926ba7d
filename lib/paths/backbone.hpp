#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "paths/resonance.hpp"

namespace dovetail::paths {

/// The joint at a value of the parameter: excitation level, wear, speed, friction, anything. All members must have the
/// same contact nodes and options.
using BackboneFamily = std::function<steady::Joint(double parameter)>;

/// The forces of harmonics >= 1 times the parameter; static load kept.
[[nodiscard]] BackboneFamily excitation_levels(const steady::Joint& joint);
/// Wear depths start + parameter * growth [Nc], m; those of the joint are the start.
[[nodiscard]] BackboneFamily wear_levels(const steady::Joint& joint, const Eigen::VectorXd& growth);

struct BackboneOptions {
  ResonanceOptions resonance = {};  ///< of the first point, and of the searches where Newton does not get through
  int max_iterations = 60;          ///< Jacobians of one Newton on (U, omega), >= 2
  int halvings = 3;                 ///< times the way to the next parameter is halved when it fails, >= 0
  bool search = true;               ///< fall back on resonance() when the halvings do not help
  /// Each point is held against the highest peak of the branch within this fraction of its frequency, and from there to
  /// that of the last point that was the highest (in the beginning omega_start), [0, 1); 0: no.
  double check_range = 0.4;
};

struct BackbonePoint {
  double parameter = 0;
  Status status = Status::iteration_limit;
  double omega = 0;       ///< rad/s, where the amplitude is largest
  double amplitude = 0;   ///< half peak-to-peak of the output
  double error = 0;       ///< of omega, relative: correction left or width of the bracket
  bool searched = false;  ///< found by resonance() or by the check instead of Newton on (U, omega)
  /// Not the peak followed from the point before (or next to omega_start), which was lost or lower than this one.
  bool jumped = false;
  /// Held against the branch in check_range, of which no hump and no end is higher by more than 1 / samples. False: a
  /// maximum, perhaps not the largest.
  bool checked = false;
  int intermediate = 0;  ///< points between the one before and this that were needed and not reported
  int jacobians = 0;     ///< of this point and its intermediate ones
  int checking = 0;      ///< Jacobians of the check, not in the former
  steady::State state;   ///< at omega, with its tangent when steady::Options::linearise
};

struct Backbone {
  Status status = Status::iteration_limit;  ///< converged when all points are
  std::vector<BackbonePoint> points;        ///< one per parameter, in order
  int jacobians = 0;                        ///< of everything
};

/// The resonance of one output tracked over `parameters`, in the order given. The first is searched from `omega_start`
/// (rad/s) by resonance(); the others are found by Newton on (U, omega), started from the polynomial through the last
/// (at most three) points, at six to eight Jacobians each where resonance() takes about twice as many. eps is
/// that of the first point, or of the last jump.
///
/// A maximum that is followed can become a side maximum, since contact that slips or opens adds peaks: each point is
/// held against the highest on the branch of its parameter, followed coarsely through `check_range` (some fifty to
/// two hundred solves), and replaced by that when it is higher. The points do then not depend on the way they were
/// reached in, as long as the ranges contain the peak, but for humps between the points of the coarse branch that are
/// higher by up to 1 / samples. Where there are modes closer than check_range
/// the answer is the largest of their peaks; with a check_range of 0 it is the one followed.
///
/// A parameter that fails has its status, and the next one starts from the last that did not.
/// `progress` may return false to stop: the points left then carry Status::interrupted.
[[nodiscard]] Backbone backbone(const BackboneFamily& family, std::span<const double> parameters, double omega_start,
                                const BackboneOptions& backbone_options = {},
                                const std::function<bool(const BackbonePoint&)>& progress = {});

}  // namespace dovetail::paths

namespace dovetail {
template <>
std::span<const Field<paths::BackboneOptions>> option_table<paths::BackboneOptions>();
}
