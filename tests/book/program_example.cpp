/// Worked example of the API reference: one function, its gradient and its Taylor series.
#include <gtest/gtest.h>

// [example]
#include <array>
#include <cmath>

#include "nlmech/program/dual.hpp"
#include "nlmech/program/power_series.hpp"

// Written once, for every type of number.
template <class T>
T range(const T& speed, const T& angle) {  // of a throw over level ground, metres
  using std::sin;
  return speed * speed * sin(2.0 * angle) / 9.81;
}

// d range/d speed and d range/d angle, exact to rounding.
std::array<double, 2> gradient(double speed, double angle) {
  using Dual = nlmech::Dual<double, 2>;
  return range(Dual::variable(speed, 0), Dual::variable(angle, 1)).partial;
}

// Coefficients of 1, d, ..., d^order of the range at angle + d.
std::vector<double> expansion(double speed, double angle, std::size_t order) {
  using Series = nlmech::PowerSeries<double>;
  return range(Series(speed), Series::variable(angle, order)).coefficients();
}
// [example]

namespace {

TEST(Example, Program) {
  const double speed = 20, angle = 0.6, eps = 2.3e-16;
  const double a = speed * speed / 9.81;  // the range is a sin(2 angle)
  const auto [by_speed, by_angle] = gradient(speed, angle);
  EXPECT_NEAR(by_speed, 2 * speed * std::sin(2 * angle) / 9.81, 16 * eps * a);
  EXPECT_NEAR(by_angle, 2 * a * std::cos(2 * angle), 16 * eps * a);
  const std::vector<double> c = expansion(speed, angle, 3);
  ASSERT_EQ(c.size(), 4u);
  EXPECT_NEAR(c[2], -2 * a * std::sin(2 * angle), 16 * eps * a);
  EXPECT_NEAR(c[3], -4.0 / 3 * a * std::cos(2 * angle), 16 * eps * a);
}

}  // namespace
