#include "steady/tangent.hpp"

#include <algorithm>
#include <limits>
#include <optional>

#include "numerics/dense_product.hpp"
#include "steady/near_jacobian.hpp"
#include "steady/params.hpp"
#include "steady/work.hpp"

namespace dovetail::steady {

Tangent::Tangent(std::shared_ptr<const Point> point, const Tangent* previous, Factorise when)
    : point_(std::move(point)) {
  if (previous) {
    near_ = previous->factors_ ? previous->factors_ : previous->near_;
    if (!near_->serve(problem())) near_ = nullptr;
  }
  if (near_ && near_->belong_to(*point_)) {
    factors_ = near_;
    shares_factors_ = true;
  } else if (when == Factorise::now || most_products() == 0) {
    (void)factors();
  }
}

const FactoredJacobian& Tangent::factors() const {
  if (!factors_) factors_ = std::make_shared<const FactoredJacobian>(point_, near_.get());
  return *factors_;
}

int Tangent::most_products() const {
  if (!near_) return 0;
  const double products = WorkParams{}.products * near_->operations() / near_->product_operations();
  return static_cast<int>(std::min(products, WorkParams{}.most_products));
}

std::optional<numerics::GmresResult> Tangent::solved_nearly(const Eigen::VectorXd& rhs, double tolerance) const {
  numerics::GmresResult found = solve_near(*point_, *near_, rhs, {.tolerance = tolerance, .most = most_products()});
  if (problem().budget()) problem().budget()->spend_on_factors(found.products * near_->product_operations());
  if (found.status != Status::converged) return {};
  return found;
}

bool Tangent::is_regular() const {
  constexpr SingularityParams kParams;
  if (!factors_ && !near_->nearly_singular(kParams.safe_pivots)) {
    const Eigen::VectorXd rhs = -residual_to_frequency(*point_).reshaped();
    if (const std::optional<numerics::GmresResult> found = solved_nearly(rhs, WorkParams{}.product_tolerance);
        found && found->products > 0 && found->least_stretch > kParams.safe_stretch) {
      by_frequency_ = found->x;
      return true;
    }
  }
  return factors().status() == Status::converged && !factors_->regularised() &&
         !factors_->nearly_singular(kParams.floats);
}

Eigen::MatrixXd Tangent::solve(const Eigen::Ref<const Eigen::MatrixXd>& rhs, double tolerance) const {
  if (!factors_ && rhs.cols() == 1)
    if (std::optional<numerics::GmresResult> found = solved_nearly(rhs, tolerance)) return found->x;
  if (factors().status() == Status::converged) return factors_->solve(rhs);
  return Eigen::MatrixXd::Constant(rhs.rows(), rhs.cols(), std::numeric_limits<double>::quiet_NaN());
}

Eigen::MatrixXd Tangent::solve_transposed(const Eigen::Ref<const Eigen::MatrixXd>& rhs) const {
  return factors().solve_transposed(rhs);
}

Eigen::MatrixXd Tangent::residual_to_wear(const std::vector<Eigen::Index>& nodes) const {
  const Eigen::Index nc = problem().model().contact_size(), d = problem().model().directions();
  const Eigen::Index k = problem().basis().coefficients();
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(unknowns(), static_cast<Eigen::Index>(nodes.size()));
  for (std::size_t p = 0; p < nodes.size(); ++p) {
    const Eigen::Index i = nodes[p];
    const Eigen::VectorXd column =
        -problem().penalty().normal(i) * point_->nodes[static_cast<std::size_t>(i)].force_derivative.col(0);
    for (Eigen::Index l = 0; l < d * k; ++l)
      result((l / d) * nc + i * d + l % d, static_cast<Eigen::Index>(p)) = column(l);
  }
  return result;
}

Eigen::MatrixXd Tangent::response_to_wear(const Eigen::VectorXd& wear_change) const {
  const Eigen::Index nc = problem().model().contact_size();
  std::vector<Eigen::Index> nodes;
  std::vector<double> change;
  for (Eigen::Index i = 0; i < wear_change.size(); ++i)
    if (wear_change(i) != 0) {
      nodes.push_back(i);
      change.push_back(wear_change(i));
    }
  const Eigen::VectorXd by_wear =
      residual_to_wear(nodes) *
      Eigen::Map<const Eigen::VectorXd>(change.data(), static_cast<Eigen::Index>(change.size()));
  const Eigen::VectorXd solved = solve(-by_wear);
  return solved.reshaped(nc, problem().basis().coefficients());
}

Eigen::MatrixXd Tangent::response_to_frequency() const {
  const Eigen::Index nc = problem().model().contact_size();
  if (by_frequency_.size() == 0) by_frequency_ = solve(-residual_to_frequency(*point_).reshaped());
  return by_frequency_.reshaped(nc, problem().basis().coefficients());
}

WearRateSlopes Tangent::wear_rate_slopes() const {
  const dynamics::CondensedModel& model = problem().model();
  const Eigen::Index d = model.directions(), nc = model.contact_size(), k = problem().basis().coefficients();
  WearRateSlopes slopes{.by_displacement = {}, .by_wear = Eigen::VectorXd(model.nodes())};
  const std::vector<Eigen::MatrixXd> by_prediction = wear_rate_by_prediction(*point_);
  for (Eigen::Index i = 0; i < model.nodes(); ++i)
    slopes.by_wear(i) = -problem().penalty().normal(i) * by_prediction[static_cast<std::size_t>(i)](0, 0);
  // A node predicts (eps I - Z) U - eps_N W; the transpose of the real form of Z is that of its conjugate.
  slopes.by_displacement = -problem().system().stiffness.apply_to_blocks(by_prediction, true);
  for (Eigen::Index i = 0; i < model.nodes(); ++i)
    for (Eigen::Index j = 0; j < k; ++j)
      slopes.by_displacement.col(i).segment(j * nc + i * d, d) +=
          by_prediction[static_cast<std::size_t>(i)].col(j).cwiseProduct(problem().dof_penalty().segment(i * d, d));
  return slopes;
}

Eigen::MatrixXd Tangent::wear_rate_to_wear(const std::vector<Eigen::Index>& nodes) const {
  const WearRateSlopes slopes = wear_rate_slopes();
  Eigen::MatrixXd result = numerics::transposed_product(slopes.by_displacement, solve(-residual_to_wear(nodes)));
  for (std::size_t p = 0; p < nodes.size(); ++p)
    result(nodes[p], static_cast<Eigen::Index>(p)) += slopes.by_wear(nodes[p]);
  return result;
}

}  // namespace dovetail::steady
