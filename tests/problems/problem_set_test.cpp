/// tables/reference/problem_set.csv, the judge of chapter integrators, is judged itself: by closed forms, by
/// the digits of the test set of Bari, by another kind of method, and by other tables.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "chapters/integrators/problem_list.hpp"
#include "nlmech/problems/reference_trajectory.hpp"
#include "tests/ivp/test_set.hpp"
#include "tests/problems/oracle.hpp"

namespace nlmech::problems::tests::problem_set_test {
namespace {

using namespace nlmech::chapters::integrators;

/// The states of a problem by time, as they stand in the table.
std::map<double, std::vector<Real>> states_of(const std::string& problem) {
  std::ifstream in(NLMECH_SOURCE_DIR "/tables/reference/problem_set.csv");
  std::map<double, std::vector<Real>> states;
  std::string line;
  while (std::getline(in, line)) {
    std::istringstream cells(line);
    std::string name, t, component, value;
    for (std::string* cell : {&name, &t, &component, &value}) std::getline(cells, *cell, ',');
    if (name == problem) states[std::stod(t)].emplace_back(value);
  }
  return states;
}

/// Of problem_set_conditions.csv.
double condition_of(const std::string& problem) {
  std::ifstream in(NLMECH_SOURCE_DIR "/tables/reference/problem_set_conditions.csv");
  std::string line;
  while (std::getline(in, line)) {
    std::istringstream cells(line);
    std::string name, digits, condition;
    for (std::string* cell : {&name, &digits, &condition}) std::getline(cells, *cell, ',');
    if (name == problem) return std::stod(condition);
  }
  throw std::runtime_error("no condition of " + problem);
}

/// Greatest relative difference.
double miss(const std::vector<Real>& a, const std::vector<Real>& b) {
  double worst = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    worst = std::max(worst, static_cast<double>(Real(abs(a[i] - b[i]) / abs(b[i]))));
  return worst;
}

TEST(ProblemSet, EachHasSixteenStates) {
  for (const Case& c : all_cases()) {
    const auto states = states_of(std::string(c.name));
    ASSERT_EQ(states.size(), c.by == By::nothing ? 0U : 16U) << c.name;
    for (int k = 0; const auto& [t, x] : states) {
      EXPECT_EQ(t, judged_time(c.problem.initial_time, c.end, k++)) << c.name;
      EXPECT_EQ(std::ssize(x), c.problem.initial_state().size()) << c.name;
    }
  }
  EXPECT_EQ(states_of("friction").size(), 16U);
}

// Newton's iteration for Kepler's equation in 50 digits, from the doubles that the problem begins with: these
// make an ellipse whose size is not quite 1.
TEST(ProblemSet, KeplerMovesOnItsEllipse) {
  for (const double e : {0.1, 0.7, 0.99}) {
    const ivp::State x0 = TextProblem("kepler", {{"eccentricity", e}}).initial_state();
    const Real r0 = x0[0], v0 = x0[3], size = 1 / (2 / r0 - v0 * v0), eccentricity = 1 - r0 / size;
    const Real rate = 1 / (size * sqrt(size)), across = sqrt(1 - eccentricity * eccentricity);
    char name[32];
    (void)std::snprintf(name, sizeof name, "kepler-%g", e);
    for (const auto& [t, x] : states_of(name)) {
      Real anomaly = rate * t;
      for (int turn = 0; turn < 200; ++turn)
        anomaly -= (anomaly - eccentricity * sin(anomaly) - rate * t) / (1 - eccentricity * cos(anomaly));
      const Real speed = rate / (1 - eccentricity * cos(anomaly));
      const std::vector<Real> exact = {size * (cos(anomaly) - eccentricity), size * across * sin(anomaly),
                                       -size * speed * sin(anomaly), size * across * speed * cos(anomaly)};
      EXPECT_LT(miss(x, exact), 1e-30) << e << " at " << t;
    }
  }
}

// Jacobi's functions; the phase at the end of 10 000 periods is 5e4, so that 50 digits leave 45.
TEST(ProblemSet, DuffingIsAJacobiFunction) {
  const std::pair<const char*, double> hardenings[] = {
      {"duffing", 1}, {"duffing-1e6", 1e6}, {"duffing-10000", 1}};
  for (const auto& [name, hardening] : hardenings) {
    for (const auto& [t, x] : states_of(name)) {
      const Vector<Real, 2> exact = free_oscillation(Duffing{.hardening = hardening}, 1, t);
      EXPECT_LT(miss(x, {exact[0], exact[1]}), 1e-30) << name << " at " << t;
    }
  }
}

// The parameters of the test set are decimals and ours the doubles next to them: relative differences of up
// to 2^-53, of which each of a handful counts; and the last digit printed.
TEST(ProblemSet, EndsAsTheTestSetSays) {
  const std::pair<const char*, const char*> names[] = {
      {"pleiades", "Pleiades"}, {"pollution", "Pollution"}, {"hires", "HIRES"}, {"robertson", "Robertson"}};
  for (const auto& [ours, theirs] : names) {
    const std::vector<Real> end = states_of(ours).rbegin()->second;
    const std::vector<double> published = nlmech::oracle::published_end_state(theirs);
    ASSERT_EQ(end.size(), published.size()) << ours;
    const double tolerance = 1e-13 + 32 * condition_of(ours) * 0x1p-53;
    for (std::size_t i = 0; i < end.size(); ++i)
      EXPECT_NEAR(static_cast<double>(end[i]) / published[i], 1, tolerance) << ours << " component " << i + 1;
  }
}

// A period after its begin the satellite is where it was, as far as the doubles of its begin, of the period
// and of the moon's mass say. There, beside the moon, errors are some ten times those of the median over the
// judged times.
TEST(ProblemSet, ArenstorfsOrbitCloses) {
  const std::vector<Real> end = states_of("arenstorf").rbegin()->second;
  const double bound = 40 * condition_of("arenstorf") * 0x1p-53;
  const ivp::State begin = TextProblem("arenstorf").initial_state();
  for (int i = 0; i < 4; ++i)
    EXPECT_NEAR(static_cast<double>(end[static_cast<std::size_t>(i)]), begin[i], bound) << i;
}

// Van der Pol by collocation, against Taylor series in 60 digits; the pendulum against a series in long
// double.
TEST(ProblemSet, CollocationAgreesWithTaylorSeries) {
  const std::vector<Real> end = states_of("van-der-pol-1000").rbegin()->second;
  const Vector<Real, 2> series = reference_state<2>("van-der-pol", "mu=1000", "2000");
  EXPECT_LT(miss(end, {series[0], series[1]}), 1e-17);

  const TextProblem pendulum("spring-pendulum");
  const auto states = states_of("spring-pendulum");
  std::vector<long double> times;
  for (const auto& state : states) times.push_back(state.first);
  std::vector<Vector<long double, Eigen::Dynamic>> found;
  const Vector<long double, Eigen::Dynamic> x0 = pendulum.initial_state().cast<long double>();
  ASSERT_TRUE(reference_states(pendulum, x0, 0.0L, std::span<const long double>(times), found).ok());
  for (std::size_t k = 0; const auto& state : states) {
    // 12 000 steps of long double, relative to the greatest component.
    for (int i = 0; i < 4; ++i)
      EXPECT_NEAR(static_cast<double>(found[k][i] -
                                      static_cast<long double>(state.second[static_cast<std::size_t>(i)])),
                  0, 1e-14);
    ++k;
  }
}

// The same equation in Runge-Kutta-Fehlberg steps of long double.
TEST(ProblemSet, TaylorSeriesAgreeWithARungeKuttaMethod) {
  const auto check = [](const char* name) {
    const TextProblem problem(name);
    const auto x0 = problem.initial_state().template cast<long double>().eval();
    const auto found =
        by_odeint<long double, TextProblem>(problem, x0, problem.initial_time, problem.final_time, 1e-18L);
    const std::vector<Real> x = states_of(name).rbegin()->second;
    // An error of 1e-18 in each of some thousand steps, multiplied by the condition.
    for (int i = 0; i < problem.size(); ++i)
      EXPECT_NEAR(static_cast<double>(found[i] / static_cast<long double>(x[static_cast<std::size_t>(i)])), 1,
                  1e-14 * condition_of(name))
          << name << " " << i;
  };
  check("forced-duffing");
  check("oscillator");
  check("lorenz");
}

}  // namespace
}  // namespace nlmech::problems::tests::problem_set_test
