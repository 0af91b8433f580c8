/// @file
/// Boundary value problem from function templates, with all derivatives by dual numbers.
#pragma once

#include <array>
#include <utility>

#include "nlmech/bvp/problem.hpp"
#include "nlmech/program/dual.hpp"

namespace nlmech::bvp {

/// Problem from equations E, an aggregate with
///  - `static constexpr int states` n and `static constexpr int parameters` m (which may be 0);
///  - `std::vector<double> points() const`: see Problem;
///  - `template <class T> void rhs(const T& t, const Vector<T, n>& x, const Vector<T, m>& p, Vector<T, n>&
///    dxdt) const`;
///  - `template <class T> void conditions(const Matrix<T, n, Eigen::Dynamic>& ends, const Vector<T, m>& p,
///    Vector<T, Eigen::Dynamic>& r) const`, where the size of r is set by the caller.
/// Derivatives are exact to rounding.
template <class E>
class DualProblem final : public Problem {
 public:
  static constexpr int n = E::states;      ///< states
  static constexpr int m = E::parameters;  ///< unknown constants

  /// Stores the equations.
  explicit DualProblem(E equations) : equations_(std::move(equations)) {}

  /// The equations.
  [[nodiscard]] const E& equations() const { return equations_; }
  [[nodiscard]] int states() const override { return n; }
  [[nodiscard]] int parameters() const override { return m; }
  [[nodiscard]] std::vector<double> points() const override { return equations_.points(); }

  void rhs(double t, const Eigen::VectorXd& x, const Eigen::VectorXd& p,
           Eigen::VectorXd& dxdt) const override {
    Vector<double, n> f;
    equations_.rhs(t, Vector<double, n>(x), Vector<double, m>(p), f);
    dxdt = f;
  }

  void jacobian(double t, const Eigen::VectorXd& x, const Eigen::VectorXd& p, Eigen::MatrixXd& by_state,
                Eigen::MatrixXd& by_parameter) const override {
    using D = Dual<double, n + m>;
    Vector<D, n> at, f;
    Vector<D, m> q;
    for (int i = 0; i < n; ++i) at[i] = D::variable(x[i], i);
    for (int i = 0; i < m; ++i) q[i] = D::variable(p[i], n + i);
    equations_.rhs(D(t), at, q, f);
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < n; ++j) by_state(i, j) = f[i].partial[static_cast<std::size_t>(j)];
      for (int j = 0; j < m; ++j) {
        by_parameter(i, j) = f[i].partial[std::size_t{n} + static_cast<std::size_t>(j)];
      }
    }
  }

  void conditions(const Eigen::MatrixXd& ends, const Eigen::VectorXd& p, Eigen::VectorXd& r) const override {
    equations_.conditions(Matrix<double, n, Eigen::Dynamic>(ends), Vector<double, m>(p), r);
  }

  /// See Problem. Computes four derivatives per evaluation.
  void condition_jacobian(const Eigen::MatrixXd& ends, const Eigen::VectorXd& p, Eigen::MatrixXd& by_ends,
                          Eigen::MatrixXd& by_parameter) const override {
    constexpr int lanes = 4;
    using D = Dual<double, lanes>;
    const int inputs = static_cast<int>(ends.size()) + m;
    Matrix<D, n, Eigen::Dynamic> at(n, ends.cols());
    Vector<D, m> q;
    Vector<D, Eigen::Dynamic> r(by_ends.rows());
    for (int first = 0; first < inputs; first += lanes) {
      const auto seed = [first](double value, int index) {
        const int lane = index - first;
        return lane >= 0 && lane < lanes ? D::variable(value, lane) : D(value);
      };
      for (int i = 0; i < ends.size(); ++i) at(i % n, i / n) = seed(ends(i % n, i / n), i);
      for (int i = 0; i < m; ++i) q[i] = seed(p[i], static_cast<int>(ends.size()) + i);
      equations_.conditions(at, q, r);
      for (int lane = 0; lane < lanes && first + lane < inputs; ++lane) {
        const int column = first + lane;
        for (Eigen::Index i = 0; i < r.size(); ++i) {
          const double slope = r[i].partial[static_cast<std::size_t>(lane)];
          if (column < ends.size()) {
            by_ends(i, column) = slope;
          } else {
            by_parameter(i, column - ends.size()) = slope;
          }
        }
      }
    }
  }

 private:
  E equations_;
};

}  // namespace nlmech::bvp
