/// @file
/// Collocation at Radau nodes by Newton's iteration: the engine of adaptive-collocation for stiff problems.
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <utility>

#include "nlmech/collocation/radau_transform.hpp"
#include "nlmech/ivp/collocation_loops.hpp"
#include "nlmech/ivp/collocation_trial.hpp"
#include "nlmech/ivp/smooth_segment.hpp"
#include "nlmech/ivp/solution.hpp"
#include "nlmech/ivp/system.hpp"
#include "nlmech/support/statistics.hpp"

namespace nlmech::ivp::adaptive {

/// Steps of s nodes, s odd, by simplified Newton iterations on the increments z_i = x_i - x_0, with one
/// Jacobian for all nodes and, where it changes little, for many steps. In the coordinates of RadauTransform
/// an iteration solves one real and (s - 1)/2 complex systems of the size of the state (E. Hairer and G.
/// Wanner, Stiff differential equations solved by Radau methods, J. Comput. Appl. Math. 111 (1999) 93-111).
///
/// The estimate is (gamma/h - J)^-1 r_0, r_0 what the trial function fails the equation by at the begin:
/// formally of order s, damped where the problem is stiff. It is held against 0.1 tol^((s+1)/(2s)), because
/// the end is of order 2s - 1.
template <SystemLike S, int s>
class NewtonSteps : public DenseOutput<S::dimension> {
 public:
  static constexpr int n = S::dimension;  ///< components of the state

  /// @param setup the equation and what is asked
  explicit NewtonSteps(const Setup<S>& setup)
      : system_(setup.system),
        share_(0.1 * std::pow(reference(setup.tolerance), (s + 1.) / (2 * s) - 1)),
        tolerance_{setup.tolerance.absolute * share_, setup.tolerance.relative * share_},
        z_(Increments::Zero(system_.size(), s)),
        w_(z_),
        f_(z_),
        last_(z_),
        change_of_w_(z_),
        x0_(State<n>::Zero(system_.size())),
        x1_(x0_),
        carry_(x0_),
        change_(x0_),
        weight_(x0_),
        f0_(x0_),
        node_(x0_),
        slope_(x0_),
        update_(x0_),
        jacobian_(Jacobian<n>::Zero(system_.size(), system_.size())),
        real_(x0_),
        complex_(x0_.template cast<std::complex<double>>()) {}

  /// Starts a segment at (t, x).
  void begin_segment(double t, double end, const State<n>& x, Statistics& statistics) {
    segment_ = SmoothSegment(t, end);
    x0_ = x;
    carry_.setZero();
    last_length_ = 0;
    has_jacobian_ = false;
    is_first_ = true;
    system_.rhs(segment_(t), x, f0_);
    ++statistics.right_hand_sides;
  }
  /// Is the slope at the begin finite?
  [[nodiscard]] bool begin_is_finite() const { return all_finite(f0_.data(), f0_.size()); }
  /// State at the begin.
  [[nodiscard]] const State<n>& begin_state() const { return x0_; }
  /// State at the end of the trial.
  [[nodiscard]] const State<n>& end_state() const { return x1_; }
  /// h |J|, the greatest row sum, in the latest trial: how stiff the problem is for its step.
  [[nodiscard]] double stiffness() const {
    return std::abs(h_) * jacobian_.cwiseAbs().rowwise().sum().maxCoeff();
  }

  /// Power of the step with which the estimate grows.
  [[nodiscard]] int error_order() const { return s + 1; }
  /// Goes from the begin, t, to t1.
  Trial attempt(double t, double t1, Statistics& statistics) {
    t0_ = t;
    t1_ = t1;
    h_ = t1 - t;
    for (Eigen::Index i = 0; i < x0_.size(); ++i)
      weight_[i] = tolerance_.absolute + tolerance_.relative * std::abs(x0_[i]);
    if (!has_jacobian_) {
      system_.jacobian(segment_(t), x0_, jacobian_);
      ++statistics.jacobians;
      has_jacobian_ = true;
      is_fresh_ = true;
      factored_ = 0;
    }
    if (factored_ != h_) factor(statistics);
    predict();
    Trial trial = iterate(statistics);
    if (!trial.converged) {
      if (!is_fresh_) has_jacobian_ = false;
      return trial;
    }
    finish();
    trial.error = error(statistics);
    trial.converged = all_finite(x1_.data(), x1_.size()) && std::isfinite(trial.error);
    was_rejected_ = !(trial.error <= 1);
    return trial;
  }
  /// Takes the trial for the begin of the next.
  void accept() {
    std::swap(x0_, x1_);
    carry_ = change_;
    last_ = z_;
    last_length_ = h_;
    is_first_ = false;
    was_rejected_ = false;
    // f at the end is that of the last node: (A^-1 z)_s/h, whose rounding a stiff problem does not enlarge.
    system_.rhs(segment_(t1_), x0_, f0_);
    if (contraction_ > keep_jacobian) has_jacobian_ = false;
    is_fresh_ = false;
  }

