// Shared by the tests of integrators: equations with known solutions, and measures of the error.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "nlmech/ivp/implicit/backward_euler.hpp"
#include "nlmech/ivp/runge_kutta/dop853.hpp"
#include "nlmech/ivp/runge_kutta/dormand_prince.hpp"
#include "nlmech/ivp/runge_kutta/explicit_runge_kutta.hpp"
#include "nlmech/ivp/structural/alpha_family.hpp"
#include "nlmech/ivp/structural/central_difference.hpp"
#include "nlmech/problems/problem.hpp"
#include "nlmech/program/value_of.hpp"
#include "tests/ivp/typed.hpp"

namespace nlmech::ivp::testing {

inline constexpr double eps = std::numeric_limits<double>::epsilon();
inline constexpr double nan = std::numeric_limits<double>::quiet_NaN();
inline constexpr double infinity = std::numeric_limits<double>::infinity();

// q'' = -2 zeta q' - w2 q - cubic q^3 + f(t), with f such that q = A cos t.
struct Manufactured {
  double damping = 0.3, stiffness = 1, cubic = 1, amplitude = 1;
  operator program::Problem() const {
    return typed_problem(
        fmt::format("q'' = -c q' - k q - m q^3 - c A sin(t) + (k - 1) A cos(t) + m (A cos(t))^3;"
                    "c = {:.17g}; k = {:.17g}; m = {:.17g}; A = {:.17g}",
                    damping, stiffness, cubic, amplitude));
  }
  [[nodiscard]] State exact(double t) const { return {amplitude * std::cos(t), -amplitude * std::sin(t)}; }
};

// q'' = -w^2 q.
struct Oscillator {
  double frequency = 1;
  operator program::Problem() const {
    return typed_problem(fmt::format("q'' = -(w^2) q; w = {:.17g}", frequency));
  }
};

// q'' = before for t < at, then after: q is a parabola on both sides. Every method but Euler's is exact if it
// ends a step at the jump, and otherwise has an error of a fraction of the jump's effect in one step.
struct JumpingForce {
  static constexpr int dimension = 2;
  double at = 0.3, before = -1, after = 2;
  template <class T>
  void acceleration(const T& t, const Vector<T, 1>& /*q*/, const Vector<T, 1>& /*v*/, Vector<T, 1>& a) const {
    a[0] = value_of(t) < at ? before : after;
  }
  template <class T>
  void operator()(const T& t, const Vector<T, 2>& x, Vector<T, 2>& dxdt) const {
    problems::first_order_form(*this, t, x, dxdt);
  }
  [[nodiscard]] std::vector<double> discontinuities(double t0, double t1) const {
    if (at > std::min(t0, t1) && at < std::max(t0, t1)) return {at};
    return {};
  }
  // The solution from rest at q = 0, t = 0.
  [[nodiscard]] State exact(double t) const {
    if (t < at) return {before * t * t / 2, before * t};
    const double s = t - at;
    return {before * at * at / 2 + before * at * s + after * s * s / 2, before * at + after * s};
  }
};

// q'' = -q for t < at, then `value`.
struct Poisoned {
  static constexpr int dimension = 2;
  double at = 0.5, value = nan;
  template <class T>
  void acceleration(const T& t, const Vector<T, 1>& q, const Vector<T, 1>& /*v*/, Vector<T, 1>& a) const {
    a[0] = value_of(t) < at ? T(-q[0]) : T(value);
  }
  template <class T>
  void operator()(const T& t, const Vector<T, 2>& x, Vector<T, 2>& dxdt) const {
    problems::first_order_form(*this, t, x, dxdt);
  }
};

// A problem with accelerations that does not announce its discontinuities.
template <class Problem>
struct Unannounced {
  static constexpr int dimension = Problem::dimension;
  Problem problem = {};
  [[nodiscard]] int size() const { return problem.size(); }
  template <class T, int m>
  void acceleration(const T& t, const Vector<T, m>& q, const Vector<T, m>& v, Vector<T, m>& a) const {
    problem.acceleration(t, q, v, a);
  }
  template <class T>
  void operator()(const T& t, const Vector<T, dimension>& x, Vector<T, dimension>& dxdt) const {
    problem(t, x, dxdt);
  }
};

// The method with another step size; for ode45 with tolerances that never reject a step, so that all steps
// are equal.
template <class Method>
[[nodiscard]] Method with_step(Method method, double step) {
  if constexpr (requires { method.step; }) {
    method.step = step;
  } else {
    method.initial_step = method.largest_step = step;
    method.relative_tolerance = method.absolute_tolerance = 0.1;
  }
  return method;
}

// Largest error of both components against exact(t), at step ends and optionally within the steps.
template <class Problem, class Method>
[[nodiscard]] double largest_error(const Problem& problem, const Method& method, double t0, double t1,
                                   bool within = false) {
  double largest = 0;
  State x(2);
  const auto measure = [&](const Step& step) {
    largest = std::max(largest, (step.x1 - problem.exact(step.t1)).cwiseAbs().maxCoeff());
    for (const double s : {0.3, 0.5, 0.9}) {
      const double t = step.t0 + s * (step.t1 - step.t0);
      step.dense.at(t, x);
      if (within) largest = std::max(largest, (x - problem.exact(t)).cwiseAbs().maxCoeff());
    }
    return true;
  };
  const auto solution = integrate(System(problem), problem.exact(t0), t0, t1, method, measure);
  EXPECT_TRUE(solution.status.ok()) << solution.status.text();
  EXPECT_EQ(solution.t, t1);
  return largest;
}

// @returns the text of the std::invalid_argument that an integration of the oscillator with these options
// throws.
template <class Method>
[[nodiscard]] std::string refusal(const Method& method) {
  try {
    (void)integrate(System(Oscillator{}), State{1, 0}, 0, 1, method);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

}  // namespace nlmech::ivp::testing
