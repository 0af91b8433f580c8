/// @file
/// The equations of one interval of collocation in time (Eq. 4.16) as a system F(x) = 0 for any solver, in
/// two forms, and Picard's iteration for them.
#pragma once

#include <utility>
#include <vector>

#include "nlmech/algebraic/equations.hpp"
#include "nlmech/collocation/basis.hpp"
#include "nlmech/ivp/system.hpp"

namespace nlmech::chapters::rbf_ivp {

/// Which F. Both have the same roots, and Newton's iteration takes the same steps on both.
enum class Form {
  printed,    ///< D x - g, as Eq. 4.16
  integrated  ///< x - (D_ss)^-1 (g - D_s1 x_1): the same times the inverse of the rows and columns 2..N of D
};

/// The states at nodes 2..N of an interval, ordered node by node, are the unknowns.
class CollocationEquations : public algebraic::Equations {
 public:
  /// @param system the problem
  /// @param basis trial functions
  /// @param form which F
  CollocationEquations(ivp::System system, const collocation::Basis& basis, Form form)
      : CollocationEquations(std::move(system), basis.nodes(), basis.derivative(), form) {}
  /// @param system the problem
  /// @param nodes on the unit interval, the first 0, the last 1
  /// @param derivative from values at the nodes to derivatives there
  /// @param form which F
  CollocationEquations(ivp::System system, const Eigen::VectorXd& nodes, const Eigen::MatrixXd& derivative,
                       Form form);

  /// From now on the interval from @p t0 to @p t0 + @p h, with the state @p x0 at its begin.
  void begin(double t0, double h, const ivp::State& x0);
  /// The constant state.
  [[nodiscard]] Eigen::VectorXd start() const;
  /// The state at the end of the interval.
  [[nodiscard]] ivp::State end(const Eigen::VectorXd& x) const { return x.tail(system_.size()); }
  /// Times of the nodes 2..N.
  [[nodiscard]] const std::vector<double>& times() const { return times_; }

  /// See Equations.
  [[nodiscard]] Eigen::Index size() const override { return states_.size(); }
  /// See Equations.
  void residual(const Eigen::VectorXd& x, Eigen::VectorXd& f) override;
  /// See Equations.
  void linearise(const Eigen::VectorXd& x) override;
  /// See Equations.
  void apply(const Eigen::VectorXd& v, Eigen::VectorXd& out) const override;
  /// See Equations.
  void apply_transposed(const Eigen::VectorXd& v, Eigen::VectorXd& out) const override;
  /// See Equations.
  void matrix(Eigen::MatrixXd& b) const override;

  /// One sweep of Picard's iteration: x = (D_ss)^-1 (g(x) - D_s1 x_1). @p x and @p next are different
  /// objects.
  void picard(const Eigen::VectorXd& x, Eigen::VectorXd& next);

 private:
  // Column k of a vector of unknowns is the state at node k + 2.
  [[nodiscard]] Eigen::Map<ivp::Nodes> as_states(Eigen::VectorXd& x) const {
    return {x.data(), states_.rows(), states_.cols()};
  }
  [[nodiscard]] Eigen::Map<const ivp::Nodes> as_states(const Eigen::VectorXd& x) const {
    return {x.data(), states_.rows(), states_.cols()};
  }
  [[nodiscard]] const ivp::Jacobian& slab(Eigen::Index k) const {
    return slabs_[static_cast<std::size_t>(k)];
  }
  void slopes(const Eigen::VectorXd& x);

  ivp::System system_;
  Form form_;
  Eigen::VectorXd nodes_;
  Eigen::MatrixXd derivative_, integral_;  // of the unit interval, rows and columns 2..N, and the inverse
  Eigen::VectorXd from_left_, constant_;  // D_s1; what a constant x_1 becomes at the nodes: 1 for polynomials
  double h_ = 1;
  ivp::State x0_, node_;
  std::vector<double> times_;
  ivp::Nodes states_;
  mutable ivp::Nodes slopes_;         // right-hand sides; room for products
  std::vector<ivp::Jacobian> slabs_;  // dg/dx at the nodes
};

}  // namespace nlmech::chapters::rbf_ivp
