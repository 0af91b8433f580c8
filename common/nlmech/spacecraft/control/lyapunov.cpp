#include "nlmech/spacecraft/control/lyapunov.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <unsupported/Eigen/MatrixFunctions>

#include "nlmech/spacecraft/plant/gauss_rule.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::spacecraft {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

DiscreteLoop::DiscreteLoop(const DiscreteModel& model, const Gains& gains, double final_angle, double step)
    : step_(step), k3_(gains.k3), final_angle_(final_angle), shape_(model.shape) {
  if (!(step > 0) || !std::isfinite(step))
    throw invalid_argument("DiscreteLoop: the step is {:g}; it must be positive", step);
  const bool right = gains.k1 > 0 && gains.k2 > -2 && gains.k3 >= 0 && std::isfinite(gains.k1) &&
                     std::isfinite(gains.k2) && std::isfinite(gains.k3);
  if (!right)
    throw invalid_argument("DiscreteLoop: gains {:g}, {:g}, {:g}; k1 > 0, k2 > -2, k3 >= 0 are possible",
                           gains.k1, gains.k2, gains.k3);
  const double part = (2 + gains.k2) / 2;
  MatrixXd mass = model.full_mass(), stiffness = part * model.full_stiffness();
  mass(0, 0) -= model.hub_inertia;
  mass *= part;
  mass(0, 0) += model.hub_inertia;
  stiffness(0, 0) += gains.k1;
  const Eigen::LLT<MatrixXd> factors(mass);
  if (factors.info() != Eigen::Success)
    throw std::invalid_argument("DiscreteLoop: the mass matrix is not positive definite");
  // M = L L^T; L^-1 K L^-T = U Omega^2 U^T; a = Omega U^T L^T (x - x_f), b = U^T L^T x'.
  const Index n = mass.rows();
  MatrixXd reduced = factors.matrixL().solve(stiffness);
  reduced = factors.matrixL().solve(MatrixXd(reduced.transpose()));
  const Eigen::SelfAdjointEigenSolver<MatrixXd> modes(reduced);
  if (modes.info() != Eigen::Success || !(modes.eigenvalues()[0] > 0))
    throw std::invalid_argument("DiscreteLoop: the stiffness matrix is not positive definite");
  const VectorXd omega = modes.eigenvalues().cwiseSqrt();
  velocities_ = factors.matrixU().solve(modes.eigenvectors());
  displacements_ = velocities_ * omega.cwiseInverse().asDiagonal();
  rate_ = MatrixXd::Zero(2 * n, 2 * n);
  rate_.topRightCorner(n, n) = omega.asDiagonal();
  rate_.bottomLeftCorner(n, n) = -MatrixXd(omega.asDiagonal());
  rate_.bottomRightCorner(n, n) = -gains.k3 * velocities_.row(0).transpose() * velocities_.row(0);
  propagator_ = MatrixXd(rate_ * step).exp();
  rates_.resize(10, 2 * n);
  VectorXd theta_rate = VectorXd::Zero(2 * n);
  theta_rate.tail(n) = velocities_.row(0).transpose();
  for (Index k = 0; k < 10; ++k) {
    const double place = gauss_rule[static_cast<std::size_t>(k)].place;
    rates_.row(k) = theta_rate.transpose() * MatrixXd(rate_ * (step * (1 + place) / 2)).exp();
  }
  VectorXd start = VectorXd::Zero(n);
  start[0] = -final_angle;
  state_ = VectorXd::Zero(2 * n);
  state_.head(n) = omega.asDiagonal() * (modes.eigenvectors().transpose() * (factors.matrixU() * start));
  next_ = state_;
}

void DiscreteLoop::advance() {
  next_.noalias() = propagator_ * state_;
  state_.swap(next_);
  ++steps_;
}

VectorXd DiscreteLoop::displacement() const {
  VectorXd x = displacements_ * state_.head(displacements_.cols());
  x[0] += final_angle_;
  return x;
}

VectorXd DiscreteLoop::velocity() const { return velocities_ * state_.tail(velocities_.cols()); }

