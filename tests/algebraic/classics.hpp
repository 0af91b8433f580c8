/// @file
/// Systems of equations with known roots, dense or sparse.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <cmath>
#include <initializer_list>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "nlmech/algebraic/equations.hpp"
#include "tests/random.hpp"

namespace nlmech::algebraic::classics {

using Eigen::MatrixXd;
using Eigen::VectorXd;

inline VectorXd vector(std::initializer_list<double> list) {
  VectorXd v(static_cast<Eigen::Index>(list.size()));
  std::copy(list.begin(), list.end(), v.begin());
  return v;
}

/// Components from -4 to 4.
inline VectorXd random_vector(Eigen::Index n) {
  VectorXd v(n);
  for (double& x : v) x = *rc::gen::map(rc::gen::inRange(-1000, 1001), [](int k) { return k / 250.0; });
  return v;
}
inline MatrixXd random_matrix(Eigen::Index n, Eigen::Index m) {
  MatrixXd a(n, m);
  for (Eigen::Index k = 0; k < m; ++k) a.col(k) = random_vector(n);
  return a;
}

/// Records the iterates of a method.
template <class Method>
std::vector<VectorXd> iterates(const Method& method, Equations& equations, VectorXd x) {
  std::vector<VectorXd> all;
  static_cast<void>(find_root(method, equations, x, [&](const Iterate& i) {
    all.push_back(i.x);
    return true;
  }));
  return all;
}

/// The same equations with a sparse matrix that stores every entry, zeros included.
class Sparse : public DenseEquations {
 public:
  explicit Sparse(const DenseEquations& of) : DenseEquations(of) {
    matrix_ = MatrixXd::Ones(size(), size()).sparseView();
    matrix_.makeCompressed();
  }
  void linearise(const VectorXd& x) override {
    DenseEquations::linearise(x);
    MatrixXd b(size(), size());
    DenseEquations::matrix(b);
    std::copy(b.data(), b.data() + b.size(), matrix_.valuePtr());
  }
  [[nodiscard]] const Eigen::SparseMatrix<double>* sparse() const override { return &matrix_; }

 private:
  Eigen::SparseMatrix<double> matrix_;
};

/// The linear equations A (x - root) = 0.
inline DenseEquations linear(const MatrixXd& a, const VectorXd& root) {
  return {a.rows(), [=](const VectorXd& x, VectorXd& f) { f = a * (x - root); },
          [=](const VectorXd&, MatrixXd& b) { b = a; }};
}

/// One equation in one unknown.
template <class F, class D>
DenseEquations scalar(F f, D d) {
  return {1, [f](const VectorXd& x, VectorXd& r) { r[0] = f(x[0]); },
          [d](const VectorXd& x, MatrixXd& b) { b(0, 0) = d(x[0]); }};
}

/// x^3 - 8 = 0.
inline DenseEquations cube() {
  return scalar([](double x) { return x * x * x - 8; }, [](double x) { return 3 * x * x; });
}
/// Circle x^2 + y^2 = 4 and hyperbola x y = 1 intersect at x^2 = 2 + sqrt(3); dF/dx is singular at 0.
inline DenseEquations circle() {
  return {2, [](const VectorXd& x, VectorXd& f) { f << x.squaredNorm() - 4, x[0] * x[1] - 1; },
          [](const VectorXd& x, MatrixXd& b) { b << 2 * x[0], 2 * x[1], x[1], x[0]; }};
}

/// Options that every method refuses.
template <class Method>
void expect_refused(const Method& method) {
  DenseEquations equations = circle();
  VectorXd x = vector({2, 1});
  EXPECT_THROW((void)find_root(method, equations, x), std::invalid_argument);
}
/// Rosenbrock 1960: root (1, 1), usual start (-1.2, 1).
inline DenseEquations rosenbrock() {
  return {2, [](const VectorXd& x, VectorXd& f) { f << 10 * (x[1] - x[0] * x[0]), 1 - x[0]; },
          [](const VectorXd& x, MatrixXd& b) { b << -20 * x[0], 10, -1, 0; }};
}

/// Powell 1962: root 0, at which dF/dx has rank 2; usual start (3, -1, 0, 1).
inline DenseEquations powell_singular() {
  const double r5 = std::sqrt(5.0), r10 = std::sqrt(10.0);
  return {4,
          [=](const VectorXd& x, VectorXd& f) {
            f << x[0] + 10 * x[1], r5 * (x[2] - x[3]), std::pow(x[1] - 2 * x[2], 2),
                r10 * std::pow(x[0] - x[3], 2);
          },
          [=](const VectorXd& x, MatrixXd& b) {
            const double u = 2 * (x[1] - 2 * x[2]), v = 2 * r10 * (x[0] - x[3]);
            b << 1, 10, 0, 0, 0, 0, r5, -r5, 0, u, -2 * u, 0, v, 0, 0, -v;
          }};
}

/// Brown's almost linear system: roots (a, ..., a, a^(1-n)) with n a^n - (n + 1) a^(n-1) + 1 = 0, of which
/// a = 1 is one; usual start (1/2, ..., 1/2).
inline DenseEquations brown_almost_linear(Eigen::Index n) {
  return {n,
          [n](const VectorXd& x, VectorXd& f) {
            f = x.array() + x.sum() - static_cast<double>(n + 1);
            f[n - 1] = x.prod() - 1;
          },
          [n](const VectorXd& x, MatrixXd& b) {
            b.setOnes();
            b.diagonal().setConstant(2);
            for (Eigen::Index j = 0; j < n; ++j) b(n - 1, j) = x.head(j).prod() * x.tail(n - j - 1).prod();
          }};
}

/// Broyden's tridiagonal system: usual start (-1, ..., -1).
inline DenseEquations broyden_tridiagonal(Eigen::Index n) {
  return {n,
          [n](const VectorXd& x, VectorXd& f) {
            f = (3 - 2 * x.array()) * x.array() + 1;
            f.tail(n - 1) -= x.head(n - 1);
            f.head(n - 1) -= 2 * x.tail(n - 1);
          },
          [](const VectorXd& x, MatrixXd& b) {
            b.setZero();
            b.diagonal().array() = 3 - 4 * x.array();
            b.diagonal(-1).setConstant(-1);
            b.diagonal(1).setConstant(-2);
          }};
}

/// Freudenstein and Roth 1963: root (5, 4), and a minimum of |F| at (11.41..., -0.8968...) with |F|^2 =
/// 48.9842... (More, Garbow and Hillstrom 1981), which descent from (0.5, -2) reaches.
inline DenseEquations freudenstein_roth() {
  return {2,
          [](const VectorXd& x, VectorXd& f) {
            const double y = x[1];
            f << -13 + x[0] + ((5 - y) * y - 2) * y, -29 + x[0] + ((y + 1) * y - 14) * y;
          },
          [](const VectorXd& x, MatrixXd& b) {
            const double y = x[1];
            b << 1, (10 - 3 * y) * y - 2, 1, (3 * y + 2) * y - 14;
          }};
}

}  // namespace nlmech::algebraic::classics
