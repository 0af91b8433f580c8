/// The tape against series in 50 digits of the same equations; SIMD lanes.
#include "nlmech/program/recorded.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include "nlmech/program/growing_series.hpp"
#include "nlmech/program/tape_expansion.hpp"
#include "nlmech/program/tape_lanes.hpp"
#include "tests/program/numbers.hpp"
#include "tests/thrown.hpp"

namespace nlmech::tests::tape_test {
namespace {

/// Every operation of a right-hand side, with constants as either operand, functions of time, and sums that
/// the tape merges.
struct Tangle {
  static constexpr int dimension = 3;
  template <class T>
  void operator()(const T& t, const Vector<T, 3>& x, Vector<T, 3>& f) const {
    const T &a = x[0], &b = x[1], &c = x[2];
    const T line = 2 * t - 1, one = 1;
    T sum = a * b - 0.3 * a + b / 3.0 - (one + one) * (c - a);
    sum += 0.1 * (0.7 * c) - (b - (c - t));
    sum -= 1 - a * a;
    sum /= 4.0;
    f[0] = sum + sqrt(b) * line - a / b + 0.5 / c - pow(c, 3) * 0.01 + pow(a, -2) / 7.0;
    const T s = sin(a * b), r = cos(a * b) + sin(line) - cos(line) * s;
    f[1] = -r * exp(-c) + log(b) * tanh(a) - exp(0.5 * t) / 9.0 + +a * T(0) + T(2) * T(0.25);
    f[2] = pow(b, -1.5) - tan(a / 4.0) + 0.2 * sinh(a - b) - cosh(t) * 0.1 + pow(c, 0.7) - line * line;
  }
};

/// Functions that a tape computes from their derivatives: each of a state, of the time and of a constant.
struct Inverses {
  static constexpr int dimension = 3;
  template <class T>
  void operator()(const T& t, const Vector<T, 3>& x, Vector<T, 3>& f) const {
    const T &a = x[0], &b = x[1], &c = x[2];
    const T constant = 0.5;
    f[0] = asin(a * c / 2.0) - acos(t) * b + asin(constant);
    f[1] = atan(a - b) + erf(c * c - t) - atan2(b, a * c) + acos(constant) + erf(constant);
    f[2] = atan2(T(2), -b) - atan2(-c, T(-1)) + atan(t * t) * a + atan2(constant, T(-3)) + atan(constant) +
           asinh(a * b - t) * asinh(constant);
  }
};

/// Few operations, for the highest orders.
struct Few {
  static constexpr int dimension = 3;
  template <class T>
  void operator()(const T& t, const Vector<T, 3>& x, Vector<T, 3>& f) const {
    f[0] = x[1] * x[2] - sin(x[0]) * t;
    f[1] = x[0] * x[0] - 1 / x[2];
    f[2] = sqrt(x[1]) - x[2];
  }
};

/// Arithmetic with constants as either operand and functions of time.
struct Arithmetic {
  static constexpr int dimension = 3;
  template <class T>
  void operator()(const T& t, const Vector<T, 3>& x, Vector<T, 3>& f) const {
    const T &a = x[0], &b = x[1], &c = x[2];
    const T line = 2 * t - 1, one = 1;
    T sum = a * b - 0.3 * a + b / 3.0 - (one + one) * (c - a);
    sum += 0.1 * (0.7 * c) - (b - (c - t));
    sum -= 1 - a * a;
    sum /= 4.0;
    f[0] = sum + sqrt(b) * line - a / b + 0.5 / c - pow(c, 3) * 0.01 + pow(a, -2) / 7.0 + pow(b, 6) / 9.0;
    const T s = sin(a * b), r = cos(a * b) + sin(line) - cos(line) * s;
    f[1] = -r * exp(-c) - exp(0.5 * t) / 9.0 + +a * T(0) + T(2) * T(0.25) + sqrt(one) - pow(one, 2);
    f[2] = exp(one) - sin(one) * cos(one) + pow(c, 0) - line * line;
  }
};

/// A point where all of them are defined.
const Vector<double, 3> point(0.6, 1.2, 0.9);

/// Instruction sets of this processor; single series have kernels for two of them.
std::vector<InstructionSet> sets() {
  std::vector<InstructionSet> all;
  for (const auto set : {InstructionSet::baseline, InstructionSet::avx2, InstructionSet::avx512}) {
    if (available(set)) all.push_back(set);
  }
  return all;
}
std::vector<InstructionSet> single_sets() {
  std::vector<InstructionSet> all = sets();
  std::erase(all, InstructionSet::avx512);
  return all;
}

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

/// Errors grow like the coefficients: they are relative to the smallest geometric series above all of them.
/// Tolerance: 64 k rounding errors for a coefficient of some forty operations with up to k terms.
template <class Coefficients>
void expect_coefficients(const std::vector<std::vector<Real>>& reference, const Coefficients& computed,
                         double scale) {
  const auto order = static_cast<int>(reference[0].size()) - 1;
  double largest = 0;
  std::vector<double> log2(reference[0].size(), -1e9);
  for (const auto& c : reference) {
    for (int k = 0; k <= order; ++k) {
      const auto i = static_cast<std::size_t>(k);
      int exponent = 0;
      const double mantissa = std::abs(static_cast<double>(frexp(c[i], &exponent)));
      if (mantissa > 0) log2[i] = std::max(log2[i], std::log2(mantissa) + exponent);
    }
  }
  const double ratio = log2.back() / order;
  for (int k = 0; k <= order; ++k) largest = std::max(largest, log2[static_cast<std::size_t>(k)] - k * ratio);
  for (std::size_t i = 0; i < reference.size(); ++i) {
    for (int k = 0; k <= order; ++k) {
      const double unit = std::log2(64.0 * (k + 1) * epsilon) + largest + k * ratio;
      const Real error = abs(Real(computed(static_cast<int>(i))[k]) / pow(Real(scale), k) -
                             reference[i][static_cast<std::size_t>(k)]);
      EXPECT_LE(error, pow(Real(2), unit)) << "component " << i << ", coefficient " << k;
    }
  }
}

template <class Problem>
void expect_taped(const Problem& problem, const std::vector<int>& orders) {
  for (const int order : orders) {
    const auto reference = exact(problem, 0.3, point, static_cast<std::size_t>(order));
    for (const InstructionSet set : single_sets()) {
      SCOPED_TRACE(std::string(to_string(set)) + ", order " + std::to_string(order));
      TapeExpansion expansion(set);
      expansion.load(program::record(problem, 0.3, 3, false).tape(), order);
      for (const double scale : {1.0, 0.125}) {
        expansion.expand(0.3, point.data(), scale);
        expect_coefficients(
            reference, [&](int i) { return expansion.coefficients(i); }, scale);
      }
    }
  }
}

TEST(Tape, HasTheCoefficientsOfTheSolution) {
  expect_taped(Tangle{}, {1, 2, 3, 7, 16, 33, 60, 100});
  expect_taped(Inverses{}, {1, 2, 3, 8, 30, 60});
  expect_taped(Arithmetic{}, {1, 2, 3, 4, 9, 33});
}

// A tape is valid for other times and states than those of the recording.
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

// A - (B - C) must not become A - B + C: for large B and C this would cancel A.
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
  return thrown<std::invalid_argument>(
      [&] { static_cast<void>(program::record(problem, 0.25, 1, announced).tape()); });
}

TEST(Tape, RefusesBranchesThatAreNotAnnounced) {
  EXPECT_EQ(complaint({}, true), "");
  EXPECT_TRUE(holds(complaint({}, false), "discontinuities(t0, t1)"));
  EXPECT_TRUE(holds(complaint({.on_state = true}, true), "branches on the state"));
  EXPECT_TRUE(holds(complaint({.on_state = true}, false), "branches on the state"));
}

// The branch is that of the time of the recording.
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
  for (const InstructionSet set : single_sets()) {
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

// Several series in SIMD lanes: each is bitwise equal to a single series, whatever the other lanes contain.

/// Bitwise equality, including NaN and the signs of zeros.
bool same(double a, double b) { return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b); }

/// The kernel of a single series that gives bitwise equal sums.
InstructionSet alone(InstructionSet set) {
  return set == InstructionSet::baseline ? set : InstructionSet::avx2;
}

Vector<double, 3> start(int lane) {
  return {0.6 + 0.01 * lane, 1.2 - 0.02 * lane, 0.9 + 0.003 * lane * lane};
}

template <class Problem>
void expect_same(const Problem& problem, const std::vector<int>& orders) {
  const Tape tape = program::record(problem, 0.3, 3, false).tape();
  for (const InstructionSet set : sets()) {
    TapeLanes lanes(set);
    TapeExpansion one(alone(set));
    for (const int order : orders) {
      SCOPED_TRACE(std::string(to_string(set)) + ", order " + std::to_string(order));
      lanes.load(tape, order);
      one.load(tape, order);
      for (int lane = 0; lane < lanes.lanes(); ++lane)
        lanes.set(lane, 0.3 - 0.01 * lane, start(lane).data(), std::ldexp(1, -(lane % 5)));
      lanes.expand();
      int differ = 0;
      for (int lane = 0; lane < lanes.lanes(); ++lane) {
        one.expand(0.3 - 0.01 * lane, start(lane).data(), std::ldexp(1, -(lane % 5)));
        for (int i = 0; i < 3; ++i) {
          for (int k = 0; k <= order; ++k) {
            if (!same(lanes.coefficients(i, k)[lane], one.coefficients(i)[k])) ++differ;
          }
        }
      }
      EXPECT_EQ(differ, 0);
    }
  }
}

TEST(TapeLanes, HaveTheBitsOfOne) {
  expect_same(Tangle{}, {2, 3, 4, 5, 6, 7, 8, 9, 12, 13, 14, 15, 16, 17, 20, 25, 33, 60, 100});
  expect_same(Inverses{}, {2, 3, 5, 8, 13, 21, 30});
  expect_same(Few{}, {2, 3, 4, 9, 26, 40, 100});
}

/// Constants at all positions that admit one.
struct Constants {
  static constexpr int dimension = 3;
  double p = 0.5;
  template <class T>
  void operator()(const T& t, const Vector<T, 3>& x, Vector<T, 3>& f) const {
    f[0] = p * (x[1] - 3 * p * x[0]) / (7 * p) + (x[2] + p) * x[0];
    f[1] = 0.1 * p - p / x[1] + pow(x[2], 0.3 * p);
    f[2] = T(11 * p) + 0 * t;
  }
};

// Each lane has its own constants; a tape with other operations is refused.
TEST(TapeLanes, HaveTheirOwnConstants) {
  const auto of = [](double p) { return program::record(Constants{p}, 0, 3, false).tape(); };
  for (const InstructionSet set : sets()) {
    TapeLanes lanes(set);
    TapeExpansion one(alone(set));
    lanes.load(of(1.1), 20);
    for (int lane = 0; lane < lanes.lanes(); ++lane) {
      const Tape tape = of(0.31 + 0.1 * lane);
      ASSERT_TRUE(lanes.fits(tape));
      lanes.put(lane, tape);
      lanes.set(lane, 0, start(lane).data(), 0.25);
    }
    lanes.expand();
    for (int lane = 0; lane < lanes.lanes(); ++lane) {
      one.load(of(0.31 + 0.1 * lane), 20);
      one.expand(0, start(lane).data(), 0.25);
      for (int i = 0; i < 3; ++i) {
        for (int k = 0; k <= 20; ++k) EXPECT_EQ(lanes.coefficients(i, k)[lane], one.coefficients(i)[k]);
      }
    }
    EXPECT_FALSE(lanes.fits(of(1 / 0.3)));  // an exponent of 1, and another number of operations
    EXPECT_FALSE(lanes.fits(program::record(Few{}, 0, 3, false).tape()));
  }
}

// Infinity or NaN in one lane does not affect the other lanes.
TEST(TapeLanes, KeepToThemselves) {
  const Tape tape = program::record(Few{}, 0.3, 3, false).tape();
  for (const InstructionSet set : sets()) {
    TapeLanes lanes(set);
    lanes.load(tape, 12);
    TapeExpansion one(alone(set));
    one.load(tape, 12);
    one.expand(0, point.data(), 1);
    const Vector<double, 3> bad(std::numeric_limits<double>::infinity(), -1, 0);
    for (int lane = 0; lane < lanes.lanes(); ++lane)
      lanes.set(lane, 0, lane % 2 == 0 ? bad.data() : point.data(), 1);
    lanes.expand();
    for (int lane = 0; lane < lanes.lanes(); ++lane) {
      EXPECT_EQ(std::isfinite(lanes.coefficients(0, 12)[lane]), lane % 2 != 0);
      if (lane % 2 == 0) continue;
      EXPECT_EQ(lanes.coefficients(0, 12)[lane], one.coefficients(0)[12]);
    }
  }
}

// Ends of steps against Horner's rule in long double; end() + end_carry() has the rounding of the sum of the
// series alone, whose terms of about 1 are rounded once or twice. The last terms by their definition.
TEST(TapeLanes, AdvanceAndMeasure) {
  const Tape tape = program::record(Few{}, 0.3, 3, false).tape();
  for (const InstructionSet set : sets()) {
    for (const int order : {2, 3, 4, 17}) {
      TapeLanes lanes(set);
      lanes.load(tape, order);
      for (int lane = 0; lane < lanes.lanes(); ++lane) {
        lanes.set(lane, 0.3, start(lane).data(), 0.25);
        lanes.set_argument(lane, 0.1 * lane - 0.4);
      }
      lanes.expand();
      lanes.advance();
      lanes.measure(1e-3, 1e-2);
      for (int lane = 0; lane < lanes.lanes(); ++lane) {
        const SeriesTail<double> tail = lanes.tail(lane);
        double last = 0, before = 0, total = 0;
        for (int i = 0; i < 3; ++i) {
          const auto c = [&](int k) { return lanes.coefficients(i, k)[lane]; };
          long double sum = 0, size = 0;
          const double s = 0.1 * lane - 0.4;
          for (int k = order; k >= 1; --k) {
            sum = (sum + c(k)) * s;
            size = (size + std::abs(c(k))) * std::abs(s);
          }
          const long double end = lanes.end(i)[lane];
          EXPECT_NEAR(static_cast<double>(end - c(0) + lanes.end_carry(i)[lane] - sum), 0,
                      static_cast<double>(4 * order * 0x1p-52L * size));
          EXPECT_LE(std::abs(lanes.end_carry(i)[lane]), 0x1p-53 * std::abs(lanes.end(i)[lane]));
          const double unit = 1 / (1e-3 + 1e-2 * std::abs(c(0)));
          last = std::max(last, unit * std::abs(c(order)));
          before = std::max(before, unit * std::abs(c(order - 1)));
          total += std::abs(c(order)) + std::abs(c(1));
        }
        EXPECT_EQ(tail.last, last);
        EXPECT_EQ(tail.before, before);
        EXPECT_EQ(tail.sum, total);
      }
      const double end = lanes.end(1)[1], carry = lanes.end_carry(1)[1], other = lanes.state(1)[0];
      lanes.accept(1);
      EXPECT_EQ(lanes.state(1)[1], end);
      EXPECT_EQ(lanes.carry(1)[1], carry);
      EXPECT_EQ(lanes.state(1)[0], other);
    }
  }
}

}  // namespace
}  // namespace nlmech::tests::tape_test
