#include "nlmech/ivp/transversal/mtl_weights.hpp"

#include <cmath>

namespace nlmech::ivp {

using Eigen::Index;

int mtl_order(MtlBasis basis, int points) {
  if (basis == MtlBasis::interpolet) return 2;
  return points + (points % 2 == 1 ? 1 : 2);
}

namespace {

/// Lagrange's polynomial phi_k = product over i of (j + s - i)/(k - i), expanded about s = 0.
Eigen::VectorXd lagrange_piece(int points, int j, int k) {
  Eigen::VectorXd c = Eigen::VectorXd::Unit(points + 1, 0);
  for (int i = 0; i <= points; ++i) {
    if (i == k) continue;
    Eigen::VectorXd next = (j - i) * c;
    next.tail(points) += c.head(points);
    c = next / (k - i);
  }
  return c;
}

/// Taylor coefficients of exp(-(a + s)^2/(2 w^2)) about s = 0, from f' = -(a + s)/w^2 f. For w >= 2, |a| <= 8
/// and s <= 1 the first one that is left out is below 2e-16.
Eigen::VectorXd gaussian_piece(double a, double w) {
  Eigen::VectorXd c(20);
  c[0] = std::exp(-a * a / (2 * w * w));
  c[1] = -a * c[0] / (w * w);
  for (Index m = 1; m + 1 < c.size(); ++m)
    c[m + 1] = -(a * c[m] + c[m - 1]) / (static_cast<double>(m + 1) * w * w);
  return c;
}

/// Product of two polynomials.
Eigen::VectorXd product(const Eigen::VectorXd& left, const Eigen::VectorXd& right) {
  Eigen::VectorXd c = Eigen::VectorXd::Zero(left.size() + right.size() - 1);
  for (Index i = 0; i < left.size(); ++i) c.segment(i, right.size()) += left[i] * right;
  return c;
}

}  // namespace

std::vector<Eigen::MatrixXd> mtl_pieces(MtlBasis basis, int points, double width) {
  std::vector<Eigen::MatrixXd> pieces;
  for (int j = 0; j < points; ++j) {
    if (basis == MtlBasis::interpolet) {
      Eigen::MatrixXd lines = Eigen::MatrixXd::Zero(points + 1, 2);
      lines.row(j) << 1, -1;
      lines.row(j + 1) << 0, 1;
      pieces.push_back(lines);
      continue;
    }
    std::vector<Eigen::VectorXd> rows;
    for (int k = 0; k <= points; ++k) {
      rows.push_back(lagrange_piece(points, j, k));
      if (basis == MtlBasis::daf) rows.back() = product(rows.back(), gaussian_piece(j - k, width));
    }
    Eigen::MatrixXd polynomials(points + 1, rows.front().size());
    for (Index k = 0; k <= points; ++k) polynomials.row(k) = rows[static_cast<std::size_t>(k)];
    pieces.push_back(polynomials);
  }
  return pieces;
}

MtlWeights::MtlWeights(int size, int columns, MtlBasis basis, int points, std::span<const Harmonic> load,
                       double width)
    : pieces_(mtl_pieces(basis, points, width)),
      flow_(size, columns, static_cast<int>(pieces_.front().cols()), load),
      partial_(flow_),
      weights_(Eigen::MatrixXd::Zero(Index{points} * size, Index{points + 1} * columns)),
      part_(size, columns),
      coefficient_(columns) {}

Outcome MtlWeights::compute(const Eigen::Ref<const Eigen::MatrixXd>& a, double h) {
  if (const Outcome outcome = flow_.compute(a, h); outcome != Outcome::success) return outcome;
  h_ = h;
  const Index n = part_.rows(), m = part_.cols();
  for (Index j = 0; j < static_cast<Index>(pieces_.size()); ++j) {
    const Eigen::MatrixXd& c = pieces_[static_cast<std::size_t>(j)];
    for (Index k = 0; k < c.rows(); ++k) {
      part_.setZero();
      double factor = 1;  // i!/h^i
      for (Index i = 0; i < c.cols(); ++i) {
        if (i > 0) factor *= static_cast<double>(i) / h;
        if (c(k, i) != 0) part_ += (c(k, i) * factor) * flow_.phi(static_cast<int>(i) + 1);
      }
      auto here = weights_.block(j * n, k * m, n, m);
      if (j > 0) part_.noalias() += flow_.exponential() * weights_.block((j - 1) * n, k * m, n, m);
      here = part_;
    }
  }
  return weights_.allFinite() ? Outcome::success : Outcome::non_finite;
}

void MtlWeights::free_motion(const Eigen::Ref<const Eigen::VectorXd>& x0, const Eigen::MatrixXd& phases,
                             Eigen::MatrixXd& out) const {
  out.col(0) = x0;
  for (Index l = 1; l < out.cols(); ++l) {
    out.col(l).noalias() = flow_.exponential() * out.col(l - 1);
    out.col(l).noalias() += flow_.response() * phases.col(l - 1);
  }
}

Outcome MtlWeights::prepare_between(const Eigen::Ref<const Eigen::MatrixXd>& a, double tau) {
  tau_ = tau;
  return partial_.compute(a, tau);
}

void MtlWeights::between(Index j, const Eigen::MatrixXd& g, const Eigen::Ref<const Eigen::VectorXd>& xj,
                         const Eigen::Ref<const Eigen::VectorXd>& phase, Eigen::Ref<Eigen::VectorXd> out) {
  const Eigen::MatrixXd& c = pieces_[static_cast<std::size_t>(j)];
  out.noalias() = partial_.exponential() * xj;
  out.noalias() += partial_.response() * phase;
  double factor = 1;
  for (Index i = 0; i < c.cols(); ++i) {
    if (i > 0) factor *= static_cast<double>(i) / h_;
    coefficient_.noalias() = g * c.col(i);
    coefficient_ *= factor;
    out.noalias() += partial_.phi(static_cast<int>(i) + 1) * coefficient_;
  }
}

void MtlWeights::interpolate(Index j, const Eigen::MatrixXd& g, Eigen::Ref<Eigen::VectorXd> out) const {
  const Eigen::MatrixXd& c = pieces_[static_cast<std::size_t>(j)];
  const double s = tau_ / h_;
  out.setZero();
  for (Index k = 0; k < c.rows(); ++k) {
    double value = 0;
    for (Index i = c.cols() - 1; i >= 0; --i) value = value * s + c(k, i);
    out += value * g.col(k);
  }
}

}  // namespace nlmech::ivp
