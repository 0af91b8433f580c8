/// @file
/// Control model from function templates: Euler-Lagrange equations by nested dual numbers.
#pragma once

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

#include "nlmech/bvp/optimal_control/control_model.hpp"
#include "nlmech/program/dual.hpp"

namespace nlmech::bvp {

/// ControlModel from an aggregate P with
///  - `static constexpr int states` n and `static constexpr int controls` q;
///  - `dynamics(t, x, u, mu, g)`, which sets g = dx/dt;
///  - `running_cost(t, x, u, mu)`;
///  - `end_cost(x0, xF, tF)`,
///
/// three const function templates on the number type; x and g have n components, u has q. H must be strictly
/// convex in u. Newton's iteration eliminates the control pointwise (one step if H is quadratic in u), and
/// one more step in dual numbers yields its derivatives. Exact to rounding.
template <class P>
class DualControl final : public ControlModel {
 public:
  static constexpr int n = P::states;    ///< states
  static constexpr int q = P::controls;  ///< controls

  /// Stores the functions.
  explicit DualControl(P problem) : problem_(std::move(problem)) {}

  /// The functions.
  [[nodiscard]] const P& problem() const { return problem_; }
  [[nodiscard]] int states() const override { return n; }
  [[nodiscard]] int controls() const override { return q; }

  void control(double t, const Eigen::VectorXd& z, double mu, const Constraints& c,
               Eigen::VectorXd& u) const override {
    const Vector<double, n> x = z.head<n>(), lambda = z.tail<n>();
    u = eliminated(t, x, lambda, mu, c);
  }

  void extremal(double t, const Eigen::VectorXd& z, double mu, const Constraints& c,
                Eigen::VectorXd& dzdt) const override {
    const Vector<double, n> x = z.head<n>(), lambda = z.tail<n>();
    Vector<double, 2 * n> f;
    [[maybe_unused]] const double h = flow(t, x, lambda, mu, c, f);
    dzdt = f;
  }

  void extremal_jacobian(double t, const Eigen::VectorXd& z, double mu, const Constraints& c,
                         Eigen::MatrixXd& j) const override {
    if (j.cols() == Eigen::Index{2} * n)
      set_jacobian<2 * n>(t, z, mu, c, j);
    else
      set_jacobian<2 * n + 1>(t, z, mu, c, j);
  }

  [[nodiscard]] double hamiltonian(double t, const Eigen::VectorXd& z, double mu, const Constraints& c,
                                   Eigen::VectorXd& gradient) const override {
    constexpr int variables = 2 * n + 1;
    Vector<Dual<double, variables>, 2 * n> f;
    const auto h = dual_flow<variables>(t, z, mu, c, f);
    gradient.resize(variables);
    for (int k = 0; k < variables; ++k) gradient[k] = h.partial[static_cast<std::size_t>(k)];
    return h.value;
  }

  [[nodiscard]] HamiltonianExpansion expand(double t, const Eigen::VectorXd& x, const Eigen::VectorXd& u,
                                            const Eigen::VectorXd& lambda, double mu,
                                            const Constraints& c) const override {
    using First = Dual<double, n + q>;
    using Second = Dual<First, n + q>;
    const auto seed = [](double value, int k) { return Second::variable(First::variable(value, k), k); };
    Vector<Second, n> at, g;
    Vector<Second, q> v;
    for (int i = 0; i < n; ++i) at[i] = seed(x[i], i);
    for (int i = 0; i < q; ++i) v[i] = seed(u[i], n + i);
    problem_.dynamics(Second(t), at, v, Second(mu), g);
    Second h = cost(Second(t), at, v, Second(mu), c);
    for (int i = 0; i < n; ++i) h += lambda[i] * g[i];
    HamiltonianExpansion e;
    read_off([&](int i) { return g[i].value; }, e);
    e.value = h.value.value;
    e.gradient.resize(n + q);
    e.hessian.resize(n + q, n + q);
    for (std::size_t i = 0; i < n + q; ++i) {
      e.gradient[static_cast<int>(i)] = h.value.partial[i];
      for (std::size_t k = 0; k < n + q; ++k) {
        e.hessian(static_cast<int>(i), static_cast<int>(k)) = h.partial[i].partial[k];
      }
    }
    return e;
  }

