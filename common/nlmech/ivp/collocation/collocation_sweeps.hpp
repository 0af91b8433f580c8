/// @file
/// Collocation at Radau nodes by sweeps: the engine of adaptive-collocation for problems that are not stiff.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string_view>
#include <utility>

#include "nlmech/collocation/radau/radau.hpp"
#include "nlmech/collocation/radial/stable_gaussian.hpp"
#include "nlmech/ivp/collocation/collocation_loops.hpp"
#include "nlmech/ivp/collocation/collocation_trial.hpp"
#include "nlmech/ivp/second_order.hpp"
#include "nlmech/ivp/smooth_segment.hpp"
#include "nlmech/ivp/solution.hpp"
#include "nlmech/support/statistics.hpp"

namespace nlmech::ivp::adaptive {

/// Steps with s nodes. The unknowns are the slopes at the nodes: accelerations of a second-order problem,
/// otherwise all of dx/dt; states follow from them by quadrature. A sweep evaluates the slope at each node
/// from left to right and corrects all states immediately (Gauss-Seidel; modified Chebyshev-Picard iteration
/// corrects at the end of a sweep and needs twice as many). The first sweep starts from the extrapolated
/// polynomial of the last step.
///
/// Error at the end of the step. The trial function p has the defect r(t) = f(t, p) - p', which is 0 at the
/// nodes and so, to leading order, r_0 times the Radau polynomial; r_0 follows from f at the start. That
/// polynomial is orthogonal to all polynomials of degree < s - 1, so r affects the end only through the part
/// of the slope of higher degree, a fraction r_0/max|f| if both decay alike. So the estimate is h
/// r_0^2/max|f|, with the last Legendre coefficients of the slope in place of r_0 where they are larger.
/// @tparam second are the unknowns accelerations?
template <int s, bool second>
class Sweeper : public DenseOutput {
 public:
  using Slope = State;                                      ///< unknowns at a node
  using Slopes = Eigen::Matrix<double, s, Eigen::Dynamic>;  ///< at all nodes, one component per column
  static constexpr std::string_view name = "adaptive-collocation";  ///< for messages

  /// @param setup system, tolerance and basis
  explicit Sweeper(const Setup& setup)
      : system_(setup.system),
        tolerance_(setup.tolerance),
        shape_(setup.shape),
        x_(Eigen::Matrix<double, s, Eigen::Dynamic>::Zero(s, system_.size())),
        f_(Slopes::Zero(s, second ? system_.size() / 2 : system_.size())),
        last_(f_),
        x0_(State::Zero(system_.size())),
        x1_(x0_),
        carry_(x0_),
        change_(x0_),
        per_tolerance_(x0_),
        f0_(Slope::Zero(f_.cols())),
        new_(f0_),
        q_(f0_),
        v_(f0_) {}

  /// Starts a segment at (t, x).
  void begin_segment(double t, double end, const State& x, Statistics& statistics) {
    segment_ = SmoothSegment(t, end);
    x0_ = x;
    carry_.setZero();
    last_length_ = 0;
    slope(t, x, f0_);
    ++statistics.right_hand_sides;
  }
  /// Is the slope at the start finite?
  [[nodiscard]] bool begin_is_finite() const { return all_finite(f0_.data(), f0_.size()); }
  /// State at the start.
  [[nodiscard]] const State& begin_state() const { return x0_; }
  /// State at the end of the trial.
  [[nodiscard]] const State& end_state() const { return x1_; }
  /// First step size: the time in which the state @p x0, by the slope at the start, changes by a tenth of its
  /// size or by one tolerance if it is zero; at most @p interval.
  [[nodiscard]] double first_length(const State& x0, double interval) const {
    const Eigen::Index m = f_.cols();
    double size = 0, rate = 0;
    for (Eigen::Index i = 0; i < x0.size(); ++i) {
      const double tolerance = tolerance_.absolute + tolerance_.relative * std::abs(x0[i]);
      const double change = second && i < m ? x0[m + i] : f0_[second ? i - m : i];
      size = std::max(size, std::abs(x0[i]) / tolerance);
      rate = std::max(rate, std::abs(change) / tolerance);
    }
    const double change = std::max(first_share * size, 1.);
    return rate * interval > change ? change / rate : interval;
  }

