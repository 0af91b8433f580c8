/// @file
/// KINSOL of SUNDIALS behind our interface, if this build has it.
#pragma once

#include <cstdint>
#include <string_view>

#include "nlmech/algebraic/equations.hpp"

namespace nlmech::peers {

/// KINSOL (A. C. Hindmarsh and others, SUNDIALS, ACM Trans. Math. Softw. 31 (2005) 363-396): Newton's method
/// with the exact derivative, dense and factorised anew at every iteration, and no bound on the step's
/// length.
struct Kinsol {
  /// How a step is taken.
  enum class Strategy : std::uint8_t {
    none,        ///< KIN_NONE: Newton's full step
    line_search  ///< KIN_LINESEARCH: shortened until |F|^2 falls enough, by Goldstein and Armijo
  };
  Strategy strategy = Strategy::line_search;  ///< which
  /// Done when max |F_i| is no greater (KINSOL's own measure); positive.
  double tolerance = 1e-10;
  /// Ends where steps are shorter, relative to x; positive. KINSOL's own default is 3.7e-11.
  double step_tolerance = 1e-15;
  std::int64_t iterations = 200;  ///< at most so many; at least 1

  /// "kinsol" with a line search, else "kinsol-none".
  [[nodiscard]] std::string_view name() const {
    return strategy == Strategy::none ? "kinsol-none" : "kinsol";
  }
};

/// Was the library found when this program was built?
[[nodiscard]] bool kinsol_available() noexcept;

/// Solves by KINSOL. The observer sees every evaluation of F, trial points too, and so do `first`, `least`
/// and `last`. Outcomes besides success: `not_converged` where the line search or the steps end above the
/// tolerance, as in a minimum of |F| that is no root; `singular_matrix`; `non_finite`; `step_limit`;
/// `interrupted`.
/// @throws std::logic_error if the build has no KINSOL or the equations have no matrix
/// @throws std::invalid_argument if an option is out of range or x has another size than the equations
[[nodiscard]] algebraic::Report find_root(const Kinsol& method, algebraic::Equations& equations,
                                          Eigen::VectorXd& x, const algebraic::Observer& observer = {});

}  // namespace nlmech::peers
