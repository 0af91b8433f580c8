/// @file
/// Collocation at Radau nodes by sweeps: the engine of adaptive-collocation for problems that are not stiff.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>

#include "nlmech/collocation/radau.hpp"
#include "nlmech/ivp/collocation_trial.hpp"
#include "nlmech/ivp/second_order.hpp"
#include "nlmech/ivp/smooth_segment.hpp"
#include "nlmech/ivp/solution.hpp"
#include "nlmech/support/statistics.hpp"

namespace nlmech::ivp::adaptive {

/// Steps of s nodes. The unknowns are the slopes at the nodes: accelerations of a second-order problem, else
/// all of dx/dt; states follow from them by quadrature. A sweep goes through the nodes from left to right,
/// asks the equation for the slope at the state there, and corrects all states at once (Gauss-Seidel, where
/// modified Chebyshev-Picard iteration waits until the end of the sweep, which takes twice as many). The
/// first sweep starts from the polynomial of the step before.
///
/// Error at the end of the step. The trial function p fails the equation by r(t) = f(t, p) - p', which is 0
/// at the nodes and so, to leading order, r_0 times the Radau polynomial; f at the begin is known, and r_0
/// with it. The polynomial is orthogonal to all of degree < s - 1: r acts on the end only through what the
/// solution's slope has beyond that degree, a share r_0/max|f| of it if both decay alike. So the estimate is
/// h r_0^2/max|f|, with the last Legendre coefficients of the slope in place of r_0 where they are larger.
/// @tparam second are the unknowns accelerations?
template <SystemLike S, int s, bool second>
class Sweeper : public DenseOutput<S::dimension> {
 public:
  static constexpr int error_order = 2 * s;                         ///< of the estimate in the step
  static constexpr int n = S::dimension;                            ///< components of the state
  using Slope = Vector<double, second ? half<n> : n>;               ///< what is unknown at a node
  static constexpr std::string_view name = "adaptive-collocation";  ///< in sentences

  /// @param system outlives the sweeper
  Sweeper(const S& system, const Tolerance& tolerance)
      : system_(system),
        tolerance_(tolerance),
        x_(s, system.size()),
        f_(s, second ? system.size() / 2 : system.size()),
        last_(f_),
        x0_(State<n>::Zero(system.size())),
        x1_(x0_),
        carry_(x0_),
        change_(x0_),
        weight_(x0_),
        f0_(Slope::Zero(f_.cols())),
        new_(f0_),
        q_(f0_),
        v_(f0_) {}

  /// Starts a segment at (t, x).
  void begin_segment(double t, double end, const State<n>& x, Statistics& statistics) {
    segment_ = SmoothSegment(t, end);
    x0_ = x;
    carry_.setZero();
    last_length_ = 0;
    slope(t, x, f0_);
    ++statistics.right_hand_sides;
  }
  /// Is the slope at the begin finite?
  [[nodiscard]] bool begin_is_finite() const { return f0_.allFinite(); }
  /// State at the begin.
  [[nodiscard]] const State<n>& begin_state() const { return x0_; }
  /// State at the end of the trial.
  [[nodiscard]] const State<n>& end_state() const { return x1_; }
  /// A time in which the state, @p x0 with the slope at the begin, changes by a tenth of its size.
  [[nodiscard]] double first_length(const State<n>& x0, double interval) const {
    const Eigen::Index m = f_.cols();
    double rate = 0;
    for (Eigen::Index i = 0; i < x0.size(); ++i) {
      const double size = std::max(std::abs(x0[i]), tolerance_.absolute);
      const double change = second && i < m ? x0[m + i] : f0_[second ? i - m : i];
      rate = std::max(rate, std::abs(change) / size);
    }
    return rate * interval > first_share ? first_share / rate : interval;
  }

  /// Goes from the begin, t, to t1.
  Trial attempt(double t, double t1, Statistics& statistics) {
    t0_ = t;
    h_ = t1 - t;
    t1_ = t1;
    predict();
    return sweep(statistics, true);
  }
  /// Takes the trial for the begin of the next.
  void accept() {
    std::swap(x0_, x1_);
    carry_ = change_;
    f0_ = f_.row(s - 1);
    std::swap(f_, last_);
    last_length_ = h_;
  }