  void linearise(double t, const Eigen::VectorXd& x, const Eigen::VectorXd& u, double mu,
                 LinearDynamics& linear) const override {
    using First = Dual<double, n + q>;
    Vector<First, n> at, g;
    Vector<First, q> v;
    for (int i = 0; i < n; ++i) at[i] = First::variable(x[i], i);
    for (int i = 0; i < q; ++i) v[i] = First::variable(u[i], n + i);
    problem_.dynamics(First(t), at, v, First(mu), g);
    read_off([&](int i) { return g[i]; }, linear);
  }

  double dynamics(double t, const Eigen::VectorXd& x, const Eigen::VectorXd& u, double mu,
                  Eigen::VectorXd& g) const override {
    const Vector<double, n> at = x;
    const Vector<double, q> v = u;
    Vector<double, n> f;
    problem_.dynamics(t, at, v, mu, f);
    g = f;
    return problem_.running_cost(t, at, v, mu);
  }

  [[nodiscard]] EndCost end_cost(const Eigen::VectorXd& x0, const Eigen::VectorXd& xF,
                                 double tF) const override {
    constexpr int size = 2 * n + 1;
    using First = Dual<double, size>;
    using Second = Dual<First, size>;
    const auto seed = [](double value, int k) { return Second::variable(First::variable(value, k), k); };
    Vector<Second, n> from, to;
    for (int i = 0; i < n; ++i) from[i] = seed(x0[i], i);
    for (int i = 0; i < n; ++i) to[i] = seed(xF[i], n + i);
    const Second phi = problem_.end_cost(from, to, seed(tF, 2 * n));
    EndCost e{phi.value.value, Eigen::VectorXd(size), Eigen::MatrixXd(size, size)};
    for (std::size_t i = 0; i < size; ++i) {
      e.gradient[static_cast<int>(i)] = phi.value.partial[i];
      for (std::size_t k = 0; k < size; ++k) {
        e.hessian(static_cast<int>(i), static_cast<int>(k)) = phi.partial[i].partial[k];
      }
    }
    return e;
  }

 private:
  /// @param g g(i): i-th component of the dynamics with its derivatives with respect to x, then u
  template <class Component>
  static void read_off(const Component& g, LinearDynamics& linear) {
    linear.g.resize(n);
    linear.g_x.resize(n, n);
    linear.g_u.resize(n, q);
    for (int i = 0; i < n; ++i) {
      const Dual<double, n + q> component = g(i);
      const Eigen::Map<const Eigen::RowVector<double, n + q>> partial(component.partial.data());
      linear.g[i] = component.value;
      linear.g_x.row(i) = partial.head(n);
      linear.g_u.row(i) = partial.tail(q);
    }
  }

  /// L with the penalties on states.
  template <class T>
  T cost(const T& t, const Vector<T, n>& x, const Vector<T, q>& u, const T& mu, const Constraints& c) const {
    using std::sqrt;
    T sum = problem_.running_cost(t, x, u, mu);
    if (c.penalty_weight == 0) return sum;
    const double d = c.penalty_smoothing;
    const auto add = [&](const T& excess) {
      const T positive = (excess + sqrt(excess * excess + d * d)) / 2;
      sum += c.penalty_weight / 2 * (positive * positive);
    };
    for (const StateBound& bound : c.states) {
      if (std::isfinite(bound.high)) add(x[bound.component] - bound.high);
      if (std::isfinite(bound.low)) add(bound.low - x[bound.component]);
    }
    return sum;
  }

  /// dH/du in T, at a control @p u.
  template <class T>
  Vector<T, q> stationarity(const T& t, const Vector<T, n>& x, const Vector<T, q>& u,
                            const Vector<T, n>& lambda, const T& mu, const Constraints& c) const {
    using D = Dual<T, q>;
    Vector<D, n> at, g;
    Vector<D, q> v;
    for (int i = 0; i < n; ++i) at[i] = D(x[i]);
    for (int i = 0; i < q; ++i) v[i] = D::variable(u[i], i);
    problem_.dynamics(D(t), at, v, D(mu), g);
    D h = cost(D(t), at, v, D(mu), c);
    for (int i = 0; i < n; ++i) h += D(lambda[i]) * g[i];
    Vector<T, q> result;
    for (int i = 0; i < q; ++i) result[i] = h.partial[static_cast<std::size_t>(i)];
    return result;
  }