  /// Goes on where another order has come to, from its trial function.
  template <int other>
  [[gnu::noinline]] void continue_from(const NewtonSteps<S, other>& from) {
    segment_ = from.segment_;
    x0_ = from.x0_;
    carry_ = from.carry_;
    f0_ = from.f0_;
    h_ = from.h_;
    last_length_ = from.last_length_;
    jacobian_ = from.jacobian_;
    has_jacobian_ = from.has_jacobian_;
    is_fresh_ = false;
    is_first_ = false;
    was_rejected_ = false;
    factored_ = 0;
    eta_ = 1;
    typename NewtonSteps<S, other>::Row row;
    for (int i = 0; i < s; ++i) {
      from.lagrange(table_.nodes[i], row);
      for (Eigen::Index d = 0; d < x0_.size(); ++d) last_(d, i) = from.sum(row, from.last_, d);
    }
  }
  /// After a trial: 1 where Newton's iteration converges at once and more nodes would let the steps become
  /// longer; -1 where it hardly converges, which longer steps make worse (Hairer and Wanner).
  [[nodiscard]] int better_order() const {
    if (contraction_ > 0.8) return -1;
    return contraction_ < 0.002 && iterations_ > 1 ? 1 : 0;
  }

  /// The trial function itself, of order s + 1.
  void at(double t, State<n>& x) const override {
    if (t == t0_ || t == t1_) {
      x = t == t0_ ? x0_ : x1_;
      return;
    }
    Row row;
    lagrange((t - t0_) / h_, row);
    for (Eigen::Index d = 0; d < x0_.size(); ++d) x[d] = x0_[d] + sum(row, z_, d);
  }

 private:
  template <SystemLike, int>
  friend class NewtonSteps;
  using Increments = Eigen::Matrix<double, n, s>;  // a node a column
  using Row = Column<s>;                           // a number for each node
  using RealLu = Eigen::PartialPivLU<Jacobian<n>>;
  using ComplexLu = Eigen::PartialPivLU<Matrix<std::complex<double>, n, n>>;
  static constexpr int most_iterations = 7 + (s - 3) * 5 / 2;
  static constexpr double keep_jacobian = 1e-3;  // contraction
  static constexpr double share = 0.05;          // of the tolerance that the iteration may leave
  static constexpr double least_trusted = 1e-3;  // contraction, before a step has shown its own

  static double reference(const Tolerance& t) {
    return std::min(t.relative > 0 ? t.relative : t.absolute, 0.1);
  }
  [[gnu::noinline]] void factor(Statistics& statistics) {
    Jacobian<n> a = -jacobian_;
    a.diagonal().array() += transform_.real / h_;
    real_lu_.compute(a);
    for (std::size_t p = 0; p < complex_lu_.size(); ++p) {
      Matrix<std::complex<double>, n, n> b = -jacobian_.template cast<std::complex<double>>();
      b.diagonal().array() += transform_.complex[p] / h_;
      complex_lu_[p].compute(b);
    }
    factored_ = h_;
    ++statistics.factorisations;
  }

