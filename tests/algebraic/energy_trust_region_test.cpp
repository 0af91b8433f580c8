/// Minimisation of potentials by trust regions.
#include "nlmech/algebraic/newton/energy_trust_region.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <utility>

namespace nlmech::algebraic::energy_trust_region_test {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double eps = std::numeric_limits<double>::epsilon();

/// A potential given by functions.
class Given : public Potential {
 public:
  Given(Eigen::Index n, std::function<double(const VectorXd&)> energy, DenseEquations::Residual residual,
        DenseEquations::Derivative derivative)
      : equations_(n, std::move(residual), std::move(derivative)), energy_(std::move(energy)) {}
  [[nodiscard]] Eigen::Index size() const override { return equations_.size(); }
  void residual(const VectorXd& x, VectorXd& f) override { equations_.residual(x, f); }
  void linearise(const VectorXd& x) override { equations_.linearise(x); }
  void apply(const VectorXd& v, VectorXd& out) const override { equations_.apply(v, out); }
  void apply_transposed(const VectorXd& v, VectorXd& out) const override {
    equations_.apply_transposed(v, out);
  }
  void matrix(MatrixXd& b) const override { equations_.matrix(b); }
  [[nodiscard]] double energy(const VectorXd& x) override { return energy_(x); }

 private:
  DenseEquations equations_;
  std::function<double(const VectorXd&)> energy_;
};

/// Rosenbrock's valley, with its minimum at (1, 1).
Given valley() {
  return {2,
          [](const VectorXd& x) {
            const double a = 1 - x[0], b = x[1] - x[0] * x[0];
            return a * a + 100 * b * b;
          },
          [](const VectorXd& x, VectorXd& f) {
            const double b = x[1] - x[0] * x[0];
            f << -2 * (1 - x[0]) - 400 * x[0] * b, 200 * b;
          },
          [](const VectorXd& x, MatrixXd& h) {
            h << 2 - 400 * (x[1] - 3 * x[0] * x[0]), -400 * x[0], -400 * x[0], 200;
          }};
}

/// V = x^4/4 - x^2/2 + slope x: two minima, or one.
Given two_wells(double slope) {
  return {1, [=](const VectorXd& x) { return std::pow(x[0], 4) / 4 - x[0] * x[0] / 2 + slope * x[0]; },
          [=](const VectorXd& x, VectorXd& f) { f[0] = std::pow(x[0], 3) - x[0] + slope; },
          [](const VectorXd& x, MatrixXd& h) { h(0, 0) = 3 * x[0] * x[0] - 1; }};
}

TEST(EnergyTrustRegion, WalksDownTheValley) {
  Given equations = valley();
  VectorXd x(2);
  x << -1.2, 1;
  std::int64_t seen = 0;
  double energy = HUGE_VAL;
  const Report report = find_root(EnergyTrustRegion{}, equations, x, [&](const Iterate& i) {
    EXPECT_EQ(i.index, seen++);
    EXPECT_LE(equations.energy(i.x), energy);
    energy = equations.energy(i.x);
    return true;
  });
  ASSERT_TRUE(report.status.ok()) << report.status.text();
  // The condition number of the Hessian there is 2500.
  EXPECT_NEAR(x[0], 1, 2500 * 4 * eps);
  EXPECT_NEAR(x[1], 1, 2500 * 4 * eps);
  EXPECT_LE(report.statistics.steps, 30);
  EXPECT_LE(report.last, 1e-12);
}

// V is stationary between the wells, but has no minimum there. For a slope beyond 2/(3 sqrt(3)) one well
// disappears, and |F| has a minimum there that is no root.
TEST(EnergyTrustRegion, EndsInAMinimumOnly) {
  const auto end = [](double slope, double from) {
    Given equations = two_wells(slope);
    VectorXd x = VectorXd::Constant(1, from);
    const Report report = find_root(EnergyTrustRegion{}, equations, x);
    EXPECT_TRUE(report.status.ok()) << report.status.text();
    return x[0];
  };
  EXPECT_NEAR(std::abs(end(0, 0)), 1, 4 * eps);
  EXPECT_NEAR(end(0, 0.5), 1, 4 * eps);
  const double limit = 2 / (3 * std::sqrt(3.0));
  for (const double beyond : {1e-9, 1e-5, 0.1, 10.}) {
    const double x = end(limit * (1 + beyond), 1);
    EXPECT_LT(x, -1.1);
    EXPECT_NEAR(x * x * x - x, -limit * (1 + beyond), 1e-14 * std::abs(x * x * x));
  }
}

// -sqrt(x) + x^2 is defined for x >= 0 only: its minimum is at 4^(-2/3), and steps from a large x lead below
// 0.
TEST(EnergyTrustRegion, ComesBackFromWhereThereIsNoEnergy) {
  Given equations(
      1, [](const VectorXd& x) { return x[0] * x[0] - std::sqrt(x[0]); },
      [](const VectorXd& x, VectorXd& f) { f[0] = 2 * x[0] - 0.5 / std::sqrt(x[0]); },
      [](const VectorXd& x, MatrixXd& h) { h(0, 0) = 2 + 0.25 / std::pow(x[0], 1.5); });
  for (const double start : {1e-6, 0.1, 3., 1e6}) {
    VectorXd x = VectorXd::Constant(1, start);
    const Report report = find_root(EnergyTrustRegion{.radius = 1e9}, equations, x);
    EXPECT_TRUE(report.status.ok()) << report.status.text();
    EXPECT_NEAR(x[0], std::pow(4, -2. / 3), 4 * eps) << start;
  }
}

TEST(EnergyTrustRegion, SaysWhyItFails) {
  Given flat(
      1, [](const VectorXd& x) { return x[0]; }, [](const VectorXd&, VectorXd& f) { f[0] = 1; },
      [](const VectorXd&, MatrixXd& h) { h(0, 0) = 0; });
  VectorXd x = VectorXd::Zero(1);
  EXPECT_EQ(find_root(EnergyTrustRegion{.iterations = 20}, flat, x).status.outcome(), Outcome::step_limit);
  Given equations = valley();
  x = VectorXd::Constant(2, std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(find_root(EnergyTrustRegion{}, equations, x).status.outcome(), Outcome::non_finite);
  x << -1.2, 1;
  const Report stopped =
      find_root(EnergyTrustRegion{}, equations, x, [](const Iterate& i) { return i.index < 2; });
  EXPECT_EQ(stopped.status.outcome(), Outcome::interrupted);
  EXPECT_THROW((void)find_root(EnergyTrustRegion{.radius = -1}, equations, x), std::invalid_argument);
  EXPECT_THROW((void)find_root(EnergyTrustRegion{.scale = VectorXd::Zero(2)}, equations, x),
               std::invalid_argument);
  x = VectorXd::Zero(3);
  EXPECT_THROW((void)find_root(EnergyTrustRegion{}, equations, x), std::invalid_argument);
}

}  // namespace
}  // namespace nlmech::algebraic::energy_trust_region_test
