#include "nlmech/ivp/transversal/mtl_propagator.hpp"

#include <algorithm>
#include <cmath>

namespace nlmech::ivp {

using Eigen::Index;

namespace {

/// Numerator of the Pade approximant of degree 13, lowest power first; the denominator has (-1)^k.
constexpr double b[] = {64764752532480000.,
                        32382376266240000.,
                        7771770303897600.,
                        1187353796428800.,
                        129060195264000.,
                        10559470521600.,
                        670442572800.,
                        33522128640.,
                        1323241920.,
                        40840800.,
                        960960.,
                        16380.,
                        182.,
                        1.};
/// The largest norm for which the error of the approximant is below the unit roundoff.
constexpr double largest_norm = 5.371920351148152;

}  // namespace

MtlPropagator::MtlPropagator(int size, int columns, int orders, std::span<const Harmonic> load)
    : size_(size), columns_(columns), orders_(orders) {
  for (const Harmonic& h : load) {
    if (std::find(frequencies_.begin(), frequencies_.end(), h.frequency) == frequencies_.end())
      frequencies_.push_back(h.frequency);
  }
  load_.setZero(size_, phase_count());
  for (const Harmonic& h : load) {
    const Index which =
        std::find(frequencies_.begin(), frequencies_.end(), h.frequency) - frequencies_.begin();
    load_(h.component, 2 * which) += h.cosine;
    load_(h.component, 2 * which + 1) += h.sine;
  }
  const Index all = size_ + orders_ * columns_ + phase_count();
  for (Eigen::MatrixXd* m : {&matrix_, &result_, &a2_, &a4_, &a6_, &u_, &v_, &work_}) m->setZero(all, all);
  scale_.setOnes(all);
  lu_ = Eigen::PartialPivLU<Eigen::MatrixXd>(all);
}

void MtlPropagator::phases(double t, Eigen::VectorXd& out) const {
  for (std::size_t i = 0; i < frequencies_.size(); ++i) {
    out[static_cast<Index>(2 * i)] = std::cos(frequencies_[i] * t);
    out[static_cast<Index>(2 * i + 1)] = std::sin(frequencies_[i] * t);
  }
}

void MtlPropagator::assemble(const Eigen::Ref<const Eigen::MatrixXd>& a, double tau) {
  matrix_.setZero();
  matrix_.topLeftCorner(size_, size_) = tau * a;
  // E is the last columns of a unit matrix, and so is every link of the chain.
  matrix_.block(size_ - columns_, size_, columns_, columns_).diagonal().setConstant(tau);
  for (Index k = 1; k < orders_; ++k) {
    const Index at = size_ + (k - 1) * columns_;
    matrix_.block(at, at + columns_, columns_, columns_).diagonal().setConstant(tau);
  }
  const Index first = size_ + orders_ * columns_;
  matrix_.topRightCorner(size_, phase_count()) = tau * load_;
  for (std::size_t i = 0; i < frequencies_.size(); ++i) {
    const Index at = first + static_cast<Index>(2 * i);
    matrix_(at, at + 1) = -frequencies_[i] * tau;
    matrix_(at + 1, at) = frequencies_[i] * tau;
  }
}

// Balances by Osborne's iteration: powers of two, which cause no rounding, equalise row and column sums of
// every index. An index with a zero row or column is skipped; a few sweeps suffice.
void MtlPropagator::balance() {
  scale_.setOnes();
  const Index all = matrix_.rows();
  for (int sweep = 0; sweep < 10; ++sweep) {
    bool changed = false;
    for (Index i = 0; i < all; ++i) {
      const double diagonal = std::abs(matrix_(i, i));
      const double column = matrix_.col(i).cwiseAbs().sum() - diagonal;
      const double row = matrix_.row(i).cwiseAbs().sum() - diagonal;
      if (!(column > 0 && row > 0)) continue;
      const int power = static_cast<int>(std::lround(std::log2(row / column) / 2));
      const double factor = std::ldexp(1., power);
      if (power == 0 || !(column * factor + row / factor < 0.95 * (column + row))) continue;
      matrix_.col(i) *= factor;
      matrix_.row(i) /= factor;
      scale_[i] *= factor;
      changed = true;
    }
    if (!changed) return;
  }
}

void MtlPropagator::pade() {
  a2_.noalias() = matrix_ * matrix_;
  a4_.noalias() = a2_ * a2_;
  a6_.noalias() = a4_ * a2_;
  work_ = b[13] * a6_ + b[11] * a4_ + b[9] * a2_;
  v_.noalias() = a6_ * work_;
  v_ += b[7] * a6_ + b[5] * a4_ + b[3] * a2_;
  v_.diagonal().array() += b[1];
  u_.noalias() = matrix_ * v_;
  work_ = b[12] * a6_ + b[10] * a4_ + b[8] * a2_;
  v_.noalias() = a6_ * work_;
  v_ += b[6] * a6_ + b[4] * a4_ + b[2] * a2_;
  v_.diagonal().array() += b[0];
  work_ = v_ - u_;
  lu_.compute(work_);
  u_ += v_;
  result_ = lu_.solve(u_);
}

Outcome MtlPropagator::compute(const Eigen::Ref<const Eigen::MatrixXd>& a, double tau) {
  assemble(a, tau);
  if (!matrix_.allFinite()) return Outcome::non_finite;
  balance();
  const double norm = matrix_.cwiseAbs().colwise().sum().maxCoeff();
  if (!std::isfinite(norm)) return Outcome::non_finite;
  const int squarings = norm > largest_norm ? static_cast<int>(std::ceil(std::log2(norm / largest_norm))) : 0;
  matrix_ *= std::ldexp(1., -squarings);
  pade();
  for (int k = 0; k < squarings; ++k) {
    work_.noalias() = result_ * result_;
    result_.swap(work_);
  }
  for (Index j = 0; j < result_.cols(); ++j) result_.col(j) = result_.col(j).cwiseProduct(scale_) / scale_[j];
  return result_.allFinite() ? Outcome::success : Outcome::non_finite;
}

}  // namespace nlmech::ivp
