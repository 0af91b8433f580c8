/// @file
/// One interval of a collocation method for boundary value problems, as matrices on [0, 1].
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string_view>

#include "nlmech/support/status.hpp"

namespace nlmech::bvp {

/// Trial functions and nodes on an interval.
enum class Family : std::uint8_t {
  lobatto,         ///< polynomials whose slope is collocated at LGL nodes (Lobatto IIIA); order 2N - 2 at the
                   ///< ends of intervals. The default
  radau,           ///< polynomials at the left end and Radau nodes (Radau IIA); order 2N - 3, damps
  lobatto_values,  ///< polynomials through the values at LGL nodes, D of the dissertation in its flat limit;
                   ///< the equations at the left end left out
  gaussian,        ///< Gaussians at LGL nodes, D = Phi' Phi^-1 by the factors of Phi (Eq. 5.15)
  stable_gaussian,  ///< the same functions, D to all digits (StableGaussian)
};

/// As on a command line: "stable-gaussian".
[[nodiscard]] std::string_view to_string(Family family);

/// N nodes on [0, 1], both ends among them, and N - 1 equations
///     sum_j value_ij x_j = h sum_j slope_ij f(t_j, x_j),      i = 1..N-1,
/// which with the value at the left end determine the others. For families given by D they are the rows of
/// D x = f but the first, so that an interval is solved from its left end.
struct Scheme {
  Family family = Family::lobatto;  ///< which
  Eigen::VectorXd nodes;            ///< ascending from 0 to 1
  Eigen::MatrixXd value;            ///< N - 1 by N
  Eigen::MatrixXd slope;            ///< N - 1 by N
  Eigen::RowVectorXd weights;       ///< of the quadrature over [0, 1] with values at the nodes
  int order = 0;           ///< q of the residual between nodes, O(h^q); for Gaussians that of the flat limit
  int end_order = 0;       ///< of the values at the ends of intervals; for Gaussians that of the flat limit
  Eigen::VectorXd probes;  ///< where the residual is measured, between the nodes
  Eigen::MatrixXd probe_value;      ///< u(probes) = probe_value X + h probe_slope F
  Eigen::MatrixXd probe_slope;      ///< see probe_value
  Eigen::MatrixXd probe_value_dot;  ///< u'(probes) = probe_value_dot X/h + probe_slope_dot F
  Eigen::MatrixXd probe_slope_dot;  ///< see probe_value_dot
  Eigen::VectorXd interpolated;     ///< where slopes (lobatto, radau) or values are interpolated
  Eigen::VectorXd barycentric;      ///< weights of the polynomial through these
  Eigen::VectorXd gauss;            ///< nodes on [0, 1] of the Gauss rule that integrates it exactly
  Eigen::VectorXd gauss_weights;    ///< of that rule

  /// Rows of the interpolant: u(t_0 + tau h) = of_value X + h of_slope F for values X and slopes F at nodes.
  /// lobatto, radau: the collocation polynomial itself; else the polynomial through the values.
  /// @param tau in [0, 1]
  void row(double tau, Eigen::RowVectorXd& of_value, Eigen::RowVectorXd& of_slope) const;
  /// The same for the derivative: u' = of_value X/h + of_slope F.
  void row_dot(double tau, Eigen::RowVectorXd& of_value, Eigen::RowVectorXd& of_slope) const;
};

/// A scheme, or why there is none.
struct SchemeOrStatus {
  Scheme scheme;  ///< set if status is success
  Status status;  ///< singular_matrix, non_finite or outside_validity: the Gaussians cannot be inverted
};

/// @param family which
/// @param nodes N, both ends included: 2 to 200 (radau, lobatto: 3 to 200)
/// @param relative_shape c h of Gaussians, > 0 (Eq. 5.11); the others take no notice
/// @param keep_ill_conditioned take a D of Gaussians that is finite although its status is a failure, as the
/// printed method does
/// @throws std::invalid_argument for numbers out of range
[[nodiscard]] SchemeOrStatus make_scheme(Family family, int nodes, double relative_shape,
                                         bool keep_ill_conditioned = false);

}  // namespace nlmech::bvp
