#include "tests/spacecraft/oracle.hpp"
#include "nlmech/support/extended_real.hpp"

#include <array>
#include <cstddef>
#include <utility>

namespace nlmech::spacecraft::oracle {
namespace {

namespace mp = boost::multiprecision;
using Real = ExtendedReal<110>;

struct Z {
  Real re{0}, im{0};
  Z() = default;
  Z(const Real& a) : re(a) {}
  Z(const Real& a, const Real& b) : re(a), im(b) {}
};
Z operator+(const Z& a, const Z& b) { return {a.re + b.re, a.im + b.im}; }
Z operator-(const Z& a, const Z& b) { return {a.re - b.re, a.im - b.im}; }
Z operator-(const Z& a) { return {-a.re, -a.im}; }
Z operator*(const Z& a, const Z& b) { return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re}; }
Z operator/(const Z& a, const Z& b) {
  const Real size = b.re * b.re + b.im * b.im;
  return {(a.re * b.re + a.im * b.im) / size, (a.im * b.re - a.re * b.im) / size};
}
Real size(const Z& a) { return sqrt(a.re * a.re + a.im * a.im); }
Z exponential(const Z& a) {
  const Real e = exp(a.re);
  return {e * cos(a.im), e * sin(a.im)};
}
Z root(const Z& a) {
  const Real r = size(a);
  if (r == 0) return {};
  // The larger part first.
  if (a.re >= 0) {
    const Real re = sqrt((r + a.re) / 2);
    return {re, a.im / (2 * re)};
  }
  const Real im = sqrt((r - a.re) / 2);
  return a.im < 0 ? Z{-a.im / (2 * im), -im} : Z{a.im / (2 * im), im};
}

/// exp(way u (x - from)): value, derivatives, and the integral of (r + x) times it.
struct Function {
  Z u;
  Real from;
};
Z value(const Function& f, const Real& x, int order) {
  Z v = exponential(f.u * Z(x - f.from));
  for (int i = 0; i < order; ++i) v = v * f.u;
  return v;
}
Z first_moment(const Function& f, const Real& r, const Real& l) {
  const auto primitive = [&](const Real& x) {
    return value(f, x, 0) * (Z(r + x) / f.u - Z(Real(1)) / (f.u * f.u));
  };
  return primitive(l) - primitive(Real(0));
}

/// A function that is a sum of two exponentials: cos, sin, cosh, sinh, or one alone.
struct Column {
  Function a, b;
  Z ca, cb;
  [[nodiscard]] Z at(const Real& x, int order) const {
    return ca * value(a, x, order) + cb * value(b, x, order);
  }
  [[nodiscard]] Z moment(const Real& r, const Real& l) const {
    return ca * first_moment(a, r, l) + cb * first_moment(b, r, l);
  }
};

using Columns = std::array<Column, 4>;

std::array<Z, 4> solve(std::array<std::array<Z, 5>, 4> m) {
  for (std::size_t k = 0; k < 4; ++k) {
    std::size_t best = k;
    for (std::size_t i = k + 1; i < 4; ++i) {
      if (size(m[i][k]) > size(m[best][k])) best = i;
    }
    std::swap(m[k], m[best]);
    for (std::size_t i = 0; i < 4; ++i) {
      if (i == k) continue;
      const Z factor = m[i][k] / m[k][k];
      for (std::size_t j = k; j < 5; ++j) m[i][j] = m[i][j] - factor * m[k][j];
    }
  }
  return {m[0][4] / m[0][0], m[1][4] / m[1][1], m[2][4] / m[2][2], m[3][4] / m[3][3]};
}

struct Pair {
  Z theta, deflection;
};

/// w(0) = r, EI w''(0) = k (w'(0) - 1), EI w'' = -s^2 I_tip w' or w' = 1, EI w''' = s^2 m w or w = r + L at
/// L, and u = s^2 (I_hub theta + 2 (integral of rho (r + x) w + m (r + L) w(L) + I_tip w'(L))).
template <class MakeColumns>
Pair transfer(const Parameters& p, const Z& s, double place, const MakeColumns& make) {
  const Real ei = Real(p.youngs_modulus) * Real(p.second_moment), rho(p.mass_per_length), l(p.length),
             r(p.hub_radius), m(p.tip_mass), j(p.tip_inertia), x(place);
  const Z square = s * s, k = root(root(-(square * Z(rho / ei))));
  const Columns columns = make(k, l);
  const bool turns = std::isfinite(p.root_stiffness);
  const Real stiffness(turns ? p.root_stiffness : 0);
  std::array<std::array<Z, 5>, 4> a;
  for (std::size_t i = 0; i < 4; ++i) {
    const Column& c = columns[i];
    a[0][i] = c.at(Real(0), 0);
    a[1][i] = c.at(Real(0), 1);
    if (turns) a[1][i] = Z(stiffness) * a[1][i] - Z(ei) * c.at(Real(0), 2);
    a[2][i] = p.tip_keeps_slope() ? c.at(l, 1) : Z(ei) * c.at(l, 2) + square * Z(j) * c.at(l, 1);
    a[3][i] = p.tip_stays() ? c.at(l, 0) : Z(ei) * c.at(l, 3) - square * Z(m) * c.at(l, 0);
  }
  a[0][4] = Z(r);
  a[1][4] = Z(turns ? stiffness : Real(1));
  if (p.tip_keeps_slope()) a[2][4] = Z(Real(1));
  if (p.tip_stays()) a[3][4] = Z(r + l);
  const std::array<Z, 4> amplitude = solve(a);
  Z momentum{Real(p.hub_inertia)}, w;
  for (std::size_t i = 0; i < 4; ++i) {
    const Column& c = columns[i];
    momentum = momentum + Z(Real(2)) * amplitude[i] *
                              (Z(rho) * c.moment(r, l) + Z(m * (r + l)) * c.at(l, 0) + Z(j) * c.at(l, 1));
    w = w + amplitude[i] * c.at(x, 0);
  }
  const Z theta = Z(Real(1)) / (square * momentum);
  return {theta, (w - Z(r + x)) * theta};
}

template <class MakeColumns>
Exact exact(const Parameters& p, Complex s, double x, const MakeColumns& make) {
  const Z at(Real(s.real()), Real(s.imag()));
  const Real step("1e-25");
  const Pair here = transfer(p, at, x, make), near = transfer(p, at * Z(Real(1 + step)), x, make);
  const auto rounded = [](const Z& z) {
    return Complex(static_cast<double>(z.re), static_cast<double>(z.im));
  };
  const auto condition = [&](const Z& a, const Z& b) {
    return size(a) == 0 ? 0. : static_cast<double>(Real(size(b - a) / size(a) / step));
  };
  return {rounded(here.theta), rounded(here.deflection), condition(here.theta, near.theta),
          condition(here.deflection, near.deflection)};
}

}  // namespace

