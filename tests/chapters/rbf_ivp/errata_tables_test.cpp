/// Misprints of Tables 4.2, 4.4, 4.5 and 4.6: results of the library under the printed and the corrected
/// reading against the published errors; and printed errors against independent implementations in a few
/// lines.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "chapters/rbf_ivp/examples/runs.hpp"
#include "chapters/rbf_ivp/readings/explicit_variants.hpp"
#include "chapters/rbf_ivp/readings/readings.hpp"
#include "nlmech/problems/texts.hpp"
#include "tests/errata/erratum.hpp"
#include "tests/problems/text.hpp"

namespace nlmech::chapters::rbf_ivp::errata_tables_test {
namespace {

using ivp::RbfCollocation;
using ivp::Rk4;
using tests::expect_erratum;

/// Half a unit of the last digit of a number as printed, relative to it.
double half_digit(const std::string& printed) { return last_digit(printed) / 2 / std::stod(printed); }

/// The load of Eq. 4.24 with the values of Table 4.3.
double impact(double t) { return t <= 0.5 ? 2 * t : t < 1 ? 2 * (1 - t) : 0; }
double no_load(double /*t*/) { return 0; }

/// Position and velocity of x'' = f(t) - x - x^3, advanced by single steps, and the mean square of the
/// position error at their ends.
struct Oscillation {
  const Case& exact;
  double (*load)(double);
  double t = 0, x = 0, v = 0;
  std::vector<std::pair<double, double>> squares = {{0, 0}};  ///< times and errors; the start counts

  [[nodiscard]] double acceleration(double time, double position) const {
    return load(time) - position - position * position * position;
  }
  void count() {
    const double e = x - static_cast<double>(exact.reference(t)[0]);
    squares.emplace_back(t, e * e);
  }
  [[nodiscard]] double rms(double end = HUGE_VAL) const {
    double sum = 0;
    int ends = 0;
    for (const auto& [time, square] : squares) {
      if (time > end + 1e-9) break;
      sum += square;
      ++ends;
    }
    return std::sqrt(sum / ends);
  }

  /// The classical Runge-Kutta method.
  void runge_kutta(double h, int steps) {
    const double start = t;
    for (int k = 1; k <= steps; ++k) {
      const double a1 = acceleration(t, x), v2 = v + h / 2 * a1, a2 = acceleration(t + h / 2, x + h / 2 * v),
                   v3 = v + h / 2 * a2, a3 = acceleration(t + h / 2, x + h / 2 * v2), v4 = v + h * a3,
                   a4 = acceleration(t + h, x + h * v3);
      x += h / 6 * (v + 2 * v2 + 2 * v3 + v4);
      v += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
      t = start + k * h;
      count();
    }
  }

  /// Eq. 4.4: velocities half a step before positions. At both ends a half step of velocity.
  void central_differences(double h, int steps) {
    const double start = t;
    v -= h / 2 * acceleration(t, x);
    for (int k = 1; k <= steps; ++k) {
      v += h * acceleration(t, x);
      x += h * v;
      t = start + k * h;
      count();
    }
    v += h / 2 * acceleration(t, x);
  }

