#include "tests/adversary/commands/half_toggle.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace nlmech::adversary {
namespace {

using Element = Eigen::Matrix<Real, 6, 1>;
constexpr Real pi = std::numbers::pi_v<Real>;
constexpr Real eps = std::numeric_limits<Real>::epsilon();

/// The axial force n = N l^2/EI of a stretch under both bendings: the root of a function that falls between
/// the pole at -4 pi^2 and infinity.
Real axial_of(Real strain, Real antisymmetric, Real symmetric, Real softness) {
  const auto balance = [&](Real n) {
    const Flexibility f = flexibility(n / 4);
    // g_s = 4 (1 + y u), g_a = 4/u
    const Real of_s = f.u + n / 4 * f.slope, of_a = -f.slope / (f.u * f.u);
    return strain + (antisymmetric * of_a + symmetric * of_s) / 2 - softness * n;
  };
  Real low = -4 * pi * pi * (1 - 1e-15L), high = std::max<Real>(1, 2 * (std::abs(strain) + 1) / softness);
  if (balance(low) < 0) return std::numeric_limits<Real>::quiet_NaN();
  Real n = std::clamp(strain / softness, low / 2, high / 2), at = balance(n);
  const Real h = 1e-6L * (1 + std::abs(n));
  Real slope = (balance(n + h) - at) / h;
  for (int i = 0; i < 200 && at != 0; ++i) {
    (at > 0 ? low : high) = n;
    Real next = n - at / slope;
    if (!(next > low && next < high)) next = low + (high - low) / 2;
    const Real change = next - n, before = at;
    n = next;
    if (std::abs(change) <= 2 * eps * std::abs(n)) break;  // a tiny load has all digits too
    at = balance(n);
    if (at != before) slope = (at - before) / change;
  }
  return n;
}

/// Pivots of a symmetric matrix, eliminated in the order of its rows: as many are negative as eigenvalues.
void count(RealMatrix k, int& negative, Real& least) {
  const RealVector diagonal = k.diagonal().cwiseAbs();
  for (Eigen::Index i = 0; i < k.rows(); ++i) {
    const Real pivot = k(i, i);
    negative += pivot < 0 ? 1 : 0;
    least = std::min(least, std::abs(pivot) / diagonal[i]);
    const Eigen::Index rest = k.rows() - i - 1;
    const RealVector column = k.col(i).tail(rest);
    k.bottomRightCorner(rest, rest) -= column * column.transpose() / pivot;
  }
}

}  // namespace

Flexibility flexibility(Real y) {
  if (std::abs(y) < 1) {  // u = 2 sum (-1)^k zeta(2 k + 2) y^k/pi^(2 k + 2)
    static const std::vector<Real> terms = [] {
      std::vector<Real> all;
      for (int k = 0; k < 22; ++k)
        all.push_back((k % 2 == 0 ? 2 : -2) * std::riemann_zeta(Real(2 * k + 2)) * std::pow(pi, -2 * k - 2));
      return all;
    }();
    Real u = 0, slope = 0;
    for (std::size_t k = terms.size(); k-- > 0;) {
      slope = slope * y + u;
      u = u * y + terms[k];
    }
    return {u, slope};
  }
  const Real r = std::sqrt(std::abs(y));
  const Real cotangent = y > 0 ? 1 / std::tanh(r) : 1 / std::tan(r),
             sine = y > 0 ? std::sinh(r) : std::sin(r);
  const Real c = r * cotangent, c_slope = (y > 0 ? 1 : -1) * (cotangent - r / (sine * sine)) / (2 * r);
  const Real u = (c - 1) / y;
  return {u, (c_slope - u) / y};
}

HalfToggle::HalfToggle(double height, int elements) : m_(elements) {
  const Real length = 12.94, h = height;  // the double
  dx_ = std::sqrt((length - h) * (length + h)) / m_;
  dy_ = h / m_;
  length_ = std::hypot(dx_, dy_);
}

Element HalfToggle::element_force(const Element& d) const {
  const Real u = d[3] - d[0], v = d[4] - d[1], x = dx_ + u, y = dy_ + v, reach = std::hypot(x, y);
  const Real stretch = (2 * (dx_ * u + dy_ * v) + u * u + v * v) / (reach + length_);
  const Real turned = std::atan2(dx_ * v - dy_ * u, dx_ * x + dy_ * y);  // dx y - dy x without cancellation
  const Real a = std::remainder((d[2] + d[5]) / 2 - turned, 2 * pi), s = (d[2] - d[5]) / 2;
  const Real n = axial_of(stretch / length_, a * a, s * s, ei_ / (ea_ * length_ * length_));
  const Flexibility f = flexibility(n / 4);
  const Real axial = n * ei_ / (length_ * length_), of_a = ei_ / length_ * 4 / f.u * a,
             of_s = ei_ / length_ * 4 * (1 + n / 4 * f.u) * s;
  const Real c = x / reach, q = y / reach, across = of_a / reach;  // theta_a falls as the chord turns
  Element force;
  force << -axial * c - across * q, -axial * q + across * c, (of_a + of_s) / 2, axial * c + across * q,
      axial * q - across * c, (of_a - of_s) / 2;
  return force;
}

