#include "nlmech/geodesy/tangent_fit.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>

namespace nlmech::geodesy {
namespace {

using Index = std::size_t;

constexpr Index nodes = 16;  // in each variable; enough to keep aliasing below the truncated terms
using Grid = std::array<std::array<double, nodes>, nodes>;

/// cos(k pi/32) for any k, from constants: library cosines may differ in the last digit between machines.
double cosine(Index k) {
  constexpr std::array<double, 17> first = {1.0,
                                            0.99518472667219688624,
                                            0.98078528040323044913,
                                            0.95694033573220886494,
                                            0.92387953251128675613,
                                            0.88192126434835502971,
                                            0.83146961230254523708,
                                            0.77301045336273696081,
                                            0.70710678118654752440,
                                            0.63439328416364549822,
                                            0.55557023301960222474,
                                            0.47139673682599764856,
                                            0.38268343236508977173,
                                            0.29028467725446236764,
                                            0.19509032201612826785,
                                            0.098017140329560601994,
                                            0.0};
  k %= 64;
  if (k > 32) k = 64 - k;
  return k <= 16 ? first[k] : -first[32 - k];
}

/// Chebyshev coefficients of values at the Chebyshev nodes, along the second index.
Grid transform_rows(const Grid& values) {
  Grid result{};
  for (Index i = 0; i < nodes; ++i) {
    for (Index j = 0; j < nodes; ++j) {
      double sum = 0;
      for (Index k = 0; k < nodes; ++k) sum += values[i][k] * cosine(j * (2 * k + 1));
      result[i][j] = sum * (j == 0 ? 1. : 2.) / nodes;
    }
  }
  return result;
}

Grid transposed(const Grid& g) {
  Grid result{};
  for (Index i = 0; i < nodes; ++i) {
    for (Index j = 0; j < nodes; ++j) result[j][i] = g[i][j];
  }
  return result;
}

/// Row n: T_n(2x - 1) in powers of x, integer coefficients, by T_n+1 = 2 (2x - 1) T_n - T_n-1.
std::array<std::array<double, 6>, 6> shifted_chebyshev() {
  std::array<std::array<double, 6>, 6> t{};
  t[0][0] = 1;
  t[1] = {-1, 2};
  for (Index n = 1; n + 1 < t.size(); ++n) {
    for (Index k = 0; k < t.size(); ++k) {
      t[n + 1][k] = (k == 0 ? 0 : 4 * t[n][k - 1]) - 2 * t[n][k] - t[n - 1][k];
    }
  }
  return t;
}

double value(const TangentFit& fit, double q, double m) {
  double sum = 0;
  for (Index i = TangentFit::q_terms; i-- > 0;) {
    double row = 0;
    for (Index j = TangentFit::m_terms; j-- > 0;) row = row * m + fit.coefficient[i][j];
    sum = sum * q + row;
  }
  return sum;
}

}  // namespace

double exact_tangent(double e2, double q, double m) noexcept {
  const double c2 = 1 - m;
  double u = e2 * q, F = e2;
  for (int n = 0; n < 20; ++n) {
    const double A = 1 + c2 * u, B = 1 - m * u;
    const double W = std::sqrt(1 + m * c2 * u * u - e2 * m * A * A);
    // Divided by q, so that q = 0 is a regular point.
    const double residual = F * W - e2 * A * B;
    const double slope = W + m * c2 * u * (u - e2 * A) / W - e2 * q * (c2 * B - m * A);
    const double step = residual / slope;
    F -= step;
    u = q * F;
    if (std::abs(step) <= 1e-16 * std::abs(F)) break;
  }
  return F;
}

TangentFit fit_tangent(const Ellipsoid& ellipsoid) {
  const double f = ellipsoid.f(), e2 = ellipsoid.e2();
  if (!(std::abs(f) <= 0.25)) {
    throw std::invalid_argument("fit_tangent: flattening must lie between -1/4 and 1/4, is " +
                                std::to_string(f));
  }
  TangentFit fit;
  fit.q_max = 1 / (std::min(1., 1 - f) * (1 - TangentFit::depth));

  Grid samples{};
  for (Index i = 0; i < nodes; ++i) {
    const double q = fit.q_max * (1 + cosine(2 * i + 1)) / 2;
    for (Index j = 0; j < nodes; ++j) samples[i][j] = exact_tangent(e2, q, (1 + cosine(2 * j + 1)) / 2);
  }
  const Grid chebyshev = transposed(transform_rows(transposed(transform_rows(samples))));

  const auto basis = shifted_chebyshev();
  for (Index i = 0; i < TangentFit::q_terms; ++i) {
    for (Index j = 0; j < TangentFit::m_terms; ++j) {
      for (Index k = 0; k <= i; ++k) {
        for (Index l = 0; l <= j; ++l) fit.coefficient[k][l] += chebyshev[i][j] * basis[i][k] * basis[j][l];
      }
    }
  }
  double scale = 1;
  for (auto& row : fit.coefficient) {
    for (double& c : row) c *= scale;
    scale /= fit.q_max;
  }

  // The grid avoids the nodes and includes the edges, where the error is greatest.
  constexpr Index steps = 40;
  for (Index i = 0; i <= steps; ++i) {
    for (Index j = 0; j <= steps; ++j) {
      const double q = fit.q_max * static_cast<double>(i) / steps, m = static_cast<double>(j) / steps;
      const double difference = value(fit, q, m) - exact_tangent(e2, q, m);
      fit.error = std::max(fit.error, q * std::sqrt(m * (1 - m)) * std::abs(difference));
    }
  }
  return fit;
}

}  // namespace nlmech::geodesy
