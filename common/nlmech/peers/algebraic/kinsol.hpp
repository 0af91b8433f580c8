/// @file
/// KINSOL of SUNDIALS as a peer; optional.
#pragma once

#include <cstdint>
#include <string_view>

#include "nlmech/algebraic/equations.hpp"

namespace nlmech::peers {

/// KINSOL (A. C. Hindmarsh and others, SUNDIALS, ACM Trans. Math. Softw. 31 (2005) 363-396): Newton's method
/// with the exact Jacobian, a dense factorisation at every iteration, and no bound on the step.
struct Kinsol {
  /// Globalisation strategies.
  enum class Strategy : std::uint8_t {
    none,        ///< KIN_NONE: Newton's full step
    line_search  ///< KIN_LINESEARCH: step shortened until |F|^2 decreases enough (Goldstein and Armijo)
  };
  Strategy strategy = Strategy::line_search;  ///< strategy
  /// Converged if max |F_i| is at most this (KINSOL's own measure); positive.
  double tolerance = 1e-10;
  /// Least step relative to x; positive. KINSOL's default is 3.7e-11.
  double step_tolerance = 1e-15;
  std::int64_t iterations = 200;  ///< limit of the number of iterations; at least 1

  /// "kinsol" with a line search, else "kinsol-none".
  [[nodiscard]] std::string_view name() const {
    return strategy == Strategy::none ? "kinsol-none" : "kinsol";
  }
};

/// Does this build have KINSOL?
[[nodiscard]] bool kinsol_available() noexcept;

/// Solves by KINSOL. The observer and `first`, `least` and `last` include every evaluation of F, also at
/// trial points. Outcomes besides success: `not_converged` if the line search or the steps end above the
/// tolerance, as at a minimum of |F| that is no root; `singular_matrix`; `non_finite`; `step_limit`;
/// `interrupted`.
/// @throws std::logic_error if the build has no KINSOL or the equations have no matrix
/// @throws std::invalid_argument if an option is out of range or x has another size than the equations
[[nodiscard]] algebraic::Report find_root(const Kinsol& method, algebraic::Equations& equations,
                                          Eigen::VectorXd& x, const algebraic::Observer& observer = {});

}  // namespace nlmech::peers
