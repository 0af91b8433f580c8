/// The tape and the unrolled recurrence against series in 50 digits that grow with the same equations.
#include "nlmech/program/recorded.hpp"

#include <gtest/gtest.h>

#include "nlmech/ivp/series/unrolled_taylor.hpp"
#include "nlmech/program/growing_series.hpp"
#include "nlmech/program/tape_expansion.hpp"
#include "tests/program/numbers.hpp"
#include "tests/program/tape_problems.hpp"

namespace nlmech::tests::tape_test {
namespace {

template <class Problem>
std::vector<std::vector<Real>> exact(const Problem& problem, double t,
                                     const Vector<double, Problem::dimension>& x, std::size_t order) {
  constexpr int n = Problem::dimension;
  using S = GrowingSeries<Real>;
  SeriesMemory<Real> memory;
  memory.start(order);
  S time = S::variable(memory);
  Vector<S, n> state, slope;
  for (int i = 0; i < n; ++i) state[i] = S::variable(memory);
  time.set(0, t);
  time.set(1, 1);
  std::vector<std::vector<Real>> c(n, std::vector<Real>(order + 1));
  for (int i = 0; i < n; ++i) state[i].set(0, c[static_cast<std::size_t>(i)][0] = x[i]);
  for (std::size_t k = 0; k < order; ++k) {
    memory.begin_pass(k);
    problem(time, state, slope);
    for (int i = 0; i < n; ++i) {
      c[static_cast<std::size_t>(i)][k + 1] = slope[i][k] / static_cast<int>(k + 1);
      state[i].set(k + 1, c[static_cast<std::size_t>(i)][k + 1]);
    }
  }
  return c;
}

/// Errors grow like the coefficients themselves: they are measured by the smallest geometric series above
/// all of them. 64 k roundings for a coefficient that is made of some forty operations of up to k terms.
template <class Coefficients>
void expect_coefficients(const std::vector<std::vector<Real>>& truth, const Coefficients& computed,
                         double scale) {
  const auto order = static_cast<int>(truth[0].size()) - 1;
  double largest = 0;
  std::vector<double> log2(truth[0].size(), -1e9);
  for (const auto& c : truth) {
    for (int k = 0; k <= order; ++k) {
      const auto i = static_cast<std::size_t>(k);
      int exponent = 0;
      const double mantissa = std::abs(static_cast<double>(frexp(c[i], &exponent)));
      if (mantissa > 0) log2[i] = std::max(log2[i], std::log2(mantissa) + exponent);
    }
  }
  const double ratio = log2.back() / order;
  for (int k = 0; k <= order; ++k) largest = std::max(largest, log2[static_cast<std::size_t>(k)] - k * ratio);
  for (std::size_t i = 0; i < truth.size(); ++i) {
    for (int k = 0; k <= order; ++k) {
      const double unit = std::log2(64.0 * (k + 1) * epsilon) + largest + k * ratio;
      const Real error = abs(Real(computed(static_cast<int>(i))[k]) / pow(Real(scale), k) -
                             truth[i][static_cast<std::size_t>(k)]);
      EXPECT_LE(error, pow(Real(2), unit)) << "component " << i << ", coefficient " << k;
    }
  }
}

TEST(Tape, HasTheCoefficientsOfTheSolution) {
  const Tangle problem;
  for (const int order : {1, 2, 3, 7, 16, 33, 60, 100}) {
    const auto truth = exact(problem, 0.3, point, static_cast<std::size_t>(order));
    for (const InstructionSet set : sets()) {
      SCOPED_TRACE(std::string(to_string(set)) + ", order " + std::to_string(order));
      TapeExpansion expansion(set);
      expansion.load(program::record(problem, 0.3, 3, false).tape(), order);
      for (const double scale : {1.0, 0.125}) {
        expansion.expand(0.3, point.data(), scale);
        expect_coefficients(
            truth, [&](int i) { return expansion.coefficients(i); }, scale);
      }
    }
  }
}

TEST(Tape, HasFunctionsMadeOfTheirSlopes) {
  const Inverses problem;
  for (const int order : {1, 2, 3, 8, 30, 60}) {
    const auto truth = exact(problem, 0.3, point, static_cast<std::size_t>(order));
    for (const InstructionSet set : sets()) {
      SCOPED_TRACE(std::string(to_string(set)) + ", order " + std::to_string(order));
      TapeExpansion expansion(set);
      expansion.load(program::record(problem, 0.3, 3, false).tape(), order);
      for (const double scale : {1.0, 0.125}) {
        expansion.expand(0.3, point.data(), scale);
        expect_coefficients(
            truth, [&](int i) { return expansion.coefficients(i); }, scale);
      }
    }
  }
}

template <int most, class Problem>
void expect_unrolled(const Problem& problem, const std::vector<int>& orders) {
  for (const int order : orders) {
    const auto truth = exact(problem, 0.3, point, static_cast<std::size_t>(order));
    ivp::UnrolledTaylor<Problem, most> taylor(problem, order, false);
    taylor.begin_segment(0.3, point);
    for (const double scale : {1.0, 0.25}) {
      taylor.expand(0.3, point, scale);
      expect_coefficients(
          truth, [&](int i) { return taylor.coefficients(i); }, scale);
    }
  }
}

TEST(Unrolled, HasTheCoefficientsOfTheSolution) {
  expect_unrolled<9>(Tangle{}, {1, 2, 3, 4, 5, 7, 8, 9});
  constexpr int most = unrolled::most_order;
  expect_unrolled<most>(Few{}, {1, 2, most / 4, most / 2, most / 2 + 1, most - 1, most});
}

// A tape does not depend on where it was recorded.
TEST(Tape, HoldsElsewhere) {
  const Tangle problem;
  const Vector<double, 3> other(0.9, 0.8, 1.3);
  TapeExpansion expansion;
  expansion.load(program::record(problem, 0.3, 3, false).tape(), 12);
  expansion.expand(-1.5, other.data());
  expect_coefficients(
      exact(problem, -1.5, other, 12), [&](int i) { return expansion.coefficients(i); }, 1);
}

struct Repetitive {
  static constexpr int dimension = 2;
  template <class T>
  void operator()(const T& t, const Vector<T, 2>& x, Vector<T, 2>& f) const {
    const T unused = exp(x[0] * t);
    static_cast<void>(unused);
    f[0] = x[0] * x[0] * sin(x[1]) + T(2) * T(3) * 1.0 * x[0];
    f[1] = cos(x[1]) * (x[0] * x[0]) - sin(x[1]) * 1 + 0 * t;
  }
};

// The square, the slope of x1 with sine and cosine, two products with them, and two sums.
TEST(Tape, RecordsCommonExpressionsOnceAndFoldsConstants) {
  const Tape tape = program::record(Repetitive{}, 0, 2, false).tape();
  EXPECT_EQ(tape.instructions(), 7);
  EXPECT_EQ(tape.products(), 4);
}

struct Constant {
  static constexpr int dimension = 2;
  template <class T>
  void operator()(const T&, const Vector<T, 2>&, Vector<T, 2>& f) const {
    f[0] = T(3);
    f[1] = T(0);
  }
};

TEST(Tape, OfConstantsIsEmpty) {
  TapeExpansion expansion;
  expansion.load(program::record(Constant{}, 0, 2, false).tape(), 5);
  expansion.expand(0, Vector<double, 2>(1, 2).data(), 2);
  EXPECT_EQ(expansion.tape().instructions(), 0);
  const double first[] = {1, 6, 0, 0, 0, 0}, second[] = {2, 0, 0, 0, 0, 0};
  for (int k = 0; k <= 5; ++k) {
    EXPECT_EQ(expansion.coefficients(0)[k], first[k]);
    EXPECT_EQ(expansion.coefficients(1)[k], second[k]);
  }
}

// A - (B - C) must not become A - B + C: with B and C large nothing would be left of A.
struct Cancelling {
  static constexpr int dimension = 3;
  template <class T>
  void operator()(const T&, const Vector<T, 3>& x, Vector<T, 3>& f) const {
    f[0] = x[0] - (x[1] - x[2]);
    f[1] = (x[1] - x[2]) + x[0] * 2.0;
    f[2] = T(0);
  }
};

TEST(Tape, KeepsTheOrderOfSums) {
  TapeExpansion expansion;
  const Vector<double, 3> x(1e-3, 1e17, 1e17);
  expansion.load(program::record(Cancelling{}, 0, 3, false).tape(), 2);
  expansion.expand(0, x.data());
  EXPECT_EQ(expansion.coefficients(0)[1], 1e-3);
  EXPECT_EQ(expansion.coefficients(1)[1], 2e-3);
}

struct Branches {
  static constexpr int dimension = 1;
  bool on_state = false;
  template <class T>
  void operator()(const T& t, const Vector<T, 1>& x, Vector<T, 1>& f) const {
    f[0] = value_of(on_state ? T(x[0] + t) : T(2 * t)) < 1 ? T(x[0]) : T(-x[0]);
  }
};

std::string complaint(const Branches& problem, bool announced) {
  try {
    static_cast<void>(program::record(problem, 0.25, 1, announced).tape());
    ivp::UnrolledTaylor<Branches, 5> taylor(problem, 5, announced);
    taylor.begin_segment(0.25, Vector<double, 1>(1.0));
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(Tape, RefusesBranchesThatAreNotAnnounced) {
  EXPECT_EQ(complaint({}, true), "");
  EXPECT_NE(complaint({}, false).find("discontinuities(t0, t1)"), std::string::npos);
  EXPECT_NE(complaint({.on_state = true}, true).find("branches on the state"), std::string::npos);
  EXPECT_NE(complaint({.on_state = true}, false).find("branches on the state"), std::string::npos);
}

// The branch is taken as at the time of the recording.
TEST(Tape, TakesTheAnnouncedBranch) {
  for (const double t : {0.25, 0.75}) {
    TapeExpansion expansion;
    expansion.load(program::record(Branches{}, t, 1, true).tape(), 4);
    const double x = 3;
    expansion.expand(t, &x);
    EXPECT_EQ(expansion.coefficients(0)[1], t < 0.5 ? 3 : -3);
  }
}

TEST(Tape, ComesOutTheSameEveryTime) {
  for (const InstructionSet set : sets()) {
    TapeExpansion one(set), two(set);
    one.load(program::record(Tangle{}, 0.3, 3, false).tape(), 25);
    two.load(program::record(Tangle{}, 0.3, 3, false).tape(), 25);
    one.expand(0.3, point.data());
    two.expand(0.1, point.data());
    two.expand(0.3, point.data());
    for (int i = 0; i < 3; ++i) {
      for (int k = 0; k <= 25; ++k) EXPECT_EQ(one.coefficients(i)[k], two.coefficients(i)[k]);
    }
  }
}

}  // namespace
}  // namespace nlmech::tests::tape_test
