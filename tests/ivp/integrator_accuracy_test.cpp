/// Accuracy of every integrator: orders of methods with fixed steps, errors over tolerance of methods with
/// adaptive steps.
#include <gtest/gtest.h>

#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/special_functions/jacobi_elliptic.hpp>
#include <functional>
#include <numbers>

#include "nlmech/ivp/collocation/collocation.hpp"
#include "nlmech/ivp/hermitian/hermitian.hpp"
#include "nlmech/ivp/named/named_integrators.hpp"
#include "nlmech/ivp/step_control.hpp"
#include "nlmech/problems/texts.hpp"
#include "tests/ivp/integrators.hpp"
#include "tests/ivp/oracle.hpp"
#include "tests/ivp/typed.hpp"

namespace nlmech::ivp::integrator_accuracy_test {
namespace {

using namespace testing;
using collocation::NodeFamily;

// ------------------------------------------------------------ orders

/// A method, its order at the ends of steps and within them, and a number of steps over two units of time for
/// which the next term of the error expansion is small.
struct Ordered {
  std::string name;
  std::function<NamedIntegrator(double step)> with;
  double order, within;
  int steps;
};

template <class Method>
Ordered ordered(const std::string& name, Method method, double order, int steps, double within = 0) {
  return {name,
          [method](double step) mutable {
            method.step = step;
            return named::with_options(method);
          },
          order, within > 0 ? within : order, steps};
}

std::vector<Ordered> methods_of_known_order() {
  std::vector<Ordered> all = {
      ordered("euler", Euler{}, 1, 2000), ordered("backward-euler", BackwardEuler{}, 1, 500),
      ordered("explicit", CentralDifference{}, 2, 200), ordered("rk4", Rk4{}, 4, 50),
      ordered("rk6", Rk6{}, 6, 25), ordered("newmark", Newmark{}, 2, 200),
      ordered("newmark, gamma = 0.6", Newmark{.gamma = 0.6}, 1, 1000), ordered("hht", Hht{}, 2, 200),
      ordered("hht, alpha = -1/3", Hht{.alpha = -1. / 3}, 2, 200),
      // Eq. 4.7 as printed loses an order, because (1 + alpha)(1/2 - alpha) is not 1/2.
      ordered("hht as printed", Hht{.form = Hht::Form::as_printed}, 1, 1000),
      ordered("hht as printed, alpha = -0.01", Hht{.alpha = -0.01, .form = Hht::Form::as_printed}, 1, 4000),
      ordered("hht as printed, alpha = 0", Hht{.alpha = 0, .form = Hht::Form::as_printed}, 2, 200),
      // Legendre-Gauss-Lobatto nodes without the left end as a stage: order N - 1. Radau nodes: 2 N - 3, N
      // within steps.
      ordered("lgl-coll, 3 nodes", PolynomialCollocation{.nodes = 3}, 2, 40),
      ordered("lgl-coll, 4 nodes", PolynomialCollocation{.nodes = 4}, 3, 20),
      ordered("lgl-coll, 6 nodes", PolynomialCollocation{.nodes = 6}, 5, 8),
      ordered("radau-coll, 3 nodes",
              PolynomialCollocation{.nodes = 3, .points = NodeFamily::left_end_and_radau}, 3, 40),
      ordered("radau-coll, 4 nodes",
              PolynomialCollocation{.nodes = 4, .points = NodeFamily::left_end_and_radau}, 5, 20, 4)};
  for (const double rho : {0.0, 0.5, 0.8, 1.0})
    all.push_back(ordered("generalized-alpha", GeneralizedAlpha{.rho_inf = rho}, 2, 200));
  for (const HermitianPair& pair : hermitian_table) {
    const int order = order_of(solved_for_end(pair));
    all.push_back(
        ordered(std::string(pair.name), Hermitian{.operators = pair}, order, order == 4 ? 25 : 200));
  }
  for (const int order : {2, 3, 4, 5, 6, 8})
    all.push_back(ordered("series", Series{.order = order}, order, order < 6 ? 32 : 12));
  return all;
}

// Damping, a load and a cubic spring; step sizes that do not divide the interval.
TEST(Orders, AreTheStatedOnes) {
  for (const Ordered& method : methods_of_known_order()) {
    const Manufactured problem;
    const auto errors = [&](int steps) {
      State largest{0, 0}, x(2);
      const auto measure = [&](const Step& step) {
        largest[0] = std::max(largest[0], oracle::distance(step.x1, problem.exact(step.t1)));
        for (const double part : {0.3, 0.5, 0.9}) {
          const double t = step.t0 + part * (step.t1 - step.t0);
          step.dense.at(t, x);
          largest[1] = std::max(largest[1], oracle::distance(x, problem.exact(t)));
        }
        return true;
      };
      const auto s = method.with(2 / (steps + 0.4))(System(problem), problem.exact(0), 0, 2, measure, {});
      EXPECT_TRUE(s.status.ok()) << s.status.text();
      return largest;
    };
    const State coarse = errors(method.steps), fine = errors(2 * method.steps);
    const double room = method.steps < 15 ? 0.25 : 0.1;  // for the next term of the error expansion
    EXPECT_NEAR(std::log2(coarse[0] / fine[0]), method.order, room) << method.name;
    EXPECT_NEAR(std::log2(coarse[1] / fine[1]), method.within, room) << method.name << ", within steps";
  }
}

// ------------------------------------------------------------ tolerances

class EveryAdaptive : public EveryIntegrator {
 protected:
  [[nodiscard]] static double bound(double tolerance) {
    return multiple_of_tolerance(row().name) * tolerance;
  }
  static Solution run_to(double tolerance, const System& system, const State& x0, double t1,
                         const Observer& observer = {}, const Limits& limits = {.steps = 3'000'000}) {
    return with(tolerance)(system, x0, 0, t1, observer, limits);
  }
};
INSTANTIATE_TEST_SUITE_P(All, EveryAdaptive, ::testing::ValuesIn(integrators_that([](const Integrator& i) {
                           return !i.by_steps;
                         })),
                         label_of);

// The free Duffing oscillator from rest at 1: x = cn(sqrt(2) t | m = 1/4), to rounding.
State duffing(double t) {
  const double u = std::sqrt(2.0) * t;
  double cn = 0, dn = 0;
  const double sn = boost::math::jacobi_elliptic(0.5, u, &cn, &dn);
  return {cn, -std::sqrt(2.0) * sn * dn};
}

// At tighter tolerances these methods need some million steps.
bool of_second_order(std::string_view name) { return name == "hoff" || name == "bazzi"; }

TEST_P(EveryAdaptive, FollowsTheDuffingOscillator) {
  for (const double tolerance : {1e-6, 1e-8, 1e-10, 1e-12}) {
    if (of_second_order(row().name) && tolerance < 1e-9) continue;
    double worst = 0;
    const auto compare = [&](const Step& step) {
      worst = std::max(worst, oracle::distance(step.x1, duffing(step.t1)));
      return true;
    };
    const auto s = run_to(tolerance, System(problems::TextProblem("duffing")), {1, 0}, 20, compare);
    ASSERT_TRUE(s.status.ok()) << s.status.text();
    EXPECT_LT(worst, bound(tolerance)) << tolerance;
    EXPECT_GT(worst, 1e-4 * tolerance) << "the comparison measures nothing";
  }
}

// Dense output meets the bound for the ends of steps. The cubic Hermite interpolant of arkode adds h^4/384
// max |x''''|; x'''' and v'''' stay below 9 and 28 on this orbit (|x| <= 1, |v| < 1.3).
TEST_P(EveryAdaptive, InterpolatesItsSteps) {
  const bool cubic = row().name.starts_with("arkode");
  for (const double tolerance : {1e-5, 1e-9}) {
    const auto compare = [&](const Step& step) {
      const double h = std::abs(step.t1 - step.t0),
                   room = bound(tolerance) + (cubic ? 28 * h * h * h * h / 384 : 0);
      State x(2);
      for (const double part : {0.0, 0.1, 0.35, 0.5, 0.8, 1.0}) {
        const double t = part == 1 ? step.t1 : step.t0 + part * (step.t1 - step.t0);
        step.dense.at(t, x);
        EXPECT_LT(oracle::distance(x, duffing(t)), room) << t << " within " << h;
      }
      return true;
    };
    for (const double end : {20.0, -20.0})
      EXPECT_TRUE(
          run_to(tolerance, System(problems::TextProblem("duffing")), {1, 0}, end, compare).status.ok());
  }
}

// x' = k x grows by exp(k (t - t0)) within a step. The matrix 1 - c h k of an implicit formula is singular
// for some h; dense output that takes shorter steps must avoid such h if the step itself did.
TEST_P(EveryAdaptive, InterpolatesGrowth) {
  if (row().second_order_only) GTEST_SKIP() << "for accelerations";
  const double k = 20, tolerance = 1e-9;
  const bool cubic = row().name.starts_with("arkode");
  // Newton's steps have order s + 1 between their s = 5 nodes and order 2s - 1 at their ends.
  const double between = row().family == Family::collocation ? 0.1 * std::pow(tolerance, 0.6) : 0;
  const auto compare = [&](const Step& step) {
    const double h = step.t1 - step.t0, kh = k * h;
    const double room =
        (bound(tolerance) + between + (cubic ? kh * kh * kh * kh / 384 : 0)) * (1 + std::abs(step.x1[0]));
    State x(1);
    for (int part = 1; part < 400; ++part) {
      const double t = step.t0 + part * h / 400;
      step.dense.at(t, x);
      EXPECT_NEAR(x[0], step.x0[0] * std::exp(k * (t - step.t0)), room) << t << " within " << h;
    }
    return true;
  };
  EXPECT_TRUE(run_to(tolerance, typed("x' = 20 x"), State{1.0}, 1, compare).status.ok());
}

// ------------------------------------------------------------ stiff equations

bool is_for_stiff(const MethodInfo& row) {
  return row.family == Family::implicit || row.family == Family::collocation;
}

// x' = -1e6 (x - cos t) - sin t from x = 1: x = cos t (A. Prothero, A. Robinson, Math. Comp. 28 (1974)
// 145-162). An explicit formula would need some 300 000 steps. Errors decay, so the multiple of the tolerance
// is small.
TEST_P(EveryAdaptive, IsNotSlowedByStiffnessIfImplicit) {
  if (!is_for_stiff(row())) GTEST_SKIP() << "explicit";
  const double tolerance = 1e-7;
  const auto s = run_to(tolerance, typed("x' = -1e6 (x - cos(t)) - sin(t)"), State{1.0}, 3);
  ASSERT_TRUE(s.status.ok()) << s.status.text();
  EXPECT_NEAR(s.x[0], std::cos(3.0), 10 * tolerance);
  EXPECT_LT(s.statistics.steps + s.statistics.rejected, 30000);
}

// On its slow branch van der Pol's oscillator follows dx/dt = p(x)/mu, where eps p p' = (1 - x^2) p - x with
// eps = 1/mu^2: p = p0 + eps p0 p0'/(1 - x^2) + O(eps^2), p0 = x/(1 - x^2). The time from x = 2 to 1.5 is an
// integral, accurate to 1e-11 for mu = 1000.
double creep(double x) {
  constexpr double e = 1e-6;
  const double q = 1 - x * x, p0 = x / q, slope = (1 + x * x) / (q * q);
  return p0 + e * p0 * slope / q;
}

TEST_P(EveryAdaptive, CreepsWithVanDerPolIfImplicit) {
  if (!is_for_stiff(row())) GTEST_SKIP() << "explicit";
  const double mu = 1000, tolerance = 1e-8;
  const double end = mu * boost::math::quadrature::gauss<double, 30>::integrate(
                              [](double x) { return -1 / creep(x); }, 1.5, 2.0);
  const auto s = run_to(tolerance, System(problems::TextProblem("van-der-pol", {{"mu", mu}})),
                        State{2, creep(2) / mu}, end);
  ASSERT_TRUE(s.status.ok()) << s.status.text();
  // The distance of two solutions grows only by p(1.5)/p(2) = 1.8. Some hundred steps of multistep formulas,
  // which underestimate their errors, add up to 330 tolerances.
  const double room = (row().name == "gsl-msbdf" ? 1000 : 100) * tolerance;
  EXPECT_NEAR(s.x[0], 1.5, room);
  EXPECT_NEAR(s.x[1], creep(1.5) / mu, room);
  EXPECT_LT(s.statistics.steps + s.statistics.rejected, 10000);
}

// ------------------------------------------------------------ bounds on steps, and forces of the time

// Odeint's last step is longer than the bound by a factor of at most 1 + 1e-12; times are rounded.
TEST_P(EveryAdaptive, TakesNoStepBeyondTheBound) {
  for (const double end : {10.0, -10.0}) {
    for (const double most : {0.03, 0.7}) {
      double longest = 0;
      const auto look = [&](const Step& step) {
        longest = std::max(longest, std::abs(step.t1 - step.t0) - 2 * spacing(10));
        return true;
      };
      const auto s = run_to(1e-3, typed("x'' = -x"), {1, 0}, end, look, {.largest_step = most});
      ASSERT_TRUE(s.status.ok()) << s.status.text();
      EXPECT_LE(longest, most * (1 + 1e-12)) << end;
      EXPECT_GE(static_cast<double>(s.statistics.steps), 10 / most - 1);
    }
  }
  const System pushed = typed("x'' = cos(3 t) - x - x^3");
  const auto free = run_to(1e-6, pushed, {1, 0}, 10),
             bounded = run_to(1e-6, pushed, {1, 0}, 10, {}, {.largest_step = 1e3});
  EXPECT_TRUE(free.status.ok()) << free.status.text();
  EXPECT_EQ(free.x, bounded.x) << "a bound beyond its steps";
  EXPECT_EQ(free.statistics.right_hand_sides, bounded.statistics.right_hand_sides);
}

/// Largest error at t1 in tolerances: gsl-msbdf on an oscillator.
const double worst_multiple = multiple_of_tolerance("gsl-msbdf");

// A pulse after an interval of rest a hundred times as long. A method that misses the pulse has an error of
// 0.886.
TEST_P(EveryAdaptive, MeetsAPulseAfterARest) {
  const double area = std::sqrt(std::numbers::pi) / 2, tolerance = 1e-7;
  const auto s =
      run_to(tolerance, typed("x'' = exp(-((t-50)/0.5)^2)"), {0, 0}, 100, {}, {.largest_step = 0.25});
  ASSERT_TRUE(s.status.ok()) << s.status.text();
  EXPECT_NEAR(s.x[1], area, worst_multiple * tolerance);
  EXPECT_NEAR(s.x[0], 50 * area, 50 * worst_multiple * tolerance);
}

// A quadrature and a constant component. If the error estimate is 0, the error does not depend on the
// tolerance.
TEST_P(EveryAdaptive, EstimatesTheErrorOfAQuadrature) {
  if (row().second_order_only) GTEST_SKIP() << "for accelerations";
  const auto error = [&](double tolerance) {
    const auto s = run_to(tolerance, typed("x' = cos(10 t); y' = 0"), {0, 1}, 1);
    EXPECT_TRUE(s.status.ok()) << s.status.text();
    return std::abs(s.x[0] - std::sin(10) / 10);
  };
  if (row().estimate_misses_time)
    EXPECT_GT(error(1e-10), worst_multiple * 1e-10);
  else
    for (const double tolerance : {1e-7, 1e-10}) EXPECT_LT(error(tolerance), worst_multiple * tolerance);
}

TEST_P(EveryAdaptive, EstimatesTheErrorOfAForce) {
  if (row().estimate_misses_time) GTEST_SKIP() << "is not chosen for it";
  for (const double tolerance : {1e-7, 1e-9}) {
    const auto s = run_to(tolerance, typed("x'' = cos(10 t)"), {0, 0}, 5);
    ASSERT_TRUE(s.status.ok()) << s.status.text();
    EXPECT_NEAR(s.x[0], (1 - std::cos(50)) / 100, worst_multiple * tolerance);
    EXPECT_NEAR(s.x[1], std::sin(50) / 10, worst_multiple * tolerance);
  }
}

}  // namespace
}  // namespace nlmech::ivp::integrator_accuracy_test