  // z_j at the time t of the step: l_j(t) with the begin as a further node, where z is 0.
  void lagrange(double t, Row& row) const {
    for (int j = 0; j < s; ++j) {
      double value = t / table_.nodes[j];
      for (int m = 0; m < s; ++m) {
        if (m != j) value *= (t - table_.nodes[m]) / (table_.nodes[j] - table_.nodes[m]);
      }
      row[j] = value;
    }
  }
  [[gnu::noinline]] void predict() {
    const double ratio = last_length_ != 0 ? h_ / last_length_ : HUGE_VAL;
    if (!(ratio > 0 && ratio < 10)) {
      z_.setZero();
    } else {
      Row row;
      for (int i = 0; i < s; ++i) {
        lagrange(1 + ratio * table_.nodes[i], row);
        row[s - 1] -= 1;
        for (Eigen::Index d = 0; d < x0_.size(); ++d) z_(d, i) = sum(row, last_, d);
      }
      if (!all_finite(z_.data(), z_.size())) z_.setZero();
    }
    combine(transform_.to, z_, w_);
  }
  // Component d of the nodes' sum with these weights.
  [[nodiscard]] double sum(const Row& weights, const Increments& of, Eigen::Index d) const {
    double total = 0;
    for (int j = 0; j < s; ++j) total += weights[j] * of(d, j);
    return total;
  }
  // to_i = sum_j a_ij from_j over nodes.
  static void combine(const Square<s>& a, const Increments& from, Increments& to) {
    for (int i = 0; i < s; ++i) {
      for (Eigen::Index d = 0; d < from.rows(); ++d) {
        double total = 0;
        for (int j = 0; j < s; ++j) total += a(i, j) * from(d, j);
        to(d, i) = total;
      }
    }
  }

  [[gnu::noinline]] Trial iterate(Statistics& statistics) {
    const double enough =
        std::max(share / share_, 20 * std::numeric_limits<double>::epsilon() / least_relative());
    double before = HUGE_VAL, contraction_before = 0;
    contraction_ = 0;
    for (int count = 1;; ++count) {
      iterations_ = count;
      for (int i = 0; i < s; ++i) {
        for (Eigen::Index d = 0; d < x0_.size(); ++d) node_[d] = x0_[d] + z_(d, i);
        system_.rhs(segment_(i == s - 1 ? t1_ : t0_ + h_ * table_.nodes[i]), node_, slope_);
        std::copy_n(slope_.data(), slope_.size(), f_.data() + i * slope_.size());
      }
      statistics.right_hand_sides += s;
      const double size = solve(statistics);
      if (!std::isfinite(size)) return {false, 0, count, 0.5};
      // What the step before says of the contraction is forgotten little by little.
      double eta = std::pow(std::max(eta_, least_trusted), 0.8);
      if (count > 1) {
        const double now = size / before;
        contraction_ = count == 2 ? now : std::sqrt(now * contraction_before);
        contraction_before = now;
        if (!(contraction_ < 0.99)) return {false, 0, count, 0.5};
        eta = contraction_ / (1 - contraction_);
        const double expected = eta * size * std::pow(contraction_, most_iterations - count) / enough;
        if (expected > 1) {
          const double excess = std::clamp(expected, 1e-4, 20.);
          return {false, 0, count, 0.8 * std::pow(excess, -1. / (4 + most_iterations - count))};
        }
      }
      if (eta * size <= enough || size == 0) {
        eta_ = eta;
        return {true, 0, count, 0};
      }
      if (count == most_iterations) return {false, 0, count, 0.5};
      before = size;
    }
  }
  [[nodiscard]] double least_relative() const {
    double largest = std::numeric_limits<double>::min();
    for (Eigen::Index i = 0; i < x0_.size(); ++i) largest = std::max(largest, std::abs(x0_[i]) / weight_[i]);
    return 1 / largest;
  }
  // One iteration: (Lambda/h - J) dw = T^-1 f - Lambda w/h. The size of dz in units of the tolerance.
  [[gnu::noinline]] double solve(Statistics& statistics) {
    ++statistics.newton_iterations;
    const Eigen::Index size = x0_.size();
    combine(transform_.to, f_, change_of_w_);
    for (Eigen::Index d = 0; d < size; ++d) real_[d] = change_of_w_(d, 0) - transform_.real / h_ * w_(d, 0);
    real_ = real_lu_.solve(real_);
    for (Eigen::Index d = 0; d < size; ++d) change_of_w_(d, 0) = real_[d];
    for (std::size_t p = 0; p < complex_lu_.size(); ++p) {
      const auto a = static_cast<Eigen::Index>(2 * p + 1), b = a + 1;
      const std::complex<double> eigenvalue = transform_.complex[p] / h_;
      for (Eigen::Index d = 0; d < size; ++d)
        complex_[d] = std::complex<double>(change_of_w_(d, a), change_of_w_(d, b)) -
                      eigenvalue * std::complex<double>(w_(d, a), w_(d, b));
      complex_ = complex_lu_[p].solve(complex_);
      for (Eigen::Index d = 0; d < size; ++d) {
        change_of_w_(d, a) = complex_[d].real();
        change_of_w_(d, b) = complex_[d].imag();
      }
    }
    for (Eigen::Index k = 0; k < w_.size(); ++k) w_.data()[k] += change_of_w_.data()[k];
    combine(transform_.from, w_, z_);
    combine(transform_.from, change_of_w_, f_);
    double squares = 0;
    for (int i = 0; i < s; ++i) {
      for (Eigen::Index d = 0; d < size; ++d) squares += (f_(d, i) / weight_[d]) * (f_(d, i) / weight_[d]);
    }
    return std::sqrt(squares / static_cast<double>(s * size));
  }

