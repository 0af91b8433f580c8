/// @file
/// Taylor coefficients of the solutions of a system: from a tape, or from the problem itself where the
/// compiler sees it.
#pragma once

#include "nlmech/ivp/series/unrolled_taylor.hpp"
#include "nlmech/program/tape_expansion.hpp"
#include "nlmech/program/vector.hpp"

namespace nlmech::ivp {

/// What a system's taylor() gives, by its tape. Used so: begin_segment() at the begin of every stretch on
/// which the right-hand side is smooth, then expand() for every step, then coefficients().
/// @tparam S has `Tape record(double t) const`
template <class S>
class TapedTaylor {
 public:
  using State = typename S::State;  ///< all components

  /// @param system outlives this object
  /// @param order 1 or more
  TapedTaylor(const S& system, int order) : system_(system), order_(order) {}

  /// Records the right-hand side as it is at time @p t, which lies within the stretch.
  /// @throws std::invalid_argument for a branch that the problem has not announced
  void begin_segment(double t, const State& /*x*/) { expansion_.load(system_.record(t), order_); }
  /// Computes the coefficients at (t, x), that of order k times scale^k.
  void expand(double t, const State& x, double scale = 1) { expansion_.expand(t, x.data(), scale); }
  /// Coefficients 0 to order of component @p i.
  [[nodiscard]] const double* coefficients(int i) const { return expansion_.coefficients(i); }
  /// Order of the series.
  [[nodiscard]] int order() const { return order_; }
  /// What was recorded.
  [[nodiscard]] const Tape& tape() const { return expansion_.tape(); }

 private:
  const S& system_;
  int order_;
  TapeExpansion expansion_;
};

/// The same for a problem that the compiler sees: unrolled up to unrolled::most_order, beyond by a tape.
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
