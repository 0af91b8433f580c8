#include "nlmech/collocation/radau/radau_transform.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <vector>

#include "nlmech/collocation/integration.hpp"
#include "nlmech/collocation/nodes.hpp"

namespace nlmech::collocation {
namespace {

/// Columns of T: the real eigenvector, then the real and imaginary parts of the complex ones, by increasing
/// imaginary part of the eigenvalue.
template <int s>
RadauTransform<s> make_transform() {
  // Dynamic size, so that one eigenvalue solver is compiled for all s.
  using Square = Matrix<long double>;
  const Square inverse = (integration_matrix(radau_right<long double>(s)) / 2).inverse();
  const Eigen::EigenSolver<Square> eigen(inverse);
  const auto& values = eigen.eigenvalues();
  const auto vectors = eigen.eigenvectors();
  std::vector<int> order;
  for (int i = 0; i < s; ++i) {
    if (values[i].imag() >= 0) order.push_back(i);
  }
  std::sort(order.begin(), order.end(), [&](int a, int b) { return values[a].imag() < values[b].imag(); });
  RadauTransform<s> r;
  Square t(s, s);
  int column = 0;
  for (const int i : order) {
    for (int row = 0; row < s; ++row) t(row, column) = vectors(row, i).real();
    if (column == 0) {
      r.real = static_cast<double>(values[i].real());
      ++column;
      continue;
    }
    // For the vector u + iv of alpha + i beta, A^-1 (a u - b v) = (alpha a - beta b) u - (beta a + alpha b)
    // v: the pair (a, b) transforms as a + ib.
    for (int row = 0; row < s; ++row) t(row, column + 1) = -vectors(row, i).imag();
    r.complex[static_cast<std::size_t>((column - 1) / 2)] = {static_cast<double>(values[i].real()),
                                                             static_cast<double>(values[i].imag())};
    column += 2;
  }
  r.from = t.template cast<double>();
  r.to = t.inverse().eval().template cast<double>();
  return r;
}

}  // namespace

template <int s>
const RadauTransform<s>& radau_transform() {
  static const RadauTransform<s> tables = make_transform<s>();
  return tables;
}

template const RadauTransform<3>& radau_transform<3>();
template const RadauTransform<5>& radau_transform<5>();
template const RadauTransform<7>& radau_transform<7>();

namespace {

using Real = long double;
using Complex = std::complex<Real>;

/// Eigenvalues of A^-1: the real one, then one of each pair by increasing imaginary part, as in
/// RadauTransform.
template <int s>
std::vector<Complex> upper_eigenvalues() {
  const Matrix<Real> inverse = (integration_matrix(radau_right<Real>(s)) / 2).inverse();
  const auto values = inverse.eigenvalues().eval();
  std::vector<Complex> upper;
  for (const Complex& value : values) {
    if (value.imag() >= 0) upper.push_back(value);
  }
  std::sort(upper.begin(), upper.end(),
            [](const Complex& a, const Complex& b) { return a.imag() < b.imag(); });
  return upper;
}

/// Value and derivative at @p t of the polynomial that is 1 at node j, 0 at the others and at the start.
std::array<Real, 2> cardinal(const Vector<Real>& nodes, Eigen::Index j, Real t) {
  Real value = t / nodes[j], slope = 1 / nodes[j];
  for (Eigen::Index m = 0; m < nodes.size(); ++m) {
    if (m == j) continue;
    const Real scale = 1 / (nodes[j] - nodes[m]);
    slope = (slope * (t - nodes[m]) + value) * scale;
    value *= (t - nodes[m]) * scale;
  }
  return {value, slope};
}

/// Integral of (1 - c)^k/k! p(c) over the unit interval by the Radau quadrature with @p degree nodes.
template <class P>
Real moment(int k, int degree, P p) {
  const Vector<Real> tau = radau_right<Real>(degree);
  const Matrix<Real> integral = integration_matrix(tau);
  Real sum = 0;
  for (Eigen::Index i = 0; i < tau.size(); ++i) {
    const Real c = (1 + tau[i]) / 2;
    Real power = 1;
    for (int m = 1; m <= k; ++m) power *= (1 - c) / m;
    sum += integral(tau.size() - 1, i) / 2 * power * p(c);
  }
  return sum;
}

/// N/Q in partial fractions for the integral of exp((1 - c) z) p(c).
template <int s, class P>
typename RadauDefect<s>::Weights fractions(const std::vector<Complex>& upper, P p) {
  std::vector<Complex> all = upper;
  for (std::size_t i = 1; i < upper.size(); ++i) all.push_back(std::conj(upper[i]));
  Complex rate = 0;  // Q = 1 - rate z + ...
  for (const Complex& value : all) rate += Real(1) / value;
  const Real low = moment(s - 2, 2 * s, p), high = moment(s - 1, 2 * s, p) - rate.real() * low;
  typename RadauDefect<s>::Weights weights;
  for (std::size_t i = 0; i < upper.size(); ++i) {
    Complex w = (low + high * upper[i]) * upper[i];
    for (int m = 0; m < s - 2; ++m) w *= upper[i];
    for (const Complex& value : all) {
      if (value != upper[i]) w *= value / (value - upper[i]);
    }
    weights[i] = std::complex<double>(i == 0 ? w : Real(2) * w);
  }
  return weights;
}

// The usual error estimate, of order s + 1 and compared with a power of the tolerance because the order at
// the end is 2 s - 1, fails if stiffness reduces the order: it accepts a fast vibration far above the
// tolerance.
template <int s>
RadauDefect<s> make_defect() {
  const Vector<Real> nodes = (radau_right<Real>(s).array() + 1) / 2;
  // A point near the end at which the node polynomial is large enough for a division.
  const Real inner = (nodes[s - 3] + nodes[s - 2]) / 2;
  RadauDefect<s> r;
  r.inner_time = static_cast<double>(inner);
  for (int j = 0; j < s; ++j) {
    const auto at_inner = cardinal(nodes, j, inner);
    r.begin_slope[j] = static_cast<double>(cardinal(nodes, j, 0)[1]);
    r.inner_value[j] = static_cast<double>(at_inner[0]);
    r.inner_slope[j] = static_cast<double>(at_inner[1]);
  }
  const auto m = [&](Real c) { return (1 - c / nodes.array()).prod(); };
  const std::vector<Complex> upper = upper_eigenvalues<s>();
  r.begin = fractions<s>(upper, [&](Real c) { return m(c) * (1 - c / inner); });
  r.inner = fractions<s>(upper, [&](Real c) { return m(c) / m(inner) * c / inner; });
  return r;
}

}  // namespace

template <int s>
const RadauDefect<s>& radau_defect() {
  static const RadauDefect<s> tables = make_defect<s>();
  return tables;
}

template const RadauDefect<3>& radau_defect<3>();
template const RadauDefect<5>& radau_defect<5>();
template const RadauDefect<7>& radau_defect<7>();

}  // namespace nlmech::collocation
