/// @file
/// Interpolating bases for multi-step transversal linearisation, as polynomials between neighbouring points.
#pragma once

#include <Eigen/Core>
#include <string_view>
#include <vector>

namespace nlmech::ivp {

/// The functions phi_k with phi_k(t_i) = delta_ki that stand for the nonlinear terms (Roy, Eq. 3). What they
/// need beside is a sum of one everywhere; the printed condition, an integral of one, is not it.
enum class MtlBasis {
  lagrange,   ///< Lagrange polynomials through all points, degree p: order p + 1 (odd p), p + 2 (even p)
  interpolet  ///< the simplest of Saito and Beylkin's: the autocorrelation of Haar's scaling function, which
              ///< is the hat |x| < 1. Straight lines between points: order 2 for every p
};

/// "lagrange", "interpolet".
[[nodiscard]] std::string_view to_string(MtlBasis basis);

/// Order of convergence of the method with p points beyond the first.
[[nodiscard]] int mtl_order(MtlBasis basis, int points);

/// Entry j: on the interval from point j to point j + 1, phi_k at the fraction s of it is sum over m of
/// (k, m) s^m. p matrices of p + 1 rows.
/// @param points p, 1 or more
[[nodiscard]] std::vector<Eigen::MatrixXd> mtl_pieces(MtlBasis basis, int points);

}  // namespace nlmech::ivp
