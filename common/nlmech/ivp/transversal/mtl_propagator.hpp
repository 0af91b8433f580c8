/// @file
/// The exact flow of x' = A x + E s^k + harmonic loads over a time, by one exponential of an augmented
/// matrix.
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <span>
#include <vector>

#include "nlmech/program/linear_terms.hpp"
#include "nlmech/support/status.hpp"

namespace nlmech::ivp {

/// Computes exp(A tau), tau^k phi_k(A tau) E for k = 1..q, and the response to harmonic loads over a time
/// tau, where phi_0 = exp and phi_k(z) = (phi_{k-1}(z) - 1/(k-1)!)/z. They are the upper blocks of
///
///     exp(tau [A E 0 .. 0 B; 0 0 I .. 0; ...; 0 .. 0; 0 .. 0 R]),
///
/// where the chain of unit matrices is nilpotent and R is a rotation [0 -w; w 0] for each frequency (C. Van
/// Loan, Computing integrals involving the matrix exponential, IEEE Trans. Autom. Control 23 (1978) 395-404;
/// J. Niesen and W. M. Wright, ACM Trans. Math. Softw. 38 (2012) 22). The recursion for phi_k through A^-1
/// would lose all digits for a small A tau, and A may be singular.
///
/// The matrix is balanced by powers of two, so that the norm of an oscillator of frequency w is w tau and not
/// w^2 tau. Then follow scaling, the Pade approximant of degree 13 and squaring (N. J. Higham, The scaling
/// and squaring method for the matrix exponential revisited, SIAM J. Matrix Anal. Appl. 26 (2005) 1179-1193).
/// For oscillators with w tau from 0 to 1e6 the error is at most 8 eps (1 + w tau) of the block's largest
/// entry; a part w tau eps is unavoidable, since w^2 is rounded.
class MtlPropagator {
 public:
  /// Allocates the workspace; compute() allocates nothing for up to 64 rows of the augmented matrix.
  /// @param size n, components of the state
  /// @param columns of E: n/2 for the lower half of a unit matrix, or n for all of it
  /// @param orders q, 1 or more
  /// @param load harmonics of components below n
  MtlPropagator(int size, int columns, int orders, std::span<const Harmonic> load);

  /// Fills the blocks for the matrix @p a, n by n, and the time @p tau of either sign.
  /// @return success; `non_finite` if the exponential overflows
  [[nodiscard]] Outcome compute(const Eigen::Ref<const Eigen::MatrixXd>& a, double tau);

  /// exp(A tau), n by n.
  [[nodiscard]] auto exponential() const { return result_.topLeftCorner(size_, size_); }
  /// tau^k phi_k(A tau) E, n by columns; k from 1 to q.
  [[nodiscard]] auto phi(int k) const {
    return result_.block(0, size_ + (k - 1) * columns_, size_, columns_);
  }
  /// State after tau from rest under the harmonics, as a matrix on phases(): n by phase_count().
  [[nodiscard]] auto response() const { return result_.topRightCorner(size_, phase_count()); }

  /// Number of phases: two for each frequency of the load.
  [[nodiscard]] Eigen::Index phase_count() const {
    return 2 * static_cast<Eigen::Index>(frequencies_.size());
  }
  /// cos(w t) and sin(w t) of each frequency at the start time t of the response.
  void phases(double t, Eigen::VectorXd& out) const;
  /// The load as an n by phase_count() matrix on phases().
  [[nodiscard]] const Eigen::MatrixXd& load() const { return load_; }
  /// Columns of E.
  [[nodiscard]] Eigen::Index columns() const { return columns_; }

 private:
  void assemble(const Eigen::Ref<const Eigen::MatrixXd>& a, double tau);
  void balance();
  void pade();

  Eigen::Index size_, columns_, orders_;
  std::vector<double> frequencies_;
  Eigen::MatrixXd load_, matrix_, result_, a2_, a4_, a6_, u_, v_, work_;
  Eigen::VectorXd scale_;
  Eigen::PartialPivLU<Eigen::MatrixXd> lu_;
};

}  // namespace nlmech::ivp