  /// The same equations on the part of the latest trial up to @p t: as accurate as its end.
  void at(double t, State<n>& x) const override {
    Sweeper part(*this);
    part.t1_ = t;
    part.h_ = t - t0_;
    part.interpolate((t - t0_) / h_, part.f_);
    part.form_states();
    Statistics unused;
    (void)part.sweep(unused, false);
    x = part.x1_;
  }

 private:
  static constexpr double first_share = 0.1;  ///< of a state's size, in the first step
  static constexpr int most_sweeps = 40;
  static constexpr double slowest = 0.9;  ///< contraction of a sweep with which there is no point in going on
  static constexpr double hopeless = 100;  ///< estimate over tolerance that ends a trial before it converges
  static constexpr double share = 0.05;    ///< of the tolerance that the iteration may leave
  static constexpr double outside = 10;
  static constexpr int most_extrapolated = 7;  ///< degree that is trusted outside the interval

  void slope(double t, const State<n>& x, Slope& f) {
    if constexpr (second) {
      q_ = positions(x);
      v_ = velocities(x);
      system_.acceleration(segment_(t), q_, v_, f);
    } else {
      system_.rhs(segment_(t), x, f);
    }
  }
  void slope_at_node(int i) {
    const double t = i == s - 1 ? t1_ : t0_ + h_ * table_.nodes[i];
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

  // The slope of the step before, continued; its high coefficients say nothing outside.
  void predict() {
    const double ratio = last_length_ != 0 ? h_ / last_length_ : HUGE_VAL;
    if (!(ratio > 0 && ratio < 3)) {
      f_.rowwise() = f0_.transpose();
    } else {
      constexpr int degree = std::min(s - 1, most_extrapolated);
      for (Eigen::Index d = 0; d < f_.cols(); ++d) {
        Eigen::Matrix<double, degree + 1, 1> c =
            table_.legendre.template topRows<degree + 1>() * last_.col(d);
        for (int i = 0; i < s; ++i) f_(i, d) = legendre_sum<degree>(c, 1 + 2 * ratio * table_.nodes[i]);
        if (!f_.col(d).allFinite()) f_.col(d).setConstant(f0_[d]);
      }
    }
    form_states();
  }
  // The slope of the latest trial at the nodes of its first part.
  void interpolate(double part, Eigen::Matrix<double, s, Slope::RowsAtCompileTime>& to) const {
    for (Eigen::Index d = 0; d < f_.cols(); ++d) {
      const typename collocation::Radau<s>::Column c = table_.legendre * f_.col(d);
      for (int i = 0; i < s; ++i) to(i, d) = legendre_sum<s - 1>(c, 2 * part * table_.nodes[i] - 1);
    }
  }
  // Clenshaw's recurrence.
  template <int degree>
  [[nodiscard]] static double legendre_sum(const Eigen::Matrix<double, degree + 1, 1>& c, double x) {
    double b = 0, above = 0;
    for (int j = degree; j >= 1; --j) {
      const double next = c[j] + (2 * j + 1) * x / (j + 1) * b - static_cast<double>(j + 1) / (j + 2) * above;
      above = b;
      b = next;
    }
    return c[0] + x * b - above / 2;
  }

  // States at the nodes from slopes, and the tolerances that belong to their size.
  void form_states() {
    const Eigen::Index m = f_.cols();
    for (Eigen::Index d = 0; d < m; ++d) {
      const auto f = f_.col(d);
      if constexpr (second) {
        x_.col(d) = (h_ * h_) * (table_.twice * f) + (h_ * x0_[m + d]) * table_.nodes;
        x_.col(d).array() += x0_[d];
        x_.col(m + d) = h_ * (table_.integral * f);
        x_.col(m + d).array() += x0_[m + d];
      } else {
        x_.col(d) = h_ * (table_.integral * f);
        x_.col(d).array() += x0_[d];
      }
    }
    for (Eigen::Index i = 0; i < x0_.size(); ++i) {
      const double size = std::max(std::abs(x0_[i]), x_.col(i).cwiseAbs().maxCoeff());
      weight_[i] = tolerance_.absolute + tolerance_.relative * size;
    }
  }

  // What a slope of this size in component d does to the state over the step, in units of the tolerance.
  [[nodiscard]] double measure(Eigen::Index d, double size) const {
    const double change = std::abs(h_) * size;
    if constexpr (second) {
      return std::max(change / weight_[f_.cols() + d], change * std::abs(h_) / 2 / weight_[d]);
    } else {
      return change / weight_[d];
    }
  }

  Trial sweep(Statistics& statistics, bool may_give_up) {
    double before = HUGE_VAL;
    for (int count = 1;; ++count) {
      double update = 0;
      for (int i = 0; i < s; ++i) update = std::max(update, correct(i));
      statistics.right_hand_sides += s;
      const double contraction = update / before;
      // A correction of nothing but rounding cannot become smaller.
      const bool done =
          (contraction < 1 && update * contraction / (1 - contraction) < share) || update <= noise();
      if (done && (count > 1 || update == 0)) {
        finish();
        // What the iteration has left is not the solution's: the polynomial enlarges it outside the nodes.
        return {x1_.allFinite(), error(outside * update * std::min(contraction, 1.)), count, 0};
      }
      if (count == most_sweeps || !std::isfinite(update) || (count > 3 && contraction > slowest))
        return {false, 0, count, 0.5};
      if (may_give_up && count == 3) {
        if (const double e = error(0); e > hopeless) return {false, e, count, 0};
      }
      before = update;
    }
  }
  // Puts the equation's slope at node i; how much that changes the state.
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
        x_.col(d) += (h_ * change) * table_.twice.col(i);
        x_.col(m + d) += change * table_.integral.col(i);
      } else {
        x_.col(d) += change * table_.integral.col(i);
      }
    }
    return update;
  }
  [[nodiscard]] double noise() const {
    double largest = 0;
    for (Eigen::Index i = 0; i < x0_.size(); ++i)
      largest = std::max(largest, std::abs(x1_bound(i)) / weight_[i]);
    return 4 * std::numeric_limits<double>::epsilon() * largest;
  }
  [[nodiscard]] double x1_bound(Eigen::Index i) const {
    return std::max(std::abs(x0_[i]), std::abs(x_(s - 1, i)));
  }

  // The state at the end anew from the slopes, so that corrections leave no rounding, with what the sum
  // before has cut off.
  void finish() {
    const Eigen::Index m = f_.cols();
    for (Eigen::Index d = 0; d < m; ++d) {
      const double integral = h_ * table_.integral.row(s - 1).dot(f_.col(d));
      if constexpr (second) {
        add(d, h_ * x0_[m + d] + h_ * h_ * table_.twice.row(s - 1).dot(f_.col(d)));
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
  [[nodiscard]] double error(double left) const {
    double residual = 0, size = 0;
    for (Eigen::Index d = 0; d < f_.cols(); ++d) {
      const auto f = f_.col(d);
      const double begin = std::abs(table_.left.dot(f) - f0_[d]);
      const double tail =
          std::max(std::abs(table_.legendre.row(s - 1).dot(f)), std::abs(table_.legendre.row(s - 2).dot(f)));
      residual = std::max(residual, measure(d, std::max(begin, tail)));
      size = std::max(size, measure(d, f.cwiseAbs().maxCoeff()));
    }
    residual -= left;
    return residual > 0 ? residual * (residual / std::max(size, residual)) : 0;
  }

  const S& system_;
  Tolerance tolerance_;
  const collocation::Radau<s>& table_ = collocation::radau<s>();
  SmoothSegment segment_;
  Eigen::Matrix<double, s, n> x_;                                // states at the nodes, a component a column
  Eigen::Matrix<double, s, Slope::RowsAtCompileTime> f_, last_;  // slopes there, now and in the step before
  State<n> x0_, x1_, carry_, change_, weight_;
  Slope f0_, new_, q_, v_;
  double t0_ = 0, t1_ = 0, h_ = 1, last_length_ = 0;
};

}  // namespace nlmech::ivp::adaptive
