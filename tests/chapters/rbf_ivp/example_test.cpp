/// The program of the page's last section against the equation integrated here.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>

#include "nlmech/scene/program/process.hpp"
#include "tests/places.hpp"

namespace nlmech::rbf_ivp_example_test {
namespace {

/// The pendulum of the example, by the classical method with 100 000 steps in extended precision: its error
/// is below (1e-4)^4 and rounding.
std::array<long double, 2> pendulum() {
  const auto f = [](const std::array<long double, 2>& x) {
    return std::array<long double, 2>{x[1], -std::sin(x[0]) - x[1] / 10};
  };
  const auto add = [](const std::array<long double, 2>& x, long double h,
                      const std::array<long double, 2>& k) {
    return std::array<long double, 2>{x[0] + h * k[0], x[1] + h * k[1]};
  };
  std::array<long double, 2> x = {1, 0};
  const long double h = 1e-4L;
  for (int i = 0; i < 100'000; ++i) {
    const auto a = f(x), b = f(add(x, h / 2, a)), c = f(add(x, h / 2, b)), d = f(add(x, h, c));
    x = add(add(add(add(x, h / 6, a), h / 3, b), h / 3, c), h / 6, d);
  }
  return x;
}

TEST(Example, OfThePageRuns) {
  const scene::Finished f = scene::run_program({NLMECH_BINARY_DIR "/bin/rbf_ivp_example"}, {});
  EXPECT_EQ(f.exit_code, 0) << f.errors;
  const std::size_t comma = f.output.find(", v = ");
  ASSERT_TRUE(f.output.starts_with("success: x = ") && comma != std::string::npos) << f.output;
  const double x = std::stod(f.output.substr(13)), v = std::stod(f.output.substr(comma + 6));
  // Twelve printed digits; Radau IIA of order 21 in ten steps has no visible error.
  const auto truth = pendulum();
  EXPECT_NEAR(x, static_cast<double>(truth[0]), 2e-12);
  EXPECT_NEAR(v, static_cast<double>(truth[1]), 2e-12);
}

}  // namespace
}  // namespace nlmech::rbf_ivp_example_test
