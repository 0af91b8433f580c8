/// @file
/// Computes the coefficients of nlmech/geodesy/kernels/arctangent.hpp: the polynomial Q of n terms for which
/// t + t^3 Q(t^2) is the best approximation of atan(t) on |t| <= tan(pi/8), by the exchange algorithm of
/// Remez in 50 digits. Prints them rounded to double, and the largest error of the rounded polynomial.

#include <cstdio>
#include <cstdlib>
#include <vector>

#include "nlmech/support/extended_real.hpp"

namespace {

using Real = nlmech::ExtendedReal<50>;
using Vector = std::vector<Real>;

const Real pi = boost::math::constants::pi<Real>();

Real weight(const Real& w) { return w * sqrt(w); }

/// (atan(t) - t)/t^3 for w = t^2.
Real target(const Real& w) {
  const Real t = sqrt(w);
  return (atan(t) - t) / (w * t);
}

Real polynomial(const Vector& c, const Real& w) {
  Real sum = 0;
  for (std::size_t k = c.size(); k-- > 0;) sum = sum * w + c[k];
  return sum;
}

/// Gaussian elimination with row exchange, for small systems in 50 digits.
Vector solve(std::vector<Vector> m) {
  const std::size_t n = m.size();
  for (std::size_t i = 0; i < n; ++i) {
    std::size_t pivot = i;
    for (std::size_t k = i + 1; k < n; ++k) {
      if (abs(m[k][i]) > abs(m[pivot][i])) pivot = k;
    }
    swap(m[i], m[pivot]);
    for (std::size_t k = 0; k < n; ++k) {
      if (k == i) continue;
      const Real factor = m[k][i] / m[i][i];
      for (std::size_t j = i; j <= n; ++j) m[k][j] -= factor * m[i][j];
    }
  }
  Vector x;
  for (std::size_t i = 0; i < n; ++i) x.push_back(m[i][n] / m[i][i]);
  return x;
}

/// Coefficients for which the weighted error has equal size and alternating sign at the given points.
Vector equal_ripple(const Vector& points) {
  const std::size_t n = points.size() - 1;
  std::vector<Vector> m;
  for (std::size_t i = 0; i <= n; ++i) {
    Vector row(1, Real(1));
    while (row.size() < n) row.push_back(row.back() * points[i]);
    row.push_back((i % 2 == 0 ? 1 : -1) / weight(points[i]));
    row.push_back(target(points[i]));
    m.push_back(row);
  }
  Vector c = solve(m);
  c.pop_back();
  return c;
}

struct Errors {
  Vector extrema;  ///< one in each interval of equal sign
  Real greatest = 0;
};

Errors errors(const Vector& c, const Real& end) {
  constexpr int samples = 4000;
  Errors result;
  Real at_peak = 0;
  for (int k = 1; k <= samples; ++k) {
    const Real w = end * (1 - cos(pi * k / samples)) / 2;
    const Real error = weight(w) * (polynomial(c, w) - target(w));
    if (result.extrema.empty() || error * at_peak < 0) {
      result.extrema.push_back(w);
      at_peak = error;
    } else if (abs(error) > abs(at_peak)) {
      result.extrema.back() = w;
      at_peak = error;
    }
    if (abs(error) > result.greatest) result.greatest = abs(error);
  }
  return result;
}

}  // namespace

int main(int count, char** arguments) {
  const long n = count > 1 ? std::strtol(arguments[1], nullptr, 10) : 10;
  const Real end = tan(pi / 8) * tan(pi / 8);
  Vector points;
  for (long k = 0; k <= n; ++k) points.push_back(end * (1 - cos(pi * (k + Real(1) / 2) / (n + 1))) / 2);

  Vector c;
  for (int sweep = 0; sweep < 8; ++sweep) {
    c = equal_ripple(points);
    const Errors e = errors(c, end);
    if (e.extrema.size() != points.size()) break;
    points = e.extrema;
  }
  for (Real& value : c) {
    value = Real(value.convert_to<double>());
    std::printf("%a\n", value.convert_to<double>());
  }
  std::printf("greatest error %.3g\n", errors(c, end).greatest.convert_to<double>());
}
