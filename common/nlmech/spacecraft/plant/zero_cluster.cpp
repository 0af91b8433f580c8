#include "nlmech/spacecraft/plant/zero_cluster.hpp"

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "nlmech/support/sentences.hpp"

namespace nlmech::spacecraft {
namespace {

constexpr std::size_t most_zeros = 8;

Status no_cluster(Outcome outcome, Complex centre, double radius, const char* what) {
  return failed_with(outcome, "zeros in a circle about {:g}{:+g}i of radius {:g}: {}; choose another circle",
                     centre.real(), centre.imag(), radius, what);
}

/// Newton's identities: coefficients, from z^0 on, of the monic polynomial whose zeros have these power sums.
std::vector<Complex> polynomial_of(const std::vector<Complex>& power_sums, std::size_t m) {
  std::vector<Complex> elementary(m + 1, 0.);
  elementary[0] = 1;
  for (std::size_t k = 1; k <= m; ++k) {
    Complex sum = 0;
    for (std::size_t i = 1; i <= k; ++i) sum += (i % 2 == 1 ? 1. : -1.) * elementary[k - i] * power_sums[i];
    elementary[k] = sum / static_cast<double>(k);
  }
  std::vector<Complex> a(m);
  for (std::size_t k = 1; k <= m; ++k) a[m - k] = (k % 2 == 1 ? -1. : 1.) * elementary[k];
  return a;
}

/// Weights at the zeros themselves that give the moments: w_i = sum_j l_ij mu_j, l_i being Lagrange's
/// polynomials.
std::vector<Complex> at_zeros(const std::vector<Complex>& zeros, const std::vector<Complex>& moments) {
  std::vector<Complex> weights;
  for (std::size_t i = 0; i < zeros.size(); ++i) {
    std::vector<Complex> l = {1.};
    for (std::size_t k = 0; k < zeros.size(); ++k) {
      if (k == i) continue;
      const Complex scale = 1. / (zeros[i] - zeros[k]);
      l.push_back(0.);
      for (std::size_t j = l.size(); j-- > 0;)
        l[j] = scale * ((j > 0 ? l[j - 1] : Complex(0)) - zeros[k] * l[j]);
    }
    Complex w = 0;
    for (std::size_t j = 0; j < l.size(); ++j) w += l[j] * moments[j];
    weights.push_back(w);
  }
  return weights;
}

/// Weights at points of a circle that give the moments and those that follow from them by the polynomial.
std::vector<Complex> on_circle(const std::vector<Complex>& nodes, const std::vector<Complex>& polynomial,
                               std::vector<Complex> moments) {
  const std::size_t m = polynomial.size(), count = nodes.size();
  for (std::size_t j = m; j < count; ++j) {
    Complex next = 0;
    for (std::size_t i = 0; i < m; ++i) next -= polynomial[i] * moments[j - m + i];
    moments.push_back(next);
  }
  std::vector<Complex> weights;
  for (const Complex& z : nodes) {
    Complex w = 0;
    for (std::size_t j = count; j-- > 0;) w = w / z + moments[j];
    weights.push_back(w / static_cast<double>(count));
  }
  return weights;
}

}  // namespace

std::vector<Complex> polynomial_zeros(const std::vector<Complex>& a) {
  const auto m = static_cast<Eigen::Index>(a.size());
  if (m == 1) return {-a[0]};
  Eigen::MatrixXcd companion = Eigen::MatrixXcd::Zero(m, m);
  companion.diagonal(-1).setOnes();
  for (Eigen::Index i = 0; i < m; ++i) companion(i, m - 1) = -a[static_cast<std::size_t>(i)];
  const bool real = std::all_of(a.begin(), a.end(), [](Complex c) { return c.imag() == 0; });
  const Eigen::VectorXcd values =
      real ? Eigen::VectorXcd(
                 Eigen::EigenSolver<Eigen::MatrixXd>(Eigen::MatrixXd(companion.real()), false).eigenvalues())
           : Eigen::VectorXcd(Eigen::ComplexEigenSolver<Eigen::MatrixXcd>(companion, false).eigenvalues());
  return {values.begin(), values.end()};
}

ZeroCluster zeros_in_circle(const std::function<Jet(Complex)>& f, Complex centre, double radius) {
  if (!(radius > 0) || !std::isfinite(radius))
    throw invalid_argument("zeros in a circle: the radius is {:g}", radius);
  ZeroCluster cluster{centre, radius, {}, {}, {}};
  std::vector<Complex> sums(most_zeros + 1, 0.);
  for (std::size_t k = 0; k < circle_points; ++k) {
    const Complex turn = std::polar(1., std::numbers::pi * static_cast<double>(2 * k + 1) / circle_points);
    const Jet value = f(centre + radius * turn);
    // In units of the radius, so that powers of it stay in range.
    Complex term = turn * (radius * (value.slope / value.value)) / static_cast<double>(circle_points);
    for (Complex& s : sums) {
      s += term;
      term *= turn;
    }
  }
  if (!is_finite(sums[0])) {
    cluster.status = no_cluster(Outcome::non_finite, centre, radius, "the function is 0 or not finite on it");
    return cluster;
  }
  const double count = std::round(sums[0].real());
  if (!(std::abs(sums[0] - count) < 1e-7) || count < 0 || count > most_zeros) {
    cluster.status =
        no_cluster(Outcome::not_converged, centre, radius, "zeros lie near it, or too many in it");
    return cluster;
  }
  const auto m = static_cast<std::size_t>(count);
  if (centre.imag() == 0) {
    for (Complex& s : sums) s = s.real();
  }
  std::vector<Complex> unit = polynomial_of(sums, m);
  cluster.zeros = m == 0 ? std::vector<Complex>{} : polynomial_zeros(unit);
  for (const Complex& z : cluster.zeros) {
    // A zero that other sums than these would be needed for.
    if (std::abs(z) > 0.75) {
      cluster.status = no_cluster(Outcome::not_converged, centre, radius, "zeros lie near it");
      return cluster;
    }
  }
  for (Complex& z : cluster.zeros) z *= radius;
  double power = radius;
  for (std::size_t j = m; j-- > 0; power *= radius) unit[j] *= power;
  cluster.polynomial = std::move(unit);
  return cluster;
}

ClusterNodes cluster_nodes(const ZeroCluster& cluster, const std::vector<std::vector<Complex>>& moments,
                           double decay, bool own) {
  constexpr std::size_t count = 24;
  double spread = 0;
  for (const Complex& z : cluster.zeros) spread = std::max(spread, std::abs(z));
  ClusterNodes result;
  if (spread >= 0.1 * decay) {
    result.nodes = cluster.zeros;
    for (const std::vector<Complex>& mu : moments) result.weights.push_back(at_zeros(result.nodes, mu));
  } else {
    const double radius = std::max(3 * spread, 0.1 * decay);
    for (std::size_t k = 0; k < count; ++k)
      result.nodes.push_back(std::polar(radius, std::numbers::pi * static_cast<double>(2 * k + 1) / count));
    for (const std::vector<Complex>& mu : moments)
      result.weights.push_back(on_circle(result.nodes, cluster.polynomial, mu));
  }
  if (!own) return result;
  // Of two conjugates one stands for both; a real one counts half, as in an ExponentialSum.
  ClusterNodes half;
  half.weights.resize(moments.size());
  for (std::size_t k = 0; k < result.nodes.size(); ++k) {
    const Complex z = result.nodes[k];
    if (z.imag() < 0) continue;
    half.nodes.push_back(z);
    for (std::size_t i = 0; i < moments.size(); ++i) {
      const Complex w = result.weights[i][k];
      half.weights[i].push_back(z.imag() == 0 ? Complex(w.real() / 2) : w);
    }
  }
  return half;
}

}  // namespace nlmech::spacecraft