Exact by_exponentials(const Parameters& parameters, Complex s, double x) {
  return exact(parameters, s, x, [](const Z& k, const Real& l) {
    // Of two opposite roots of k^4 = -beta the one that decays from x = 0; its opposite decays from x = L.
    const Z one = k.re >= 0 ? k : -k, turned{-k.im, k.re}, two = turned.re >= 0 ? turned : -turned;
    const Z unit(Real(1)), none;
    const auto alone = [&](const Z& u, const Real& from) { return Column{{u, from}, {u, from}, unit, none}; };
    return Columns{alone(-one, Real(0)), alone(-two, Real(0)), alone(one, l), alone(two, l)};
  });
}

Exact by_hyperbolics(const Parameters& parameters, Complex s, double x) {
  return exact(parameters, s, x, [](const Z& k, const Real& /*l*/) {
    const Z i{Real(0), Real(1)}, half(Real(0.5));
    const auto sum = [&](const Z& u, const Z& ca, const Z& cb) {
      return Column{{u, Real(0)}, {-u, Real(0)}, ca, cb};
    };
    return Columns{sum(i * k, half, half), sum(i * k, -(half * i), half * i), sum(k, half, half),
                   sum(k, half, -half)};
  });
}

}  // namespace nlmech::spacecraft::oracle
