/// @file
/// What a user's run is judged by: the end state in extended precision, forwards or backwards in time.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "nlmech/ivp/state.hpp"
#include "nlmech/problems/reference_trajectory.hpp"
#include "nlmech/program/value_of.hpp"

namespace nlmech::comparison {

/// A problem run backwards: dx/ds = -f(-s, x).
template <class Problem>
struct Backwards {
  static constexpr int dimension = Problem::dimension;  ///< the problem's
  Problem problem;                                      ///< as it is

  /// dx/ds. At a discontinuity f is the limit from the right, and here the one from the left is needed: f is
  /// asked for at the time just before, by an error of time far below that of double.
  template <class T>
  void operator()(const T& s, const Vector<T, dimension>& x, Vector<T, dimension>& dxds) const {
    using std::nextafter;
    const auto now = -value_of(s);
    const T t = -s + (nextafter(now, -std::numeric_limits<decltype(now)>::infinity()) - now);
    problem(t, x, dxds);
    dxds = (-dxds).eval();
  }
  /// The problem's, seen backwards.
  [[nodiscard]] std::vector<double> discontinuities(double from, double to) const {
    std::vector<double> times;
    if constexpr (problems::HasDiscontinuities<Problem>) times = problem.discontinuities(-from, -to);
    for (double& t : times) t = -t;
    return times;
  }
};

/// The end of a solution to some 18 digits.
struct ReferenceEnd {
  Status status;     ///< success, or why there is no reference
  ivp::LongState x;  ///< state at the end
  ivp::State size;   ///< greatest |x_i| seen on the way
};

/// The solution from (t0, x0) to t1 >= t0. @param most_steps of the Taylor series, after which it gives up
template <class Problem>
[[nodiscard]] ReferenceEnd reference_ahead(const Problem& problem,
                                           const problems::StateOf<double, Problem>& x0, double t0, double t1,
                                           std::size_t most_steps) {
  constexpr int n = Problem::dimension;
  ReferenceEnd end{{}, x0.template cast<long double>(), x0.cwiseAbs()};
  const auto look = [&](const problems::TaylorStep<long double, n>& step, const Vector<long double, n>& x) {
    const Vector<long double, n> middle = step.at(step.length / 2);
    end.size = end.size.cwiseMax(middle.template cast<double>().cwiseAbs())
                   .cwiseMax(x.template cast<double>().cwiseAbs());
    end.x = x;
  };
  problems::ReferenceOptions options;
  options.most_steps = most_steps;
  end.status = problems::walk_reference(problem, Vector<long double, n>(end.x), static_cast<long double>(t0),
                                        static_cast<long double>(t1), options, look);
  return end;
}

/// The same to any t1.
template <class Problem>
[[nodiscard]] ReferenceEnd reference_end(const Problem& problem, const problems::StateOf<double, Problem>& x0,
                                         double t0, double t1, std::size_t most_steps = 200'000) {
  if (t1 >= t0) return reference_ahead(problem, x0, t0, t1, most_steps);
  return reference_ahead(Backwards<Problem>{problem}, x0, -t0, -t1, most_steps);
}

/// The largest error of a component: relative to the component, or, where that is close to zero - below a
/// thousandth of its size - relative to its size. Components that are zero throughout count absolutely.
[[nodiscard]] inline double relative_error(const ivp::State& found, const ivp::LongState& truth,
                                           const ivp::State& size) {
  double worst = 0;
  for (Eigen::Index i = 0; i < found.size(); ++i) {
    const auto value = static_cast<double>(std::abs(truth[i]));
    double scale = value >= 1e-3 * size[i] ? value : size[i];
    if (!(scale > 0)) scale = 1;
    const auto error = static_cast<double>(std::abs(found[i] - truth[i])) / scale;
    if (std::isnan(error)) return error;
    worst = std::max(worst, error);
  }
  return worst;
}

/// -log10 of an error, at most what double can hold.
[[nodiscard]] inline double digits_of(double error) {
  return -std::log10(std::max(error, std::numeric_limits<double>::epsilon() / 2));
}

}  // namespace nlmech::comparison
