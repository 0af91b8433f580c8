/// @file
/// A solution at equidistant times by dense output, for curves and tables.
#pragma once

#include <vector>

#include "nlmech/ivp/integrate.hpp"
#include "nlmech/ivp/series/series.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::chapters::algebraic_series {

/// A state at a time.
struct Sample {
  double t;      ///< time
  ivp::State x;  ///< state
};

/// Selects one component of a sample, for tables and curves.
struct Component {
  Eigen::Index i;  ///< index of the component
  /// Value of the component.
  [[nodiscard]] double operator()(const Sample& s) const { return s.x[i]; }
};

/// States at t0, t0 + dt, t0 + 2 dt, ... up to the end of an integration. @throws Failure if it fails
/// @param limits of the work
/// @tparam Method any method of the library
template <class Method>
[[nodiscard]] std::vector<Sample> sampled(const ivp::System& system, const ivp::State& x0, double t0,
                                          double t1, const Method& method, double dt,
                                          const ivp::Limits& limits = {}) {
  std::vector<Sample> samples = {{t0, x0}};
  // The last sample is kept if rounding puts k dt just beyond t1.
  const auto next = [&] { return t0 + dt * static_cast<double>(samples.size()); };
  const auto observe = [&](const ivp::Step& step) {
    for (double t = next(); t <= step.t1 || (step.t1 == t1 && t <= t1 + 1e-9 * dt); t = next()) {
      ivp::State x;
      step.dense.at(std::min(t, step.t1), x);
      samples.push_back({t, x});
    }
    return true;
  };
  const auto solution = ivp::integrate(system, x0, t0, t1, method, observe, limits);
  if (!solution.status.ok()) throw Failure(solution.status);
  return samples;
}

/// Series with order and steps from the radius of convergence, tolerance 1e-16.
[[nodiscard]] inline ivp::Series accurate_series() {
  return {.relative_tolerance = 1e-16, .absolute_tolerance = 1e-16};
}

/// The published scheme: @p order terms after the first, fixed step size @p step (T).
[[nodiscard]] inline ivp::Series published_series(double step, int order) {
  return {.order = order, .step = step};
}

}  // namespace nlmech::chapters::algebraic_series
