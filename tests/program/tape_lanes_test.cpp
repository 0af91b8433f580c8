/// Series side by side: each lane has the bits of a series alone, whatever stands in the others.
#include "nlmech/program/tape_lanes.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include "nlmech/program/recorded.hpp"
#include "nlmech/program/tape_expansion.hpp"
#include "tests/program/tape_problems.hpp"

namespace nlmech::tests::tape_lanes_test {
namespace {

/// NaN and the signs of zeros, too.
bool same(double a, double b) { return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b); }

/// The kernel whose sums a lane has.
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

/// With constants in all places that have one.
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

// Each lane has constants of its own; what has other operations is refused.
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
    EXPECT_FALSE(lanes.fits(of(1 / 0.3)));  // a power of 1, and another number of operations
    EXPECT_FALSE(lanes.fits(program::record(Few{}, 0, 3, false).tape()));
  }
}

// What is infinite or NaN in one lane stays there.
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

// Sums of the series against Horner's rule; the order of the sum is that of a single series, whose bits
// integrations are held to. Each of the terms of some 1 may round once or twice.
TEST(TapeLanes, AddUp) {
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
      lanes.add_up();
      for (int lane = 0; lane < lanes.lanes(); ++lane) {
        for (int i = 0; i < 3; ++i) {
          double sum = 0, size = 0;
          const double s = 0.1 * lane - 0.4;
          for (int k = order; k >= 1; --k) {
            sum = (sum + lanes.coefficients(i, k)[lane]) * s;
            size = (size + std::abs(lanes.coefficients(i, k)[lane])) * std::abs(s);
          }
          EXPECT_NEAR(lanes.increments(i)[lane], sum, 4 * order * 0x1p-52 * size);
        }
      }
    }
  }
}

}  // namespace
}  // namespace nlmech::tests::tape_lanes_test
