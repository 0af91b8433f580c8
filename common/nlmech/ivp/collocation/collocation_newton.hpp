/// @file
/// Collocation at Radau nodes by Newton's iteration: the engine of adaptive-collocation for stiff problems.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <utility>

#include "nlmech/algebraic/dense_lu.hpp"
#include "nlmech/collocation/radau/radau_transform.hpp"
#include "nlmech/ivp/collocation/collocation_loops.hpp"
#include "nlmech/ivp/collocation/collocation_trial.hpp"
#include "nlmech/ivp/smooth_segment.hpp"
#include "nlmech/ivp/solution.hpp"
#include "nlmech/ivp/system.hpp"
#include "nlmech/support/statistics.hpp"

namespace nlmech::ivp::adaptive {

/// Steps with s nodes, s odd, by simplified Newton iterations on the increments z_i = x_i - x_0, with one
/// Jacobian for all nodes and, if it changes little, for many steps. In the coordinates of RadauTransform an
/// iteration solves one real and (s - 1)/2 complex systems of the size of the state (E. Hairer and G. Wanner,
/// Stiff differential equations solved by Radau methods, J. Comput. Appl. Math. 111 (1999) 93-111).
///
/// Error at the end of the step, e_i <= absolute + relative |x_i| at the start. The trial function has the
/// defect r, which is 0 at the nodes. The linear part of the equation propagates two samples of r, at the
/// start and at an inner time, to the end (collocation::RadauDefect). This estimate is exact up to a small
/// factor for linear equations with any spectrum, through transients that the step does not resolve, and
/// under order reduction by stiffness; it decreases like h^(2s) with superconvergence. It does not include
/// the quadrature error for a nonlinear solution: for coefficients that decay geometrically, the fraction
/// r_0/f of r_0. A tenth of that is added (in tests all of it is 10 to 100 times too large). In HIRES and
/// through the jumps of van der Pol's oscillator the errors of steps, where a tenth of the tolerance can be
/// verified, are at most 1.4 times the estimate, on average a quarter of it.
template <int s>
class NewtonSteps : public DenseOutput {
 public:
  /// @param setup system, tolerance and basis
  explicit NewtonSteps(const Setup& setup)
      : system_(setup.system),
        tolerance_(setup.tolerance),
        z_(Increments::Zero(s, system_.size())),
        w_(z_),
        f_(z_),
        last_(z_),
        change_of_w_(z_),
        x0_(State::Zero(system_.size())),
        x1_(x0_),
        carry_(x0_),
        change_(x0_),
        weight_(x0_),
        f0_(x0_),
        node_(x0_),
        slope_(x0_),
        begin_defect_(x0_),
        filtered_(x0_),
        carried_(x0_),
        jacobian_(Jacobian::Zero(system_.size(), system_.size())),
        real_(x0_),
        complex_(x0_.template cast<std::complex<double>>()),
        real_factors_(system_.size()),
        complex_factors_(of_each_pair(std::make_index_sequence<pairs>())) {}

  /// Starts a segment at (t, x).
  void begin_segment(double t, double end, const State& x, Statistics& statistics) {
    segment_ = SmoothSegment(t, end);
    x0_ = x;
    carry_.setZero();
    last_length_ = 0;
    left_before_ = 0;
    has_jacobian_ = false;
    system_.rhs(segment_(t), x, f0_);
    ++statistics.right_hand_sides;
  }
  /// Is the slope at the start finite?
  [[nodiscard]] bool begin_is_finite() const { return all_finite(f0_.data(), f0_.size()); }
  /// State at the start.
  [[nodiscard]] const State& begin_state() const { return x0_; }
  /// State at the end of the trial.
  [[nodiscard]] const State& end_state() const { return x1_; }
  /// h |J| (largest row sum) in the latest trial: stiffness of the problem for its step size.
  [[nodiscard]] double stiffness() const {
    return std::abs(h_) * jacobian_.cwiseAbs().rowwise().sum().maxCoeff();
  }

