#include "nlmech/ivp/near_zero.hpp"

#include <algorithm>
#include <cmath>

namespace nlmech::ivp {
namespace {

using program::Interval;

double middle_of(const Interval& v) { return (v.low + v.high) / 2; }

/// dg/dx by central differences.
State gradient(const Event& g, double t, const State& x) {
  State d(x.size()), at = x;
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    const double by = 1e-6 * std::max(std::abs(x[i]), 1e-3 * std::max(x.norm(), 1e-9));
    at[i] = x[i] + by;
    const double above = g.value(t, at);
    at[i] = x[i] - by;
    d[i] = (above - g.value(t, at)) / (2 * by);
    at[i] = x[i];
  }
  return d;
}

}  // namespace

Interval at_point(const BoundsOver& bounds, double t, const State& x, StateAccuracy error) {
  std::vector<Interval> box;
  for (const double xi : x)
    box.push_back(Interval(xi).inflated(error.absolute + error.relative * std::abs(xi)));
  return bounds(Interval(t), box);
}
double rate_at(const Event& g, double t, const State& x) {
  const Interval rate = at_point(g.rate_bounds, t, x, {});
  return rate.has(0) ? 0 : middle_of(rate);
}

State moved_to(const Event& g, double t, State x, double value) {
  constexpr int most = 8;
  for (int k = 0; k < most; ++k) {
    const double excess = g.value(t, x) - value;
    if (!(excess > 0 || k == 0) || excess == 0) break;
    const State slope = gradient(g, t, x);
    if (!(slope.squaredNorm() > 0)) break;
    const State before = x;
    x -= (k < 2 ? 1 : 2) * excess / slope.squaredNorm() * slope;
    if (x == before) break;
  }
  return x;
}

bool repels(const Event& g, double t, const State& x, double near, int direction) {
  const auto slope = [&](double distance) {
    return direction * (rate_at(g, t, moved_to(g, t, x, distance)) - rate_at(g, t, x)) / distance;
  };
  const double far = slope(near);
  return far > 0 && slope(near / 1e4) > 3 * far;
}

bool stays_or_leaves(const Event& g, double t, const State& x, double near, int direction) {
  return rate_at(g, t, x) == 0 && (repels(g, t, x, near, direction) || repels(g, t, x, -near, direction));
}

}  // namespace nlmech::ivp
