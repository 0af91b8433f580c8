/// @file
/// All solvers of this component by name, under one tolerance and one limit.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "nlmech/algebraic/equations.hpp"

namespace nlmech::algebraic {

/// A solver with its usual options, named as on a command line: one of solver_names().
///
/// Success means that |F|, evaluated once more at the x that is handed back, is at most tolerance times
/// scale, whatever the solver's own criterion. Rounding of x in its last digits changes F; where that alone
/// exceeds the tolerance no solver can meet it, as with structures of very many elements, whose forces are
/// differences of forces that grow like EI/l^3. Then the sentence names that floor, or, with `to_rounding`,
/// the floor is what |F| is held to.
///
/// Tests hold every solver of the list to the roots of classical systems, to the tolerance times |B^-1|
/// (1e-10 to 1e-9; 1e-3 where B is singular), or to a status that names it: for no root, singular matrices,
/// values that are not finite, and used-up limits. Random systems with known roots hold every success to its
/// residual in extended precision.
struct NamedSolver {
  std::string name;                  ///< "newton", "levenberg-marquardt", ...
  double tolerance = 1e-10;          ///< done when |F|, Euclidean, is at most this part of `scale`; positive
  double scale = 1;                  ///< what |F| is compared with, as the length of a load; positive
  std::int64_t iterations = 10'000;  ///< at most so many accepted and rejected steps; at least 1
  /// Is |F| at 4 times what changes of x by a unit in the last place make of it, measured, good enough too,
  /// up to `scale`? Such an end is counted as a fallback.
  bool to_rounding = false;
};

/// The names, in the order of the dissertation and then of the library.
[[nodiscard]] std::vector<std::string_view> solver_names();

/// Holds a solver's report to |F| at @p x, as NamedSolver says: a success above the tolerance becomes
/// `not_converged`, with `to_rounding` a failure at the level of rounding becomes a success. `wrong_branch`,
/// if the equations say so of x. Sets `last` and `bound`; the evaluations are not counted.
[[nodiscard]] Report held_to_tolerance(const NamedSolver& method, Equations& equations,
                                       const Eigen::VectorXd& x, Report report);

/// Solves by name. `scalar-homotopy` is Eq. 2.11, `fixed-point` 2.15 and `newton-homotopy` 2.16 with Euler's
/// rule of step 1; all else is as the solver's own header says. `energy-trust-region` needs a Potential; it
/// and the paths `riks`, `crisfield` and `gdc` end at rounding and are then held to the tolerance, and a
/// path's start is taken for the structure at rest.
/// @return as the solver's own find_root(), and held_to_tolerance()
/// @throws std::invalid_argument for an unknown name, with all names in the text, for options out of range,
/// or if x has another size than the equations; std::logic_error if the equations do not offer what the
/// solver needs
[[nodiscard]] Report find_root(const NamedSolver& method, Equations& equations, Eigen::VectorXd& x,
                               const Observer& observer = {});

}  // namespace nlmech::algebraic
