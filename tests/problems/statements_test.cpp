// What problems say of themselves: the equation as text, bounds, conserved sums.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <string>
#include <vector>

#include "nlmech/problems/blow_up.hpp"
#include "nlmech/problems/bodies.hpp"
#include "nlmech/problems/driven_duffing.hpp"
#include "nlmech/problems/duffing.hpp"
#include "nlmech/problems/duffing_chain.hpp"
#include "nlmech/problems/forced_duffing.hpp"
#include "nlmech/problems/hires.hpp"
#include "nlmech/problems/impact_duffing.hpp"
#include "nlmech/problems/linear_oscillator.hpp"
#include "nlmech/problems/lorenz.hpp"
#include "nlmech/problems/projectile.hpp"
#include "nlmech/problems/robertson.hpp"
#include "nlmech/problems/strong_oscillator.hpp"
#include "nlmech/problems/texts.hpp"
#include "nlmech/problems/three_mass_chain.hpp"
#include "nlmech/problems/two_body.hpp"
#include "nlmech/problems/two_dof.hpp"
#include "nlmech/problems/van_der_pol.hpp"
#include "nlmech/program/dual.hpp"
#include "nlmech/support/errors.hpp"
#include "tests/problems/oracle.hpp"

namespace nlmech::problems::tests::statements_test {
namespace {

template <class Problem>
class StatementsOf : public ::testing::Test {};
using All = ::testing::Types<BlowUp, FourBodies, DrivenDuffing, Duffing, ForcedDuffing, Hires, ImpactDuffing,
                             LinearOscillator, Lorenz, Projectile, Robertson, StrongOscillator,
                             ThreeMassChain, TwoBody, TwoDof, VanDerPol, DuffingChain>;
TYPED_TEST_SUITE(StatementsOf, All);

// A chain's k1 to k4 stand as kj.
TYPED_TEST(StatementsOf, EquationNamesEveryParameter) {
  const std::string text(TypeParam::equation);
  EXPECT_NE(text.find('='), std::string::npos);
  for (const char c : text) EXPECT_TRUE(c >= ' ' && c <= '~') << text;
  for (const std::string_view name : parameter_names<TypeParam>()) {
    std::string general(name.substr(0, name.find_last_not_of("0123456789") + 1));
    const bool is_named =
        text.find(name) != std::string::npos || text.find(general + "j") != std::string::npos;
    EXPECT_TRUE(is_named) << name << " is not in: " << text;
  }
}

/// Greatest rate of the invariants along the equation at @p x.
template <class Problem>
double drift(const Problem& problem, const Vector<double, Problem::dimension>& x) {
  constexpr int n = Problem::dimension;
  Vector<double, n> f;
  problem(0.0, x, f);
  Vector<Dual<double, n>, n> v;
  for (int i = 0; i < n; ++i) v[i] = Dual<double, n>::variable(x[i], i);
  const auto kept = problem.invariants(Dual<double, n>(0.0), v);
  double most = 0;
  for (int k = 0; k < kept.size(); ++k) {
    double rate = 0;
    for (int i = 0; i < n; ++i) rate += kept[k].partial[static_cast<std::size_t>(i)] * f[i];
    most = std::max(most, std::abs(rate));
  }
  return most;
}

RC_GTEST_PROP(Statements, SumsOfConcentrationsAreConserved, ()) {
  Robertson robertson;
  Hires hires{.k_plus = *between(0, 1e4)};
  Vector<double, 3> x;
  Vector<double, 8> y;
  for (int i = 0; i < 3; ++i) x[i] = *between(-1, 1);
  for (int i = 0; i < 8; ++i) y[i] = *between(-1, 1);
  // Terms up to k3 = 3e7, and to k_plus; a handful of roundings.
  RC_ASSERT(drift(robertson, x) <= 8 * 3e7 * epsilon);
  RC_ASSERT(drift(hires, y) <= 8 * 1e4 * epsilon);
}

/// A problem that is a text, and the rates of expressions along its solutions.
struct Text {
  explicit Text(std::string_view name, const program::Settings& settings = {})
      : equations({std::string(name), std::string(text_of(name))}, settings) {}

