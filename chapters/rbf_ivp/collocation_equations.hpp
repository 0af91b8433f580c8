/// @file
/// The equations of one interval of collocation in time (Eq. 4.16) as a system F(x) = 0 for any solver, in
/// two forms, and Picard's iteration for them.
#pragma once

#include <Eigen/LU>
#include <utility>
#include <vector>

#include "nlmech/algebraic/equations.hpp"
#include "nlmech/collocation/basis.hpp"
#include "nlmech/ivp/system.hpp"

namespace nlmech::chapters {

/// Which F. Both have the same roots, and Newton's iteration takes the same steps on both.
enum class Form {
  printed,    ///< D x - g, as Eq. 4.16
  integrated  ///< x - (D_ss)^-1 (g - D_s1 x_1): the same times the inverse of the rows and columns 2..N of D
};

/// The states at nodes 2..N of an interval, ordered node by node, are the unknowns.
template <int n>
class CollocationEquations : public algebraic::Equations {
 public:
  /// @param system the problem
  /// @param basis trial functions
  /// @param form which F
  CollocationEquations(ivp::System<n> system, const collocation::Basis& basis, Form form)
      : CollocationEquations(std::move(system), basis.nodes(), basis.derivative(), form) {}
  /// @param system the problem
  /// @param nodes on the unit interval, the first 0, the last 1
  /// @param derivative from values at the nodes to derivatives there
  /// @param form which F
  CollocationEquations(ivp::System<n> system, const Eigen::VectorXd& nodes, const Eigen::MatrixXd& derivative,
                       Form form)
      : system_(std::move(system)), form_(form), nodes_(nodes) {
    const Eigen::Index s = nodes_.size() - 1;
    derivative_ = derivative.bottomRightCorner(s, s);
    integral_ = derivative_.inverse();
    from_left_ = derivative.col(0).tail(s);
    constant_ = -integral_ * from_left_;
    times_.resize(static_cast<std::size_t>(s));
    states_.resize(system_.size(), s);
    slopes_.resize(system_.size(), s);
    slabs_.assign(times_.size(), ivp::Jacobian<n>::Zero(system_.size(), system_.size()));
    begin(0, 1, ivp::State<n>::Zero(system_.size()));
  }

  /// From now on the interval from @p t0 to @p t0 + @p h, with the state @p x0 at its begin.
  void begin(double t0, double h, const ivp::State<n>& x0) {
    h_ = h;
    x0_ = x0;
    for (std::size_t k = 0; k < times_.size(); ++k)
      times_[k] = t0 + h * nodes_[static_cast<Eigen::Index>(k) + 1];
    times_.back() = t0 + h;
  }
  /// The constant state.
  [[nodiscard]] Eigen::VectorXd start() const {
    Eigen::VectorXd x(size());
    as_states(x).colwise() = x0_;
    return x;
  }
  /// The state at the end of the interval.
  [[nodiscard]] ivp::State<n> end(const Eigen::VectorXd& x) const { return x.tail(system_.size()); }
  /// Times of the nodes 2..N.
  [[nodiscard]] const std::vector<double>& times() const { return times_; }

  /// See Equations.
  [[nodiscard]] Eigen::Index size() const override { return states_.size(); }

  /// See Equations.
  void residual(const Eigen::VectorXd& x, Eigen::VectorXd& f) override {
    slopes(x);
    auto out = as_states(f);
    if (form_ == Form::printed) {
      out.noalias() = as_states(x) * derivative_.transpose();
      out.noalias() += x0_ * from_left_.transpose();
      out = out / h_ - slopes_;
    } else {
      out.noalias() = slopes_ * integral_.transpose();
      out = as_states(x) - x0_ * constant_.transpose() - h_ * out;
    }
  }

  /// One sweep of Picard's iteration: x = (D_ss)^-1 (g(x) - D_s1 x_1). @p x and @p next are different
  /// objects.
  void picard(const Eigen::VectorXd& x, Eigen::VectorXd& next) {
    slopes(x);
    auto out = as_states(next);
    out.noalias() = (h_ * slopes_) * integral_.transpose();
    out.noalias() += x0_ * constant_.transpose();
  }

