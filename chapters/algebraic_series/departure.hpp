/// @file
/// Departure of a run from the solution. The paper claims that its steps never depart.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "chapters/algebraic_series/samples.hpp"
#include "nlmech/comparison/commands/example.hpp"

namespace nlmech::chapters::algebraic_series {

/// Errors of a run at the ends of steps.
struct Departure {
  std::string status;         ///< outcome of the run, such as "success"
  std::vector<double> t;      ///< ends of steps
  std::vector<double> error;  ///< max_i |error of x_i| at t

  /// First time at which the error exceeds @p bound; nothing if it never does.
  [[nodiscard]] std::optional<double> first_above(double bound) const {
    for (std::size_t i = 0; i < t.size(); ++i) {
      if (!(error[i] <= bound)) return t[i];
    }
    return {};
  }
  /// Largest error up to @p end.
  [[nodiscard]] double greatest(double end) const {
    double greatest = 0;
    for (std::size_t i = 0; i < t.size() && t[i] <= end; ++i) greatest = std::max(greatest, error[i]);
    return greatest;
  }
};

/// Runs a method from the start of an example to @p end, which may exceed the example's own end but not its
/// reference. After a failure only the errors up to it are returned.
template <class Method>
[[nodiscard]] Departure departure(const comparison::Example& example, const Method& method, double end) {
  Departure result;
  const auto observe = [&](const ivp::Step& step) {
    const ivp::State reference = example.reference(step.t1).template cast<double>();
    result.t.push_back(step.t1);
    result.error.push_back((step.x1 - reference).cwiseAbs().maxCoeff());
    return true;
  };
  const auto solution = ivp::integrate(example.system, example.x0, example.t0, end, method, observe);
  result.status = to_string(solution.status.outcome());
  return result;
}

/// States of the solution and of the printed steps at one time.
struct Both {
  double t;                   ///< time
  ivp::State exact, printed;  ///< states
};

/// A solution with the motion by the printed steps.
struct Motion {
  std::vector<Both> path;  ///< at equidistant times
  Departure departure;     ///< departure of the printed steps
};

/// Computes the motion of an example to @p end, which may exceed the example's own end; states every @p dt.
[[nodiscard]] inline Motion motion(const comparison::Example& example, const ivp::Series& printed, double end,
                                   double dt) {
  const auto exact = sampled(example.system, example.x0, example.t0, end, accurate_series(), dt);
  const auto steps = sampled(example.system, example.x0, example.t0, end, printed, dt);
  Motion motion{{}, departure(example, printed, end)};
  for (std::size_t i = 0; i < exact.size(); ++i) motion.path.push_back({exact[i].t, exact[i].x, steps[i].x});
  return motion;
}

/// Selects one component of the solution.
struct Exact {
  Eigen::Index i;  ///< index of the component
  /// Value of the component.
  [[nodiscard]] double operator()(const Both& b) const { return b.exact[i]; }
};
/// Selects one component of the motion by the printed steps.
struct Printed {
  Eigen::Index i;  ///< index of the component
  /// Value of the component.
  [[nodiscard]] double operator()(const Both& b) const { return b.printed[i]; }
};

}  // namespace nlmech::chapters::algebraic_series
