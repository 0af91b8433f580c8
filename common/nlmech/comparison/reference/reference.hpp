/// @file
/// What runs are judged by: the states of a solution by two independent computations, and how far these
/// agree.
///
/// Where the Taylor series in extended precision arrives within bounded work, two of different order are
/// taken. Elsewhere, for stiff and for long problems, methods of ours and peers run at tolerances far below
/// those asked until two agree. What they agree to is what the reference knows, and no more is concluded from
/// it.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "nlmech/ivp/domain.hpp"
#include "nlmech/ivp/events.hpp"
#include "nlmech/ivp/named/named_methods.hpp"
#include "nlmech/ivp/system.hpp"
#include "nlmech/support/status.hpp"

namespace nlmech::comparison {

/// States at several times, one a column, in extended precision.
using StatesAt = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;

/// A relative and an absolute tolerance: those of a run, or how finely a reference should know a component x:
/// to absolute + relative |x|, with |x| at least a thousandth of the component's greatest value. A reference
/// that knows less is given all the same, and says so.
struct Tolerance {
  double relative = 1e-13;  ///< positive
  double absolute = 1e-13;  ///< positive

  /// A finer one.
  [[nodiscard]] Tolerance operator/(double times) const { return {relative / times, absolute / times}; }
};

/// Bounds on the work for a reference.
struct WorkLimit {
  /// In steps and evaluations, so that a result does not depend on the speed of the machine: 1 is about a
  /// second.
  double work = 1;
  double seconds = std::numeric_limits<double>::infinity();  ///< wall time besides
  /// Longest step of each computation.
  double largest_step = std::numeric_limits<double>::infinity();
  std::vector<ivp::Event> changes = {};            ///< of the state on the way, as of the run that is judged
  std::shared_ptr<const ivp::Domain> domain = {};  ///< of the equations; may be null
};

/// The longest step of computations from @p t0 to @p t1 that are to miss nothing: at most that of the run
/// that is judged, and a 128th of the way, so that a pulse of some such parts after a long rest is seen.
[[nodiscard]] inline double watchful_step(double t0, double t1, double largest_step) {
  return std::min(largest_step, std::abs(t1 - t0) / 128);
}

/// Ends a computation that is too slow to arrive: one that, after a twentieth of its steps, has made less
/// than a twentieth of the way that they would have to.
class StepBudget {
 public:
  /// @param most steps from t0 to t1
  StepBudget(double t0, double t1, double most) : t0_(t0), way_(t1 - t0), most_(most) {}
  /// After a step to @p t: may it go on?
  [[nodiscard]] bool suffices(double t) {
    ++steps_;
    return steps_ < most_ / 20 || 20 * std::abs(t - t0_) >= std::abs(way_) * steps_ / most_;
  }

 private:
  double t0_, way_, most_, steps_ = 0;
};

/// A state in extended precision.
using ExtendedState = Eigen::Matrix<long double, Eigen::Dynamic, 1>;

/// Where a solution begins and where it is wanted.
struct ReferenceRequest {
  ExtendedState x0;  ///< initial state
  double t0 = 0;     ///< begin
  std::vector<double>
      times;  ///< in the direction of travel from t0, each other than the one before; the last is the end
};

/// One way to compute the states of a solution.
struct Candidate {
  std::string name;       ///< "adaptive-collocation"
  bool extended = false;  ///< works in extended precision; if one of these fails, no other is tried
  /// Fills the states at the asked times, within that wall time in seconds.
  std::function<Status(const ReferenceRequest&, double seconds, StatesAt&)> compute;
};

/// A solution at several times, as far as it is known.
struct Reference {
  Status status;               ///< success, or why there is none
  bool undetermined = false;   ///< none, because two computations in extended precision part: their rounding
                               ///< is multiplied to the size of the solution
  bool ends = false;           ///< none, because the solution seems to end on the way: the steps of two
                               ///< computations, one of them in extended precision, shrink to nothing
  Candidate first;             ///< of the two computations that agree best the one whose states are given
  Candidate second;            ///< the other one
  StatesAt states;             ///< of the first of them
  Eigen::MatrixXd difference;  ///< |difference| of the two, for each component and time
  Eigen::VectorXd size;        ///< greatest |x_i| at these times

  /// How wrong the last state may be: the greatest difference of a component there, relative to the component
  /// or, where that is below a thousandth of its size, to its size.
  [[nodiscard]] double uncertainty() const;
  /// "adaptive-collocation and cvode-bdf agree to 11.2 digits", or why there is none.
  [[nodiscard]] std::string text() const;
};

/// Runs the candidates in turn until two agree as finely as needed; else the two are taken that agree best,
/// if they agree to two digits at all times.
/// @param seconds wall time for all of them
[[nodiscard]] Reference agree(const std::vector<Candidate>& candidates, const ReferenceRequest& way,
                              const Tolerance& needed, double seconds);

/// The states of a problem at @p times, by the first two that agree of @p extended, computations in extended
/// precision, and then of methods that share nothing but the problem, cheap ones first: Taylor series in
/// double precision, collocation, Rosenbrock, Runge-Kutta, differentiation formulas, Hermitian operators;
/// peers as far as this build has them. Each of these is begun anew at every time, so that no dense output
/// has a part in the states. Tolerances are a tenth of what is needed, but not below 1e-13 (differentiation
/// formulas and Rosenbrock: 1e-12); absolute ones are a millionth of that first, for components that decay,
/// and if the method fails so, as coarse as needed.
/// @param x0 state at t0, finite
/// @param times in the direction of travel from t0, each other than the one before; at least one
/// @param needed how finely
/// @param effort when to give up
[[nodiscard]] Reference reference_of(std::vector<Candidate> extended, const ivp::System& system,
                                     const ivp::State& x0, double t0, const std::vector<double>& times,
                                     const Tolerance& needed, const WorkLimit& effort);

/// The states at all times by a method that is begun anew at each.
/// @param observer of all segments; may be empty
[[nodiscard]] Status states_by(const ivp::NamedIntegrator& run, const ivp::System& system,
                               const ReferenceRequest& way, const ivp::Observer& observer,
                               const ivp::Limits& limits, StatesAt& states);

/// The times at which a way from @p t0 to @p t1 is looked at: @p count equidistant ones, the last of them the
/// end.
[[nodiscard]] std::vector<double> look_at(double t0, double t1, int count);

}  // namespace nlmech::comparison