  void finish() {
    for (Eigen::Index i = 0; i < x0_.size(); ++i) {
      const double whole = z_(i, s - 1) + carry_[i];
      x1_[i] = x0_[i] + whole;
      change_[i] = whole - (x1_[i] - x0_[i]);
    }
  }
  // See the class. The second, better damped form is for steps that the first would refuse at a begin where
  // it overestimates: the first step and those after a rejection.
  [[gnu::noinline]] double error(Statistics& statistics) {
    // The trial function's own slope at the begin, from z: l_j'(0) z_j/h.
    for (Eigen::Index d = 0; d < x0_.size(); ++d) {
      slope_[d] = sum(derivative_, z_, d) / h_;
      node_[d] = f0_[d] - slope_[d];
    }
    update_ = real_lu_.solve(node_);
    double size = norm(update_);
    if (size > 1 && (is_first_ || was_rejected_)) {
      for (Eigen::Index d = 0; d < x0_.size(); ++d) node_[d] = x0_[d] + update_[d];
      system_.rhs(segment_(t0_), node_, real_);
      ++statistics.right_hand_sides;
      for (Eigen::Index d = 0; d < x0_.size(); ++d) real_[d] -= slope_[d];
      update_ = real_lu_.solve(real_);
      size = norm(update_);
    }
    return size;
  }
  [[nodiscard]] double norm(const State<n>& x) const {
    double sum = 0;
    for (Eigen::Index i = 0; i < x.size(); ++i) sum += (x[i] / weight_[i]) * (x[i] / weight_[i]);
    return std::sqrt(sum / static_cast<double>(x.size()));
  }
  // Row l(0) A^-1: from increments to the slope at the begin, times h.
  static Row begin_slope(const collocation::Radau<s>& table) {
    Row row;
    for (int j = 0; j < s; ++j) {
      double value = 1 / table.nodes[j];
      for (int m = 0; m < s; ++m) {
        if (m != j) value *= -table.nodes[m] / (table.nodes[j] - table.nodes[m]);
      }
      row[j] = value;
    }
    return row;
  }

  const S& system_;
  double share_;
  Tolerance tolerance_;
  const collocation::Radau<s>& table_ = collocation::radau<s>();
  const collocation::RadauTransform<s>& transform_ = collocation::radau_transform<s>();
  Row derivative_ = begin_slope(table_);
  SmoothSegment segment_;
  Increments z_, w_, f_, last_, change_of_w_;
  State<n> x0_, x1_, carry_, change_, weight_, f0_, node_, slope_, update_;
  Jacobian<n> jacobian_;
  State<n> real_;
  Vector<std::complex<double>, n> complex_;
  RealLu real_lu_;
  std::array<ComplexLu, static_cast<std::size_t>((s - 1) / 2)> complex_lu_;
  double t0_ = 0, t1_ = 0, h_ = 1, last_length_ = 0, factored_ = 0, contraction_ = 0, eta_ = 1;
  int iterations_ = 0;
  bool has_jacobian_ = false, is_fresh_ = false, is_first_ = true, was_rejected_ = false;
};

}  // namespace nlmech::ivp::adaptive
