#include "nlmech/spacecraft/plant/discrete_model.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "nlmech/support/sentences.hpp"

namespace nlmech::spacecraft {
namespace {

void require_sizes(const DiscreteModel& m) {
  const Eigen::Index n = m.size();
  if (n < 1 || m.mass.rows() != n || m.mass.cols() != n || m.stiffness.rows() != n || m.stiffness.cols() != n)
    throw invalid_argument("DiscreteModel: {} coordinates, mass {} x {}, stiffness {} x {}", n, m.mass.rows(),
                           m.mass.cols(), m.stiffness.rows(), m.stiffness.cols());
}

template <class R>
R judged(R r) {
  if (!is_finite(r.theta) || !is_finite(r.deflection)) r.outcome = Outcome::at_pole;
  return r;
}

}  // namespace

Eigen::MatrixXd DiscreteModel::full_mass() const {
  require_sizes(*this);
  const Eigen::Index n = size();
  Eigen::MatrixXd full(n + 1, n + 1);
  full(0, 0) = total_inertia;
  full.block(1, 0, n, 1) = coupling;
  full.block(0, 1, 1, n) = coupling.transpose();
  full.block(1, 1, n, n) = mass;
  return full;
}

Eigen::MatrixXd DiscreteModel::full_stiffness() const {
  require_sizes(*this);
  const Eigen::Index n = size();
  Eigen::MatrixXd full = Eigen::MatrixXd::Zero(n + 1, n + 1);
  full.block(1, 1, n, n) = stiffness;
  return full;
}

DenseResponse::DenseResponse(const DiscreteModel& model, double x)
    : mass_(model.full_mass()),
      stiffness_(model.full_stiffness()),
      real_(mass_.rows(), mass_.cols()),
      complex_(mass_.rows(), mass_.cols()),
      shape_(model.shape(x)),
      real_solver_(mass_.rows()),
      complex_solver_(mass_.rows()),
      real_solution_(mass_.rows()),
      complex_solution_(mass_.rows()) {}

Response DenseResponse::response(Complex s) {
  const Eigen::Index n = shape_.size();
  complex_ = s * s * mass_ + stiffness_;
  complex_solver_.compute(complex_);
  complex_solution_ = complex_solver_.solve(Eigen::VectorXcd::Unit(n + 1, 0));
  return judged(Response{complex_solution_[0], shape_.dot(complex_solution_.tail(n)), Outcome::success});
}

AxisResponse DenseResponse::at_frequency(double omega) {
  const Eigen::Index n = shape_.size();
  real_ = stiffness_ - omega * omega * mass_;
  real_solver_.compute(real_);
  real_solution_ = real_solver_.solve(Eigen::VectorXd::Unit(n + 1, 0));
  return judged(AxisResponse{real_solution_[0], shape_.dot(real_solution_.tail(n)), Outcome::success});
}

Eigen::VectorXd ModalModel::mode_shapes(double x) const { return vectors.transpose() * shape(x); }

// With theta'' = (u - c^T q'')/J: (M - c c^T/J) q'' + K q = -c u/J. Solved as M' v = (1/omega^2) K v, for K
// is the better conditioned of the two, and the low frequencies are the large eigenvalues.
ModalModel diagonalise(const DiscreteModel& model) {
  require_sizes(model);
  const Eigen::VectorXd& c = model.coupling;
  const Eigen::MatrixXd reduced = model.mass - c * c.transpose() / model.total_inertia;
  // Coordinates of equal size: the conditions of both matrices are those of the functions alone.
  const Eigen::VectorXd scale = model.stiffness.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd k = scale.asDiagonal() * model.stiffness * scale.asDiagonal();
  const Eigen::MatrixXd m = scale.asDiagonal() * reduced * scale.asDiagonal();
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(m, k);
  if (solver.info() != Eigen::Success || !(solver.eigenvalues().minCoeff() > 0))
    throw std::invalid_argument("diagonalise: mass or stiffness matrix is not positive definite to rounding");
  ModalModel modes;
  modes.hub_inertia = model.hub_inertia;
  modes.total_inertia = model.total_inertia;
  modes.omega = solver.eigenvalues().reverse().cwiseSqrt().cwiseInverse();
  // Eigen makes v^T K v = 1; wanted is v^T M' v = 1.
  modes.vectors = scale.asDiagonal() * solver.eigenvectors().rowwise().reverse() * modes.omega.asDiagonal();
  modes.participation = -(modes.vectors.transpose() * c) / model.total_inertia;
  modes.shape = model.shape;
  return modes;
}

ModalResponse::ModalResponse(const ModalModel& model, double x)
    : total_inertia_(model.total_inertia),
      omega_squared_(model.omega.cwiseAbs2()),
      theta_gain_(model.participation.cwiseAbs2()),
      deflection_gain_(model.participation.cwiseProduct(model.mode_shapes(x))) {}

Response ModalResponse::response(Complex s) const {
  const Complex z = s * s;
  Response r{1. / (total_inertia_ * z), 0., Outcome::success};
  for (Eigen::Index i = 0; i < omega_squared_.size(); ++i) {
    const Complex inverse = 1. / (z + omega_squared_[i]);
    r.theta += theta_gain_[i] * inverse;
    r.deflection += deflection_gain_[i] * inverse;
  }
  return judged(r);
}

AxisResponse ModalResponse::at_frequency(double omega) const {
  const double z = -omega * omega;
  AxisResponse r{1 / (total_inertia_ * z), 0, Outcome::success};
  for (Eigen::Index i = 0; i < omega_squared_.size(); ++i) {
    const double inverse = 1 / (z + omega_squared_[i]);
    r.theta += theta_gain_[i] * inverse;
    r.deflection += deflection_gain_[i] * inverse;
  }
  return judged(r);
}

}  // namespace nlmech::spacecraft
