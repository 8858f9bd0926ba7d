#pragma once

#include <Eigen/Core>
#include <complex>
#include <memory>
#include <string>
#include <vector>

#include "contact/contact_law.hpp"
#include "contact/wear_law.hpp"
#include "core/status.hpp"
#include "dynamics/harmonic_matrices.hpp"
#include "reduction/reduced_model.hpp"

namespace dovetail::dynamics {

/// What the contact displacements see of harmonic h at one frequency beside the dynamic stiffness
/// Z_h = S_cc - S_ci S_ii^-1 S_ic with S = K + i h w C - (h w)^2 M [Salles 2009, eq. 10-11]: its load, and what follows
/// within. Complex amplitudes stand for c - i s: q = Re(Q e^(i h tau)).
struct CondensedHarmonic {
  Eigen::VectorXcd force;  ///< F_h [nc] N
  // Internal coordinates are q_i = internal_force - internal_shape U_c.
  Eigen::MatrixXcd internal_shape;    ///< S_ii^-1 S_ic [ni, nc]
  Eigen::VectorXcd internal_force;    ///< S_ii^-1 F_i [ni]
  Status status = Status::converged;  ///< singular: the glued structure is undamped and exactly at resonance
};

/// A reduced model split into contact and internal dofs, built once and then asked for many frequencies.
/// Contact dofs are ordered node by node (N, T1[, T2]), nc = Nc d. When the internal matrices are simultaneously
/// diagonalisable (diagonal, modal or Rayleigh damping) internal coordinates are modal and a frequency costs
/// O(nc^2 ni) per harmonic; otherwise a dense complex factorisation O(ni^3) is added.
class CondensedModel {
 public:
  /// Copies what it needs. Throws InputError when sizes, indices or values of the model do not fit together.
  explicit CondensedModel(const reduction::ReducedModel& model);

  [[nodiscard]] Eigen::Index nodes() const { return contact_.count(); }               ///< Nc
  [[nodiscard]] Eigen::Index directions() const { return contact_.directions(); }     ///< d
  [[nodiscard]] Eigen::Index contact_size() const { return nodes() * directions(); }  ///< nc
  [[nodiscard]] Eigen::Index size() const { return n_; }
  [[nodiscard]] const reduction::ContactNodes& contact() const { return contact_; }
  [[nodiscard]] const std::vector<std::string>& output_names() const { return output_names_; }
  [[nodiscard]] Eigen::Index output_count() const { return output_contact_.rows(); }  ///< n_out
  [[nodiscard]] bool modal() const { return modal_; }
  [[nodiscard]] int force_harmonics() const { return static_cast<int>(force_contact_.cols()) - 1; }
  /// What a node wears per cycle by its slip.
  [[nodiscard]] contact::WearRate wear_rate(Eigen::Index node, const contact::Slip& slip) const {
    return wear_law_->rate(wear_node(node), slip);
  }
  /// The law behind it, and what it knows of a node.
  [[nodiscard]] const contact::WearLaw& wear_law() const { return *wear_law_; }
  [[nodiscard]] contact::WearNode wear_node(Eigen::Index node) const;
  /// The contact law of a node, without pseudo-penalty and slip origin.
  [[nodiscard]] contact::NodeLaw contact_law(Eigen::Index node) const { return {.friction = contact_.friction(node)}; }
  /// Replaces the friction coefficients mu [Nc], >= 0 (large: a node that is held stuck).
  void set_friction(const Eigen::VectorXd& friction) { contact_.friction = friction; }
  /// Replaces the wear coefficients [Nc], >= 0.
  void set_wear_coefficient(const Eigen::VectorXd& coefficient) { contact_.wear_coefficient = coefficient; }
  /// Multiplies the forces of harmonics >= 1 (an excitation level).
  void scale_excitation(double factor) {
    force_contact_.rightCols(force_harmonics()) *= factor;
    force_internal_.rightCols(force_harmonics()) *= factor;
  }

  /// The same model in this object's coordinates: contact dofs first, node by node, then the internal coordinates.
  [[nodiscard]] reduction::ReducedModel reduced() const;

