/// @file
/// Powell's hybrid method of GSL as a peer; optional.
#pragma once

#include <cstdint>

#include "nlmech/algebraic/equations.hpp"

namespace nlmech::peers {

/// gsl_multiroot_fdfsolver_hybridsj of the GNU Scientific Library, a translation of MINPACK's HYBRJ: dogleg
/// steps in a scaled trust region, Broyden's updates of the exact Jacobian.
struct GslHybrid {
  double tolerance = 1e-10;        ///< converged when |F|, Euclidean, is at most this; positive
  std::int64_t iterations = 1000;  ///< limit of the number of iterations; at least 1
};

/// Does this build have GSL?
[[nodiscard]] bool gsl_hybrid_available() noexcept;

/// Solves by GSL. Outcomes besides success: `not_converged` if the iteration makes no progress; `non_finite`;
/// `step_limit`.
/// @throws std::logic_error if the build has no GSL or the equations have no matrix
/// @throws std::invalid_argument if an option is out of range or x has another size than the equations
[[nodiscard]] algebraic::Report find_root(const GslHybrid& method, algebraic::Equations& equations,
                                          Eigen::VectorXd& x);

}  // namespace nlmech::peers
