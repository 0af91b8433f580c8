#include "nlmech/bvp/optimal_control/second_variation.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>

namespace nlmech::bvp {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

SecondOrder classify(const MatrixXd& hessian, const std::vector<Eigen::RowVectorXd>& held) {
  const auto count = static_cast<Index>(held.size());
  MatrixXd reduced = hessian;
  if (count > 0) {
    MatrixXd rows(count, hessian.rows());
    for (Index i = 0; i < count; ++i) rows.row(i) = held[static_cast<std::size_t>(i)];
    const MatrixXd q = Eigen::HouseholderQR<MatrixXd>(rows.transpose()).householderQ();
    const MatrixXd null = q.rightCols(hessian.rows() - count);
    reduced = null.transpose() * hessian * null;
  }
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(reduced, Eigen::EigenvaluesOnly);
  const VectorXd& values = eigen.eigenvalues();
  SecondOrder result;
  result.least = values.minCoeff();
  result.tolerance = 1e-6 * std::max(1.0, values.maxCoeff());
  result.negative = static_cast<int>((values.array() < -result.tolerance).count());
  result.kind = result.negative > 0               ? Kind::saddle
                : result.least > result.tolerance ? Kind::minimum
                                                  : Kind::degenerate;
  return result;
}

}  // namespace nlmech::bvp
