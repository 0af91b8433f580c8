/// Worked example of the API reference: a user-defined problem and its derivatives.
#include <gtest/gtest.h>

// [example]
#include <cmath>

#include "nlmech/problems/problem.hpp"
#include "nlmech/program/dual.hpp"

// A pendulum whose pivot is shaken: q'' = -(1 + a cos(w t)) sin q. State (q, v).
struct ShakenPendulum {
  static constexpr int dimension = 2;
  double amplitude = 0.2, frequency = 2;

  template <class T>
  void acceleration(const T& t, const nlmech::Vector<T, 1>& q, const nlmech::Vector<T, 1>& /*v*/,
                    nlmech::Vector<T, 1>& a) const {
    using std::cos;
    using std::sin;
    a[0] = -(1.0 + amplitude * cos(frequency * t)) * sin(q[0]);
  }
  template <class T>
  void operator()(const T& t, const nlmech::Vector<T, 2>& x, nlmech::Vector<T, 2>& dxdt) const {
    nlmech::problems::first_order_form(*this, t, x, dxdt);
  }
};

// The Jacobian of any problem: its right-hand side with dual numbers.
template <class Problem, int n = Problem::dimension>
nlmech::Matrix<double, n, n> jacobian(const Problem& problem, double t, const nlmech::Vector<double, n>& x) {
  using Dual = nlmech::Dual<double, n>;
  nlmech::Vector<Dual, n> variables, dxdt;
  for (int i = 0; i < n; ++i) variables[i] = Dual::variable(x[i], i);
  problem(Dual(t), variables, dxdt);
  nlmech::Matrix<double, n, n> b;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) b(i, j) = dxdt[i].partial[static_cast<std::size_t>(j)];
  }
  return b;
}
// [example]

namespace {

TEST(Example, Problems) {
  const double t = 0.3, q = 0.8;
  const nlmech::Matrix<double, 2, 2> b = jacobian(ShakenPendulum{}, t, {q, 0.1});
  EXPECT_EQ(b(0, 0), 0);
  EXPECT_EQ(b(0, 1), 1);
  EXPECT_NEAR(b(1, 0), -(1 + 0.2 * std::cos(2 * t)) * std::cos(q), 1e-15);  // derived by hand; 4 eps
  EXPECT_EQ(b(1, 1), 0);
}

}  // namespace
