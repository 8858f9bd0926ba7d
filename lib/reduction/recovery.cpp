#include "reduction/recovery.hpp"

#include <cassert>

namespace dovetail::reduction {

Eigen::MatrixXd Recovery::apply(const Eigen::Ref<const Eigen::MatrixXd>& q,
                                const Eigen::Ref<const Eigen::MatrixXd>& lambda, double offset_scale) const {
  assert(q.rows() >= first + basis.cols());
  Eigen::MatrixXd field = basis * q.middleRows(first, basis.cols());
  if (contact_response.cols() > 0) {
    assert(lambda.rows() == contact_response.cols() && lambda.cols() == q.cols());
    field.noalias() += contact_response * lambda;
  }
  if (offset.size() > 0) field.colwise() += offset_scale * offset;
  return field;
}

Recovery Recovery::project(const Eigen::SparseMatrix<double>& rows_of_interest) const {
  Recovery part;
  part.first = first;
  part.basis = rows_of_interest * basis;
  if (contact_response.cols() > 0) part.contact_response = rows_of_interest * contact_response;
  if (offset.size() > 0) part.offset = rows_of_interest * offset;
  return part;
}

}  // namespace dovetail::reduction