  /// Power of the step size in the error estimate.
  [[nodiscard]] int error_order() const { return shape_ > 0 ? s + 1 : 2 * s; }
  /// Trial step from the start, t, to t1.
  Trial attempt(double t, double t1, Statistics& statistics) {
    t0_ = t;
    h_ = t1 - t;
    t1_ = t1;
    if (shape_ > 0 && !make_table()) return {false, 0, 0, 0.5};
    predict();
    return sweep(statistics, true);
  }
  /// Accepts the trial; its end becomes the start of the next step.
  void accept(Statistics& /*statistics*/) {
    std::swap(x0_, x1_);
    carry_ = change_;
    for (Eigen::Index d = 0; d < f0_.size(); ++d) f0_[d] = f_(s - 1, d);
    std::swap(f_, last_);
    last_length_ = h_;
  }
  /// Continues from the state and trial function of another order.
  template <int other>
  [[gnu::noinline]] void continue_from(const Sweeper<other, second>& from) {
    segment_ = from.segment_;
    x0_ = from.x0_;
    carry_ = from.carry_;
    f0_ = from.f0_;
    last_length_ = from.last_length_;
    for (Eigen::Index d = 0; d < last_.cols(); ++d) {
      double c[other];
      multiply<other>(from.table_->legendre, from.last_.data() + d * other, c);
      legendre_sums<s>(c, other - 1, positions_after(-1, 2), last_.data() + d * s);
    }
  }
  /// Change of order after a trial: 1 or -1 if s + 4 or s - 4 nodes are cheaper, otherwise 0.
  ///
  /// For a solution with singularities at a distance R the last coefficient of the slope is about F (h/R)^s.
  /// The estimate E (h/R)^{2s} = 1 with E = h F/tolerance allows the step size R E^{-1/(2s)}. A sweep costs s
  /// evaluations, and an overhead of two more (measured). So more nodes are cheaper for large E, that is if
  /// the state changes by many tolerances in a step.
  [[nodiscard]] int better_order() const {
    if (shape_ > 0) return 0;
    const auto cost = [&](int nodes) { return (nodes + 2) * std::pow(scale_, 0.5 / nodes); };
    if (least_order_gain * cost(s + 4) < cost(s)) return 1;
    return least_order_gain * cost(s - 4) < cost(s) ? -1 : 0;
  }

  /// Dense output: solves the equations of the latest trial up to @p t; as accurate as its end.
  void at(double t, State& x) const override {
    if (t == t0_ || t == t1_) {
      x = t == t0_ ? x0_ : x1_;
      return;
    }
    Sweeper part(*this);
    part.t1_ = t;
    part.h_ = t - t0_;
    if (shape_ > 0) static_cast<void>(part.make_table());
    part.interpolate((t - t0_) / h_, part.f_);
    part.form_states();
    Statistics unused;
    (void)part.sweep(unused, false);
    x = part.x1_;
  }

 private:
  template <int, bool>
  friend class Sweeper;
  static constexpr double least_order_gain = 1.03;  ///< smallest gain for a change of order
  static constexpr double first_share = 0.1;        ///< relative change of the state in the first step
  static constexpr int most_sweeps = 40;
  static constexpr double most_predicted_sweeps = 16;  ///< limit; more cost more than two steps
  static constexpr double slowest = 0.9;               ///< contraction of a sweep above which the trial ends
  static constexpr double abandon_ratio = 100;         ///< estimate over tolerance that ends a trial early
  static constexpr double share = 0.05;                ///< residual of the iteration, in tolerances
  static constexpr double outside = 10;
  static constexpr int most_extrapolated = 9;  ///< largest degree used for extrapolation

  void slope(double t, const State& x, Slope& f) {
    if constexpr (second) {
      q_ = positions(x);
      v_ = velocities(x);
      system_.acceleration(segment_(t), q_, v_, f);
    } else {
      system_.rhs(segment_(t), x, f);
    }
  }
  void slope_at_node(int i) {
    const double t = i == s - 1 ? t1_ : t0_ + h_ * table_->nodes[i];
    if constexpr (second) {
      const Eigen::Index m = f_.cols();
      for (Eigen::Index d = 0; d < m; ++d) {
        q_[d] = x_(i, d);
        v_[d] = x_(i, m + d);
      }
      system_.acceleration(segment_(t), q_, v_, new_);
    } else {
      for (Eigen::Index d = 0; d < f_.cols(); ++d) q_[d] = x_(i, d);
      system_.rhs(segment_(t), q_, new_);
    }
  }