  /// Equation of motion of the HHT method between both ends of a step, (1 + alpha) r1 - alpha r0 = 0 for the
  /// residual forces r, solved for the position x1.
  void hilber_hughes_taylor(double h, int steps, double alpha = -0.1) {
    const double start = t, beta = (1 - alpha) * (1 - alpha) / 4, gamma = 0.5 - alpha;
    double a = acceleration(t, x);
    for (int k = 1; k <= steps; ++k) {
      const double end = start + k * h, old_force = acceleration(t, x);
      double x1 = x + h * v;
      const auto new_acceleration = [&] {
        return (x1 - x - h * v - h * h * (0.5 - beta) * a) / (beta * h * h);
      };
      for (int i = 0; i < 20; ++i) {
        const double lack = new_acceleration() - (1 + alpha) * acceleration(end, x1) + alpha * old_force;
        const double change = -lack / (1 / (beta * h * h) + (1 + alpha) * (1 + 3 * x1 * x1));
        x1 += change;
        if (std::abs(change) < 1e-14) break;
      }
      const double a1 = new_acceleration();
      v += h * ((1 - gamma) * a + gamma * a1);
      x = x1;
      a = a1;
      t = end;
      count();
    }
  }
};

// Row Explicit of both tables. Table 4.4 as printed results from a half-step velocity that is carried
// unchanged from one phase to the next, as the chapter's check shows.
TEST(ErrataOfTables, ExplicitRowsOfTables4_2And4_4) {
  Oscillation free{free_duffing_case(), no_load, 0, 1};
  free.central_differences(duffing_period() / 10, 1000);
  expect_erratum("rbf_ivp-table-4.2-explicit",
                 {.printed = 0.1, .corrected = 0.99, .oracle = free.rms(), .tolerance = half_digit("0.99")});
  Oscillation coarse{impact_case(), impact}, fine{impact_case(), impact};
  coarse.central_differences(0.1, 10);
  coarse.central_differences(0.5, 996);
  expect_erratum(
      "rbf_ivp-table-4.4-explicit",
      {.printed = 0.41, .corrected = 0.455, .oracle = coarse.rms(), .tolerance = half_digit("0.455")});
  fine.central_differences(0.005, 200);
  fine.central_differences(0.006, 83000);
  expect_erratum(
      "rbf_ivp-table-4.4-explicit",
      {.printed = 0.0025, .corrected = 2.63e-4, .oracle = fine.rms(), .tolerance = half_digit("2.63e-4")});
}

// Printed 2.41e-2; the first row, 0.405, is correct.
TEST(ErrataOfTables, HhtOfTable4_4) {
  Oscillation coarse{impact_case(), impact}, fine{impact_case(), impact};
  coarse.hilber_hughes_taylor(0.1, 10);
  coarse.hilber_hughes_taylor(0.5, 996);
  EXPECT_NEAR(coarse.rms(), 0.405, 0.0005);
  fine.hilber_hughes_taylor(0.05, 20);
  fine.hilber_hughes_taylor(0.03, 16600);
  expect_erratum(
      "rbf_ivp-table-4.4-hht",
      {.printed = 2.41e-2, .corrected = 2.51e-2, .oracle = fine.rms(), .tolerance = half_digit("2.51e-2")});
}

// The text states t_F = 500; the errors of Table 4.2 are those after 100 periods. The oracle is the published
// errors, to their last digit; 1.175e-4 may be rounded either way.
TEST(ErrataOfTables, EndTimeOfTable4_2) {
  const double P = duffing_period();
  const auto expect = [&](const auto& method, Points points, double published, double tolerance) {
    const auto kept = record(free_duffing_case(), 500, throughout(method));
    expect_erratum("rbf_ivp-table-4.2-end", {.printed = rms_error(kept, 0, points),
                                             .corrected = rms_error(kept, 0, points, 100 * P),
                                             .oracle = published,
                                             .tolerance = tolerance});
  };
  expect(ivp::Ode45{1e-6, 1e-6}, Points::all, 1.18e-4, 2 * half_digit("1.18e-4"));
  expect(ivp::Ode45{}, Points::all, 1.14e-6, half_digit("1.14e-6"));
  expect(ivp::Newmark{.step = P / 10}, Points::ends, 0.998, half_digit("0.998"));
  // oracle: rbf_ivp_methods 4.2 RK4-2 to *
  const auto kept = record(free_duffing_case(), 500, throughout(Rk4{P / 250}));
  EXPECT_NEAR(rms_error(kept, 0, Points::ends, 100 * P), 5.008e-6, 0.001e-6);
  EXPECT_NEAR(rms_error(kept, 0, Points::ends), 5.42e-6, 0.005e-6);
}

/// Number of significant rows of Table 4.4 that are reproduced with this end time.
double rows_explained(double end) {
  int count = 0;
  const auto look = [&](const auto& during, const auto& after, const std::string& printed) {
    const double rms =
        rms_error(record(impact_case(), 500, in_two_phases(during, after)), 0, Points::ends, end);
    count += std::abs(rms - std::stod(printed)) <= last_digit(printed) / 2 ? 1 : 0;
  };
  look(Rk4{0.1}, Rk4{0.5}, "0.399");
  look(Rk4{0.05}, Rk4{0.03}, "2.88e-6");
  look(ivp::Newmark{.step = 0.1}, ivp::Newmark{.step = 0.5}, "0.457");
  look(ivp::Newmark{.step = 0.05}, ivp::Newmark{.step = 0.03}, "1.46e-2");
  look(ivp::Hht{.step = 0.1}, ivp::Hht{.step = 0.5}, "0.405");
  return count;
}

/// The whole second at which most of these rows are reproduced, by the independent methods above.
double end_that_explains_most() {
  struct Rerun {
    Oscillation motion;
    std::string printed;
  };
  std::vector<Rerun> rows;
  const auto add = [&rows](double during, double after, const std::string& printed, const auto& steps) {
    rows.push_back({{impact_case(), impact}, printed});
    steps(rows.back().motion, during, static_cast<int>(std::lround(1 / during)));
    steps(rows.back().motion, after, static_cast<int>(std::lround(499 / after)));
  };
  const auto rk4 = [](Oscillation& o, double h, int n) { o.runge_kutta(h, n); };
  const auto newmark = [](Oscillation& o, double h, int n) { o.hilber_hughes_taylor(h, n, 0); };
  const auto hht = [](Oscillation& o, double h, int n) { o.hilber_hughes_taylor(h, n); };
  add(0.1, 0.5, "0.399", rk4);
  add(0.05, 0.03, "2.88e-6", rk4);
  add(0.1, 0.5, "0.457", newmark);
  add(0.05, 0.03, "1.46e-2", newmark);
  add(0.1, 0.5, "0.405", hht);
  int most = -1;
  double best = 0;
  for (int end = 490; end <= 500; ++end) {
    const auto explained = static_cast<int>(std::count_if(rows.begin(), rows.end(), [end](const Rerun& row) {
      return std::abs(row.motion.rms(end) - std::stod(row.printed)) <= last_digit(row.printed) / 2;
    }));
    if (explained <= most) continue;
    most = explained;
    best = end;
  }
  return best;
}

// Those of Table 4.4 belong to 499, by their third digits alone (2.884e-6 against 2.895e-6 for RK4-2). The
// oracle is the end that the printed errors and other code say. oracle: rbf_ivp_methods 4.4 end time, 4.4
// rows as printed at that end
TEST(ErrataOfTables, EndTimeOfTable4_4) {
  EXPECT_EQ(rows_explained(499), 5);
  EXPECT_LT(rows_explained(500), 5);
  expect_erratum(
      "rbf_ivp-table-4.4-end",
      {.printed = 500, .corrected = 499, .oracle = end_that_explains_most(), .tolerance = 0.05, .scale = 1});
}

// Section 4.4.2 gives one shape, c = 2.5, for steps of 0.1 and 0.5: the phase is lost. The printed 1.19e-6
// needs a second shape (recorded: 0.33; 1.1e-6 to 1.3e-6 with c = 0.66 after the impact).
TEST(ErrataOfTables, SecondShapeOfRbfColl1IsMissing) {
  const RbfCollocation during{0.1, 7, 2.5};
  const auto error = [&](double shape) {
    const auto kept = record(impact_case(), 500, in_two_phases(during, RbfCollocation{0.5, 7, shape}));
    return rms_error(kept, 0, Points::ends, 499);
  };
  const double one_shape = error(2.5), two_shapes = error(0.66);
  EXPECT_NEAR(one_shape, 0.33, 0.005);
  EXPECT_LT(two_shapes, 3 * 1.3e-6);
  EXPECT_GT(two_shapes, 1.1e-6 / 3);
  // In decades: rounding noise makes of the printed number up to three times as much, or a third.
  expect_erratum("rbf_ivp-table-4.4-shape", {.printed = std::log10(one_shape),
                                             .corrected = std::log10(two_shapes),
                                             .oracle = std::log10(1.19e-6),
                                             .tolerance = std::log10(3),
                                             .scale = 1});
}

/// RMS error of x1 at the step ends of RK4-1 of Table 4.6, against RK6 with steps a hundred times shorter,
/// whose error is below 1e-12.
double rms_of_rk4_1(const ivp::System& system) {
  const auto positions = [&system](const auto& method) {
    std::vector<double> x;
    const auto keep = [&x](const ivp::Step& step) {
      x.push_back(step.states(0, step.states.cols() - 1));
      return true;
    };
    const auto solution = ivp::integrate(system, ivp::State::Zero(6), 0, 200, method, keep);
    EXPECT_TRUE(solution.status.ok()) << solution.status.text();
    return x;
  };
  const std::vector<double> found = positions(Rk4{0.625}), fine = positions(ivp::Rk6{0.00625});
  double sum = 0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const double e = found[i] - fine.at(100 * i + 99);
    sum += e * e;
  }
  return std::sqrt(sum / static_cast<double>(found.size() + 1));  // the start counts
}

/// The error that Table 4.6 prints for RK4-1.
constexpr double rk4_1_of_table_4_6 = 4.6e-3;

// 6.08e-3 for the equations as printed is recorded. oracle: rbf_ivp_methods 4.6 RK4-1 x1
TEST(ErrataOfTables, Equation4_25) {
  const double corrected = rms_of_rk4_1(ivp::System(problems::TextProblem("three-dof"))),
               printed = rms_of_rk4_1(ivp::System(problems::tests::three_dof_as_printed()));
  EXPECT_NEAR(corrected, 4.582e-3, 0.001e-3);
  EXPECT_NEAR(printed, 6.08e-3, 0.01e-3);
  expect_erratum("rbf_ivp-4.25-c2", {.printed = printed,
                                     .corrected = corrected,
                                     .oracle = rk4_1_of_table_4_6,
                                     .tolerance = half_digit("4.6e-3")});
}

// Table 4.5 has no load, and the masses start at rest.
TEST(ErrataOfTables, LoadOfTable4_5) {
  expect_erratum("rbf_ivp-table-4.5",
                 {.printed = rms_of_rk4_1(ivp::System(problems::TextProblem("three-dof", {{"force", 0}}))),
                  .corrected = rms_of_rk4_1(ivp::System(problems::TextProblem("three-dof"))),
                  .oracle = rk4_1_of_table_4_6,
                  .tolerance = half_digit("4.6e-3")});
}

// Table 4.6 states that its errors are those of x1.
TEST(ErrataOfTables, ExplicitRowsOfTable4_6AreOfX3) {
  const auto expect = [](double h, const std::string& published) {
    const Record kept = explicit_chain(h, ExplicitStart::half_step, ExplicitDamping::from_half);
    expect_erratum("rbf_ivp-table-4.6", {.printed = rms_error(kept, 0, Points::ends, 200),
                                         .corrected = rms_error(kept, 2, Points::ends, 200),
                                         .oracle = std::stod(published),
                                         .tolerance = half_digit(published)});
  };
  expect(0.625, "0.131");
  expect(0.00625, "1.44e-5");
}

}  // namespace
}  // namespace nlmech::chapters::rbf_ivp::errata_tables_test
