#include "nlmech/algebraic/paths/long_factors.hpp"

#include <Eigen/SparseCholesky>

namespace nlmech::algebraic {

struct LongFactors::Factors {
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<long double>> ldlt;
};

LongFactors::LongFactors() : factors_(std::make_unique<Factors>()) {}
LongFactors::LongFactors(LongFactors&&) noexcept = default;
LongFactors& LongFactors::operator=(LongFactors&&) noexcept = default;
LongFactors::~LongFactors() = default;

bool LongFactors::factorise(Eigen::SparseMatrix<long double>& b, const Eigen::VectorXd& scale) {
  for (Eigen::Index j = 0; j < b.cols(); ++j) {
    for (Eigen::SparseMatrix<long double>::InnerIterator i(b, j); i; ++i)
      i.valueRef() /= static_cast<long double>(scale[i.row()]) * scale[j];
  }
  auto& ldlt = factors_->ldlt;
  ldlt.compute(b);
  return ldlt.info() == Eigen::Success && ldlt.vectorD().allFinite();
}

Inertia LongFactors::inertia() const {
  Inertia inertia;
  inertia.negative = (factors_->ldlt.vectorD().array() < 0).count();
  return inertia;
}

void LongFactors::solve(const Eigen::VectorXd& b, Eigen::VectorXd& x) const {
  x = factors_->ldlt.solve(b.cast<long double>()).cast<double>();
}

}  // namespace nlmech::algebraic