Element HalfToggle::ends(const RealVector& x, int element) const {
  Element d = Element::Zero();
  const Eigen::Index end = 3 * Eigen::Index{element};
  if (element > 0) d.head(3) = x.segment(end - 3, 3);
  d.tail(3) = x.segment(end, 3);
  return d;
}

RealVector HalfToggle::force(const RealVector& x) const {
  RealVector f = RealVector::Zero(size());
  for (int i = 0; i < m_; ++i) {
    const Element e = element_force(ends(x, i));
    const Eigen::Index end = 3 * Eigen::Index{i};
    if (i > 0) f.segment(end - 3, 3) += e.head(3);
    f.segment(end, 3) += e.tail(3);
  }
  return f;
}

RealMatrix HalfToggle::stiffness(const RealVector& x) const {
  RealMatrix k = RealMatrix::Zero(size(), size());
  for (int i = 0; i < m_; ++i) {
    const Element d = ends(x, i);
    Eigen::Matrix<Real, 6, 6> own;
    for (int j = 0; j < 6; ++j) {
      // Rounding, 1e-19 EA over this, is 1e-13 EA; what is left out goes with its fourth power over a bending
      // of 1e-3.
      const Real h = 1e-6L * (j % 3 == 2 ? 1 : length_);
      const auto difference = [&](Real by) {
        Element low = d, high = d;
        low[j] -= by, high[j] += by;
        return Element((element_force(high) - element_force(low)) / (high[j] - low[j]));
      };
      own.col(j) = (4 * difference(h) - difference(2 * h)) / 3;
    }
    const Eigen::Index at = 3 * i - 3;
    if (i > 0)
      k.block(at, at, 6, 6) += own;
    else
      k.block(0, 0, 3, 3) += own.bottomRightCorner(3, 3);
  }
  return (k + k.transpose()) / 2;
}

Inertia HalfToggle::inertia(const RealMatrix& k) const {
  std::vector<Eigen::Index> inner;
  for (Eigen::Index i = 0; i + 3 < size(); ++i) inner.push_back(i);
  std::vector<Eigen::Index> symmetric = inner, antisymmetric = inner;
  symmetric.push_back(apex());
  antisymmetric.insert(antisymmetric.end(), {apex() - 1, apex() + 1});
  Inertia found;
  count(k(symmetric, symmetric), found.symmetric, found.least);
  count(k(antisymmetric, antisymmetric), found.antisymmetric, found.least);
  return found;
}

RealVector HalfToggle::way(const RealMatrix& k) const {
  RealVector w = RealVector::Zero(size());
  const Eigen::Index inner = size() - 3;
  w[apex()] = -1;
  if (inner > 0)
    w.head(inner) = k.topLeftCorner(inner, inner).partialPivLu().solve(k.col(apex()).head(inner));
  return turned(w);
}

AtDrop HalfToggle::described(const RealVector& x) const {
  const RealMatrix k = stiffness(x);
  const RealVector w = way(k);
  return {-x[apex()], -2 * force(x)[apex()], -2 * k.row(apex()).dot(w), x, inertia(k)};
}

AtDrop HalfToggle::rest() const { return described(RealVector::Zero(size())); }

RealVector HalfToggle::turned(const RealVector& x) const {
  RealVector mean = x;
  for (int i = 1; i < m_; ++i) {
    const auto here = x.segment(3 * i - 3, 3), there = x.segment(3 * (m_ - i) - 3, 3);
    mean.segment(3 * i - 3, 2) = (here + x.tail(3) - there).head(2) / 2;
    mean[3 * i - 1] = (here[2] + there[2]) / 2;
  }
  return mean;
}

std::optional<AtDrop> HalfToggle::at(Real drop, const AtDrop& near) const {
  RealVector x = near.x;
  x[apex()] = -drop;
  x = turned(x);
  const Eigen::Index inner = size() - 3;
  for (int i = 0; inner > 0; ++i) {
    const RealVector before = x;
    x.head(inner) -= stiffness(x).topLeftCorner(inner, inner).partialPivLu().solve(force(x).head(inner));
    x = turned(x);
    if (!x.allFinite() || i == 12) return {};
    if ((x - before).norm() <= 1e-15L * length_) break;
  }
  return described(x);
}

std::optional<AtDrop> HalfToggle::next_of(const AtDrop& from, Real step) const {
  AtDrop guess = from;
  guess.x += step * way(stiffness(from.x));
  auto next = at(from.drop + step, guess);
  if (!next || !std::isfinite(next->load)) return {};
  // No jump to a neighbouring branch: what the straight guess was off by is a small part of the way.
  const Real way_gone = (guess.x - from.x).norm(), missed = (next->x - guess.x).norm();
  if (missed > 0.1L * way_gone) return {};
  return next;
}

}  // namespace nlmech::adversary
