/// @file
/// Is a point a root? Proof by interval arithmetic, multiplicity of singular roots, minima of |F|.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>

#include "nlmech/algebraic/typed/typed_system.hpp"

namespace nlmech::algebraic {

/// What is known of the root near a point.
struct CheckedRoot {
  /// How much is known.
  enum class Kind {
    none,      ///< no root: Newton's iteration does not converge, or F is not 0 near its end
    proved,    ///< a root, and only one, lies within `bound` of x (Krawczyk's test)
    singular,  ///< F vanishes to rounding where dF/dx is singular: a perturbation may remove the root
    unproved   ///< F vanishes to rounding, but has a kink or jump at x, or the matrix is too ill-conditioned
  };
  Kind kind = Kind::none;  ///< how much is known
  Eigen::VectorXd x;       ///< the root, or the last iterate
  /// Bound of |x - root| by component: proved, else estimated.
  Eigen::VectorXd bound;
  /// max |F_i| over the change of F_i when every unknown changes by its typical size.
  double residual = 0;
  /// Of dF/dx with unknowns in their typical sizes and rows divided by the latter change; 2-norm.
  double condition = 0;
  Eigen::Index defect = 0;  ///< rank that dF/dx loses, at a singular root
  int order = 1;            ///< Newton's error falls by 1 - 1/order an iteration; 1: a regular root
  bool is_isolated = true;  ///< false at a singular root through which a curve of roots passes
  std::string reason;       ///< why it is none

  /// Largest bound in units of the typical sizes.
  [[nodiscard]] double error(const Eigen::VectorXd& typical) const {
    return bound.cwiseQuotient(typical).maxCoeff();
  }
};

/// "none", "proved", "singular", "unproved".
[[nodiscard]] std::string_view to_string(CheckedRoot::Kind kind) noexcept;

/// Improves @p x by Newton's iteration, with longer steps at singular roots, and checks whether the end is a
/// root. No absolute tolerance: a root of x^2 = 1e-20 is one, the minimum of x^2 + 1e-20 is none.
///
/// A singular root counts if an enclosure of F within 4 eps of its end, relative to x or to @p typical,
/// contains 0; such a root may be removed by a change of the equations in their last digits.
/// @param typical typical sizes of the unknowns, positive: of start and iterates. A root beyond
/// them is its own measure.
[[nodiscard]] CheckedRoot check_root(const TypedSystem& system, const Eigen::VectorXd& x,
                                     const Eigen::VectorXd& typical);

/// Is @p x a stationary point of |F| that is no root? Scaled as in CheckedRoot, the gradient of |F| is at
/// most 1e-5, and against it |F| falls by less than a hundredth within a hundredth of @p typical.
[[nodiscard]] bool is_stationary(const TypedSystem& system, const Eigen::VectorXd& x,
                                 const Eigen::VectorXd& typical);

/// Krawczyk's operator m - C F(m) + (1 - C dF/dx(box)) (box - m), where m is the middle of @p box and C the
/// inverse of the matrix in the middle.
/// @param j enclosure of dF/dx over the box, in which F is smooth
/// @return holds every root in the box; if it is inside the box, exactly one. Empty if it is not finite
[[nodiscard]] std::optional<Box> krawczyk(const TypedSystem& system, const Box& box, const Box& j);

/// Is @p inner in the interior of @p outer?
[[nodiscard]] bool is_inside(const Box& inner, const Box& outer);

}  // namespace nlmech::algebraic
