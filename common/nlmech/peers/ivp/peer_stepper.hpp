/// @file
/// The common walk of all peers: a library makes the steps, and everything that it could do wrong in silence
/// is watched here.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <exception>
#include <limits>
#include <string_view>
#include <utility>
#include <vector>

#include "nlmech/ivp/integrate.hpp"
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

/// What became of one try of a step.
struct Attempt {
  /// How a try ends.
  enum class Result {
    accepted,  ///< the state has moved
    rejected,  ///< a shorter step will be tried
    failed     ///< the library gives up: see failure
  };
  Result result = Result::accepted;  ///< how it ended
  double t = 0;                      ///< accepted: time reached
  double step = 0;                   ///< signed length that was tried
  Status failure;                    ///< failed: why
};

/// One integrator of a library on one system.
class PeerStepper {
 public:
  PeerStepper() = default;
  PeerStepper(const PeerStepper&) = delete;
  PeerStepper& operator=(const PeerStepper&) = delete;
  virtual ~PeerStepper() = default;

  /// Starts at (t, x) without memory of earlier steps. Steps will not pass @p end and will meet it exactly.
  [[nodiscard]] virtual Status begin(double t, const double* x, double end) = 0;
  /// Tries a step from where the latest accepted one ended. Libraries that repeat rejected steps themselves
  /// add them to statistics.rejected.
  [[nodiscard]] virtual Attempt attempt(double* x, Statistics& statistics) = 0;
  /// State at @p t within the latest accepted step; what cannot be computed is a failure of dense_output().
  virtual void at(double t, double* x) = 0;
  /// Did at() compute every state that it was asked for?
  [[nodiscard]] const Status& dense_output() const { return dense_output_; }
  /// Adds the library's counters of the work since begin().
  virtual void add_counters(Statistics& statistics) const = 0;

 protected:
  /// Notes that at() did not compute the state at @p t within the step from @p t0 to @p t1.
  void miss(std::string_view method, double t, double t0, double t1);

 private:
  Status dense_output_;
};

/// What an observer of a peer sees.
class ArrayObserver {
 public:
  ArrayObserver() = default;
  ArrayObserver(const ArrayObserver&) = delete;
  ArrayObserver& operator=(const ArrayObserver&) = delete;
  virtual ~ArrayObserver() = default;
  /// An accepted step; false ends the integration.
  virtual bool step(std::int64_t index, double t0, double t1, const double* x0, const double* x1,
                    PeerStepper& stepper) = 0;
};

/// One integration by a peer: what is asked, and what has been reached.
struct Run {
  Equations& equations;       ///< dx/dt = f(t, x)
  double t;                   ///< begin; then the time reached
  double t1;                  ///< end, another time than the start
  double* x;                  ///< state at t
  const ivp::Limits& limits;  ///< bounds on the work
  ArrayObserver* observer;    ///< may be null
  Statistics statistics;      ///< what it cost; seconds are not filled
};

/// Relative and absolute tolerance of one step's error, in the norm that the library uses.
struct Tolerances {
  double relative;  ///< of each component
  double absolute;  ///< added to it
};

/// @throws std::invalid_argument unless relative >= 0 and absolute > 0, both finite
void require_tolerances(std::string_view method, const Tolerances& tolerances);

/// A first step for libraries that ask for one: a hundredth of the time in which the state would change by
/// itself (E. Hairer, S. P. Norsett, G. Wanner, Solving Ordinary Differential Equations I, 1993, II.4), at
/// most the way to @p end. Signed. @param f f(t, x)
[[nodiscard]] double initial_step(double t, const double* x, const double* f, int size, double end,
                                  const Tolerances& tolerances);

/// Failure: f has a NaN or an infinity within the step of the length @p step from @p t.
[[nodiscard]] Status non_finite_rhs(std::string_view method, double t, double step);

/// Walks from run.t to run.t1: restarts at discontinuities, ends exactly, calls the observer, keeps the
/// limits. Any state that is not finite, any step that does not move the time ends the walk with the status
/// that says so; run keeps the last good step.
[[nodiscard]] Status walk(std::string_view method, PeerStepper& stepper, Run& run);

}  // namespace nlmech::peers
