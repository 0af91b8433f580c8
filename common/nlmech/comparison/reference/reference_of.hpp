/// @file
/// The reference of a problem: its Taylor series in extended precision, else methods by name.
#pragma once

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "nlmech/comparison/reference/reference.hpp"
#include "nlmech/comparison/reference/reference_end.hpp"
#include "nlmech/comparison/reference/reference_methods.hpp"
#include "nlmech/ivp/system.hpp"
#include "nlmech/support/stopwatch.hpp"

namespace nlmech::comparison {

namespace detail {

/// Ends a walk of a reference from within: no more steps.
struct OutOfWork {
  Outcome outcome;
};

/// Counts the steps of a walk, and ends it where the work does not suffice: a solution that has made less
/// than half of its way after a twentieth of the steps that were to bring it ten times as far will not
/// arrive.
class StepsOfReference {
 public:
  StepsOfReference(double t0, double t1, double most, double seconds)
      : t0_(t0), way_(t1 - t0), most_(most), seconds_(seconds) {}
  /// After a step to @p t. @throws OutOfWork
  void count(double t) {
    ++steps_;
    if (steps_ >= most_ || (steps_ >= most_ / 20 && 20 * (t - t0_) < way_ * steps_ / most_))
      throw OutOfWork{Outcome::step_limit};
    if (watch_.seconds() > seconds_) throw OutOfWork{Outcome::time_limit};
  }

 private:
  double t0_, way_, most_, seconds_, steps_ = 0;
  Stopwatch watch_;
};

/// The states at ascending times by one Taylor series.
template <class Problem>
Status taylor_states(const Problem& problem, const Way& way, const problems::ReferenceOptions& options,
                     double most_steps, double seconds, StatesAt& states) {
  constexpr int n = Problem::dimension;
  using Exact = Vector<long double, n>;
  const std::vector<double>& times = way.times;
  states.resize(way.x0.size(), static_cast<Eigen::Index>(times.size()));
  std::size_t next = 0;
  for (; next < times.size() && times[next] == way.t0; ++next)
    states.col(static_cast<Eigen::Index>(next)) = way.x0;
  if (next == times.size()) return {};
  StepsOfReference steps(way.t0, times.back(), most_steps, seconds);
  const auto look = [&](const problems::TaylorStep<long double, n>& step, const Exact& x) {
    const long double end = step.start + step.length;
    for (; next < times.size() && times[next] <= end; ++next) {
      const Exact now = times[next] == end ? x : step.at(times[next] - step.start);
      states.col(static_cast<Eigen::Index>(next)) = now;
    }
    if (next < times.size()) steps.count(static_cast<double>(end));
  };
  try {
    return problems::walk_reference(problem, Exact(way.x0), static_cast<long double>(way.t0),
                                    static_cast<long double>(times.back()), options, look);
  } catch (const OutOfWork& out) {
    return Status::failure(out.outcome, "the Taylor series in extended precision takes too many steps");
  }
}

/// The same in the direction of travel.
template <class Problem>
Status taylor_either_way(const Problem& problem, const Way& way, const problems::ReferenceOptions& options,
                         double most_steps, double seconds, StatesAt& states) {
  if (way.times.back() >= way.t0) return taylor_states(problem, way, options, most_steps, seconds, states);
  Way mirrored{way.x0, -way.t0, way.times};
  for (double& t : mirrored.times) t = -t;
  return taylor_states(Backwards<Problem>{problem}, mirrored, options, most_steps, seconds, states);
}

}  // namespace detail

/// Two Taylor series in extended precision, of the orders 22 and 28.
/// @param size components of the state
template <class Problem>
[[nodiscard]] std::vector<Candidate> taylor_candidates(const Problem& problem, int size,
                                                       const Effort& effort) {
  // A step takes 15 microseconds for two components, 600 for the 24 of four bodies, which attract each other.
  const double most_steps = effort.work * 1e5 / size;
  std::vector<Candidate> all;
  for (const int order : {22, 28}) {
    problems::ReferenceOptions options;
    options.order = order;
    options.largest_step = effort.largest_step;
    all.push_back({"Taylor series of order " + std::to_string(order), "Taylor series in extended precision",
                   true, [=](const Way& way, double seconds, StatesAt& states) {
                     return detail::taylor_either_way(problem, way, options, most_steps, seconds, states);
                   }});
  }
  return all;
}

/// The states of a problem at @p times.
/// @param x0 state at t0, finite
/// @param times in the direction of travel from t0, each other than the one before; at least one
/// @param needed how finely
/// @param effort when to give up
template <class Problem>
[[nodiscard]] Reference reference_of(const Problem& problem, const problems::StateOf<double, Problem>& x0,
                                     double t0, const std::vector<double>& times, const Needed& needed,
                                     const Effort& effort) {
  std::vector<Candidate> all = taylor_candidates(problem, static_cast<int>(x0.size()), effort);
  for (Candidate& c : method_candidates(ivp::System(problem), needed, effort)) all.push_back(std::move(c));
  return agree(all, {x0.template cast<long double>(), t0, times}, needed, effort.seconds);
}

}  // namespace nlmech::comparison