  /// Power of the step size in the error estimate; less where the problem is stiff.
  [[nodiscard]] int error_order() const { return 2 * s; }
  /// Trial step from the start, t, to t1.
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
    return trial;
  }
  /// Accepts the trial; its end becomes the start of the next step.
  void accept(Statistics& statistics) {
    std::swap(x0_, x1_);
    carry_ = change_;
    last_ = z_;
    last_length_ = h_;
    left_before_ = left_;
    // Evaluated, not taken from the trial function as (A^-1 z)_s/h, so that the next error estimate includes
    // the residual of Newton's iteration.
    system_.rhs(segment_(t1_), x0_, f0_);
    ++statistics.right_hand_sides;
    if (contraction_ > keep_jacobian) has_jacobian_ = false;
    is_fresh_ = false;
  }

  /// Continues from the state and trial function of another order.
  template <int other>
  [[gnu::noinline]] void continue_from(const NewtonSteps<other>& from) {
    segment_ = from.segment_;
    x0_ = from.x0_;
    carry_ = from.carry_;
    f0_ = from.f0_;
    h_ = from.h_;
    last_length_ = from.last_length_;
    left_before_ = from.left_before_;
    jacobian_ = from.jacobian_;
    has_jacobian_ = from.has_jacobian_;
    is_fresh_ = false;
    factored_ = 0;
    eta_ = 1;
    typename NewtonSteps<other>::Row row;
    for (int i = 0; i < s; ++i) {
      from.lagrange(table_.nodes[i], row);
      for (Eigen::Index d = 0; d < x0_.size(); ++d) last_(i, d) = dot<other>(row, from.nodes(from.last_, d));
    }
  }
  /// Change of order after a trial: 1 if Newton's iteration converges fast, so that more nodes allow larger
  /// steps; -1 if it converges slowly, which larger steps make worse (Hairer and Wanner); otherwise 0.
  [[nodiscard]] int better_order() const {
    if (contraction_ > 0.8) return -1;
    return contraction_ < 0.002 && iterations_ > 1 ? 1 : 0;
  }

  /// Dense output: the trial function, of order s + 1.
  void at(double t, State& x) const override {
    if (t == t0_ || t == t1_) {
      x = t == t0_ ? x0_ : x1_;
      return;
    }
    Row row;
    lagrange((t - t0_) / h_, row);
    x.resize(x0_.size());
    for (Eigen::Index d = 0; d < x0_.size(); ++d) x[d] = x0_[d] + dot<s>(row, nodes(z_, d));
  }

 private:
  template <int>
  friend class NewtonSteps;
  using Increments = Eigen::Matrix<double, s, Eigen::Dynamic>;  // at all nodes, one component per column
  using Row = Column<s>;                                        // a number for each node
  using ComplexFactors = algebraic::DenseLu<std::complex<double>>;
  static constexpr std::size_t pairs = (s - 1) / 2;  // pairs of complex eigenvalues
  static constexpr int most_iterations = 7 + (s - 3) * 5 / 2;
  static constexpr double keep_jacobian = 1e-3;  // largest contraction that keeps the Jacobian
  static constexpr double share = 0.05;          // residual of the iteration, in tolerances
  static constexpr double enlarged = 2;         // factor of the residual that is subtracted from the estimate
  static constexpr double visible = 0.1;        // smallest part of the estimate after the subtraction
  static constexpr double seen_in_tests = 0.1;  // factor of the quadrature error: see the class
  static constexpr double least_contraction = 1e-3;  // smallest one assumed at the start of an iteration

  template <std::size_t... p>
  [[nodiscard]] std::array<ComplexFactors, pairs> of_each_pair(std::index_sequence<p...> /*pairs*/) const {
    return {{(static_cast<void>(p), ComplexFactors(system_.size()))...}};
  }
  [[gnu::noinline]] void factor(Statistics& statistics) {
    real_factors_.compute(jacobian_, -1, transform_.real / h_);
    for (std::size_t p = 0; p < pairs; ++p)
      complex_factors_[p].compute(jacobian_, -1, transform_.complex[p] / h_);
    factored_ = h_;
    ++statistics.factorisations;
  }

