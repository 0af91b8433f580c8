/// @file
/// The equations as libraries of other authors see them: arrays of doubles, whatever the system's own type
/// is.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <exception>
#include <limits>
#include <utility>
#include <vector>

#include "nlmech/ivp/smooth_segment.hpp"
#include "nlmech/ivp/system.hpp"

namespace nlmech::peers {

/// Is there no NaN and no infinity among the @p size numbers at @p x?
[[nodiscard]] inline bool all_finite(const double* x, int size) {
  bool finite = true;
  for (int i = 0; i < size; ++i) finite = finite && std::isfinite(x[i]);
  return finite;
}

/// dx/dt = f(t, x) on arrays. Every evaluation is counted here, so that the numbers of all peers mean the
/// same. f is asked for within the segment that enter() names, at its later end one double before: libraries
/// evaluate at the end of a step, some of them a rounding error beyond it, and a step that ends on a jump
/// must not see its other side.
class Equations {
 public:
  /// Of @p size components.
  explicit Equations(int size) : size_(size) {}
  Equations(const Equations&) = delete;
  Equations& operator=(const Equations&) = delete;
  virtual ~Equations() = default;

  /// Number of components of the state.
  [[nodiscard]] int size() const { return size_; }
  /// f(t, x) into @p f.
  virtual void rhs(double t, const double* x, double* f) = 0;
  /// df/dx into @p j, by columns.
  virtual void jacobian(double t, const double* x, double* j) = 0;
  /// df/dt at fixed x into @p dfdt: exact to rounding by dual numbers. For a problem that is written for
  /// double alone it is a difference over twice 6e-6 max(1, |t|), within the segment: central, of an error of
  /// some 1e-10, but one-sided, some 1e-6, near the ends. Its two evaluations of f count.
  virtual void time_derivative(double t, const double* x, double* dfdt) = 0;
  /// Times strictly between @p t0 and @p t1, in the direction of travel, at which f or a derivative jumps.
  [[nodiscard]] virtual std::vector<double> discontinuities(double t0, double t1) const = 0;

  /// From now on f is asked for between @p begin and @p end alone, in either order.
  void enter(double begin, double end) {
    earliest_ = std::min(begin, end);
    segment_ = ivp::SmoothSegment(begin, end);
  }
  /// Is a state or slope finite? Remembers if it is not.
  [[nodiscard]] bool check(const double* x) {
    const bool finite = all_finite(x, size_);
    if (!finite) met_non_finite_ = true;
    return finite;
  }
  /// Did check() meet a NaN or an infinity since this was asked last?
  [[nodiscard]] bool met_non_finite() { return std::exchange(met_non_finite_, false); }
  /// Evaluations of f so far.
  [[nodiscard]] std::int64_t right_hand_sides() const { return right_hand_sides_; }
  /// Evaluations of df/dx so far.
  [[nodiscard]] std::int64_t jacobians() const { return jacobians_; }

 protected:
  friend class Uncounted;
  /// The time within the segment that stands for @p t.
  [[nodiscard]] double inside(double t) const { return segment_(std::max(t, earliest_)); }
  std::int64_t right_hand_sides_ = 0;  ///< counted by rhs()
  std::int64_t jacobians_ = 0;         ///< counted by jacobian()

 private:
  int size_;
  bool met_non_finite_ = false;
  double earliest_ = -std::numeric_limits<double>::infinity();
  ivp::SmoothSegment segment_;
};

/// While one lives, evaluations do not count: those of dense output, which an integration without an observer
/// would not make.
class Uncounted {
 public:
  /// Notes the counts.
  explicit Uncounted(Equations& equations)
      : equations_(equations),
        right_hand_sides_(equations.right_hand_sides_),
        jacobians_(equations.jacobians_) {}
  /// Sets them back.
  ~Uncounted() {
    equations_.right_hand_sides_ = right_hand_sides_;
    equations_.jacobians_ = jacobians_;
  }
  Uncounted(const Uncounted&) = delete;
  Uncounted& operator=(const Uncounted&) = delete;

 private:
  Equations& equations_;
  std::int64_t right_hand_sides_, jacobians_;
};

/// The equations of a System, or of a Direct. Final, so that code that knows the type calls without
/// indirection.
template <ivp::SystemLike S>
class EquationsOf final : public Equations {
 public:
  using State = typename S::State;  ///< of the system

  /// @param system outlives this object
  explicit EquationsOf(const S& system)
      : Equations(system.size()),
        system_(system),
        x_(system.size()),
        f_(system.size()),
        j_(system.size(), system.size()) {}

  /// f(t, x) without a copy, for libraries that take the state's own type.
  void rhs(double t, const State& x, State& f) {
    ++right_hand_sides_;
    system_.rhs(inside(t), x, f);
  }
  void rhs(double t, const double* x, double* f) override {
    std::copy_n(x, x_.size(), x_.data());
    rhs(t, x_, f_);
    std::copy_n(f_.data(), f_.size(), f);
  }
  void jacobian(double t, const double* x, double* j) override {
    ++jacobians_;
    std::copy_n(x, x_.size(), x_.data());
    system_.jacobian(inside(t), x_, j_);
    std::copy_n(j_.data(), j_.size(), j);
  }
  void time_derivative(double t, const double* x, double* dfdt) override {
    std::copy_n(x, x_.size(), x_.data());
    if (!system_.time_derivative(inside(t), x_, f_)) {
      const double h = 6e-6 * std::max(1.0, std::abs(t)), before = inside(t - h), after = inside(t + h);
      State f(size());
      rhs(before, x_, f);
      rhs(after, x_, f_);
      f_ = ((f_ - f) / (after - before)).eval();
    }
    std::copy_n(f_.data(), f_.size(), dfdt);
  }
  [[nodiscard]] std::vector<double> discontinuities(double t0, double t1) const override {
    return system_.discontinuities(t0, t1);
  }

 private:
  const S& system_;
  State x_, f_;
  typename S::Jacobian j_;
};

/// Carries an exception past a C library: kept in the callback, thrown again once the library has returned.
class Rethrower {
 public:
  /// Calls @p work; gives its result, or @p failure if it throws.
  template <class Work>
  [[nodiscard]] int keep(int failure, Work&& work) noexcept {
    try {
      return std::forward<Work>(work)();
    } catch (...) {
      kept_ = std::current_exception();
      return failure;
    }
  }
  /// Throws what was kept, if anything was.
  void rethrow() {
    if (kept_) std::rethrow_exception(std::exchange(kept_, nullptr));
  }

 private:
  std::exception_ptr kept_;
};

}  // namespace nlmech::peers