  /// See Equations.
  void linearise(const Eigen::VectorXd& x) override {
    const auto states = as_states(x);
    for (std::size_t k = 0; k < times_.size(); ++k) {
      node_ = states.col(static_cast<Eigen::Index>(k));
      system_.jacobian(times_[k], node_, slabs_[k]);
    }
  }
  /// See Equations.
  void apply(const Eigen::VectorXd& v, Eigen::VectorXd& out) const override {
    const auto in = as_states(v);
    auto result = as_states(out);
    for (Eigen::Index k = 0; k < in.cols(); ++k) slopes_.col(k).noalias() = slab(k) * in.col(k);
    if (form_ == Form::printed) {
      result.noalias() = in * derivative_.transpose();
      result = result / h_ - slopes_;
    } else {
      result.noalias() = slopes_ * integral_.transpose();
      result = in - h_ * result;
    }
  }
  /// See Equations.
  void apply_transposed(const Eigen::VectorXd& v, Eigen::VectorXd& out) const override {
    const auto in = as_states(v);
    auto result = as_states(out);
    if (form_ == Form::printed) {
      result.noalias() = in * derivative_ / h_;
      for (Eigen::Index k = 0; k < in.cols(); ++k) result.col(k).noalias() -= slab(k).transpose() * in.col(k);
    } else {
      slopes_.noalias() = h_ * (in * integral_);
      result = in;
      for (Eigen::Index k = 0; k < in.cols(); ++k)
        result.col(k).noalias() -= slab(k).transpose() * slopes_.col(k);
    }
  }
  /// See Equations.
  void matrix(Eigen::MatrixXd& b) const override {
    const Eigen::Index m = system_.size(), s = states_.cols();
    b.setZero(m * s, m * s);
    for (Eigen::Index row = 0; row < s; ++row) {
      for (Eigen::Index column = 0; column < s; ++column) {
        auto block = b.block(row * m, column * m, m, m);
        if (form_ == Form::printed) {
          block.diagonal().setConstant(derivative_(row, column) / h_);
        } else {
          block = -h_ * integral_(row, column) * slab(column);
        }
        if (row != column) continue;
        if (form_ == Form::printed) {
          block -= slab(row);
        } else {
          block.diagonal().array() += 1;
        }
      }
    }
  }

 private:
  // Column k of a vector of unknowns is the state at node k + 2.
  [[nodiscard]] Eigen::Map<ivp::Nodes<n>> as_states(Eigen::VectorXd& x) const {
    return {x.data(), states_.rows(), states_.cols()};
  }
  [[nodiscard]] Eigen::Map<const ivp::Nodes<n>> as_states(const Eigen::VectorXd& x) const {
    return {x.data(), states_.rows(), states_.cols()};
  }
  [[nodiscard]] const ivp::Jacobian<n>& slab(Eigen::Index k) const {
    return slabs_[static_cast<std::size_t>(k)];
  }
  void slopes(const Eigen::VectorXd& x) {
    states_ = as_states(x);
    system_.rhs(times_, states_, slopes_);
  }

  ivp::System<n> system_;
  Form form_;
  Eigen::VectorXd nodes_;
  Eigen::MatrixXd derivative_, integral_;  // of the unit interval, rows and columns 2..N, and the inverse
  Eigen::VectorXd from_left_, constant_;  // D_s1; what a constant x_1 becomes at the nodes: 1 for polynomials
  double h_ = 1;
  ivp::State<n> x0_, node_;
  std::vector<double> times_;
  ivp::Nodes<n> states_;
  mutable ivp::Nodes<n> slopes_;         // right-hand sides; room for products
  std::vector<ivp::Jacobian<n>> slabs_;  // dg/dx at the nodes
};

}  // namespace nlmech::chapters
