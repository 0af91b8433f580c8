/// @file
/// Weights of multi-step transversal linearisation: effect of the nonlinear terms at the points on all
/// states.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "nlmech/ivp/transversal/mtl_propagator.hpp"

namespace nlmech::ivp {

/// Basis functions phi_k with phi_k(t_i) = delta_ki that interpolate the nonlinear terms (Roy, Eq. 3). Their
/// sum must be one everywhere; the printed condition, an integral of one, is wrong.
enum class MtlBasis {
  lagrange,    ///< Lagrange polynomials through all points, degree p: order p + 1 (odd p), p + 2 (even p)
  interpolet,  ///< the simplest interpolet of Saito and Beylkin: the autocorrelation of Haar's scaling
               ///< function, the hat function on |x| < 1. Piecewise linear: order 2 for every p
  daf          ///< distributed approximating functionals of Lagrange's kind: Lagrange polynomials times
               ///< exp(-(t - t_k)^2/(2 sigma^2)). Their sum differs from one by O((h/sigma)^(p+1)): the order
               ///< of lagrange if sigma is fixed in time, no convergence if it is a multiple of h
};

/// Order of convergence of the method with p points beyond the first; of daf for sigma fixed in time.
[[nodiscard]] int mtl_order(MtlBasis basis, int points);

/// Entry j: on the interval from point j to point j + 1, phi_k at the fraction s of it is sum over m of
/// (k, m) s^m. p matrices of p + 1 rows. Those of daf are Taylor polynomials, to 1e-14.
/// @param points p, from 1 to 8
/// @param width sigma/h of daf, 2 or more
[[nodiscard]] std::vector<Eigen::MatrixXd> mtl_pieces(MtlBasis basis, int points, double width = 3);

/// For x' = A x + E sum over k of g_k phi_k(t) + load: the solution at the points l = 1..p is
///
///     x_l = exp(A l h) x_0 + r_l + sum over k of W_lk g_k,
///     W_lk = integral over (0, l h) of exp(A (l h - s)) E phi_k(s) ds  (Roy, Eqs 4 and 5).
///
/// On every interval phi_k is a polynomial sum_m c_m (s/h)^m, whose integral is sum_m c_m m! h^(m+1)
/// phi_{m+1}(A h) E; exp(A h) propagates it to the following intervals.
class MtlWeights {
 public:
  /// Allocates the workspace; other members allocate nothing.
  /// @param columns as for MtlPropagator @param width as for mtl_pieces()
  MtlWeights(int size, int columns, MtlBasis basis, int points, std::span<const Harmonic> load,
             double width = 3);

  /// Computes the weights for points of spacing @p h of either sign. @return success; `non_finite` if a
  /// weight overflows
  [[nodiscard]] Outcome compute(const Eigen::Ref<const Eigen::MatrixXd>& a, double h);

  /// W_lk, n by columns; l from 1 to p, k from 0 to p.
  [[nodiscard]] auto weight(Eigen::Index l, Eigen::Index k) const {
    const Eigen::Index n = flow_.exponential().rows(), m = flow_.columns();
    return weights_.block((l - 1) * n, k * m, n, m);
  }
  /// The flow over h.
  [[nodiscard]] const MtlPropagator& flow() const { return flow_; }

  /// States without nonlinear terms: column l is exp(A l h) x0 + r_l, for l = 0 to p.
  /// @param phases column l: MtlPropagator::phases() at point l
  void free_motion(const Eigen::Ref<const Eigen::VectorXd>& x0, const Eigen::MatrixXd& phases,
                   Eigen::MatrixXd& out) const;

  /// Prepares between() for the time @p tau after a point. @return as compute()
  [[nodiscard]] Outcome prepare_between(const Eigen::Ref<const Eigen::MatrixXd>& a, double tau);
  /// The linearised solution (Roy, Eq. 4) tau after point @p j.
  /// @param g nonlinear terms at the points, one point per column
  /// @param xj state at point j
  /// @param phase MtlPropagator::phases() at point j
  /// @param out state
  void between(Eigen::Index j, const Eigen::MatrixXd& g, const Eigen::Ref<const Eigen::VectorXd>& xj,
               const Eigen::Ref<const Eigen::VectorXd>& phase, Eigen::Ref<Eigen::VectorXd> out);
  /// The interpolated nonlinear terms (Roy, Eq. 3) at the same time; @p out has as many rows as @p g.
  void interpolate(Eigen::Index j, const Eigen::MatrixXd& g, Eigen::Ref<Eigen::VectorXd> out) const;

 private:
  std::vector<Eigen::MatrixXd> pieces_;
  MtlPropagator flow_, partial_;
  Eigen::MatrixXd weights_, part_;
  Eigen::VectorXd coefficient_;
  double h_ = 0, tau_ = 0;
};

}  // namespace nlmech::ivp
