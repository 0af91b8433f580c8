/// The tables of reference states against closed forms, a Runge-Kutta method of Boost, and extrapolation of
/// the midpoint rule in 62 digits.
#include <gtest/gtest.h>
#include <boost/math/special_functions/ellint_1.hpp>

#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "chapters/integrators/problem_list.hpp"
#include "nlmech/problems/reference_trajectory.hpp"
#include "nlmech/problems/texts.hpp"
#include "tests/ivp/test_set.hpp"
#include "tests/problems/oracle.hpp"

namespace nlmech::problems::tests::reference_table_test {
namespace {

TEST(ReferenceTable, HasThirtyDigitsInEveryRow) {
  const auto rows = read_references();
  EXPECT_GE(rows.size(), 35U);
  std::set<std::string> seen;
  for (const Reference& row : rows) {
    EXPECT_TRUE(seen.insert(row.problem + "," + row.parameters + "," + row.t + "," + row.state).second)
        << row.t;
    const std::string mantissa = row.value.substr(0, row.value.find('e'));
    EXPECT_GE(
        std::count_if(mantissa.begin(), mantissa.end(), [](unsigned char c) { return std::isdigit(c); }), 30)
        << row.problem << " " << row.state << " " << row.value;
  }
}

/// A number of the table, computed by tools/oracles/rbf_ivp_ends.py.
struct Known {
  const char *problem, *t, *state, *digits, *parameters = "";
};

// oracle: rbf_ivp_ends
const Known known[] = {
    {"duffing", "0", "period", "4.7680220291024608063045184700577190544953900025971"},
    {"duffing", "500", "x1", "0.6356014706573872618142369228219176734585"},
    {"duffing", "500", "v1", "1.007177800451054382762135703819415470357"},
    {"impact", "0.5", "x1", "0.04114876293396327914860368554860393158922"},
    {"impact", "0.5", "v1", "0.2448313772903179346460727468462075069312"},
    {"impact", "1", "x1", "0.2345637237526737363950751817088007847528"},
    {"impact", "1", "v1", "0.4279799258511257045665702574130488454827"},
    {"impact", "1", "energy", "0.1198502826813076065068879668307587195244"},
    {"impact", "1", "amplitude", "0.4650874620970523022949741812013103971775"},
    {"impact", "1", "period", "5.830560854069868991886522389275839576621"},
    {"impact", "500", "x1", "-0.4043016339378515321024209931460217858935"},
    {"impact", "500", "v1", "-0.2507612394654356944854635868874850330578"},
    {"three-dof", "200", "x1", "0.1621748860002476087274773596592835302378"},
    {"three-dof", "200", "x2", "0.346572951579977324891465606901130114272"},
    {"three-dof", "200", "x3", "0.7582358883258399112466998228870909811297"},
    {"three-dof", "200", "v1", "-0.08899514991998021237222876182686045048988"},
    {"three-dof", "200", "v2", "-0.1639274778294379145512039972593931832322"},
    {"three-dof", "200", "v3", "-0.2083204784161217199585618820587636607694"},
    {"three-dof", "200", "x1", "0.1621748860002473897017669308749293167778", "as doubles"},
    {"three-dof", "200", "x2", "0.3465729515799769464131826825424347531687", "as doubles"},
    {"three-dof", "200", "x3", "0.7582358883258392394078842846536725937750", "as doubles"},
    {"three-dof", "200", "v1", "-0.08899514991998155626594779139728866755274", "as doubles"},
    {"three-dof", "200", "v2", "-0.1639274778294406028186595358216047758829", "as doubles"},
    {"three-dof", "200", "v3", "-0.2083204784161271014782796039371228087290", "as doubles"}};

// The difference is at most one unit of the last digit, which may be rounded or truncated.
TEST(ReferenceTable, HasTheKnownDigits) {
  for (const Known& row : known) {
    const std::string digits = row.digits;
    const int decimals = static_cast<int>(digits.size() - digits.find('.') - 1);
    const Real difference = reference(row.problem, row.parameters, row.t, row.state) - Real(digits);
    EXPECT_LE(abs(difference), pow(Real(10), -decimals)) << row.problem << " " << row.state;
  }
}

// The phase omega t carries 707 units of rounding at t = 500, and 530 000 for the hard spring.
TEST(ReferenceTable, FreeOscillationIsAJacobiFunction) {
  EXPECT_LT(distance(reference_state<2>("duffing", "", "500"), free_oscillation(Duffing{}, 1, 500)), 1e-46);
  const Vector<Real, 2> table = reference_state<2>("duffing", "hardening=1e6", "0.75");
  const Vector<Real, 2> exact = free_oscillation(Duffing{.hardening = 1e6}, 1, 0.75);
  EXPECT_LT(abs(table[0] - exact[0]), 1e-46);
  EXPECT_LT(abs(table[1] - exact[1]), 1e-43);
  EXPECT_LT(
      abs(reference("duffing", "hardening=1e6", "0", "period") - Duffing{.hardening = 1e6}.period(Real(1))),
      1e-49);
}

// After the impact the oscillator is free: the state at t = 1 gives the amplitude and, by Boost's elliptic
// integral, the phase; these give the states at 499 and 500.
TEST(ReferenceTable, ImpactLeavesAJacobiFunction) {
  const Duffing free;
  const Vector<Real, 2> at_one = reference_state<2>("impact", "", "1");
  const Real amplitude = free.amplitude(at_one), omega = free.argument_frequency(amplitude);
  const Real modulus = sqrt(free.elliptic_parameter(amplitude));
  // The position still increases at t = 1: the last quarter period before the maximum.
  const Real phase = -Real(boost::math::ellint_1(modulus, Real(acos(at_one[0] / amplitude))));
  for (const char* t : {"499", "500"}) {
    const Real since_peak = Real(t) - 1 + phase / omega;
    EXPECT_LT(distance(reference_state<2>("impact", "", t), free_oscillation(free, amplitude, since_peak)),
              1e-45)
        << t;
  }
  EXPECT_LT(abs(reference("impact", "", "1", "energy") - free.energy(at_one)), 1e-49);
}

/// Distance of a state of the table from that of Odeint in long double.
template <int n, class Problem>
double miss(const Problem& problem, const std::string& parameters, const std::string& t,
            long double tolerance) {
  const auto x0 = problem.initial_state().template cast<long double>().eval();
  return distance(reference_state<n>(std::string(problem.name), parameters, t),
                  by_odeint<long double, Problem>(problem, x0, 0, std::stold(t), tolerance));
}

// Runge-Kutta-Fehlberg with an error of `tolerance` a step, over some hundred steps; errors grow at most
// tenfold.
TEST(ReferenceTable, AgreesWithARungeKuttaMethod) {
  EXPECT_LT(miss<2>(TextProblem("impact"), "", "0.5", 1e-18L), 1e-17);
  const Vector<long double, Eigen::Dynamic> half =
      reference_state<2>("impact", "", "0.5").cast<long double>();
  EXPECT_LT(
      distance(reference_state<2>("impact", "", "1"),
               by_odeint<long double, TextProblem>(TextProblem("impact"), half, 0.5L, 1 - 0x1p-64L, 1e-18L)),
      1e-17);
  EXPECT_LT(miss<6>(TextProblem("three-dof"), "as doubles", "200", 1e-18L), 1e-15);
  EXPECT_LT(miss<2>(TextProblem("van-der-pol", {{"mu", 10}}), "mu=10", "20", 1e-17L), 1e-14);
  EXPECT_LT(miss<2>(TextProblem("van-der-pol", {{"mu", 10}}), "mu=10", "100", 1e-17L), 1e-13);
  EXPECT_LT(miss<2>(TextProblem("van-der-pol", {{"mu", 100}}), "mu=100", "200", 1e-16L), 1e-11);
}

// The Test Set for Initial Value Problem Solvers (Bari) gives y1(2), y2(2) of the same equation in the time
// t/mu for mu = 1000, so x = y1 and v = y2/mu; its last two digits may be affected by rounding. The table
// does not contain this time; the tested series in long double is the reference of the chapter.
TEST(ReferenceStates, AgreeWithThePublishedEndStateOfAStiffProblem) {
  const TextProblem problem("van-der-pol", {{"mu", 1000}});
  const long double end = 2000;
  std::vector<Vector<long double, Eigen::Dynamic>> found;
  const Vector<long double, Eigen::Dynamic> x0 = problem.initial_state().cast<long double>();
  const nlmech::Status status =
      reference_states(problem, x0, 0.0L, std::span(&end, 1), found, {.most_steps = 10'000'000});
  ASSERT_TRUE(status.ok()) << status.text();
  EXPECT_LT(std::abs(found[0][0] - 1.706167732170483L), 1e-13L);
  EXPECT_LT(std::abs(found[0][1] * 1000 + 0.8928097010247975L), 1e-13L);
}

// ---- tables/reference/problem_set.csv, the reference of chapter integrators, against closed forms, the
// digits of the test set of Bari, another kind of method, and other tables.

using namespace nlmech::chapters::integrators;

/// The states of a problem in the table, by time.
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

/// Condition number of a problem from problem_set_conditions.csv.
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

/// Largest relative difference.
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

// Kepler's equation by Newton's iteration in 50 digits, from the initial state in doubles: its ellipse has a
// semi-major axis of not exactly 1.
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

// Jacobi's functions in 50 digits: the phase after 10 000 periods is 5e4, which leaves 45 digits.
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

// The parameters of the test set are decimal numbers, those of the table their nearest doubles: a handful of
// relative differences of up to 2^-53, and the last printed digit.
TEST(ProblemSet, EndsAsTheTestSetSays) {
  const std::pair<const char*, const char*> names[] = {
      {"pleiades", "Pleiades"}, {"pollution", "Pollution"}, {"hires", "HIRES"}, {"robertson", "Robertson"}};
  for (const auto& [name, published_name] : names) {
    const std::vector<Real> end = states_of(name).rbegin()->second;
    const std::vector<double> published = nlmech::oracle::published_end_state(published_name);
    ASSERT_EQ(end.size(), published.size()) << name;
    const double tolerance = 1e-13 + 32 * condition_of(name) * 0x1p-53;
    for (std::size_t i = 0; i < end.size(); ++i)
      EXPECT_NEAR(static_cast<double>(end[i]) / published[i], 1, tolerance) << name << " component " << i + 1;
  }
}

// After a period the satellite returns to its initial state, within the rounding of the initial state, the
// period and the mass of the moon to doubles. Close to the moon errors are some ten times those of the median
// over the compared times.
TEST(ProblemSet, ArenstorfsOrbitCloses) {
  const std::vector<Real> end = states_of("arenstorf").rbegin()->second;
  const double bound = 40 * condition_of("arenstorf") * 0x1p-53;
  const ivp::State begin = TextProblem("arenstorf").initial_state();
  for (int i = 0; i < 4; ++i)
    EXPECT_NEAR(static_cast<double>(end[static_cast<std::size_t>(i)]), begin[i], bound) << i;
}

// Van der Pol by collocation against Taylor series in 60 digits; the pendulum against a series in long
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
    // 12 000 steps in long double; errors relative to the largest component.
    for (int i = 0; i < 4; ++i)
      EXPECT_NEAR(static_cast<double>(found[k][i] -
                                      static_cast<long double>(state.second[static_cast<std::size_t>(i)])),
                  0, 1e-14);
    ++k;
  }
}

// The same equations by Runge-Kutta-Fehlberg steps in long double.
TEST(ProblemSet, TaylorSeriesAgreeWithARungeKuttaMethod) {
  const auto check = [](const char* name) {
    const TextProblem problem(name);
    const auto x0 = problem.initial_state().template cast<long double>().eval();
    const auto found =
        by_odeint<long double, TextProblem>(problem, x0, problem.initial_time, problem.final_time, 1e-18L);
    const std::vector<Real> x = states_of(name).rbegin()->second;
    // An error of 1e-18 in each of some thousand steps, times the condition number.
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
}  // namespace nlmech::problems::tests::reference_table_test
