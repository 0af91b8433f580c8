/// @file
/// Classical systems of n equations as texts, with standard starts and known roots.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace nlmech::chapters::homotopy {

/// A system of the test set.
struct TestSystem {
  std::string name;  ///< "rosenbrock"
  std::string text;  ///< equations with start values
  /// Known roots: closed forms, or tools/oracles/homotopy_systems.py with the first and last unknown alone;
  /// empty if no root exists or none is known in advance.
  std::vector<std::vector<double>> roots;
  bool is_complete = false;  ///< are these all roots?
  bool has_root = true;      ///< does a root exist?
};

/// The systems of J. J. More, B. S. Garbow and K. E. Hillstrom (ACM Trans. Math. Softw. 7 (1981) 17-41) that
/// have as many equations as unknowns, with their starts, where the number of unknowns is free for 10 of
/// them, chebyquad for 7, and for 8, where it has no root; Powell's (1970) example of a singular Jacobian;
/// and systems of public questions.
[[nodiscard]] std::vector<TestSystem> test_systems();

}  // namespace nlmech::chapters::homotopy
