#include "nlmech/bvp/optimal_control/duffing.hpp"

#include <gtest/gtest.h>

#include <array>

namespace nlmech::bvp::duffing_test {
namespace {

using Eigen::Vector2d;
using Eigen::Vector4d;
using Eigen::VectorXd;

/// Extremals of minimum cost at T = 2, S = I: z(0) and x(T).
struct Reference {
  DuffingCase which;
  double cost;
  std::array<double, 4> begin;
  std::array<double, 2> end;
};
// oracle: rbf_inverse_extremals free T = 2 *, fixed T = 2 *, x1x1 T = 2 *, x1x2 T = 2 *, x2x1 T = 2 *,
// harmonic T = 2 *
const std::array<Reference, 6> references = {{
    {DuffingCase::free,
     8.941912450065515,
     {0, 0, 2.060495823933756, 0.215891919825513},
     {1.406579787605473, 0.975517062167925}},
    {DuffingCase::fixed, 122.0837680864659, {0, 0, -20.3785164364616, 1.335548229680382}, {5, 2}},
    {DuffingCase::x1x1,
     7.995667087524662,
     {0, 14.08822800786590, 5.850923755444759, 0},
     {5, 1.011787960236148}},
    {DuffingCase::x1x2,
     0.103245928109679,
     {0, 14.97839700000099, 0.076466977013640, 0},
     {4.548603692554052, 2}},
    {DuffingCase::x2x1,
     9.507655814376282,
     {-5.56330095391728, 0, 0, -0.70499691970990},
     {5, 4.115791009731094}},
    {DuffingCase::harmonic,
     61.52486965748495,
     {0, 0, -14.5329639555076, -0.86459967812978},
     {1.512448336822282, 12.04724790330829}},
}};

class Cases : public testing::TestWithParam<Reference> {};

TEST_P(Cases, AreSolvedFromOwnStartsToTenDigits) {
  const Reference& reference = GetParam();
  DuffingSettings settings;
  settings.which = reference.which;
  settings.beta = printed_beta(reference.which);
  const Multistart m = duffing_extremals(settings, {.random = 0});
  ASSERT_FALSE(m.found.empty());
  EXPECT_EQ(m.spurious, 0);
  const Extremal& best = m.found.front().extremal;
  // 10 digits are documented; the references have 16.
  EXPECT_NEAR(best.cost, reference.cost, 1e-10 * reference.cost);
  for (int i = 0; i < 4; ++i) {
    const double value = reference.begin[static_cast<std::size_t>(i)];
    EXPECT_NEAR(best.solution.first()[i], value, 1e-11 * (1 + std::abs(value))) << i;
  }
  for (int i = 0; i < 2; ++i)
    EXPECT_NEAR(best.solution.last()[i], reference.end[static_cast<std::size_t>(i)], 1e-11);
  EXPECT_LE(best.miss, 1e-9);
  EXPECT_EQ(best.second_order.kind, Kind::minimum);
  // H is constant along the extremal: 1e-9 is the residual's tolerance, times the size of dH/dz.
  const ExtremalProblem problem = duffing_problem(settings);
  const double h = hamiltonian_at(problem, best.solution, 0);
  double scale = 1;
  for (int k = 0; k <= 20; ++k) {
    const VectorXd z = best.solution.at(0.1 * k);
    scale = std::max(scale, z.cwiseAbs().maxCoeff() * z.cwiseAbs().maxCoeff() * z.cwiseAbs().maxCoeff());
  }
  for (int k = 1; k <= 20; ++k) {
    EXPECT_NEAR(hamiltonian_at(problem, best.solution, 0.1 * k), h, 1e-10 * scale);
  }
}

INSTANTIATE_TEST_SUITE_P(All, Cases, testing::ValuesIn(references), [](const auto& given) {
  std::string name(to_string(given.param.which));
  return name;
});

TEST(Duffing, HasAPositiveAndASaddleExtremal) {
  // 177.997 of x1x1 is a saddle, 96.74 a minimum (reduced Hessian of a direct transcription with 48 nodes).
  DuffingSettings settings;
  settings.which = DuffingCase::x1x1;
  settings.beta = 0.94;
  const Multistart m = duffing_extremals(settings, {.direct = 12, .random = 0});
  int saddles = 0;
  for (const Found& f : m.found) {
    if (std::abs(f.extremal.cost - 177.9970) < 1e-3) {
      EXPECT_EQ(f.extremal.second_order.kind, Kind::saddle);
      ++saddles;
    }
    if (std::abs(f.extremal.cost - 96.7436) < 1e-3) {
      EXPECT_EQ(f.extremal.second_order.kind, Kind::minimum);
    }
  }
  EXPECT_EQ(saddles, 1);
}

TEST(Duffing, DualNumbersGiveTheEquationsAsPrinted) {
  DuffingSettings settings;
  settings.frequency = 1.3;
  const ExtremalProblem problem = duffing_problem(settings);
  const Vector4d z(0.7, -1.1, 2.3, 0.4);
  VectorXd f(4);
  problem.rhs(0.3, z, VectorXd(), f);
  // Eqs 5.22 and 5.24.
  const double w2 = 1.3 * 1.3, b = 0.9;
  const Vector4d printed(z[1], -w2 * z[0] - b * z[0] * z[0] * z[0] - z[3], z[3] * (w2 + 3 * b * z[0] * z[0]),
                         -z[2]);
  EXPECT_LE((f - printed).cwiseAbs().maxCoeff(), 1e-15 * 8);
  Eigen::MatrixXd j(4, 4), none(4, 0);
  problem.jacobian(0.3, z, VectorXd(), j, none);
  Eigen::Matrix4d exact = Eigen::Matrix4d::Zero();
  const double stiffness = w2 + 3 * b * z[0] * z[0];
  exact << 0, 1, 0, 0, -stiffness, 0, 0, -1, 6 * b * z[0] * z[3], 0, 0, stiffness, 0, 0, -1, 0;
  EXPECT_LE((j - exact).cwiseAbs().maxCoeff(), 1e-15 * 8);
}

TEST(Duffing, ComplementaryConditionsAreThoseOfTable51) {
  // Both cases that the text lists without solving them.
  for (const DuffingCase which : {DuffingCase::x2x2, DuffingCase::final_only}) {
    DuffingSettings settings;
    settings.which = which;
    const Multistart m = duffing_extremals(settings, {.random = 0});
    ASSERT_FALSE(m.found.empty());
    const VectorXd from = m.found[0].extremal.solution.first(), to = m.found[0].extremal.solution.last();
    EXPECT_NEAR(from[2], 0, 1e-12);
    if (which == DuffingCase::x2x2) {
      EXPECT_NEAR(to[2], to[0] - 5, 1e-12);
      EXPECT_NEAR(to[1], 2, 1e-12);
    } else {
      EXPECT_NEAR(from[3], 0, 1e-12);
      EXPECT_NEAR(m.found[0].extremal.cost, 0, 1e-12);  // the unforced motion that ends there
    }
  }
}

TEST(Duffing, WithoutWeightsNothingIsDone) {
  DuffingSettings settings;
  settings.weights = {0, 0};
  const Multistart m = duffing_extremals(settings, {.random = 0});
  ASSERT_FALSE(m.found.empty());
  EXPECT_NEAR(m.found[0].extremal.cost, 0, 1e-15);
}

TEST(Duffing, PumpReachesTheLongCase) {
  DuffingSettings settings;
  settings.which = DuffingCase::fixed;
  settings.final_time = 5;
  const ExtremalProblem problem = duffing_problem(settings);
  double least = 1e300;
  for (const double k : {0.95, 1.0, 1.05, 1.1}) {
    const Extremal e = solve_extremal(problem, pump_start(settings, k));
    if (e.solution.status.ok()) least = std::min(least, e.cost);
  }
  EXPECT_NEAR(least, 46.608623, 1e-6);  // oracle: rbf_inverse_extremals fixed T = 5 cost
}

// beta = 100 gives 14 oscillations; the estimate 3 E/(2 T), the cost of pumping with energy x^4 only, is
// within 5 %.
// oracle: rbf_inverse_extremals strong *
TEST(Duffing, DescentFromPumpsReachesManySwings) {
  DuffingSettings settings;
  settings.which = DuffingCase::fixed;
  settings.beta = 100;
  const DuffingStarts starts{
      .constants = false, .unforced = 0, .pumps = 0, .direct = 0, .random = 0, .driven = 2};
  const Multistart m = duffing_extremals(settings, starts, {}, {});
  ASSERT_FALSE(m.found.empty());
  const Extremal& e = m.found[0].extremal;
  EXPECT_NEAR(e.cost, 11649.91891386899, 1e-9 * 11650);
  EXPECT_NEAR(e.solution.first()[2], -363.733225697444628, 1e-10 * 364);
  EXPECT_NEAR(e.solution.first()[3], 79.013716333203832, 1e-10 * 79);
  EXPECT_NEAR(e.cost, 1.5 * (2 + 12.5 + 100 * 625 / 4.) / 2, 0.05 * e.cost);
  EXPECT_LE(e.miss, 1e-9);
  // No such initial guesses are made if T contains few oscillations.
  settings.beta = 0.9;
  EXPECT_TRUE(duffing_starts(settings, starts).empty());
}

// The mean of x2^2 with which an oscillation is pumped: E for a linear spring, 4 E/3 for a cubic one. An
// initial guess of strength 1 therefore ends near rest in both cases.
TEST(Duffing, PumpBeginsNearRest) {
  for (const double beta : {0.0, 1000.0}) {
    DuffingSettings settings;
    settings.which = DuffingCase::fixed;
    settings.beta = beta;
    settings.final_time = beta == 0 ? 40 : 2;
    const Start start = pump_start(settings, 1);
    VectorXd z(4);
    start.states(0, z);
    const auto energy = [&](double x, double v) { return (x * x + v * v) / 2 + beta / 4 * x * x * x * x; };
    // sqrt(E) decreases in steps of one over the number of oscillations, 6 or more.
    EXPECT_LE(std::sqrt(energy(z[0], z[1]) / energy(5, 2)), 0.1) << beta;
  }
}

TEST(Duffing, InteriorPointMakesTheCostateJump) {
  // Two polynomial methods, N = 40 for each phase, agree to 1e-9 in these.
  DuffingSettings settings;
  settings.which = DuffingCase::fixed;
  settings.waypoints = {{1.0, 0, 0.0}};
  const Multistart m = duffing_extremals(settings, {.unforced = 4, .pumps = 2, .direct = 4, .random = 0});
  ASSERT_FALSE(m.found.empty());
  const Extremal& e = m.found[0].extremal;
  EXPECT_NEAR(e.cost, 284.305667, 1e-6);
  EXPECT_NEAR(e.solution.at(1, Side::before)[2], -4.562434, 1e-6);
  EXPECT_NEAR(e.solution.at(1, Side::after)[2], 61.831273, 1e-6);
}

TEST(Duffing, BoundedForceMatchesShooting) {
  // |f| <= 15 of the fixed case at T = 2, d = 1e-4, polished by shooting with steps of 0.01.
  DuffingSettings settings;
  settings.which = DuffingCase::fixed;
  const ExtremalProblem problem = duffing_problem(settings);
  const Multistart m =
      duffing_extremals(settings, {.unforced = 0, .pumps = 2, .direct = 4, .random = 0}, {}, {});
  ASSERT_FALSE(m.found.empty());
  const Extremal e =
      tighten(problem, start_from(m.found[0].extremal.solution), control_bound_path(16.42, 15, 1e-4));
  ASSERT_TRUE(e.solution.status.ok()) << e.solution.status.text();
  EXPECT_NEAR(e.cost, 122.3004593, 1e-7);
  EXPECT_NEAR(e.solution.first()[2], -21.30021353, 1e-7);
  EXPECT_NEAR(e.solution.first()[3], 0.9462278952, 1e-7);
  EXPECT_LE(e.miss, 1e-9);
}

TEST(Duffing, NamesAndTargets) {
  EXPECT_EQ(to_string(DuffingCase::final_only), "final-only");
  EXPECT_EQ(duffing_cases().size(), 8U);
  DuffingSettings settings;
  settings.which = DuffingCase::harmonic;
  const Vector2d target = duffing_target(settings);  // Eq. 5.34 at T = 2
  EXPECT_NEAR(target[0], 1.512448336822282, 1e-14);
  EXPECT_NEAR(target[1], 12.04724790330829, 1e-13);
}

}  // namespace
}  // namespace nlmech::bvp::duffing_test