  /// Root of dH/du in double precision, and d2H/du2 at it.
  Vector<double, q> unconstrained(double t, const Vector<double, n>& x, const Vector<double, n>& lambda,
                                  double mu, const Constraints& c, Matrix<double, q>& curvature) const {
    using D = Dual<double, q>;
    Vector<double, q> u = Vector<double, q>::Zero();
    Vector<D, n> at, l;
    for (int i = 0; i < n; ++i) {
      at[i] = D(x[i]);
      l[i] = D(lambda[i]);
    }
    constexpr int most = 50;
    for (int k = 0; k < most; ++k) {
      const Vector<D, q> slope = stationarity(D(t), at, variables<double, q>(u), l, D(mu), c);
      Vector<double, q> r;
      for (int i = 0; i < q; ++i) r[i] = slope[i].value;
      curvature = jacobian_of<double, q, q>(slope);
      const Vector<double, q> step = curvature.partialPivLu().solve(r);
      u -= step;
      if (!step.allFinite() || step.norm() <= 1e-14 * (1 + u.norm())) return u;
    }
    return Vector<double, q>::Constant(std::numeric_limits<double>::quiet_NaN());
  }

  template <class T>
  Vector<T, q> eliminated(const T& t, const Vector<T, n>& x, const Vector<T, n>& lambda, const T& mu,
                          const Constraints& c) const {
    Vector<double, n> at, l;
    for (int i = 0; i < n; ++i) {
      at[i] = value_of(x[i]);
      l[i] = value_of(lambda[i]);
    }
    Matrix<double, q> curvature;
    const Vector<double, q> root = unconstrained(value_of(t), at, l, value_of(mu), c, curvature);
    Vector<T, q> u;
    for (int i = 0; i < q; ++i) u[i] = T(root[i]);
    if constexpr (!std::is_same_v<T, double>) {
      const Vector<T, q> slope = stationarity(t, x, u, lambda, mu, c);
      const Matrix<double, q> inverse = curvature.inverse();
      for (int i = 0; i < q; ++i) {
        for (int k = 0; k < q; ++k) u[i] -= inverse(i, k) * slope[k];
      }
    }
    if (std::isfinite(c.control_limit)) {
      for (int i = 0; i < q; ++i) u[i] = clipped(u[i], c);
    }
    return u;
  }

  template <class T>
  static T clipped(const T& u, const Constraints& c) {
    using std::sqrt;
    const double limit = c.control_limit, d = c.control_smoothing;
    const T up = u + limit, down = u - limit;
    return (sqrt(up * up + d * d) - sqrt(down * down + d * d)) / 2;
  }

  /// (dx/dt, dlambda/dt) and H.
  template <class T>
  T flow(const T& t, const Vector<T, n>& x, const Vector<T, n>& lambda, const T& mu, const Constraints& c,
         Vector<T, 2 * n>& f) const {
    using D = Dual<T, n>;
    const Vector<T, q> u = eliminated(t, x, lambda, mu, c);
    Vector<D, n> at, g;
    Vector<D, q> v;
    for (int i = 0; i < n; ++i) at[i] = D::variable(x[i], i);
    for (int i = 0; i < q; ++i) v[i] = D(u[i]);
    problem_.dynamics(D(t), at, v, D(mu), g);
    D h = cost(D(t), at, v, D(mu), c);
    for (int i = 0; i < n; ++i) h += D(lambda[i]) * g[i];
    for (int i = 0; i < n; ++i) {
      f[i] = g[i].value;
      f[n + i] = -h.partial[static_cast<std::size_t>(i)];
    }
    return h.value;
  }

  /// flow() with derivatives with respect to z, and to t if variables = 2 n + 1.
  template <int variables>
  Dual<double, variables> dual_flow(double t, const Eigen::VectorXd& z, double mu, const Constraints& c,
                                    Vector<Dual<double, variables>, 2 * n>& f) const {
    using D = Dual<double, variables>;
    Vector<D, n> x, lambda;
    for (int i = 0; i < n; ++i) {
      x[i] = D::variable(z[i], i);
      lambda[i] = D::variable(z[n + i], n + i);
    }
    if constexpr (variables == 2 * n)
      return flow(D(t), x, lambda, D(mu), c, f);
    else
      return flow(D::variable(t, 2 * n), x, lambda, D(mu), c, f);
  }
  template <int variables>
  void set_jacobian(double t, const Eigen::VectorXd& z, double mu, const Constraints& c,
                    Eigen::MatrixXd& j) const {
    Vector<Dual<double, variables>, 2 * n> f;
    dual_flow<variables>(t, z, mu, c, f);
    for (int i = 0; i < 2 * n; ++i) {
      for (int k = 0; k < variables; ++k) j(i, k) = f[i].partial[static_cast<std::size_t>(k)];
    }
  }

  P problem_;
};

}  // namespace nlmech::bvp
