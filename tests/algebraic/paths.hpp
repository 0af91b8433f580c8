/// @file
/// Paths with known limit and branch points.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <limits>

#include "nlmech/algebraic/paths/path.hpp"

namespace nlmech::algebraic::paths {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using Kind = PathMethod::Kind;

inline constexpr double eps = std::numeric_limits<double>::epsilon();
inline constexpr Kind kinds[] = {Kind::riks, Kind::crisfield, Kind::gdc};

/// load = x - x^3: limit points at x = +-1/sqrt(3), where the load is +-2/(3 sqrt(3)).
struct Cubic : Loaded {
  [[nodiscard]] Eigen::Index size() const override { return 1; }
  void residual(const VectorXd& x, double load, VectorXd& f) override {
    f.setConstant(1, x[0] - x[0] * x[0] * x[0] - load);
  }
  void linearise(const VectorXd& x, double) override { slope = 1 - 3 * x[0] * x[0]; }
  void load_vector(VectorXd& q) const override { q.setConstant(1, -1); }
  void matrix(MatrixXd& k) const override { k.setConstant(1, 1, slope); }
  [[nodiscard]] bool is_symmetric() const override { return symmetric; }
  double slope = 0;
  bool symmetric = true;
};

/// V = x^4/4 - load x^2/2 + (y - load)^2/2: the path x = 0, y = load, from which x^2 = load branches off at
/// 0.
struct Pitchfork : Loaded {
  [[nodiscard]] Eigen::Index size() const override { return 2; }
  void residual(const VectorXd& x, double load, VectorXd& f) override {
    f.resize(2);
    f << x[0] * x[0] * x[0] - load * x[0], x[1] - load;
  }
  void linearise(const VectorXd& x, double load) override {
    at = x;
    k00 = 3 * x[0] * x[0] - load;
  }
  void load_vector(VectorXd& q) const override {
    q.resize(2);
    q << -at[0], -1;
  }
  void matrix(MatrixXd& k) const override {
    k.setIdentity(2, 2);
    k(0, 0) = k00;
  }
  VectorXd at;
  double k00 = 0;
};

inline const double limit_load = 2 / (3 * std::sqrt(3.0)), limit_x = 1 / std::sqrt(3.0);

}  // namespace nlmech::algebraic::paths
