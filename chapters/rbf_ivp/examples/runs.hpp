/// @file
/// Recorded runs of a method on one of the three examples: values, errors, cost.
#pragma once

#include <algorithm>
#include <functional>
#include <limits>
#include <string>
#include <type_traits>
#include <vector>

#include "chapters/rbf_ivp/examples/cases.hpp"
#include "nlmech/ivp/collocation/collocation.hpp"
#include "nlmech/ivp/collocation/picard.hpp"
#include "nlmech/ivp/runge_kutta/dormand_prince.hpp"
#include "nlmech/ivp/runge_kutta/explicit_runge_kutta.hpp"
#include "nlmech/ivp/structural/alpha_family.hpp"
#include "nlmech/ivp/structural/central_difference.hpp"
#include "nlmech/scene/scene.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::chapters::rbf_ivp {

/// Values of a method at which errors are taken.
enum class Points {
  ends,  ///< the ends of steps
  all    ///< also inner nodes of a collocation and refined output of ode45
};

/// Record of one integration.
struct Record {
  /// A value returned by the method.
  struct Value {
    double t;          ///< time
    bool end;          ///< is it the end of a step?
    ivp::State x;      ///< state
    ivp::State error;  ///< state minus reference
  };
  /// A value of the dense output, for figures.
  struct Drawn {
    double t;      ///< time
    ivp::State x;  ///< state
  };
  std::vector<Value> values;  ///< ordered by time, without the start
  std::vector<Drawn> window;  ///< dense output over the window
  Statistics statistics;      ///< work of the integration
};

/// Integrates an example from its start to a time, with a method and its settings.
using Procedure = std::function<ivp::Solution(const Case&, double end, const ivp::Observer&)>;

/// Procedure with the same method from start to end.
template <class Method>
[[nodiscard]] Procedure throughout(const Method& method) {
  return [method](const Case& c, double end, const ivp::Observer& observer) {
    return ivp::integrate(c.system, c.x0, c.t0, end, method, observer);
  };
}

/// Procedure of two integrations (section 4.4.2): @p during up to the end of the impact, then @p after.
template <class Method>
[[nodiscard]] Procedure in_two_phases(const Method& during, const Method& after) {
  return [during, after](const Case& c, double end, const ivp::Observer& observer) {
    const ivp::System& system = impact_in_two_intervals();
    ivp::Solution first = ivp::integrate(system, c.x0, c.t0, impact_end(), during, observer);
    if (!first.status.ok()) return first;
    ivp::Solution second = ivp::integrate(system, first.x, first.t, end, after, observer);
    second.statistics += first.statistics;
    return second;
  };
}

/// Integrates to @p end and records the run.
/// @param window length of the final time interval with dense output, for figures
/// @throws Failure with the message of the method if it does not reach @p end
[[nodiscard]] inline Record record(const Case& c, double end, const Procedure& procedure, double window = 0) {
  Record made;
  constexpr int samples = 400;
  int sample = 0;
  const auto observe = [&](const ivp::Step& step) {
    for (std::size_t k = 0; k < step.times.size(); ++k) {
      const double t = step.times[k];
      const ivp::State x = step.states.col(static_cast<Eigen::Index>(k));
      made.values.push_back({t, k + 1 == step.times.size(), x, error_at(c, t, x)});
    }
    for (; window > 0 && sample <= samples; ++sample) {
      const double start = end - window, t = start + double(sample) / samples * (end - start);
      if (t > step.t1) break;
      ivp::State x;
      step.dense.at(t, x);
      made.window.push_back({t, x});
    }
    return true;
  };
  const ivp::Solution solution = procedure(c, end, observe);
  if (!solution.status.ok()) throw Failure(solution.status);
  made.statistics = solution.statistics;
  return made;
}

/// RMS error of one component over the points up to a time, not normalised. With Points::ends the start
/// counts, as in an array of times t_0, t_0 + h, ...; with Points::all it does not, because no method
/// computes it.
/// @param start whether the start counts with Points::ends
[[nodiscard]] inline double rms_error(const Record& record, int component, Points points,
                                      double until = std::numeric_limits<double>::infinity(),
                                      bool start = true) {
  std::vector<double> errors(start && points == Points::ends ? 1 : 0, 0.0);
  const double reach = until * (1 + 1e-12);  // step ends carry the rounding of k h
  for (const auto& value : record.values) {
    if (value.t <= reach && (value.end || points == Points::all)) errors.push_back(value.error[component]);
  }
  return root_mean_square(errors);
}

}  // namespace nlmech::chapters::rbf_ivp
