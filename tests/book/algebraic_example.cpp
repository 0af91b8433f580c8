/// Worked example of the API reference: two equations, and solvers that can be set side by side.
#include <gtest/gtest.h>

// [example]
#include "nlmech/algebraic/equations.hpp"
#include "nlmech/algebraic/named_solvers.hpp"

// Where the circle x^2 + y^2 = 4 meets the hyperbola x y = 1. `solver` is one of solver_names().
nlmech::algebraic::Report meet(const char* solver, Eigen::VectorXd& x) {
  using namespace nlmech::algebraic;
  DenseEquations equations(
      2, [](const Eigen::VectorXd& p, Eigen::VectorXd& f) { f << p.squaredNorm() - 4, p[0] * p[1] - 1; },
      [](const Eigen::VectorXd& p, Eigen::MatrixXd& b) { b << 2 * p[0], 2 * p[1], p[1], p[0]; });
  return find_root(NamedSolver{.name = solver, .tolerance = 1e-12}, equations, x);
}
// [example]

namespace {

TEST(Example, Algebraic) {
  for (const char* solver : {"newton", "levenberg-marquardt", "scalar-homotopy", "dogleg"}) {
    Eigen::VectorXd x = Eigen::Vector2d(3, 1);
    const nlmech::algebraic::Report report = meet(solver, x);
    EXPECT_TRUE(report.status.ok()) << solver << ": " << report.status.text();
    // x = 2 cos 15 deg, y = 2 sin 15 deg. |F| <= 1e-12, and 1/|B^-1| = 0.9 there.
    const double angle = std::acos(-1.0) / 12;
    EXPECT_NEAR(x[0], 2 * std::cos(angle), 2e-12) << solver;
    EXPECT_NEAR(x[1], 2 * std::sin(angle), 2e-12) << solver;
  }
}

}  // namespace
