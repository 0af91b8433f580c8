/// Classical systems: every success of every solver is a root.
#include <gtest/gtest.h>

#include <cmath>

#include "chapters/homotopy/commands/commands_typed.hpp"
#include "chapters/homotopy/solvers/test_systems.hpp"

namespace nlmech::chapters::homotopy {
namespace {

using algebraic::TypedSolution;
using algebraic::TypedSystem;

/// Distance from the nearest known root, over 1 + |x|; of some roots the first and the last unknown are
/// known.
double distance(const TestSystem& test, const Eigen::VectorXd& x) {
  double least = HUGE_VAL;
  for (const std::vector<double>& root : test.roots) {
    double off = 0;
    for (std::size_t i = 0; i < root.size(); ++i) {
      const Eigen::Index at =
          static_cast<Eigen::Index>(i) + (i > 0 && i + 1 == root.size() ? x.size() - std::ssize(root) : 0);
      off = std::max(off, std::abs(x[at] - root[i]));
    }
    least = std::min(least, off / (1 + x.cwiseAbs().maxCoeff()));
  }
  return least;
}

TEST(TestSystems, TheDefaultFindsAKnownRootOfEachOrSaysWhyNone) {
  for (const TestSystem& test : test_systems()) {
    const TypedSystem system(program::SourceText(test.name, test.text));
    int tried = 0;
    const TypedSolution found = solve_by_several(system, system.start("--start", ""), 1e-10, 300, tried);
    EXPECT_EQ(found.status.ok(), test.has_root) << test.name << ": " << found.status.text();
    if (!test.has_root) {
      EXPECT_NE(found.status.sentence().find("minimum that is no root"), std::string::npos)
          << found.status.text();
      continue;
    }
    if (test.name == "himmelblau" || test.name == "trigonometric" || test.name == "brown-almost-linear")
      EXPECT_EQ(found.root.kind, algebraic::CheckedRoot::Kind::proved) << test.name;  // they have other roots
    else
      EXPECT_LE(distance(test, found.root.x), 1e-10) << test.name << " by " << found.solver;
  }
}

TEST(TestSystems, NoSolverEndsWithAPointThatIsNoRoot) {
  for (const TestSystem& test : test_systems()) {
    const TypedSystem system(program::SourceText(test.name, test.text));
    const Eigen::VectorXd start = system.start("--start", "");
    for (const algebraic::TypedSolver& solver : solvers_of(system)) {
      const TypedSolution found = solve_by(solver, system, start, 1e-10, 200);
      if (!found.status.ok()) continue;
      EXPECT_TRUE(test.has_root) << test.name << " by " << solver.name;
      if (!test.is_complete) continue;
      EXPECT_LE(distance(test, found.root.x), 1e-9) << test.name << " by " << solver.name;
    }
  }
}

}  // namespace
}  // namespace nlmech::chapters::homotopy
