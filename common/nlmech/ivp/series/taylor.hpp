/// @file
/// Taylor coefficients of the solutions of a system.
#pragma once

#include "nlmech/program/tape_expansion.hpp"

namespace nlmech::ivp {

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

}  // namespace nlmech::ivp
