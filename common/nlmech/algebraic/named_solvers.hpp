/// @file
/// Registry of the algebraic solvers: selection by name, with a common tolerance and iteration limit.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "nlmech/algebraic/equations.hpp"

namespace nlmech::algebraic {

/// A solver with its default options, selected by a name of solver_names().
///
/// Success means that |F|, evaluated again at the returned x, is at most tolerance times scale, whatever the
/// solver's own criterion. Rounding of x in its last digits changes F. No solver can meet a tolerance below
/// that change; structures of very many elements, whose forces are differences of forces that grow like
/// EI/l^3, are an example. The message then gives this rounding level. With `to_rounding` the level replaces
/// the tolerance.
///
/// Tests compare every solver with the roots of classical systems, within the tolerance times |B^-1| (1e-10
/// to 1e-9; 1e-3 where B is singular), and require the matching failure status for systems without a root,
/// singular matrices, values that are not finite and exceeded limits. On random systems with known roots the
/// residual of every success is checked in extended precision.
struct NamedSolver {
  std::string name;          ///< "newton", "levenberg-marquardt", ...
  double tolerance = 1e-10;  ///< converged when |F|, Euclidean, is at most tolerance times scale; positive
  double scale = 1;          ///< reference size of |F|, such as the norm of the load; positive
  std::int64_t iterations = 10'000;  ///< limit of accepted plus rejected steps; at least 1
  /// Also accept |F| up to 4 times its measured change under perturbations of x by one unit in the last
  /// place, if that is at most `scale`? Each such end counts as a fallback.
  bool to_rounding = false;
};

/// Solver names: first those of the dissertation in its order, then those of the library.
[[nodiscard]] std::vector<std::string_view> solver_names();

/// Checks a solver's report against |F| at @p x. A success above the tolerance becomes `not_converged`. With
/// `to_rounding` a failure at the rounding level becomes a success. A success for which the equations report
/// `wrong_branch` at x becomes that failure. Sets `last` and `bound`; does not count its evaluations of F.
[[nodiscard]] Report checked_against_tolerance(const NamedSolver& method, Equations& equations,
                                               const Eigen::VectorXd& x, Report report);

/// Solves by name. `scalar-homotopy` is Eq. 2.11, `fixed-point` 2.15 and `newton-homotopy` 2.16 with Euler's
/// method of step size 1; the other solvers are documented in their headers. `energy-trust-region` needs a
/// Potential. It and the path methods `riks`, `crisfield` and `gdc` iterate to rounding; the tolerance is
/// checked afterwards. A path method takes its start for the structure at rest.
/// @return the outcomes of the solver's own find_root() and of checked_against_tolerance()
/// @throws std::invalid_argument for an unknown name, with all names in the text, for options out of range,
/// or if x has another size than the equations; std::logic_error if the equations do not offer what the
/// solver needs
[[nodiscard]] Report find_root(const NamedSolver& method, Equations& equations, Eigen::VectorXd& x,
                               const Observer& observer = {});

}  // namespace nlmech::algebraic
