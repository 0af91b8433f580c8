#include "nlmech/bvp/problem.hpp"

#include <cmath>
#include <random>
#include <stdexcept>

#include "nlmech/support/sentences.hpp"

namespace nlmech::bvp {

std::string Problem::unknown_name(int i) const {
  return i < states() ? "state " + std::to_string(i) : "parameter " + std::to_string(i - states());
}

Start constant_start(const Eigen::VectorXd& x, const Eigen::VectorXd& parameters) {
  return {[x](double, Eigen::VectorXd& at) { at = x; }, parameters};
}

Start random_start(const Eigen::VectorXd& amplitudes, double t0, double t1, unsigned seed,
                   const Eigen::VectorXd& parameters) {
  if (!(t0 < t1)) {
    throw invalid_argument("random_start: t0 = {} is not before t1 = {}", t0, t1);
  }
  std::mt19937 engine(seed);
  Eigen::MatrixXd coefficients(amplitudes.size(), 4);
  for (Eigen::Index j = 0; j < 4; ++j) {
    for (Eigen::Index i = 0; i < amplitudes.size(); ++i) {
      // The standard defines the numbers of the engine, but not those of std distributions.
      coefficients(i, j) = amplitudes[i] * (static_cast<double>(engine()) * 0x1p-31 - 1);
    }
  }
  const auto states = [coefficients, t0, t1](double t, Eigen::VectorXd& x) {
    const double s = 2 * (t - t0) / (t1 - t0) - 1;
    x = coefficients * Eigen::Vector4d(1, s, 2 * s * s - 1, s * (4 * s * s - 3));
  };
  return {states, parameters};
}

void check_problem(const Problem& problem) {
  if (problem.states() < 1) {
    throw invalid_argument("boundary value problem: {} states", problem.states());
  }
  if (problem.parameters() < 0) {
    throw invalid_argument("boundary value problem: {} parameters", problem.parameters());
  }
  const std::vector<double> points = problem.points();
  if (points.size() < 2) {
    throw std::invalid_argument("boundary value problem: fewer than two points in time");
  }
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (!std::isfinite(points[k]) || (k > 0 && !(points[k] > points[k - 1]))) {
      throw invalid_argument("boundary value problem: point {} at t = {} is not after the one before", k,
                             points[k]);
    }
  }
}

}  // namespace nlmech::bvp
