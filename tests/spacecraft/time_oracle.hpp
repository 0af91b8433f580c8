/// @file
/// Motion in time without poles and residues: the trapezoidal sum of the Bromwich integral, and finite
/// elements with the exponential of their matrix.
#pragma once

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <numbers>
#include <span>
#include <unsupported/Eigen/MatrixFunctions>
#include <vector>

#include "nlmech/spacecraft/control/closed_loop.hpp"
#include "nlmech/spacecraft/plant/discrete_model.hpp"

namespace nlmech::spacecraft::oracle {

/// The line Re s = shift up to a frequency, in steps of pi/half_period. The defaults suit times up to 60 s of
/// the spacecraft of Table 3.1.
struct BromwichLine {
  double half_period = 60, shift = 0.25, frequency = 1.2e4;
};

/// Durbin's sum f(t) ~ e^(ct)/T { F(c)/2 + sum Re[F(c + i k pi/T) e^(i k pi t/T)] } for several times.
/// Errors: aliasing, f(t + 2T) e^(-2cT), and truncation at the highest frequency.
inline std::vector<double> bromwich(const std::function<Complex(Complex)>& transform,
                                    std::span<const double> times, const BromwichLine& line = {}) {
  const double step = std::numbers::pi / line.half_period;
  std::vector<double> values(times.size(), 0);
  for (int k = 0; k * step <= line.frequency; ++k) {
    const Complex value = transform({line.shift, k * step}) * (k == 0 ? 0.5 : 1.);
    for (std::size_t i = 0; i < times.size(); ++i)
      values[i] += (value * std::polar(1., k * step * times[i])).real();
  }
  for (std::size_t i = 0; i < times.size(); ++i)
    values[i] *= std::exp(line.shift * times[i]) / line.half_period;
  return values;
}

/// theta, theta', y(x) and y'(x) at one time.
struct Moved {
  double theta, theta_dot, deflection, deflection_dot;
};

/// An oscillating pole, and its amplitudes in theta and y(x) at t = 0.
struct Mode {
  Complex pole;
  double theta, deflection;
};

/// M x'' + C x' + K x = k1 e_0 from rest, x = (theta, q): in the equation of the hub the appendages have the
/// factor kappa/2. For k1 = 0 a unit torque is applied instead.
class StepByElements {
 public:
  StepByElements(const Parameters& parameters, const Gains& g, double x, int elements) {
    const DiscreteModel model = finite_elements(parameters, elements);
    const Eigen::Index n = model.size() + 1;
    const double half = 1 + g.k2 / 2;
    Eigen::MatrixXd mass = half * model.full_mass(), stiffness = half * model.full_stiffness();
    mass(0, 0) += (1 - half) * model.hub_inertia;
    stiffness(0, 0) += g.k1;
    const Eigen::PartialPivLU<Eigen::MatrixXd> inverse(mass);
    const Eigen::VectorXd unit = inverse.solve(Eigen::VectorXd::Unit(n, 0));
    matrix_ = Eigen::MatrixXd::Zero(2 * n + 1, 2 * n + 1);
    matrix_.block(0, n, n, n).setIdentity();
    matrix_.block(n, 0, n, n) = -inverse.solve(stiffness);
    matrix_.block(n, n, n, 1) = -g.k3 * unit;
    matrix_.block(n, 2 * n, n, 1) = (g.k1 > 0 ? g.k1 : 1) * unit;
    shape_ = model.shape(x);
  }

  [[nodiscard]] Moved at(double time) const {
    const Eigen::Index n = (matrix_.rows() - 1) / 2;
    const Eigen::MatrixXd e = (matrix_ * time).exp();
    const Eigen::VectorXd x = e.rightCols(1);
    return {x[0], x[n], shape_.dot(x.segment(1, n - 1)), shape_.dot(x.segment(n + 1, n - 1))};
  }

  /// Ascending frequencies.
  [[nodiscard]] std::vector<Mode> modes() const {
    const Eigen::Index n = (matrix_.rows() - 1) / 2;
    const Eigen::EigenSolver<Eigen::MatrixXd> solver(matrix_);
    const Eigen::MatrixXcd& vectors = solver.eigenvectors();
    const Eigen::VectorXcd weights =
        vectors.partialPivLu().solve(Eigen::VectorXcd::Unit(matrix_.rows(), matrix_.rows() - 1));
    std::vector<Mode> all;
    for (Eigen::Index i = 0; i < weights.size(); ++i) {
      const Complex pole = solver.eigenvalues()[i];
      if (!(pole.imag() > 0)) continue;
      const Complex y = shape_.cast<Complex>().dot(vectors.col(i).segment(1, n - 1));
      all.push_back({pole, 2 * std::abs(weights[i] * vectors(0, i)), 2 * std::abs(weights[i] * y)});
    }
    std::ranges::sort(all, {}, [](const Mode& mode) { return mode.pole.imag(); });
    return all;
  }

 private:
  Eigen::MatrixXd matrix_;
  Eigen::VectorXd shape_;
};

}  // namespace nlmech::spacecraft::oracle
