#include "steady/separated_nodes.hpp"

#include <algorithm>

#include "numerics/dense_product.hpp"
#include "steady/params.hpp"

namespace dovetail::steady {

SeparatedNodes::SeparatedNodes(std::shared_ptr<const dynamics::HarmonicSystem> system, std::vector<Eigen::Index> open,
                               std::vector<Eigen::Index> kept)
    : system_(std::move(system)), open_(std::move(open)), kept_(std::move(kept)) {
  if (open_.empty()) return;
  for (const dynamics::HarmonicStiffness& at : system_->harmonics) {
    const Eigen::MatrixXcd& z = at.stiffness;
    factors_.emplace_back(Eigen::MatrixXcd(z(open_, open_)));
    // Below this a floating part is told from a soft one by rounding alone.
    reciprocal_condition_ = std::min(reciprocal_condition_, factors_.back().reciprocal_condition());
    if (!(reciprocal_condition_ > SingularityParams{}.singular)) {
      status_ = Status::singular;
      return;
    }
    const Eigen::MatrixXcd coupling = z(open_, kept_);
    shape_.emplace_back(factors_.back().solve(coupling));
    condensed_.emplace_back(z(kept_, kept_) - numerics::transposed_product(coupling, shape_.back()));
  }
}

int SeparatedNodes::determinant_sign() const {
  if (status_ != Status::converged) return 0;
  return factors_.empty() ? 1 : factors_.front().determinant_sign();
}

std::vector<const Eigen::MatrixXcd*> SeparatedNodes::stiffness() const {
  std::vector<const Eigen::MatrixXcd*> result;
  for (std::size_t h = 0; h < system_->harmonics.size(); ++h)
    result.push_back(open_.empty() ? &system_->harmonics[h].stiffness : &condensed_[h]);
  return result;
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
  Eigen::MatrixXd result(b.rows(), b.cols());
  // Z_oo is symmetric: the transpose of its real form belongs to its conjugate.
  const double sign = transposed ? 1 : -1;
  Eigen::MatrixXcd amplitude(n, b.cols());
  for (std::size_t h = 0; h < factors_.size(); ++h) {
    const Eigen::Index cosine = h == 0 ? 0 : 2 * static_cast<Eigen::Index>(h) - 1, sine = cosine + 1;
    amplitude.real() = b.middleRows(cosine * n, n);
    if (h == 0)
      amplitude.imag().setZero();
    else
      amplitude.imag() = sign * b.middleRows(sine * n, n);
    const Eigen::MatrixXcd solved = factors_[h].solve(amplitude);
    result.middleRows(cosine * n, n) = solved.real();
    if (h > 0) result.middleRows(sine * n, n) = sign * solved.imag();
  }
  return result;
}

Eigen::MatrixXd SeparatedNodes::apply_shape(dynamics::Form form, const Eigen::MatrixXd& x) const {
  std::vector<const Eigen::MatrixXcd*> shapes;
  for (const Eigen::MatrixXcd& shape : shape_) shapes.push_back(&shape);
  return dynamics::apply_harmonics(shapes, form, x);
}

}  // namespace dovetail::steady
