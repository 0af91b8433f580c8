#include "chapters/gss_control/plant/extended.hpp"
#include "nlmech/support/extended_real.hpp"

#include <utility>

namespace nlmech::chapters::gss_control {
namespace {

using Real = ExtendedReal<100>;
using Four = std::array<Real, 4>;

/// Row of a 4 x 4 system with its right-hand side.
struct Row {
  Four a;
  Real b;
};

/// Gaussian elimination with row scaling and partial pivoting.
Four solve(std::array<Row, 4> m) {
  for (Row& row : m) {
    Real largest = 0;
    for (const Real& a : row.a) largest = std::max(largest, Real(abs(a)));
    for (Real& a : row.a) a /= largest;
    row.b /= largest;
  }
  for (std::size_t k = 0; k < 4; ++k) {
    std::size_t pivot = k;
    for (std::size_t i = k + 1; i < 4; ++i) {
      if (abs(m.at(i).a.at(k)) > abs(m.at(pivot).a.at(k))) pivot = i;
    }
    std::swap(m.at(k), m.at(pivot));
    for (std::size_t i = k + 1; i < 4; ++i) {
      const Real factor = m.at(i).a.at(k) / m.at(k).a.at(k);
      for (std::size_t j = k; j < 4; ++j) m.at(i).a.at(j) -= factor * m.at(k).a.at(j);
      m.at(i).b -= factor * m.at(k).b;
    }
  }
  Four x;
  for (std::size_t k = 4; k-- > 0;) {
    x.at(k) = m.at(k).b;
    for (std::size_t j = k + 1; j < 4; ++j) x.at(k) -= m.at(k).a.at(j) * x.at(j);
    x.at(k) /= m.at(k).a.at(k);
  }
  return x;
}

/// theta/u, y(L/2)/u, y(L)/u at s = j omega. w = c1 cos qx + c2 sin qx + c3 e^(-qx) + c4 e^(-q(L - x)) with
/// q^4 = omega^2 rho/EI, theta = 1.
std::array<Real, 3> response(const spacecraft::Parameters& p, const Real& omega) {
  const Real ei = Real(p.youngs_modulus) * p.second_moment, length = p.length, r = p.hub_radius;
  const Real q = sqrt(omega) * pow(Real(p.mass_per_length) / ei, Real(1) / 4);
  const auto basis = [&](const Real& x, int derivative) {
    const Real c = cos(q * x), s = sin(q * x), near = exp(-q * x), far = exp(-q * (length - x));
    const Real power = pow(q, derivative);
    const Four trigonometric = {c, -s, -c, s}, sine = {s, c, -s, -c};
    const auto d = static_cast<std::size_t>(derivative % 4);
    return Four{trigonometric.at(d) * power, sine.at(d) * power,
                near * power * (derivative % 2 == 0 ? 1 : -1), far * power};
  };
  const Real s2 = -omega * omega;
  std::array<Row, 4> rows = {Row{basis(0, 0), r}, Row{basis(0, 1), 1}, Row{basis(length, 2), 0},
                             Row{basis(length, 3), 0}};
  const Four end = basis(length, 0), slope = basis(length, 1);
  for (std::size_t i = 0; i < 4; ++i) {
    rows[2].a.at(i) += s2 * Real(p.tip_inertia) / ei * slope.at(i);
    rows[3].a.at(i) -= s2 * Real(p.tip_mass) / ei * end.at(i);
  }
  const Four c = solve(rows);
  const auto at = [&](const Real& x, int derivative) {
    const Four b = basis(x, derivative);
    return Real(c[0] * b[0] + c[1] * b[1] + c[2] * b[2] + c[3] * b[3]);
  };
  const Real inertia = ei * (r * at(0, 3) - at(0, 2));  // s^2 B
  const Real theta = 1 / (s2 * Real(p.hub_inertia) + 2 * inertia);
  const Real middle = length / 2;
  return {theta, (at(middle, 0) - r - middle) * theta, (at(length, 0) - r - length) * theta};
}

}  // namespace

Extended extended_response(const spacecraft::Parameters& parameters, double omega) {
  const Real w = omega, step = 1e-30;
  const auto here = response(parameters, w), above = response(parameters, w * (1 + step));
  Extended e;
  for (std::size_t i = 0; i < here.size(); ++i) {
    e.value.at(i) = static_cast<double>(here.at(i));
    e.condition.at(i) = static_cast<double>(Real(abs((above.at(i) / here.at(i) - 1) / step)));
  }
  return e;
}

}  // namespace nlmech::chapters::gss_control
