/// @file
/// Common integration loop of all peers: the library takes the steps, and the loop checks for silent
/// failures.
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

/// Are the @p size numbers at @p x finite?
[[nodiscard]] inline bool all_finite(const double* x, int size) {
  bool finite = true;
  for (int i = 0; i < size; ++i) finite = finite && std::isfinite(x[i]);
  return finite;
}

/// dx/dt = f(t, x) on arrays. Evaluations are counted here, so that the counts of all peers are comparable. f
/// is evaluated only within the segment of enter(), at its later end one double earlier: libraries evaluate
/// at the end of a step or a rounding error beyond it, and a step that ends at a jump must not use the other
/// side.
class Equations {
 public:
  /// @param size number of components
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
  /// df/dt at fixed x into @p dfdt, exact to rounding by dual numbers. For a problem written for double alone
  /// it is a difference over twice 6e-6 max(1, |t|) within the segment: central with an error of about 1e-10,
  /// one-sided near the ends with about 1e-6. Its two evaluations of f count.
  virtual void time_derivative(double t, const double* x, double* dfdt) = 0;
  /// Times strictly between @p t0 and @p t1, in the direction of integration, at which f or a derivative
  /// jumps.
  [[nodiscard]] virtual std::vector<double> discontinuities(double t0, double t1) const = 0;

  /// Restricts evaluations of f to times between @p begin and @p end, in either order.
  void enter(double begin, double end) {
    earliest_ = std::min(begin, end);
    segment_ = ivp::SmoothSegment(begin, end);
  }
  /// Is a state or slope finite? Records if it is not.
  [[nodiscard]] bool check(const double* x) {
    const bool finite = all_finite(x, size_);
    if (!finite) met_non_finite_ = true;
    return finite;
  }
  /// Did check() find a NaN or an infinity since the last call?
  [[nodiscard]] bool met_non_finite() { return std::exchange(met_non_finite_, false); }
  /// Evaluations of f so far.
  [[nodiscard]] std::int64_t right_hand_sides() const { return right_hand_sides_; }
  /// Evaluations of df/dx so far.
  [[nodiscard]] std::int64_t jacobians() const { return jacobians_; }

 protected:
  friend class Uncounted;
  /// @p t limited to the segment.
  [[nodiscard]] double inside(double t) const { return segment_(std::max(t, earliest_)); }
  std::int64_t right_hand_sides_ = 0;  ///< counted by rhs()
  std::int64_t jacobians_ = 0;         ///< counted by jacobian()

 private:
  int size_;
  bool met_non_finite_ = false;
  double earliest_ = -std::numeric_limits<double>::infinity();
  ivp::SmoothSegment segment_;
};

/// Scope without counting of evaluations, for dense output, which an integration without an observer does not
/// need.
class Uncounted {
 public:
  /// Stores the counts.
  explicit Uncounted(Equations& equations)
      : equations_(equations),
        right_hand_sides_(equations.right_hand_sides_),
        jacobians_(equations.jacobians_) {}
  /// Restores the counts.
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

/// Equations of a System or a Direct. Final, so that calls with the static type need no indirection.
template <ivp::SystemLike S>
class EquationsOf final : public Equations {
 public:
  using State = typename S::State;  ///< state of the system

  /// @param system must outlive this object
  explicit EquationsOf(const S& system)
      : Equations(system.size()),
        system_(system),
        x_(system.size()),
        f_(system.size()),
        j_(system.size(), system.size()) {}

  /// f(t, x) without a copy, for libraries that use the type of the state.
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

/// Carries an exception through a C library: the callback stores it, and the caller rethrows it after the
/// library has returned.
class Rethrower {
 public:
  /// Calls @p work; returns its result, or @p failure if it throws.
  template <class Work>
  [[nodiscard]] int keep(int failure, Work&& work) noexcept {
    try {
      return std::forward<Work>(work)();
    } catch (...) {
      kept_ = std::current_exception();
      return failure;
    }
  }
  /// Throws the stored exception, if there is one.
  void rethrow() {
    if (kept_) std::rethrow_exception(std::exchange(kept_, nullptr));
  }

 private:
  std::exception_ptr kept_;
};

/// Result of a trial step.
struct Attempt {
  /// Outcomes of a trial step.
  enum class Result {
    accepted,  ///< the state has advanced
    rejected,  ///< a shorter step follows
    failed     ///< the library gives up: see failure
  };
  Result result = Result::accepted;  ///< outcome
  double t = 0;                      ///< time reached, if accepted
  double step = 0;                   ///< signed step size of the trial
  Status failure;                    ///< reason, if failed
};

/// Integrator of a library for one system.
class PeerStepper {
 public:
  PeerStepper() = default;
  PeerStepper(const PeerStepper&) = delete;
  PeerStepper& operator=(const PeerStepper&) = delete;
  virtual ~PeerStepper() = default;

  /// Starts at (t, x) without information from earlier steps. Steps do not pass @p end and meet it exactly.
  [[nodiscard]] virtual Status begin(double t, const double* x, double end) = 0;
  /// Tries a step from the end of the latest accepted one. Libraries that repeat rejected steps themselves
  /// add them to statistics.rejected.
  [[nodiscard]] virtual Attempt attempt(double* x, Statistics& statistics) = 0;
  /// State at @p t within the latest accepted step; a failure is recorded in dense_output().
  virtual void at(double t, double* x) = 0;
  /// Status of all calls of at().
  [[nodiscard]] const Status& dense_output() const { return dense_output_; }
  /// Adds the library's counters of the work since begin().
  virtual void add_counters(Statistics& statistics) const = 0;

 protected:
  /// Records that at() failed at @p t within the step from @p t0 to @p t1.
  void miss(std::string_view method, double t, double t0, double t1);

 private:
  Status dense_output_;
};

/// Observer of the steps of a peer on arrays.
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

/// One integration by a peer: its input and its current state.
struct Run {
  Equations& equations;       ///< dx/dt = f(t, x)
  double t;                   ///< start, then the time reached
  double t1;                  ///< end, different from the start
  double* x;                  ///< state at t
  const ivp::Limits& limits;  ///< limits of the work
  ArrayObserver* observer;    ///< may be null
  Statistics statistics;      ///< cost without seconds
};

/// Tolerances of the error of one step, in the norm of the library.
struct Tolerances {
  double relative;  ///< relative tolerance of each component
  double absolute;  ///< absolute tolerance
};

/// Checks tolerances. @throws std::invalid_argument unless relative >= 0 and absolute > 0, both finite
void require_tolerances(std::string_view method, const Tolerances& tolerances);

/// Signed initial step size for libraries that need one: a hundredth of the time in which the state changes
/// by its own size (E. Hairer, S. P. Norsett, G. Wanner, Solving Ordinary Differential Equations I, 1993,
/// II.4), at most up to
/// @p end. @param f f(t, x)
[[nodiscard]] double initial_step(double t, const double* x, const double* f, int size, double end,
                                  const Tolerances& tolerances);

/// Failure status for a NaN or infinity of f within the step of size @p step from @p t.
[[nodiscard]] Status non_finite_rhs(std::string_view method, double t, double step);

/// Integrates from run.t to run.t1: restarts at discontinuities, ends exactly at run.t1, calls the observer
/// and checks the limits. A state that is not finite or a step that does not advance the time ends the
/// integration with a failure; run keeps the last valid step.
[[nodiscard]] Status integrate_steps(std::string_view method, PeerStepper& stepper, Run& run);

}  // namespace nlmech::peers
