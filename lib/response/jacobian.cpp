#include <algorithm>
#include <cassert>
#include <numeric>

#include "numerics/dense_product.hpp"
#include "response/residual.hpp"

namespace dovetail::response {
namespace {

// Rows of one node that are asked for: their place in the node's block and in the result.
struct NodeRows {
  Eigen::Index node = 0;
  std::vector<Eigen::Index> local, place;
};

std::vector<NodeRows> by_node(const std::vector<Eigen::Index>& rows, Eigen::Index contact_size, Eigen::Index d) {
  std::vector<NodeRows> groups(static_cast<std::size_t>(contact_size / d));
  for (std::size_t p = 0; p < rows.size(); ++p) {
    const Eigen::Index k = rows[p] / contact_size, a = rows[p] % contact_size;
    NodeRows& group = groups[static_cast<std::size_t>(a / d)];
    group.node = a / d;
    group.local.push_back(k * d + a % d);
    group.place.push_back(static_cast<Eigen::Index>(p));
  }
  std::erase_if(groups, [](const NodeRows& group) { return group.local.empty(); });
  return groups;
}

void scatter(const Eigen::MatrixXd& block, Eigen::Index first, const std::vector<Eigen::Index>& place,
             double* const* columns) {
  const bool contiguous = place.back() - place.front() + 1 == static_cast<Eigen::Index>(place.size()) &&
                          std::is_sorted(place.begin(), place.end());
  for (Eigen::Index j = 0; j < block.cols(); ++j) {
    const double* from = block.col(j).data() + first;
    if (contiguous)
      std::copy(from, from + place.size(), columns[j] + place.front());
    else
      for (std::size_t p = 0; p < place.size(); ++p) columns[j][place[p]] = from[p];
  }
}

}  // namespace

void SteadyResidual::assemble(const ResidualState& state, const std::vector<Eigen::Index>& rows,
                              const std::vector<double*>& columns, double regularisation) const {
  assert(state.has_derivative);
  const Eigen::Index nc = offset_.size(), d = model_->directions(), k = basis_.coefficients(), m = d * k;
  const std::vector<NodeRows> groups = by_node(rows, nc, d);
  // Rows (I - D) of all groups at once: they meet Z harmonic by harmonic and node by node.
  std::vector<Eigen::MatrixXd> complements;
  for (const NodeRows& group : groups) {
    const Eigen::MatrixXd& derivative = state.nodes[static_cast<std::size_t>(group.node)].force_derivative;
    Eigen::MatrixXd complement = -derivative(group.local, Eigen::all);
    for (std::size_t p = 0; p < group.local.size(); ++p) complement(static_cast<Eigen::Index>(p), group.local[p]) += 1;
    complements.push_back((1 - regularisation) * complement);
    assert(complements.back().cols() == m);
  }
  // Cosine columns of a harmonic are E_c Re - E_s Im, sine columns E_c Im + E_s Re: one product gives both.
  Eigen::MatrixXd left, right, both;
  for (std::size_t h = 0; h < system_->harmonics.size(); ++h) {
    const Eigen::Index first = h == 0 ? 0 : 2 * static_cast<Eigen::Index>(h) - 1;
    const Eigen::MatrixXcd& stiffness = system_->harmonics[h].stiffness;
    for (std::size_t g = 0; g < groups.size(); ++g) {
      const Eigen::Index rows_here = complements[g].rows(), node = groups[g].node;
      const auto on_cosine = complements[g].middleCols(first * d, d);
      if (h == 0) {
        left = on_cosine;
        right = stiffness.middleRows(node * d, d).real();
      } else {
        const auto on_sine = complements[g].middleCols((first + 1) * d, d);
        left.resize(2 * rows_here, 2 * d);
        left << on_cosine, -on_sine, on_sine, on_cosine;
        right.resize(2 * d, nc);
        right.topRows(d) = stiffness.middleRows(node * d, d).real();
        right.bottomRows(d) = stiffness.middleRows(node * d, d).imag();
      }
      numerics::product(left, right, both);
      scatter(both, 0, groups[g].place, columns.data() + first * nc);
      if (h > 0) scatter(both, rows_here, groups[g].place, columns.data() + (first + 1) * nc);
    }
  }
  // + D eps on the node's own columns; D = I - complement.
  for (std::size_t g = 0; g < groups.size(); ++g)
    for (Eigen::Index l = 0; l < m; ++l) {
      const Eigen::Index dof = groups[g].node * d + l % d;
      double* column = columns[static_cast<std::size_t>((l / d) * nc + dof)];
      for (std::size_t p = 0; p < groups[g].local.size(); ++p)
        column[groups[g].place[p]] += dof_penalty_(dof) * ((groups[g].local[p] == l ? 1.0 : 0.0) -
                                                           complements[g](static_cast<Eigen::Index>(p), l));
    }
}

Eigen::MatrixXd SteadyResidual::jacobian_rows(const ResidualState& state, const std::vector<Eigen::Index>& rows) const {
  Eigen::MatrixXd result(static_cast<Eigen::Index>(rows.size()), unknowns());
  std::vector<double*> columns;
  for (Eigen::Index j = 0; j < unknowns(); ++j) columns.push_back(result.col(j).data());
  assemble(state, rows, columns, 0);
  return result;
}

Eigen::MatrixXd SteadyResidual::jacobian(const ResidualState& state) const {
  std::vector<Eigen::Index> rows(static_cast<std::size_t>(unknowns()));
  std::iota(rows.begin(), rows.end(), Eigen::Index{0});
  return jacobian_rows(state, rows);
}

}  // namespace dovetail::response