double DiscreteLoop::theta() const {
  return final_angle_ + displacements_.row(0).dot(state_.head(displacements_.cols()));
}

double DiscreteLoop::theta_dot() const { return velocities_.row(0).dot(state_.tail(velocities_.cols())); }

double DiscreteLoop::deflection(double x) const {
  const VectorXd q = displacement();
  return shape_(x).dot(q.tail(q.size() - 1));
}

double DiscreteLoop::deflection_dot(double x) const {
  const VectorXd q = velocity();
  return shape_(x).dot(q.tail(q.size() - 1));
}

// (a, b) = sum_i v_i e^(p_i t): each pair contributes -v_i^T W v_j/(p_i + p_j).
double DiscreteLoop::integral(const MatrixXd& p, const MatrixXd& q) const {
  const Index n = displacements_.cols();
  MatrixXd weight = MatrixXd::Zero(2 * n, 2 * n);
  weight.topLeftCorner(n, n) = displacements_.transpose() * p * displacements_;
  weight.bottomRightCorner(n, n) = velocities_.transpose() * q * velocities_;
  const Eigen::EigenSolver<MatrixXd> motions(rate_);
  const Eigen::MatrixXcd vectors = motions.eigenvectors();
  const Eigen::VectorXcd amplitudes = vectors.partialPivLu().solve(state_.cast<Complex>());
  const Eigen::MatrixXcd moved = vectors * amplitudes.asDiagonal();
  const Eigen::MatrixXcd pairs = moved.transpose() * weight.cast<Complex>() * moved;
  Complex sum = 0;
  for (Index i = 0; i < 2 * n; ++i) {
    for (Index j = 0; j < 2 * n; ++j)
      sum -= pairs(i, j) / (motions.eigenvalues()[i] + motions.eigenvalues()[j]);
  }
  return sum.real();
}

double DiscreteLoop::dissipation() const {
  double sum = 0;
  for (Index k = 0; k < 10; ++k) {
    const double rate = rates_.row(k).dot(state_);
    sum += gauss_rule[static_cast<std::size_t>(k)].weight * rate * rate;
  }
  return k3_ * sum * step_ / 2;
}

LyapunovHistory lyapunov_history(const Parameters& parameters, const Gains& gains, int modes, double until,
                                 double step) {
  if (!(until > 0) || !(step > 0) || !(until / step < 1e7))
    throw invalid_argument("lyapunov_history: until {:g} in steps of {:g}; 1 to 1e7 steps are possible",
                           until, step);
  DiscreteLoop loop(assumed_modes(parameters, modes), gains, 1, step);
  Parameters simplified = parameters;
  simplified.tip_inertia = 0;
  const DiscreteModel model = assumed_modes(simplified, modes);
  MatrixXd mass = model.full_mass();
  mass(0, 0) -= model.hub_inertia;
  const auto sample = [&](double balance) {
    const VectorXd x = loop.displacement(), v = loop.velocity();
    const VectorXd q = x.tail(x.size() - 1);
    // Energy of both appendages; the printed function contains one.
    const double beams = (v.dot(mass * v) + q.dot(model.stiffness * q)) / 2, error = x[0] - 1;
    const double hub = (parameters.hub_inertia * v[0] * v[0] + gains.k1 * error * error) / 2;
    return LyapunovSample{loop.time(), x[0], loop.lyapunov(), hub + (1 + gains.k2) * beams / 2, balance};
  };
  LyapunovHistory history;
  double balance = loop.lyapunov();
  history.samples.push_back(sample(balance));
  const LyapunovSample start = history.samples[0];
  for (long k = 0; k < std::lround(until / step); ++k) {
    balance -= loop.dissipation();
    loop.advance();
    history.samples.push_back(sample(balance));
    const LyapunovSample &before = history.samples[history.samples.size() - 2], &now = history.samples.back();
    history.corrected_rise += std::max(0., now.corrected - before.corrected) / start.corrected;
    history.printed_rise += std::max(0., now.printed - before.printed) / start.printed;
    history.imbalance = std::max(history.imbalance, std::abs(now.corrected - balance) / start.corrected);
  }
  return history;
}

}  // namespace nlmech::spacecraft