  // z_j at the time t of the step: l_j(t) with the start as a further node, where z is 0.
  void lagrange(double t, Row& row) const {
    for (int j = 0; j < s; ++j) {
      double value = t * lagrange_scale_[j];
      for (int m = 0; m < s; ++m) {
        if (m != j) value *= t - table_.nodes[m];
      }
      row[j] = value;
    }
  }
  // Constant factors of the l_j.
  [[nodiscard]] static Row lagrange_scale(const Row& at) {
    Row scale;
    for (int j = 0; j < s; ++j) {
      double differences = at[j];
      for (int m = 0; m < s; ++m) {
        if (m != j) differences *= at[j] - at[m];
      }
      scale[j] = 1 / differences;
    }
    return scale;
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
        for (Eigen::Index d = 0; d < x0_.size(); ++d) z_(i, d) = dot<s>(row, nodes(last_, d));
      }
      if (!all_finite(z_.data(), z_.size())) z_.setZero();
    }
    combine(transform_.to, z_, w_);
  }
  // Component d at all nodes.
  [[nodiscard]] static const double* nodes(const Increments& of, Eigen::Index d) { return of.data() + d * s; }
  // Each component of `to` is A times that of `from`.
  static void combine(const Square<s>& a, const Increments& from, Increments& to) {
    for (Eigen::Index d = 0; d < from.cols(); ++d) multiply<s>(a, nodes(from, d), to.data() + d * s);
  }

  [[gnu::noinline]] Trial iterate(Statistics& statistics) {
    const double enough = std::max(share, 20 * std::numeric_limits<double>::epsilon() / least_relative());
    // The contraction of the last step is forgotten gradually.
    double eta = std::pow(std::max(eta_, least_contraction), 0.8);
    double before = HUGE_VAL, contraction_before = 0;
    contraction_ = 0;
    for (int count = 1;; ++count) {
      iterations_ = count;
      for (int i = 0; i < s; ++i) {
        for (Eigen::Index d = 0; d < x0_.size(); ++d) node_[d] = x0_[d] + z_(i, d);
        system_.rhs(segment_(i == s - 1 ? t1_ : t0_ + h_ * table_.nodes[i]), node_, slope_);
        for (Eigen::Index d = 0; d < x0_.size(); ++d) f_(i, d) = slope_[d];
      }
      statistics.right_hand_sides += s;
      const double size = solve(statistics);
      if (!std::isfinite(size)) return {false, 0, count, 0.5};
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
        left_ = eta * size + 4 * std::numeric_limits<double>::epsilon() / least_relative();
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
  // One iteration: (Lambda/h - J) dw = T^-1 f - Lambda w/h. @return the size of dz in tolerances
  [[gnu::noinline]] double solve(Statistics& statistics) {
    ++statistics.newton_iterations;
    const Eigen::Index size = x0_.size();
    combine(transform_.to, f_, change_of_w_);
    for (Eigen::Index d = 0; d < size; ++d) real_[d] = change_of_w_(0, d) - transform_.real / h_ * w_(0, d);
    real_factors_.solve(real_, real_);
    for (Eigen::Index d = 0; d < size; ++d) change_of_w_(0, d) = real_[d];
    for (std::size_t p = 0; p < pairs; ++p) {
      const auto a = static_cast<Eigen::Index>(2 * p + 1), b = a + 1;
      const std::complex<double> eigenvalue = transform_.complex[p] / h_;
      for (Eigen::Index d = 0; d < size; ++d)
        complex_[d] = std::complex<double>(change_of_w_(a, d), change_of_w_(b, d)) -
                      algebraic::product(eigenvalue, std::complex<double>(w_(a, d), w_(b, d)));
      complex_factors_[p].solve(complex_, complex_);
      for (Eigen::Index d = 0; d < size; ++d) {
        change_of_w_(a, d) = complex_[d].real();
        change_of_w_(b, d) = complex_[d].imag();
      }
    }
    for (Eigen::Index k = 0; k < w_.size(); ++k) w_.data()[k] += change_of_w_.data()[k];
    combine(transform_.from, w_, z_);
    combine(transform_.from, change_of_w_, f_);
    double most = 0;
    for (Eigen::Index d = 0; d < size; ++d) {
      for (int i = 0; i < s; ++i) {
        const double part = std::abs(f_(i, d)) / weight_[d];
        if (!(part <= most)) most = part;  // a NaN stays
      }
    }
    return most;
  }

  void finish() {
    for (Eigen::Index i = 0; i < x0_.size(); ++i) {
      const double whole = z_(s - 1, i) + carry_[i];
      x1_[i] = x0_[i] + whole;
      change_[i] = whole - (x1_[i] - x0_[i]);
    }
  }
  // See the class.
  [[gnu::noinline]] double error(Statistics& statistics) {
    const Eigen::Index size = x0_.size();
    // The defect at the start and at an inner time.
    for (Eigen::Index d = 0; d < size; ++d) {
      begin_defect_[d] = f0_[d] - dot<s>(defect_.begin_slope, nodes(z_, d)) / h_;
      node_[d] = x0_[d] + dot<s>(defect_.inner_value, nodes(z_, d));
    }
    system_.rhs(segment_(t0_ + h_ * defect_.inner_time), node_, slope_);
    ++statistics.right_hand_sides;
    for (Eigen::Index d = 0; d < size; ++d) slope_[d] -= dot<s>(defect_.inner_slope, nodes(z_, d)) / h_;
    filtered_ = begin_defect_;
    real_factors_.solve(filtered_, filtered_);
    for (Eigen::Index d = 0; d < size; ++d)
      carried_[d] = defect_.begin[0].real() * begin_defect_[d] + defect_.inner[0].real() * slope_[d];
    real_factors_.solve(carried_, carried_);
    for (std::size_t p = 0; p < pairs; ++p) {
      for (Eigen::Index d = 0; d < size; ++d)
        complex_[d] = defect_.begin[p + 1] * begin_defect_[d] + defect_.inner[p + 1] * slope_[d];
      complex_factors_[p].solve(complex_, complex_);
      for (Eigen::Index d = 0; d < size; ++d) carried_[d] += complex_[d].real();
    }
    double most = 0;
    for (Eigen::Index d = 0; d < size; ++d) {
      const double part = error_of(d) / weight_[d];
      if (!(part <= most)) most = part;  // a NaN stays
    }
    return most;
  }
  // Error estimate of component d: the propagated defect less the possible residual of the iteration, plus
  // the quadrature error.
  [[nodiscard]] double error_of(Eigen::Index d) const {
    const double change = largest<s>(nodes(z_, d));
    const double bend = std::abs(transform_.real * filtered_[d]);
    const double missed = bend > 0 ? bend * (bend / std::max(change, bend)) : 0;
    const double carried = std::abs(carried_[d]), rest = enlarged * (left_ + left_before_) * weight_[d];
    return std::max(visible * carried, carried - rest) + seen_in_tests * missed;
  }

  const System& system_;
  Tolerance tolerance_;
  const collocation::Radau<s>& table_ = collocation::radau<s>();
  const Row lagrange_scale_ = lagrange_scale(table_.nodes);
  const collocation::RadauTransform<s>& transform_ = collocation::radau_transform<s>();
  const collocation::RadauDefect<s>& defect_ = collocation::radau_defect<s>();
  SmoothSegment segment_;
  Increments z_, w_, f_, last_, change_of_w_;
  State x0_, x1_, carry_, change_, weight_, f0_, node_, slope_, begin_defect_, filtered_, carried_;
  Jacobian jacobian_;
  State real_;
  Eigen::VectorXcd complex_;
  algebraic::DenseLu<double> real_factors_;
  std::array<ComplexFactors, pairs> complex_factors_;
  double t0_ = 0, t1_ = 0, h_ = 1, last_length_ = 0, factored_ = 0, contraction_ = 0, eta_ = 1, left_ = 0,
         left_before_ = 0;
  int iterations_ = 0;
  bool has_jacobian_ = false, is_fresh_ = false;
};

}  // namespace nlmech::ivp::adaptive