  static std::string_view text_of(std::string_view name) {
    const auto all = problem_texts();
    return std::ranges::find(all, name, &ProblemText::name)->text;
  }
  [[nodiscard]] std::vector<double> rates(const std::vector<program::NodeId>& of,
                                          const std::vector<double>& x) const {
    program::Graph graph = equations.graph();
    const program::Program program(graph, program::rates(graph, of, equations.slopes()));
    std::vector<double> values(of.size());
    program.run(0.0, x.data(), 0, of.size(),
                [&](int i, double value) { values[static_cast<std::size_t>(i)] = value; });
    return values;
  }
  /// Greatest rate of what is said to be conserved.
  [[nodiscard]] double drift(const std::vector<double>& x) const {
    double most = 0;
    for (const double rate : rates(equations.conserved(), x)) most = std::max(most, std::abs(rate));
    return most;
  }

  program::Equations equations;
};

/// A place of the plane at a distance from the origin of 0.5 to 2.
Vector<double, 2> place() {
  const double angle = *between(0, 6.28), distance = *between(0.5, 2);
  return {distance * std::cos(angle), distance * std::sin(angle)};
}

// Terms are products of velocities up to 2, accelerations up to 8 and their factors: below 64, some ten of
// them.
RC_GTEST_PROP(Texts, MotionsOfBodiesConserveWhatTheySay, ()) {
  const Vector<double, 2> q = place(), v = place();
  const Text kepler("kepler", {{"mu", *between(0.5, 2)}});
  RC_ASSERT(kepler.equations.conserved().size() == 2);
  RC_ASSERT(kepler.drift({q[0], q[1], v[0], v[1]}) <= 1000 * epsilon);
  // Half a unit from the earth and a tenth from the moon at least: the cubes of distances above 1e-3.
  const Text arenstorf("arenstorf", {{"moon", *between(0, 0.5)}});
  RC_ASSERT(arenstorf.equations.conserved().size() == 1);
  RC_ASSERT(arenstorf.drift({q[0], *between(0.5, 2), v[0], v[1]}) <= 1000 * epsilon);
}

RC_GTEST_PROP(Texts, StarsConserveMomentaAndEnergy, ()) {
  Text stars("pleiades");
  std::vector<double> x = stars.equations.initial_state("", "");
  for (double& component : x) component += *between(-0.4, 0.4);
  RC_ASSERT(stars.equations.conserved().size() == 4);
  // Stars are 0.2 apart at least: masses of 7 at 1/0.04, times velocities and distances of 5, 42 pairs.
  RC_ASSERT(stars.drift(x) <= 1e6 * epsilon);
}

RC_GTEST_PROP(Texts, SulphurIsConserved, ()) {
  std::vector<double> y(20);
  for (double& component : y) component = *between(0, 2);
  RC_ASSERT(Text("pollution").drift(y) == 0);
}

// The damper alone lessens the energy, at the rate c r'^2.
RC_GTEST_PROP(Texts, DamperTakesEnergyFromThePendulum, ()) {
  const double damping = *between(0, 10);
  Text pendulum("spring-pendulum", {{"stiffness", 100}, {"damping", damping}});
  const Vector<double, 2> q = place();
  const std::vector<double> x = {q[0], q[1], *between(-1, 1), *between(-1, 1)};
  const program::NodeId energy = pendulum.equations.expression(
      "energy", "mass/2*(x'^2 + y'^2) + stiffness/2*(r - length)^2 + mass gravity y");
  const double stretching = (x[0] * x[2] + x[1] * x[3]) / std::hypot(x[0], x[1]);
  RC_ASSERT(std::abs(pendulum.rates({energy}, x)[0] + damping * stretching * stretching) <= 1e4 * epsilon);
}

TEST(Texts, EndWhereTheySay) {
  for (const ProblemText& known : problem_texts()) {
    const TextProblem problem(known.name);
    EXPECT_EQ(problem.initial_time, 0) << known.name;
    EXPECT_GT(problem.final_time, 0) << known.name;
    EXPECT_EQ(problem.initial_state().size(), problem.size()) << known.name;
  }
  EXPECT_THROW(TextProblem("no-such"), std::invalid_argument);
  EXPECT_THROW(TextProblem("kepler", {{"eccentricity", 1}}), InputError);
}

TEST(Texts, DeadEndsHaveTheSlopesOfTheirSolutions) {
  const auto slope = [](const TextProblem& problem, double t, double y) {
    Vector<double, Eigen::Dynamic> x = Vector<double, Eigen::Dynamic>::Constant(1, y), f(1);
    problem(t, x, f);
    return f[0];
  };
  EXPECT_EQ(slope(TextProblem("dead-end"), 0.75, 0.5), -1);  // d sqrt(1 - t)/dt there
  EXPECT_EQ(slope(TextProblem("lost-domain"), 0.75, 2), -1.5);
  EXPECT_TRUE(std::isnan(slope(TextProblem("lost-domain"), 1.25, 2)));
}

// The energy's rate by dual numbers, for a chain of three.
RC_GTEST_PROP(Statements, ChainConservesItsEnergy, ()) {
  const DuffingChain chain{.masses = 3,
                           .natural_frequency = *between(0, 2),
                           .hardening = *between(-1, 2),
                           .coupling = *between(0, 2)};
  Vector<double, Eigen::Dynamic> x(6), f(6);
  Vector<Dual<double, 6>, Eigen::Dynamic> v(6);
  for (int i = 0; i < 6; ++i) {
    x[i] = *between(-1, 1);
    v[i] = Dual<double, 6>::variable(x[i], i);
  }
  chain(0.0, x, f);
  const auto energy = chain.invariants(Dual<double, 6>(0.0), v)[0];
  double rate = 0;
  for (int i = 0; i < 6; ++i) rate += energy.partial[static_cast<std::size_t>(i)] * f[i];
  RC_ASSERT(std::abs(rate) <= 200 * epsilon);
}

// A chain of one is a Duffing oscillator between two springs.
RC_GTEST_PROP(Statements, ChainOfOneIsADuffingOscillator, ()) {
  const double w = *between(0, 2), eta = *between(-1, 2), k = *between(0, 2);
  const DuffingChain chain{.masses = 1, .natural_frequency = w, .hardening = eta, .coupling = k};
  const Duffing one{.natural_frequency = std::sqrt(w * w + 2 * k), .hardening = eta};
  Vector<double, Eigen::Dynamic> x(2), f(2);
  x << *between(-1, 1), *between(-1, 1);
  Vector<double, 2> g;
  chain(0.0, x, f);
  one(0.0, Vector<double, 2>(x), g);
  RC_ASSERT(f[0] == g[0]);
  RC_ASSERT(std::abs(f[1] - g[1]) <= 32 * epsilon);
}

/// Does the vector field point inwards wherever a component is at its lower bound?
template <class Problem>
bool points_inwards(const Problem& problem) {
  constexpr int n = Problem::dimension;
  const Vector<double, n> lower = problem.lower_bounds();
  bool is_inwards = true;
  for (int i = 0; i < n; ++i) {
    Vector<double, n> x, f;
    for (int k = 0; k < n; ++k) x[k] = lower[k] + *between(0, 2);
    x[i] = lower[i];
    problem(0.0, x, f);
    is_inwards = is_inwards && f[i] >= 0;
  }
  return is_inwards;
}

RC_GTEST_PROP(Statements, ConcentrationsStayPositive, ()) {
  const Robertson robertson{.k1 = *between(0, 1), .k2 = *between(0, 1e5), .k3 = *between(0, 1e8)};
  RC_ASSERT(points_inwards(robertson));
  RC_ASSERT(points_inwards(Hires{.k_plus = *between(0, 1e4)}));
}

RC_GTEST_PROP(Texts, PollutionStaysPositive, ()) {
  const TextProblem problem("pollution", {{"light", *between(0, 2)}});
  Vector<double, Eigen::Dynamic> lower, upper, f(20);
  RC_ASSERT(problem.bounds(lower, upper));
  for (int i = 0; i < 20; ++i) {
    Vector<double, Eigen::Dynamic> x(20);
    for (int k = 0; k < 20; ++k) x[k] = *between(0, 2);
    x[i] = lower[i];
    problem(0.0, x, f);
    RC_ASSERT(f[i] >= 0);
  }
}

TEST(Statements, NegativeRatesHaveNoBounds) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(Robertson{}.lower_bounds().maxCoeff(), 0);
  EXPECT_EQ(Robertson{.k2 = -1}.lower_bounds().maxCoeff(), -infinity);
  EXPECT_EQ(Hires{}.lower_bounds().minCoeff(), 0);
  EXPECT_EQ(Hires{.k_plus = -1}.lower_bounds().maxCoeff(), -infinity);
}

}  // namespace
}  // namespace nlmech::problems::tests::statements_test
