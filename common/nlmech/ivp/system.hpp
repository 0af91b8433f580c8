/// @file
/// System: the interface between problems and methods.
#pragma once

#include <Eigen/Core>
#include <concepts>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "nlmech/ivp/direct.hpp"
#include "nlmech/program/problem.hpp"

namespace nlmech::ivp {

/// Requirements of a method on a system; Direct and System satisfy them.
template <class S>
concept SystemLike = requires(const S& system, double t, const typename S::State& x, typename S::State& f,
                              const typename S::Nodes& xs, typename S::Nodes& fs, typename S::Jacobian& j,
                              std::span<const double> times) {
  { system.size() } -> std::same_as<int>;
  { system.second_order() } -> std::same_as<bool>;
  system.rhs(t, x, f);
  system.rhs(times, xs, fs);
  system.jacobian(t, x, j);
  { system.time_derivative(t, x, f) } -> std::same_as<bool>;
  system.discontinuities(t, t);
};

/// A problem behind a virtual interface. Methods are compiled once, for System, so the compile time grows
/// with the sum of problems and methods, not with their product. A call costs one indirection; rhs() at many
/// nodes costs one in total. Copies share the problem.
class System {
 public:
  static constexpr int dimension = Eigen::Dynamic;  ///< number of components of the state: known at run time
  using State = ivp::State;                         ///< all components
  using Half = ivp::State;                          ///< positions or velocities
  using Nodes = ivp::Nodes;                         ///< states at many nodes, one per column
  using Jacobian = ivp::Jacobian;                   ///< df/dx

  /// System of typed equations, or of a type that converts to them; compiled in the library.
  explicit System(program::Problem problem);
  /// Compiles a problem; see Direct for its members.
  template <class Problem>
  requires(!std::same_as<Problem, System> &&
           !std::convertible_to<Problem, program::Problem>) explicit System(Problem problem)
      : problem_(std::make_shared<const Direct<Problem, Eigen::Dynamic>>(std::move(problem))) {}

  /// Number of components of the state.
  [[nodiscard]] int size() const { return problem_->size(); }
  /// Does the problem give its acceleration, so that its state is positions and then velocities?
  [[nodiscard]] bool second_order() const { return problem_->second_order(); }
  /// dx/dt = f(t, x).
  void rhs(double t, const State& x, State& dxdt) const { problem_->rhs(t, x, dxdt); }
  /// The same at many nodes: column k of @p dxdt is f(times[k], column k of @p x).
  void rhs(std::span<const double> times, const Nodes& x, Nodes& dxdt) const {
    problem_->rhs(times, x, dxdt);
  }
  /// df/dx, exact to rounding.
  void jacobian(double t, const State& x, Jacobian& j) const { problem_->jacobian(t, x, j); }
  /// df/dt at fixed x, exact to rounding. @return false, with nothing written, for a problem in double only
  [[nodiscard]] bool time_derivative(double t, const State& x, State& dfdt) const {
    return problem_->time_derivative(t, x, dfdt);
  }
  /// f and g = f_t + f_x f, that is x' and x'' of the solution through (t, x), exact to rounding.
  /// @return false, with nothing written, for a problem in double only
  [[nodiscard]] bool second_derivative(double t, const State& x, State& f, State& g) const {
    return problem_->second_derivative(t, x, f, g);
  }
  /// The same with df/dx and dg/dx.
  [[nodiscard]] bool second_derivative(double t, const State& x, State& f, State& g, Jacobian& fx,
                                       Jacobian& gx) const {
    return problem_->second_derivative(t, x, f, g, fx, gx);
  }
  /// Second-order problems only: a(t, q, v). @throws std::logic_error if the problem gives no acceleration
  void acceleration(double t, const State& q, const State& v, State& a) const {
    problem_->acceleration(t, q, v, a);
  }
  /// Times between @p t0 and @p t1, in the direction of integration, at which f or a derivative of it jumps.
  [[nodiscard]] std::vector<double> discontinuities(double t0, double t1) const {
    return problem_->discontinuities(t0, t1);
  }
  /// Number of switching functions, whose cells select the equations; 0 for smooth equations.
  [[nodiscard]] int switches() const { return problem_->switches(); }
  /// Does switching function @p i switch at every integer? Others switch at zero.
  [[nodiscard]] bool is_rounded(int i) const { return problem_->is_rounded(i); }
  /// The smooth equations of a mode. @throws std::logic_error if there are no switches
  [[nodiscard]] System in_mode(const Mode& mode) const { return System(problem_->in_mode(mode)); }
  /// Switching functions, or shares (switching.hpp), of the equations of a mode, and their rates of change.
  void surfaces(double t, const State& x, std::span<double> values, std::span<double> rates) const {
    problem_->surfaces(t, x, values, rates);
  }
  /// The derivatives of the switching functions of a mode along a @p direction of the state.
  void surfaces_along(double t, const State& x, const State& direction, std::span<double> derivatives) const {
    problem_->surfaces_along(t, x, direction, derivatives);
  }
  /// Places of the unknowns and of their sensitivities, if there are any, in the state.
  [[nodiscard]] program::VariationalLayout layout() const { return problem_->layout(); }
  /// The linear terms of f with constant coefficients, and its harmonic loads, from its expressions; none for
  /// a problem that branches or is in double only.
  [[nodiscard]] program::LinearTerms linear_terms() const { return problem_->linear_terms(); }
  /// The quantities that stay constant along every solution, at (t, x).
  /// @return false, with nothing written, if the problem gives none
  [[nodiscard]] bool invariants(double t, const State& x, Eigen::VectorXd& values) const {
    return problem_->invariants(t, x, values);
  }
  /// Bounds of each component at later times, valid if the state is within them now; infinite where there is
  /// no bound. @return false, with nothing written, if the problem gives none
  [[nodiscard]] bool bounds(State& lower, State& upper) const { return problem_->bounds(lower, upper); }
  /// Records the right-hand side as a tape; it is called once, at time @p t. @throws std::invalid_argument as
  /// Direct::record()
  [[nodiscard]] Tape record(double t) const { return problem_->record(t); }
  /// Machine code for the tapes of the problem, which runs in all threads share.
  [[nodiscard]] machine_code::SeriesCodes& series_codes() const { return problem_->series_codes(); }
  /// Taylor coefficients of solutions to the order @p order >= 1, by the tape. The result refers to this
  /// object; see TapedTaylor.
  [[nodiscard]] TapedTaylor<System> taylor(int order) const { return {*this, order}; }

 private:
  explicit System(std::shared_ptr<const detail::AnyProblem> problem) : problem_(std::move(problem)) {}

  std::shared_ptr<const detail::AnyProblem> problem_;
};

}  // namespace nlmech::ivp