  // Makes the tables of the Gaussians of this step. @return false if they are too narrow: the step must be
  // reduced
  [[nodiscard]] bool make_table() {
    const double narrow = shape_ * std::abs(h_);
    if (!(narrow <= collocation::StableGaussian::largest_shape)) return false;
    if (narrow == narrow_ && table_ == own_.get()) return true;
    own_ = std::make_shared<collocation::Radau<s>>();
    narrow_ = narrow;
    table_ = own_.get();
    return collocation::gaussian_radau<s>(narrow, *own_);
  }
  // Extrapolates the slope of the last step, without the high coefficients, which are inaccurate outside it.
  [[gnu::noinline]] void predict() {
    const double ratio = last_length_ != 0 ? h_ / last_length_ : HUGE_VAL;
    const bool is_continued = ratio > 0 && ratio < 3;
    const Column<s> positions = positions_after(1, 2 * ratio);
    for (Eigen::Index d = 0; d < f_.cols(); ++d) {
      double* const f = slopes(d);
      if (is_continued) {
        double c[s];
        multiply<s>(table_->legendre, last_.data() + d * s, c);
        legendre_sums<s>(c, std::min(s - 1, most_extrapolated), positions, f);
      }
      if (!is_continued || !all_finite(f, s)) std::fill_n(f, s, f0_[d]);
    }
    form_states();
  }
  // The slope of the latest trial at the nodes of its first @p part.
  void interpolate(double part, Slopes& to) const {
    for (Eigen::Index d = 0; d < f_.cols(); ++d) {
      double c[s];
      multiply<s>(table_->legendre, f_.data() + d * s, c);
      legendre_sums<s>(c, s - 1, positions_after(-1, 2 * part), to.data() + d * s);
    }
  }
  // The nodes of a step from @p begin of size @p length, in the coordinate of P_k (-1 to 1 over the last
  // step).
  [[nodiscard]] Column<s> positions_after(double begin, double length) const {
    Column<s> x;
    for (int i = 0; i < s; ++i) x[i] = begin + length * table_->nodes[i];
    return x;
  }
  // Component d of the slopes, of the states.
  [[nodiscard]] double* slopes(Eigen::Index d) { return f_.data() + d * s; }
  [[nodiscard]] const double* slopes(Eigen::Index d) const { return f_.data() + d * s; }
  [[nodiscard]] double* states(Eigen::Index i) { return x_.data() + i * s; }

  // Computes the states at the nodes from the slopes, and the tolerances from the states.
  [[gnu::noinline]] void form_states() {
    const Eigen::Index m = f_.cols();
    for (Eigen::Index d = 0; d < m; ++d) {
      double* const x = states(d);
      if constexpr (second) {
        double* const v = states(m + d);
        multiply<s>(table_->twice, slopes(d), x);
        multiply<s>(table_->integral, slopes(d), v);
        for (int i = 0; i < s; ++i) {
          x[i] = x0_[d] + (h_ * h_ * x[i] + h_ * x0_[m + d] * table_->nodes[i]);
          v[i] = x0_[m + d] + h_ * v[i];
        }
      } else {
        multiply<s>(table_->integral, slopes(d), x);
        for (int i = 0; i < s; ++i) x[i] = x0_[d] + h_ * x[i];
      }
    }
    form_tolerances();
  }
  void form_tolerances() {
    for (Eigen::Index i = 0; i < x0_.size(); ++i) {
      const double size = std::max(std::abs(x0_[i]), largest<s>(states(i)));
      per_tolerance_[i] = 1 / (tolerance_.absolute + tolerance_.relative * size);
    }
  }

  // Change of the state over the step by a slope of this size in component d, in tolerances.
  [[nodiscard]] double measure(Eigen::Index d, double size) const {
    const double change = std::abs(h_) * size;
    if constexpr (second) {
      return std::max(change * per_tolerance_[f_.cols() + d], change * std::abs(h_) / 2 * per_tolerance_[d]);
    } else {
      return change * per_tolerance_[d];
    }
  }

