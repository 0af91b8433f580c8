/// @file
/// The common walk of all peers: a library makes the steps, and everything that it could do wrong in silence
/// is watched here.
#pragma once

#include <string_view>

#include "nlmech/ivp/integrate.hpp"
#include "nlmech/peers/ivp/equations.hpp"

namespace nlmech::peers {

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
  double t1;                  ///< end, another time than the begin
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
