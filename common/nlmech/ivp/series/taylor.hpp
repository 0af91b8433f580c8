/// @file
/// Taylor coefficients of the solutions of a system: from a tape, or inlined from the problem.
#pragma once

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "nlmech/program/tape_expansion.hpp"
#include "nlmech/program/unrolled_series.hpp"
#include "nlmech/program/vector.hpp"

namespace nlmech::ivp {

/// Taylor coefficients of the solution through a point, by the problem with the scalar UnrolledSeries: one
/// function per order, with all sums unrolled. The order is chosen at run time up to unrolled::most_order.
///
/// Fastest for small problems; a problem of many operations exceeds the instruction cache and is faster with
/// a tape.
/// @tparam most highest order, up to unrolled::most_order: each is a function to compile
template <class Problem, int most = unrolled::most_order>
class UnrolledTaylor {
 public:
  static constexpr int n = Problem::dimension;  ///< components of the state

  /// @param problem outlives this object
  /// @param order from 1 to most
  /// @param announced has the problem a member discontinuities(t0, t1)?
  UnrolledTaylor(const Problem& problem, int order, bool announced)
      : problem_(problem), order_(order), announced_(announced) {}

  /// Starts an interval on which the right-hand side is smooth and allocates the memory.
  /// @throws std::invalid_argument for a branch for which the problem gives no discontinuities
  void begin_segment(double t, const Vector<double, n>& x) {
    using S = UnrolledSeries<-1>;
    UnrolledPass<-1> pass{nullptr, n + 1, announced_};
    Vector<S, n> state, slope;
    const S time = S::variable(pass, 0, t, true);
    for (int i = 0; i < n; ++i) state[i] = S::variable(pass, i + 1, x[i], false);
    problem_(time, state, slope);
    memory_.assign(static_cast<std::size_t>(pass.used * unrolled::stride), 0.0);
  }

  /// Computes the coefficients at (t, x); that of order k is multiplied by scale^k. See
  /// TapeExpansion::expand().
  void expand(double t, const Vector<double, n>& x, double scale) {
    if (scale != scale_) {
      scale_ = scale;
      for (std::size_t k = 0; k < factor_.size(); ++k) factor_[k] = scale * (1 / static_cast<double>(k + 1));
    }
    double* const memory = memory_.data();
    memory[0] = t;
    memory[1] = scale;
    for (int i = 0; i < n; ++i) memory[(i + 1) * unrolled::stride] = x[i];
    run(memory, std::make_integer_sequence<int, most>());
  }

  /// Coefficients 0 to order of component @p i.
  [[nodiscard]] const double* coefficients(int i) const {
    return memory_.data() + (i + 1) * unrolled::stride;
  }

 private:
  // First coefficient of the state with a rounded reciprocal in place of a division.
  static constexpr int first_reciprocal = 8;

  template <int... k>
  void run(double* memory, std::integer_sequence<int, k...> /*orders*/) const {
    static_cast<void>(((k < order_ && (pass<k>(memory), true)) && ...));
  }

  // Coefficient k of every operation, k + 1 of the state.
  template <int k>
  [[gnu::flatten, gnu::noinline]] void pass(double* memory) const {
    using S = UnrolledSeries<k>;
    UnrolledPass<k> pass{memory, n + 1, announced_};
    Vector<S, n> state, slope;
    const S time = S::variable(pass, 0, memory[k], true);
    for (int i = 0; i < n; ++i)
      state[i] = S::variable(pass, i + 1, memory[(i + 1) * unrolled::stride + k], false);
    problem_(time, state, slope);
    for (int i = 0; i < n; ++i) {
      const double f = slope[i].coefficient();
      double& next = memory[(i + 1) * unrolled::stride + k + 1];
      if constexpr (k < first_reciprocal) {
        next = scale_ * f / (k + 1);
      } else {
        next = f * factor_[k];
      }
    }
  }

  const Problem& problem_;
  int order_;
  bool announced_;
  double scale_ = 0;
  std::array<double, static_cast<std::size_t>(most)> factor_{};
  std::vector<double> memory_;
};

/// Taylor coefficients of a system by its tape. Usage: begin_segment() at the start of every interval on
/// which the right-hand side is smooth, then expand() for every step, then coefficients().
/// @tparam S has `Tape record(double t) const` and `machine_code::SeriesCodes& series_codes() const`
template <class S>
class TapedTaylor {
 public:
  using State = typename S::State;  ///< all components

  /// @param system outlives this object
  /// @param order 1 or more
  TapedTaylor(const S& system, int order) : system_(system), order_(order) {}

  /// Records the right-hand side at time @p t, which lies within the interval.
  /// @throws std::invalid_argument for a branch for which the problem gives no discontinuities
  void begin_segment(double t, const State& /*x*/) {
    expansion_.load(system_.record(t), order_, &system_.series_codes());
  }
  /// Computes the coefficients at (t, x); that of order k is multiplied by scale^k.
  void expand(double t, const State& x, double scale = 1) { expansion_.expand(t, x.data(), scale); }
  /// Coefficients 0 to order of component @p i.
  [[nodiscard]] const double* coefficients(int i) const { return expansion_.coefficients(i); }
  /// Order of the series.
  [[nodiscard]] int order() const { return order_; }
  /// The recorded right-hand side.
  [[nodiscard]] const Tape& tape() const { return expansion_.tape(); }

 private:
  const S& system_;
  int order_;
  TapeExpansion expansion_;
};

/// Taylor coefficients of an inlined problem: unrolled up to unrolled::most_order, by a tape above it.
template <class S, class Problem>
class DirectTaylor {
 public:
  using State = typename S::State;  ///< all components

  /// @param system outlives this object
  /// @param order 1 or more
  /// @param announced has the problem a member discontinuities(t0, t1)?
  DirectTaylor(const S& system, int order, bool announced)
      : order_(order), unrolled_(system.problem(), order, announced), taped_(system, order) {}

  /// As TapedTaylor.
  void begin_segment(double t, const State& x) {
    if (is_unrolled()) {
      unrolled_.begin_segment(t, x);
    } else {
      taped_.begin_segment(t, x);
    }
  }
  /// As TapedTaylor.
  void expand(double t, const State& x, double scale = 1) {
    if (is_unrolled()) {
      unrolled_.expand(t, x, scale);
    } else {
      taped_.expand(t, x, scale);
    }
  }
  /// As TapedTaylor.
  [[nodiscard]] const double* coefficients(int i) const {
    return is_unrolled() ? unrolled_.coefficients(i) : taped_.coefficients(i);
  }
  /// Order of the series.
  [[nodiscard]] int order() const { return order_; }

 private:
  [[nodiscard]] bool is_unrolled() const { return order_ <= unrolled::most_order; }

  int order_;
  UnrolledTaylor<Problem> unrolled_;
  TapedTaylor<S> taped_;
};

}  // namespace nlmech::ivp