  [[gnu::noinline]] Trial sweep(Statistics& statistics, bool may_give_up) {
    double before = HUGE_VAL;
    for (int count = 1;; ++count) {
      double update = 0;
      for (int i = 0; i < s; ++i) update = std::max(update, correct(i));
      statistics.right_hand_sides += s;
      // The extrapolated states may be of any size, so the tolerances are computed again after the first
      // sweep.
      if (count == 1) form_tolerances();
      // Divergent sweeps overflow within a few; infinities must not count as convergence.
      const double rounding = noise();
      if (!std::isfinite(update) || !std::isfinite(rounding)) return {false, 0, count, 0.5};
      const double contraction = update / before;
      // A correction at the level of rounding cannot decrease.
      const bool done =
          (contraction < 1 && update * contraction / (1 - contraction) < share) || update <= rounding;
      if (done && (count > 1 || update == 0)) {
        finish();
        form_tolerances();
        // The residual of the iteration is subtracted from the estimate; the polynomial amplifies it outside
        // the nodes.
        return {all_finite(x1_.data(), x1_.size()), error(outside * update * std::min(contraction, 1.)),
                count, 0};
      }
      if (count == most_sweeps || (count > 3 && contraction > slowest)) return {false, 0, count, 0.5};
      const double excess = update / std::max(share, rounding);
      if (may_give_up && count > 3 &&
          count - std::log(excess) / std::log(contraction) > most_predicted_sweeps)
        return {false, 0, count, 0.5};
      if (may_give_up && count == 3) {
        if (const double e = error(0); e > abandon_ratio) return {false, e, count, 0};
      }
      before = update;
    }
  }
  // Updates the slope at node i and all states. @return the change of the state in tolerances
  double correct(int i) {
    slope_at_node(i);
    double update = 0;
    const Eigen::Index m = f_.cols();
    for (Eigen::Index d = 0; d < m; ++d) {
      const double difference = new_[d] - f_(i, d);
      f_(i, d) = new_[d];
      const double part = measure(d, std::abs(difference));
      if (!(part <= update)) update = part;  // a NaN stays
      const double change = h_ * difference;
      if constexpr (second) {
        add_column<s>(table_->twice, i, h_ * change, states(d));
        add_column<s>(table_->integral, i, change, states(m + d));
      } else {
        add_column<s>(table_->integral, i, change, states(d));
      }
    }
    return update;
  }
  [[nodiscard]] double noise() const {
    double largest = 0;
    for (Eigen::Index i = 0; i < x0_.size(); ++i)
      largest = std::max(largest, x1_bound(i) * per_tolerance_[i]);
    return 4 * std::numeric_limits<double>::epsilon() * largest;
  }
  [[nodiscard]] double x1_bound(Eigen::Index i) const {
    return std::max(std::abs(x0_[i]), std::abs(x_(s - 1, i)));
  }

  // Computes the end state from the slopes, without the rounding of the corrections, as a compensated sum.
  void finish() {
    const Eigen::Index m = f_.cols();
    for (Eigen::Index d = 0; d < m; ++d) {
      const double integral = h_ * row_times<s>(table_->integral, s - 1, slopes(d));
      if constexpr (second) {
        add(d, h_ * x0_[m + d] + h_ * h_ * row_times<s>(table_->twice, s - 1, slopes(d)));
        add(m + d, integral);
      } else {
        add(d, integral);
      }
    }
  }
  void add(Eigen::Index i, double increment) {
    const double whole = increment + carry_[i];
    x1_[i] = x0_[i] + whole;
    change_[i] = whole - (x1_[i] - x0_[i]);
  }

  // See the class.
  [[gnu::noinline]] [[nodiscard]] double error(double left) {
    double residual = 0, size = 0;
    for (Eigen::Index d = 0; d < f_.cols(); ++d) {
      const double* const f = slopes(d);
      const double begin = std::abs(dot<s>(table_->left, f) - f0_[d]);
      const double tail = std::max(std::abs(row_times<s>(table_->legendre, s - 1, f)),
                                   std::abs(row_times<s>(table_->legendre, s - 2, f)));
      residual = std::max(residual, measure(d, std::max(begin, tail)));
      size = std::max(size, measure(d, largest<s>(f)));
    }
    scale_ = std::max(size, 1.);
    residual -= left;
    if (shape_ > 0) return std::max(residual, 0.);  // Gaussians are not orthogonal
    return residual > 0 ? residual * (residual / std::max(size, residual)) : 0;
  }

  const System& system_;
  Tolerance tolerance_;
  double shape_;
  // Tables of the polynomials; those of Gaussians change with the step and are in own_.
  const collocation::Radau<s>* table_ = &collocation::radau<s>();
  std::shared_ptr<collocation::Radau<s>> own_;
  SmoothSegment segment_;
  Eigen::Matrix<double, s, Eigen::Dynamic> x_;  // states at the nodes, one component per column
  Slopes f_, last_;                             // slopes at the nodes in this and the last step
  State x0_, x1_, carry_, change_, per_tolerance_;
  Slope f0_, new_, q_, v_;
  double t0_ = 0, t1_ = 0, h_ = 1, last_length_ = 0, scale_ = 1, narrow_ = 0;
};

}  // namespace nlmech::ivp::adaptive
