/// @file
/// What a method gave on one of the three examples: values, errors, cost; and how far to look at them.
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

/// Which of the values that a method gives are looked at.
enum class Points {
  ends,  ///< the ends of steps
  all    ///< inner nodes of a collocation and refined output of ode45 as well
};

/// One integration.
struct Record {
  /// A value that the method gave.
  struct Value {
    double t;          ///< time, after the start
    bool end;          ///< the end of a step
    ivp::State x;      ///< state
    ivp::State error;  ///< state minus reference
  };
  /// A value of the method's dense output, for drawings.
  struct Drawn {
    double t;      ///< time
    ivp::State x;  ///< state
  };
  std::vector<Value> values;  ///< in the order of time
  std::vector<Drawn> window;  ///< over the asked window
  Statistics statistics;      ///< of one integration
};

/// An integration of an example: from its start to a time, with a method and its settings.
using Procedure = std::function<ivp::Solution(const Case&, double end, const ivp::Observer&)>;

/// One method from begin to end.
template <class Method>
[[nodiscard]] Procedure throughout(const Method& method) {
  return [method](const Case& c, double end, const ivp::Observer& observer) {
    return ivp::integrate(c.system, c.x0, c.t0, end, method, observer);
  };
}

/// Another setting from the end of the impact on: two integrations, the second from the end of the first, as
/// section 4.4.2 says.
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

/// Integrates to @p end and records.
/// @param window length of time before the end of which dense output is kept, for drawings
/// @throws Failure with the method's own sentence if it does not get there
[[nodiscard]] inline Record record(const Case& c, double end, const Procedure& procedure, double window = 0) {
  Record kept;
  constexpr int samples = 400;
  int sample = 0;
  const auto observe = [&](const ivp::Step& step) {
    for (std::size_t k = 0; k < step.times.size(); ++k) {
      const double t = step.times[k];
      const ivp::State x = step.states.col(static_cast<Eigen::Index>(k));
      kept.values.push_back({t, k + 1 == step.times.size(), x, error_at(c, t, x)});
    }
    for (; window > 0 && sample <= samples; ++sample) {
      const double start = end - window, t = start + double(sample) / samples * (end - start);
      if (t > step.t1) break;
      ivp::State x;
      step.dense.at(t, x);
      kept.window.push_back({t, x});
    }
    return true;
  };
  const ivp::Solution solution = procedure(c, end, observe);
  if (!solution.status.ok()) throw Failure(solution.status);
  kept.statistics = solution.statistics;
  return kept;
}

/// Root of the mean square of one component's error over the points up to a time, not normalised. Among the
/// ends of steps the start counts too, as in an array of times t_0, t_0 + h, ...; among inner nodes it does
/// not, for no method computes it.
/// @param start is the start counted among the ends?
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
