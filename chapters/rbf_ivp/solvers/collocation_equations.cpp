#include "chapters/rbf_ivp/solvers/collocation_equations.hpp"

#include <Eigen/LU>
#include <utility>

namespace nlmech::chapters::rbf_ivp {

CollocationEquations::CollocationEquations(ivp::System system, const Eigen::VectorXd& nodes,
                                           const Eigen::MatrixXd& derivative, Form form)
    : system_(std::move(system)), form_(form), nodes_(nodes) {
  const Eigen::Index s = nodes_.size() - 1;
  derivative_ = derivative.bottomRightCorner(s, s);
  integral_ = derivative_.inverse();
  from_left_ = derivative.col(0).tail(s);
  constant_ = -integral_ * from_left_;
  times_.resize(static_cast<std::size_t>(s));
  states_.resize(system_.size(), s);
  slopes_.resize(system_.size(), s);
  slabs_.assign(times_.size(), ivp::Jacobian::Zero(system_.size(), system_.size()));
  begin(0, 1, ivp::State::Zero(system_.size()));
}

void CollocationEquations::begin(double t0, double h, const ivp::State& x0) {
  h_ = h;
  x0_ = x0;
  for (std::size_t k = 0; k < times_.size(); ++k)
    times_[k] = t0 + h * nodes_[static_cast<Eigen::Index>(k) + 1];
  times_.back() = t0 + h;
}

Eigen::VectorXd CollocationEquations::start() const {
  Eigen::VectorXd x(size());
  as_states(x).colwise() = x0_;
  return x;
}

void CollocationEquations::residual(const Eigen::VectorXd& x, Eigen::VectorXd& f) {
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

void CollocationEquations::picard(const Eigen::VectorXd& x, Eigen::VectorXd& next) {
  slopes(x);
  auto out = as_states(next);
  out.noalias() = (h_ * slopes_) * integral_.transpose();
  out.noalias() += x0_ * constant_.transpose();
}

void CollocationEquations::linearise(const Eigen::VectorXd& x) {
  const auto states = as_states(x);
  for (std::size_t k = 0; k < times_.size(); ++k) {
    node_ = states.col(static_cast<Eigen::Index>(k));
    system_.jacobian(times_[k], node_, slabs_[k]);
  }
}

void CollocationEquations::apply(const Eigen::VectorXd& v, Eigen::VectorXd& out) const {
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

void CollocationEquations::apply_transposed(const Eigen::VectorXd& v, Eigen::VectorXd& out) const {
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

void CollocationEquations::matrix(Eigen::MatrixXd& b) const {
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

void CollocationEquations::slopes(const Eigen::VectorXd& x) {
  states_ = as_states(x);
  system_.rhs(times_, states_, slopes_);
}

}  // namespace nlmech::chapters::rbf_ivp
