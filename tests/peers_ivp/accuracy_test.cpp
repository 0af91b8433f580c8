// What every peer owes with its default settings: errors in proportion to the tolerance against closed forms,
// forwards, backwards, between the steps, in every dimension, and on stiff equations for those made for them.
#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/special_functions/jacobi_elliptic.hpp>
#include <map>

#include "nlmech/problems/texts.hpp"
#include "tests/peers_ivp/peers.hpp"

namespace nlmech::peers::accuracy_test {
namespace {

using namespace testing;
INSTANTIATE_TEST_SUITE_P(Peers, EveryPeer, ::testing::ValuesIn(all_peer_names()), test_name);

// The free Duffing oscillator from rest at 1: x = cn(sqrt(2) t | m = 1/4), to rounding.
ivp::State duffing_exact(double t) {
  const double u = std::sqrt(2.0) * t;
  double cn = 0, dn = 0;
  const double sn = boost::math::jacobi_elliptic(0.5, u, &cn, &dn);
  return {cn, -std::sqrt(2.0) * sn * dn};
}

struct Growth {
  static constexpr int dimension = 1;
  double k = 20;
  template <class T>
  void operator()(const T& /*t*/, const Vector<T, 1>& x, Vector<T, 1>& dxdt) const {
    dxdt[0] = k * x[0];
  }
};

// How many tolerances the error may be over four periods: a tolerance bounds the error of one step, and those
// of all steps add up, carried on by the equation. Formulas of low order take many steps, and multistep ones
// underrate their error. Measured were a third of these multiples, or less, at the tolerances below.
double multiple(const std::string& peer) {
  static const std::map<std::string, double> multiples = {
      {"cvode-adams", 600},       {"cvode-bdf", 5000},        {"arkode-erk", 25},
      {"arkode-dirk", 12},        {"gsl-rkf45", 350},         {"gsl-rk8pd", 50},
      {"gsl-bsimp", 300},         {"gsl-msadams", 1500},      {"gsl-msbdf", 45000},
      {"odeint-dopri5", 120},     {"odeint-fehlberg78", 150}, {"odeint-bulirsch-stoer", 400},
      {"odeint-rosenbrock4", 35},
  };
  return multiples.at(peer);
}

TEST_P(EveryPeer, FollowsTheDuffingOscillator) {
  for (const double tolerance : {1e-6, 1e-8, 1e-10, 1e-12}) {
    double worst = 0, last = 0;
    std::int64_t steps = 0;
    const auto compare = [&](const ivp::Step& step) {
      EXPECT_EQ(step.index, ++steps);
      EXPECT_EQ(step.t0, last);
      EXPECT_EQ(step.times.back(), step.t1);
      EXPECT_EQ(step.states.col(0), step.x1);
      last = step.t1;
      worst = std::max(worst, (step.x1 - duffing_exact(step.t1)).lpNorm<Eigen::Infinity>());
      return true;
    };
    const auto solution =
        run(ivp::System(problems::TextProblem("duffing")), {1, 0}, 0, 20, tolerance, compare);
    ASSERT_TRUE(solution.status.ok()) << solution.status.text();
    EXPECT_EQ(solution.t, 20);
    EXPECT_EQ(last, 20);
    EXPECT_EQ(solution.statistics.steps, steps);
    EXPECT_LT(worst, multiple(GetParam()) * tolerance) << tolerance;
    EXPECT_GT(worst, 1e-3 * tolerance) << "the comparison measures nothing";
  }
}

// Dense output: within the multiple of the steps themselves, or for the cubic through both ends within
// h^4/384 max |x''''|; x'''' and v'''' stay below 9 and 28 on this orbit (|x| <= 1, |v| < 1.3).
TEST_P(EveryPeer, InterpolatesItsSteps) {
  const bool cubic = GetParam().starts_with("arkode");
  const double tolerance = 1e-9;
  const auto compare = [&](const ivp::Step& step) {
    const double h = step.t1 - step.t0;
    const double bound = multiple(GetParam()) * tolerance + (cubic ? 28 * h * h * h * h / 384 : 0);
    for (const double part : {0.0, 0.1, 0.35, 0.5, 0.8, 1.0}) {
      const double t = part == 1 ? step.t1 : step.t0 + part * h;
      ivp::State x(2);
      step.dense.at(t, x);
      EXPECT_LT((x - duffing_exact(t)).lpNorm<Eigen::Infinity>(), bound) << t << " within " << h;
    }
    return true;
  };
  for (const double end : {20.0, -20.0})
    EXPECT_TRUE(
        run(ivp::System(problems::TextProblem("duffing")), {1, 0}, 0, end, tolerance, compare).status.ok());
}

// x' = k x grows by exp(k (t - t0)) since the start of a step. A matrix 1 - c h k of an implicit formula is
// singular for some lengths, which dense output by shorter steps must not meet where the step itself did not.
TEST_P(EveryPeer, InterpolatesGrowth) {
  const Growth problem;
  const bool cubic = GetParam().starts_with("arkode");
  const double tolerance = 1e-9;
  const auto compare = [&](const ivp::Step& step) {
    const double h = step.t1 - step.t0, kh = problem.k * h;
    const double bound = (multiple(GetParam()) * tolerance + (cubic ? kh * kh * kh * kh / 384 : 0)) *
                         (1 + std::abs(step.x1[0]));
    for (int part = 1; part < 400; ++part) {
      const double t = step.t0 + part * h / 400;
      ivp::State x(1);
      step.dense.at(t, x);
      EXPECT_NEAR(x[0], step.x0[0] * std::exp(problem.k * (t - step.t0)), bound) << t << " within " << h;
    }
    return true;
  };
  EXPECT_TRUE(run(ivp::System(problem), ivp::State{1.0}, 0, 1, tolerance, compare).status.ok());
}

// Looking at the steps, or between them, changes neither the solution nor what it costs.
TEST_P(EveryPeer, DoesNotNoticeItsObserver) {
  const ivp::System system(problems::TextProblem("duffing"));
  const auto look = [](const ivp::Step& step) {
    ivp::State x(2);
    step.dense.at((step.t0 + step.t1) / 2, x);
    return x.allFinite();
  };
  const auto alone = run(system, {1, 0}, 0, 5), watched = run(system, {1, 0}, 0, 5, 1e-9, look);
  EXPECT_EQ(alone.x, watched.x);
  EXPECT_EQ(alone.statistics.right_hand_sides, watched.statistics.right_hand_sides);
  EXPECT_EQ(alone.statistics.steps, watched.statistics.steps);
}

// There and back again. Both ways cost the same within a factor of three: a step control that minds the sign
// of time shows here.
TEST_P(EveryPeer, RunsBackwards) {
  const ivp::System system(problems::TextProblem("duffing"));
  const auto there = run(system, {1, 0}, 0, 20), back = run(system, there.x, 20, 0);
  ASSERT_TRUE(back.status.ok()) << back.status.text();
  EXPECT_EQ(back.t, 0);
  EXPECT_LT((back.x - ivp::State{1, 0}).lpNorm<Eigen::Infinity>(), 2 * multiple(GetParam()) * 1e-9);
  EXPECT_LT(back.statistics.right_hand_sides, 3 * there.statistics.right_hand_sides);
}

TEST_P(EveryPeer, StandsStillForAnEmptyInterval) {
  const auto solution = run(ivp::System(problems::TextProblem("duffing")), {1, 0}, 3, 3);
  EXPECT_TRUE(solution.status.ok());
  EXPECT_EQ(solution.t, 3);
  EXPECT_EQ(solution.x, (ivp::State{1, 0}));
  EXPECT_EQ(solution.statistics.right_hand_sides, 0);
}

// x_i' = -(i + 1)/n x_i: every compiled dimension reaches the library whole and in order.
template <int n>
struct Decays {
  static constexpr int dimension = n;
  [[nodiscard]] static int size() { return n == Eigen::Dynamic ? 5 : n; }
  template <class T>
  void operator()(const T& /*t*/, const Vector<T, n>& x, Vector<T, n>& dxdt) const {
    dxdt.resize(size());
    for (int i = 0; i < size(); ++i) dxdt[i] = -(i + 1.0) / size() * x[i];
  }
};

template <int n>
void expect_decays(const std::string& peer) {
  const int size = Decays<n>::size();
  const ivp::System system{Decays<n>{}};
  const ivp::State x0 = ivp::State::Constant(size, 1);
  const auto solution = peer_integrator(peer, 1e-9)(system, x0, 0, 1, {}, {});
  ASSERT_TRUE(solution.status.ok()) << solution.status.text();
  for (int i = 0; i < size; ++i)
    EXPECT_NEAR(solution.x[i], std::exp(-(i + 1.0) / size), 100e-9) << i + 1 << " of " << size;
}

TEST_P(EveryPeer, TakesEveryDimension) {
  expect_decays<1>(GetParam());
  expect_decays<2>(GetParam());
  expect_decays<3>(GetParam());
  expect_decays<4>(GetParam());
  expect_decays<6>(GetParam());
  expect_decays<Eigen::Dynamic>(GetParam());
}

// x' = -1e6 (x - cos t) - sin t from x = 1: x = cos t (A. Prothero, A. Robinson, Math. Comp. 28 (1974)
// 145-162). An explicit formula would need some 300 000 steps. The equation forgets errors, so the multiple
// is small.
struct ProtheroRobinson {
  static constexpr int dimension = 1;
  template <class T>
  void operator()(const T& t, const Vector<T, 1>& x, Vector<T, 1>& dxdt) const {
    using std::cos;
    using std::sin;
    dxdt[0] = -1e6 * (x[0] - cos(t)) - sin(t);
  }
};

TEST_P(EveryPeer, IsNotSlowedByStiffnessIfImplicit) {
  if (peer_info(GetParam()).family != ivp::Family::implicit) GTEST_SKIP() << "explicit";
  const double tolerance = 1e-7;
  const auto solution = run(ivp::System(ProtheroRobinson{}), ivp::State{1.0}, 0, 3, tolerance);
  ASSERT_TRUE(solution.status.ok()) << solution.status.text();
  EXPECT_NEAR(solution.x[0], std::cos(3.0), 10 * tolerance);
  EXPECT_LT(solution.statistics.steps + solution.statistics.rejected, 30000);
}

// Van der Pol's oscillator creeps along dx/dt = p(x)/mu, where eps p p' = (1 - x^2) p - x with eps = 1/mu^2:
// p = p0 + eps p0 p0'/(1 - x^2) + O(eps^2), p0 = x/(1 - x^2). So the time from 2 to 1.5 is an integral, to
// 1e-11 for mu = 1000.
double creep(double x) {
  constexpr double e = 1e-6;
  const double q = 1 - x * x, p0 = x / q, slope = (1 + x * x) / (q * q);
  return p0 + e * p0 * slope / q;
}

TEST_P(EveryPeer, CreepsWithVanDerPolIfImplicit) {
  if (peer_info(GetParam()).family != ivp::Family::implicit) GTEST_SKIP() << "explicit";
  const double mu = 1000, tolerance = 1e-8;
  const double end = mu * boost::math::quadrature::gauss<double, 30>::integrate(
                              [](double x) { return -1 / creep(x); }, 1.5, 2.0);
  const auto solution = run(ivp::System(problems::TextProblem("van-der-pol", {{"mu", mu}})),
                            ivp::State{2, creep(2) / mu}, 0, end, tolerance);
  ASSERT_TRUE(solution.status.ok()) << solution.status.text();
  // On the way the distance of two solutions grows by p(1.5)/p(2) = 1.8 alone. Some hundred steps of
  // multistep formulas, which underrate their errors, make up to 330 tolerances.
  const double bound = (GetParam() == "gsl-msbdf" ? 1000 : 100) * tolerance;
  EXPECT_NEAR(solution.x[0], 1.5, bound);
  EXPECT_NEAR(solution.x[1], creep(1.5) / mu, bound);
  EXPECT_LT(solution.statistics.steps + solution.statistics.rejected, 10000);
}

}  // namespace
}  // namespace nlmech::peers::accuracy_test
