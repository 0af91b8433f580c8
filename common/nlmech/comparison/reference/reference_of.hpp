/// @file
/// Reference of a problem: Taylor series in extended precision, else methods in double precision.
#pragma once

#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "nlmech/comparison/reference/reference.hpp"
#include "nlmech/ivp/system.hpp"
#include "nlmech/problems/reference_trajectory.hpp"
#include "nlmech/program/value_of.hpp"
#include "nlmech/support/errors.hpp"
#include "nlmech/support/stopwatch.hpp"

namespace nlmech::comparison {

namespace detail {

/// A problem in reversed time s = -t: dx/ds = -f(-s, x).
template <class Problem>
struct Backwards {
  static constexpr int dimension = Problem::dimension;  ///< dimension of the problem
  Problem problem;                                      ///< the problem in time t

  /// dx/ds. At a discontinuity f is the limit from the right, but the limit from the left is needed here.
  /// Hence f is evaluated at the preceding floating-point number.
  template <class T>
  void operator()(const T& s, const Vector<T, dimension>& x, Vector<T, dimension>& dxds) const {
    using std::nextafter;
    const auto now = -value_of(s);
    const T t = -s + (nextafter(now, -std::numeric_limits<decltype(now)>::infinity()) - now);
    problem(t, x, dxds);
    dxds = (-dxds).eval();
  }
  /// Discontinuities of the problem in reversed time.
  [[nodiscard]] std::vector<double> discontinuities(double from, double to) const {
    std::vector<double> times;
    if constexpr (problems::HasDiscontinuities<Problem>) times = problem.discontinuities(-from, -to);
    for (double& t : times) t = -t;
    return times;
  }
};

/// A step takes some 10 microseconds for 2 components, 600 microseconds for the 24 of a four-body problem.
[[nodiscard]] inline double most_taylor_steps(const WorkLimit& effort, Eigen::Index size) {
  return effort.work * 1e5 / static_cast<double>(size);
}

/// States at ascending times by one Taylor series.
template <class Problem>
Status taylor_states(const Problem& problem, const ReferenceRequest& request,
                     const problems::ReferenceOptions& options, const WorkLimit& effort, double seconds,
                     StatesAt& states) {
  constexpr int n = Problem::dimension;
  using Exact = Vector<long double, n>;
  const std::vector<double>& times = request.times;
  states.resize(request.x0.size(), static_cast<Eigen::Index>(times.size()));
  std::size_t next = 0;
  for (; next < times.size() && times[next] == request.t0; ++next)
    states.col(static_cast<Eigen::Index>(next)) = request.x0;
  if (next == times.size()) return {};
  StepBudget budget(request.t0, times.back(), most_taylor_steps(effort, request.x0.size()), effort.continues);
  const Stopwatch watch;
  const auto visit_step = [&](const problems::TaylorStep<long double, n>& step, const Exact& x) {
    const long double end = step.start + step.length;
    for (; next < times.size() && times[next] <= end; ++next) {
      const Exact now = times[next] == end ? x : step.at(times[next] - step.start);
      states.col(static_cast<Eigen::Index>(next)) = now;
    }
    if (next == times.size()) return;
    const bool late = watch.seconds() > seconds;
    if (late || !budget.suffices(static_cast<double>(end)))  // the exception ends the integration
      throw Failure(Status::failure(late ? Outcome::time_limit : Outcome::step_limit,
                                    "the Taylor series in extended precision takes too many steps"));
  };
  try {
    return problems::integrate_reference(problem, Exact(request.x0), static_cast<long double>(request.t0),
                                         static_cast<long double>(times.back()), options, visit_step);
  } catch (const Failure& late) {
    return late.status();
  }
}

/// taylor_states() forwards or backwards in time.
template <class Problem>
Status taylor_both_directions(const Problem& problem, const ReferenceRequest& request,
                              const problems::ReferenceOptions& options, const WorkLimit& effort,
                              double seconds, StatesAt& states) {
  if (request.times.back() >= request.t0)
    return taylor_states(problem, request, options, effort, seconds, states);
  ReferenceRequest mirrored{request.x0, -request.t0, request.times};
  for (double& t : mirrored.times) t = -t;
  return taylor_states(Backwards<Problem>{problem}, mirrored, options, effort, seconds, states);
}

}  // namespace detail

/// Two Taylor series in extended precision, of orders 22 and 28.
/// @param size number of components of the state
template <class Problem>
[[nodiscard]] std::vector<Candidate> taylor_candidates(const Problem& problem, int size,
                                                       const WorkLimit& effort) {
  std::vector<Candidate> all;
  for (const int order : {22, 28}) {
    problems::ReferenceOptions options;
    options.order = order;
    options.largest_step = effort.largest_step;
    options.most_steps = static_cast<std::size_t>(std::ceil(detail::most_taylor_steps(effort, size)));
    all.push_back({"Taylor series of order " + std::to_string(order), true,
                   [=](const ReferenceRequest& request, double seconds, StatesAt& states) {
                     return detail::taylor_both_directions(problem, request, options, effort, seconds,
                                                           states);
                   }});
  }
  return all;
}

/// Reference of a problem by taylor_candidates(), else by methods in double precision. See reference.hpp.
template <class Problem>
[[nodiscard]] Reference reference_of(const Problem& problem, const problems::StateOf<double, Problem>& x0,
                                     double t0, const std::vector<double>& times, const Tolerance& needed,
                                     const WorkLimit& effort) {
  return reference_of(taylor_candidates(problem, static_cast<int>(x0.size()), effort), ivp::System(problem),
                      x0, t0, times, needed, effort);
}

}  // namespace nlmech::comparison
