#include "steady/separated_nodes.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "numerics/dense_product.hpp"
#include "steady/params.hpp"
#include "steady/work.hpp"

namespace dovetail::steady {

SeparatedNodes::SeparatedNodes(std::shared_ptr<const dynamics::HarmonicSystem> system, std::vector<Eigen::Index> open,
                               std::vector<Eigen::Index> kept)
    : system_(std::move(system)), open_(std::move(open)), kept_(std::move(kept)) {
  if (open_.empty()) return;
  if (system_->stiffness.base() && condense_shared()) return;
  condense_each();
}

/// Below the limit a floating part is told from a soft one by rounding alone.
bool SeparatedNodes::take(double reciprocal_condition) {
  reciprocal_condition_ = std::min(reciprocal_condition_, reciprocal_condition);
  if (reciprocal_condition_ > SingularityParams{}.singular) return true;
  status_ = Status::singular;
  return false;
}

bool SeparatedNodes::condense_shared() {
  const dynamics::HarmonicMatrices& of = system_->stiffness;
  const Eigen::MatrixXd &k = *of.base(), &l = *of.coupling();
  const auto open = static_cast<Eigen::Index>(open_.size()), kept = static_cast<Eigen::Index>(kept_.size());
  const Eigen::Index within = l.cols();
  operations_ = shared_condensation_operations(open, kept, within, of.harmonics());
  base_.factorise(k(open_, open_));
  if (!(base_.reciprocal_condition() > SingularityParams{}.singular)) return false;
  (void)take(base_.reciprocal_condition());
  const Eigen::MatrixXd across = k(open_, kept_), on_open = l(open_, Eigen::all);
  Eigen::MatrixXd both(open, kept + within);
  both << across, on_open;
  const Eigen::MatrixXd solved = base_.solve(both);
  static_shape_ = solved.leftCols(kept);
  pushed_ = solved.rightCols(within);
  const Eigen::MatrixXd give = numerics::transposed_product(on_open, pushed_);
  std::vector<Eigen::MatrixXcd> inner;
  for (int h = 0; h <= of.harmonics(); ++h) {
    // B = (I + A G)^-1 A. Scaled by A the matrix is as regular as the structure, whatever the modes' units.
    const Eigen::MatrixXcd& a = of.inner()[static_cast<std::size_t>(h)];
    const Eigen::VectorXd scale =
        a.diagonal().cwiseAbs().unaryExpr([](double value) { return value > 0 ? std::sqrt(value) : 1.0; });
    const Eigen::MatrixXcd unscaled = a * give;
    Eigen::MatrixXcd scaled = scale.cwiseInverse().asDiagonal() * unscaled * scale.asDiagonal();
    scaled.diagonal().array() += 1;
    const numerics::ComplexLu lu(scaled);
    if (!take(lu.reciprocal_condition())) return true;
    if (h == 0) determinant_sign_ = base_.determinant_sign() * numerics::DenseLu(scaled.real()).determinant_sign();
    inner.emplace_back(scale.asDiagonal() * lu.solve(scale.cwiseInverse().asDiagonal() * a));
  }
  const auto on_kept = [&across](const Eigen::MatrixXd& x) { return numerics::transposed_product(across, x); };
  condensed_ = dynamics::HarmonicMatrices(
      std::make_shared<const Eigen::MatrixXd>(k(kept_, kept_) - on_kept(static_shape_)),
      std::make_shared<const Eigen::MatrixXd>(l(kept_, Eigen::all) - on_kept(pushed_)), std::move(inner));
  return true;
}

void SeparatedNodes::condense_each() {
  const dynamics::HarmonicMatrices& of = system_->stiffness;
  operations_ += condensation_operations(static_cast<Eigen::Index>(open_.size()), of.size(), of.harmonics());
  reciprocal_condition_ = 1;
  std::vector<Eigen::MatrixXcd> condensed;
  for (int h = 0; h <= of.harmonics(); ++h) {
    const Eigen::MatrixXcd z = of.matrix(h);
    factors_.emplace_back(Eigen::MatrixXcd(z(open_, open_)));
    if (!take(factors_.back().reciprocal_condition())) return;
    const Eigen::MatrixXcd coupling = z(open_, kept_);
    shape_.emplace_back(factors_.back().solve(coupling));
    condensed.emplace_back(z(kept_, kept_) - numerics::transposed_product(coupling, shape_.back()));
  }
  determinant_sign_ = factors_.front().determinant_sign();
  condensed_ = dynamics::HarmonicMatrices(std::move(condensed));
}

Eigen::MatrixXd SeparatedNodes::part_of(const std::vector<Eigen::Index>& dofs, const Eigen::MatrixXd& all) const {
  if (dofs.size() == open_.size() + kept_.size()) return all;
  const auto nc = static_cast<Eigen::Index>(open_.size() + kept_.size()), n = static_cast<Eigen::Index>(dofs.size());
  Eigen::MatrixXd part(all.rows() / nc * n, all.cols());
  for (Eigen::Index k = 0; k < all.rows() / nc; ++k)
    for (Eigen::Index i = 0; i < n; ++i) part.row(k * n + i) = all.row(k * nc + dofs[static_cast<std::size_t>(i)]);
  return part;
}

void SeparatedNodes::put_part(const std::vector<Eigen::Index>& dofs, const Eigen::MatrixXd& part,
                              Eigen::MatrixXd& all) const {
  const auto nc = static_cast<Eigen::Index>(open_.size() + kept_.size()), n = static_cast<Eigen::Index>(dofs.size());
  for (Eigen::Index k = 0; k < all.rows() / nc; ++k)
    for (Eigen::Index i = 0; i < n; ++i) all.row(k * nc + dofs[static_cast<std::size_t>(i)]) = part.row(k * n + i);
}

Eigen::MatrixXd SeparatedNodes::solve_open(const Eigen::MatrixXd& b, bool transposed) const {
  const auto n = static_cast<Eigen::Index>(open_.size());
  if (factors_.empty())
    return base_.solve(b.reshaped(n, n > 0 ? b.size() / n : 0)).reshaped(b.rows(), b.cols()) -
           dynamics::apply_low_rank({.left = pushed_, .inner = condensed_.inner(), .right = pushed_}, b, transposed);
  Eigen::MatrixXd result(b.rows(), b.cols());
  for (std::size_t h = 0; h < factors_.size(); ++h) {
    const auto at = static_cast<Eigen::Index>(h);
    // Z_oo is symmetric: the transpose of its real form belongs to its conjugate.
    dynamics::put_amplitude(factors_[h].solve(dynamics::amplitude(b, n, at, transposed)), at, transposed, result);
  }
  return result;
}

Eigen::MatrixXd SeparatedNodes::apply_shape(dynamics::Form form, const Eigen::MatrixXd& x) const {
  if (factors_.empty() && !open_.empty()) {
    const Eigen::MatrixXd& coupling = *condensed_.coupling();
    const bool conjugated = form == dynamics::Form::conjugated || form == dynamics::Form::adjoint;
    if (form == dynamics::Form::plain || form == dynamics::Form::conjugated)
      return dynamics::apply_to_all(static_shape_, x, condensed_.harmonics()) +
             dynamics::apply_low_rank({.left = pushed_, .inner = condensed_.inner(), .right = coupling}, x, conjugated);
    return dynamics::apply_transposed_to_all(static_shape_, x, condensed_.harmonics()) +
           dynamics::apply_low_rank({.left = coupling, .inner = condensed_.inner(), .right = pushed_}, x, conjugated);
  }
  std::vector<const Eigen::MatrixXcd*> shapes;
  for (const Eigen::MatrixXcd& shape : shape_) shapes.push_back(&shape);
  return dynamics::apply_harmonics(shapes, form, x);
}

}  // namespace dovetail::steady
