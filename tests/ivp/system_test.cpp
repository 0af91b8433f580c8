#include "nlmech/ivp/system.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "chapters/plain_equations.hpp"
#include "nlmech/ivp/runge_kutta/explicit_runge_kutta.hpp"
#include "nlmech/problems/texts.hpp"

namespace nlmech::ivp::system_test {
namespace {

// A chain of any length, for the sizes that dual numbers process in groups of eight.
struct Chain {
  static constexpr int dimension = Eigen::Dynamic;
  int masses;
  [[nodiscard]] int size() const { return 2 * masses; }
  template <class T>
  void operator()(const T& /*t*/, const Vector<T, Eigen::Dynamic>& x, Vector<T, Eigen::Dynamic>& dxdt) const {
    for (int i = 0; i < masses; ++i) {
      const T left = i > 0 ? x[i] - x[i - 1] : x[i], right = i + 1 < masses ? x[i + 1] - x[i] : -x[i];
      dxdt[i] = x[masses + i];
      dxdt[masses + i] = right - left + right * right * right - left * left * left;
    }
  }
};

double any_number() {
  return *rc::gen::map(rc::gen::inRange(-3000, 3000), [](int k) { return k / 1000.0; });
}

// Central differences of step 1e-5 carry an error of about 1e-10 times the third derivative (at most 50 here)
// and 1e-16/1e-5 times the function (at most 500).
constexpr double difference_error = 2e-8;

RC_GTEST_PROP(System, JacobianIsTheDerivativeOfTheRightHandSide, ()) {
  const int masses = *rc::gen::inRange(1, 12), n = 2 * masses;
  const System system(Chain{masses});
  State x(n), plus(n), minus(n);
  for (int i = 0; i < n; ++i) x[i] = any_number();
  Eigen::MatrixXd j(n, n);
  system.jacobian(0, x, j);
  for (int k = 0; k < n; ++k) {
    State y = x;
    y[k] = x[k] + 1e-5;
    system.rhs(0, y, plus);
    y[k] = x[k] - 1e-5;
    system.rhs(0, y, minus);
    RC_ASSERT(((plus - minus) / 2e-5 - j.col(k)).cwiseAbs().maxCoeff() < difference_error);
  }
}

TEST(System, AgreesWithTheInlinedProblem) {
  const chapters::PlainImpact problem;
  const System system(problem);
  const Direct inlined(problem);
  EXPECT_EQ(system.size(), 2);
  const State x{0.1, -0.2};
  State f;
  system.rhs(0.75, x, f);
  Vector<double, 2> g;
  inlined.rhs(0.75, x, g);
  EXPECT_EQ(f, g);
  Jacobian j;
  system.jacobian(0.75, x, j);
  Matrix<double, 2, 2> k;
  inlined.jacobian(0.75, x, k);
  EXPECT_EQ(j, k);
}

TEST(System, ManyNodesAreTheNodesOneByOne) {
  const System system(problems::TextProblem("impact"));
  const std::vector<double> times = {0.1, 0.4, 0.7, 1.3};
  Nodes x(2, 4), f(2, 4);
  x << 1, 2, 3, 4, -1, -2, -3, -4;
  system.rhs(times, x, f);
  for (int k = 0; k < 4; ++k) {
    State one(2);
    system.rhs(times[static_cast<std::size_t>(k)], x.col(k), one);
    EXPECT_EQ(f.col(k), one);
  }
}

TEST(System, KnowsItsOrderAndItsDiscontinuities) {
  EXPECT_TRUE(System(problems::TextProblem("duffing")).second_order());
  EXPECT_FALSE(System(Chain{2}).second_order());
  const System impact(problems::TextProblem("impact"));
  EXPECT_EQ(impact.discontinuities(0, 5), (std::vector<double>{0.5, 1}));
  EXPECT_EQ(impact.discontinuities(5, 0.7), (std::vector<double>{1}));
  State q(2), a(2);
  EXPECT_THROW(System(Chain{2}).acceleration(0, q, q, a), std::logic_error);
}

struct OwnJacobian {
  static constexpr int dimension = 1;
  template <class T>
  void operator()(const T&, const Vector<T, 1>& x, Vector<T, 1>& dxdt) const {
    dxdt = -x;
  }
  void jacobian(double, const Vector<double, 1>&, Matrix<double, 1, 1>& j) const { j(0, 0) = 42; }
};

TEST(System, PassesOnWhatAProblemSaysOfItsSolutions) {
  Eigen::VectorXd kept;
  State lower2(2), upper2(2);
  const System duffing(problems::TextProblem("duffing"));
  EXPECT_TRUE(duffing.invariants(0, {1, 0}, kept));
  EXPECT_EQ(kept, Eigen::VectorXd::Constant(1, 0.75));
  EXPECT_FALSE(duffing.bounds(lower2, upper2));
  const System chain(problems::TextProblem("three-dof"));
  EXPECT_FALSE(chain.invariants(0, State::Zero(6), kept));
  const System hires(problems::TextProblem("hires"));
  State lower, upper;
  EXPECT_TRUE(hires.bounds(lower, upper));
  EXPECT_EQ(lower, Eigen::VectorXd::Zero(8));
  EXPECT_EQ(upper, Eigen::VectorXd::Constant(8, std::numeric_limits<double>::infinity()));
  EXPECT_TRUE(hires.invariants(0, problems::TextProblem("hires").initial_state(), kept));
  EXPECT_EQ(kept, Eigen::VectorXd::Constant(1, 0.0057));
}

TEST(System, AProblemsOwnJacobianIsUsed) {
  Jacobian j;
  System(OwnJacobian{}).jacobian(0, State{1}, j);
  EXPECT_EQ(j(0, 0), 42);
}

}  // namespace
}  // namespace nlmech::ivp::system_test