  /// omega in rad/s. Loads of harmonic 0 are multiplied by `static_scale` (a loading path).
  [[nodiscard]] CondensedHarmonic harmonic(int h, double omega, double static_scale = 1) const;
  /// Z_h [nc, nc], N/m, and those of all harmonics 0..H with what harmonic() says of them at that frequency.
  [[nodiscard]] Eigen::MatrixXcd stiffness(int h, double omega, const CondensedHarmonic& at) const;
  [[nodiscard]] HarmonicMatrices stiffness(double omega, const std::vector<CondensedHarmonic>& harmonics) const;
  /// dZ_h/dw U_c - dF_h/dw [nc] at constant U_c, without forming dZ_h/dw: with q = (U_c, q_i) and T = (I, -S_ii^-1
  /// S_ic) it is T^T dS/dw q. O(nc ni).
  [[nodiscard]] Eigen::VectorXcd slope(int h, double omega, const CondensedHarmonic& at,
                                       const Eigen::VectorXcd& contact) const;

  /// Local contact stiffness [nc]: the limit of diag(Z_h) for high harmonics with massless contact.
  [[nodiscard]] const Eigen::VectorXd& local_stiffness() const { return local_stiffness_; }
  /// True when contact dofs carry no mass: then Z has a limit for high harmonics.
  [[nodiscard]] bool massless_contact() const { return massless_contact_; }

  /// Complex amplitude of all n dofs of the reduced model for contact amplitude U_c [nc] of this harmonic.
  [[nodiscard]] Eigen::VectorXcd recover(const CondensedHarmonic& at, const Eigen::VectorXcd& contact) const;
  /// Complex amplitudes of the outputs [n_out].
  [[nodiscard]] Eigen::VectorXcd outputs(const CondensedHarmonic& at, const Eigen::VectorXcd& contact) const;
  /// d outputs / d U_c [n_out, nc], and d outputs / d w at constant U_c [n_out].
  [[nodiscard]] Eigen::MatrixXcd output_gradient(const CondensedHarmonic& at) const;
  [[nodiscard]] Eigen::VectorXcd output_slope(int h, double omega, const CondensedHarmonic& at,
                                              const Eigen::VectorXcd& contact) const;
  /// Energy put in by the excitation and dissipated by damping in harmonic h over one period, J.
  struct HarmonicEnergy {
    double input = 0, damping = 0;
  };
  [[nodiscard]] HarmonicEnergy energy(int h, double omega, const CondensedHarmonic& at,
                                      const Eigen::VectorXcd& contact) const;
  /// Undamped frequencies of the glued structure (contact displacements zero), rad/s, ascending.
  [[nodiscard]] Eigen::VectorXd glued_frequencies() const;

 private:
  struct Dynamic;  // S and dS/dw of one harmonic
  [[nodiscard]] Eigen::MatrixXcd solve_internal(const Eigen::MatrixXcd& internal, const Eigen::MatrixXcd& rhs,
                                                Status* status) const;
  void diagonalise();
  void subtract_massless_coordinates();
  void share_static_stiffness();
  void set_glued_frequencies(const Eigen::MatrixXd& mass,
                             const Eigen::MatrixXd& stiffness);  // of decoupled coordinates

  Eigen::Index n_ = 0;
  reduction::ContactNodes contact_;
  const contact::WearLaw* wear_law_ = nullptr;
  std::vector<std::string> output_names_;
  std::vector<Eigen::Index> contact_dofs_, internal_dofs_;
  Eigen::MatrixXd basis_;  // internal dofs = basis_ * internal coordinates
  bool modal_ = false, massless_contact_ = true;
  // Partitions in internal coordinates: [cc, ci, ii], ii as a column of diagonals when modal.
  struct Partition {
    Eigen::MatrixXd cc, ci, ii;
  };
  Partition mass_, damping_, stiffness_;
  // Where neither mass nor damping acts on or across the contact and the rest is modal all harmonics share what is
  // static: K_cc without the springs within, and K_ci of the other coordinates.
  std::vector<Eigen::Index> moving_;
  std::shared_ptr<const Eigen::MatrixXd> shared_, shared_coupling_;
  Eigen::MatrixXcd force_contact_, force_internal_;  // column h, complex amplitude c - i s
  Eigen::MatrixXd output_contact_, output_internal_;
  Eigen::VectorXd local_stiffness_, glued_frequencies_;
};

}  // namespace dovetail::dynamics
