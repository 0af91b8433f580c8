/// @file
/// The compiled face of a problem: the one small interface from which every method takes what it needs.
#pragma once

#include <Eigen/Core>
#include <concepts>
#include <memory>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "nlmech/ivp/direct.hpp"

namespace nlmech::ivp {

/// What a method asks of a system; Direct and System have it.
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

/// @cond
namespace detail {

struct Face {
  Face() = default;
  Face(const Face&) = delete;
  Face& operator=(const Face&) = delete;
  virtual ~Face() = default;
  virtual int size() const = 0;
  virtual bool second_order() const = 0;
  virtual void rhs(double, const State&, State&) const = 0;
  virtual void rhs(std::span<const double>, const Nodes&, Nodes&) const = 0;
  virtual void jacobian(double, const State&, Jacobian&) const = 0;
  virtual bool time_derivative(double, const State&, State&) const = 0;
  virtual bool second_derivative(double, const State&, State&, State&) const = 0;
  virtual bool second_derivative(double, const State&, State&, State&, Jacobian&, Jacobian&) const = 0;
  virtual void acceleration(double, const State&, const State&, State&) const = 0;
  virtual std::vector<double> discontinuities(double, double) const = 0;
  virtual int switches() const = 0;
  virtual std::shared_ptr<const Face> in_mode(const Mode&) const = 0;
  virtual void surfaces(double, const State&, std::span<double>, std::span<double>) const = 0;
  virtual program::LinearTerms linear_terms() const = 0;
  virtual bool invariants(double, const State&, Eigen::VectorXd&) const = 0;
  virtual bool bounds(State&, State&) const = 0;
  virtual Tape record(double) const = 0;
};
template <class D>
struct Compiled final : Face {
  explicit Compiled(D d) : direct(std::move(d)) {}
  int size() const override { return direct.size(); }
  bool second_order() const override { return direct.second_order(); }
  void rhs(double t, const State& x, State& f) const override { direct.rhs(t, x, f); }
  void rhs(std::span<const double> t, const Nodes& x, Nodes& f) const override { direct.rhs(t, x, f); }
  void jacobian(double t, const State& x, Jacobian& j) const override { direct.jacobian(t, x, j); }
  bool time_derivative(double t, const State& x, State& dfdt) const override {
    return direct.time_derivative(t, x, dfdt);
  }
  bool second_derivative(double t, const State& x, State& f, State& g) const override {
    return direct.second_derivative(t, x, f, g);
  }
  bool second_derivative(double t, const State& x, State& f, State& g, Jacobian& fx,
                         Jacobian& gx) const override {
    return direct.second_derivative(t, x, f, g, fx, gx);
  }
  void acceleration(double t, const State& q, const State& v, State& a) const override {
    direct.acceleration(t, q, v, a);
  }
  std::vector<double> discontinuities(double t0, double t1) const override {
    return direct.discontinuities(t0, t1);
  }
  int switches() const override { return direct.switches(); }
  std::shared_ptr<const Face> in_mode(const Mode& mode) const override {
    return std::make_shared<const Compiled>(direct.in_mode(mode));
  }
  void surfaces(double t, const State& x, std::span<double> values, std::span<double> rates) const override {
    direct.surfaces(t, x, values, rates);
  }
  program::LinearTerms linear_terms() const override { return direct.linear_terms(); }
  bool invariants(double t, const State& x, Eigen::VectorXd& values) const override {
    return direct.invariants(t, x, values);
  }
  bool bounds(State& lower, State& upper) const override { return direct.bounds(lower, upper); }
  Tape record(double t) const override { return direct.record(t); }
  D direct;
};

/// Has a problem its System compiled in the library? Not one that derives from it.
template <class Problem>
concept CompiledOnce = requires {
  requires std::same_as<typename Problem::compiled_once, Problem>;
};
/// Of such a problem. Defined by compiled_system.hpp, for the one source that compiles it:
/// typed_system.cpp and problems/texts.cpp.
template <class Problem>
std::shared_ptr<const Face> compiled_face(Problem problem);

}  // namespace detail
/// @endcond

/// A problem behind a virtual interface. Methods are compiled once, for System, so that many problems and
/// many methods cost their sum to compile, not their product. A call costs one indirection; rhs() over many
/// nodes costs one for all of them. Copies share the problem.
class System {
 public:
  static constexpr int dimension = Eigen::Dynamic;  ///< components of the state: known at run time
  using State = ivp::State;                         ///< all components
  using Half = ivp::State;                          ///< positions or velocities
  using Nodes = ivp::Nodes;                         ///< states at many nodes, one a column
  using Jacobian = ivp::Jacobian;                   ///< df/dx

  /// Compiles a problem: see Direct for what a problem has to offer. Those of nlmech::problems are
  /// compiled there.
  template <class Problem>
  requires(!std::same_as<std::remove_cvref_t<Problem>, System>) explicit System(Problem problem)
      : face_(face_of(std::move(problem))) {}

  /// Number of components of the state.
  [[nodiscard]] int size() const { return face_->size(); }
  /// Does the problem give its acceleration, so that its state is positions and then velocities?
  [[nodiscard]] bool second_order() const { return face_->second_order(); }
  /// dx/dt = f(t, x).
  void rhs(double t, const State& x, State& dxdt) const { face_->rhs(t, x, dxdt); }
  /// The same at many nodes: column k of @p dxdt is f(times[k], column k of @p x).
  void rhs(std::span<const double> times, const Nodes& x, Nodes& dxdt) const { face_->rhs(times, x, dxdt); }
  /// df/dx, exact to rounding.
  void jacobian(double t, const State& x, Jacobian& j) const { face_->jacobian(t, x, j); }
  /// df/dt at fixed x, exact to rounding. False, and nothing is written, for a problem that is written for
  /// double alone.
  [[nodiscard]] bool time_derivative(double t, const State& x, State& dfdt) const {
    return face_->time_derivative(t, x, dfdt);
  }
  /// f and g = f_t + f_x f, that is x' and x'' of the solution through (t, x), exact to rounding. False, and
  /// nothing is written, for a problem that is written for double alone.
  [[nodiscard]] bool second_derivative(double t, const State& x, State& f, State& g) const {
    return face_->second_derivative(t, x, f, g);
  }
  /// The same with df/dx and dg/dx.
  [[nodiscard]] bool second_derivative(double t, const State& x, State& f, State& g, Jacobian& fx,
                                       Jacobian& gx) const {
    return face_->second_derivative(t, x, f, g, fx, gx);
  }
  /// Second-order problems only: a(t, q, v). @throws std::logic_error if the problem gives no acceleration
  void acceleration(double t, const State& q, const State& v, State& a) const {
    face_->acceleration(t, q, v, a);
  }
  /// Times between @p t0 and @p t1, in the direction of travel, at which f or a derivative of it jumps.
  [[nodiscard]] std::vector<double> discontinuities(double t0, double t1) const {
    return face_->discontinuities(t0, t1);
  }
  /// How many functions decide by their signs what the equations are; 0 for smooth equations.
  [[nodiscard]] int switches() const { return face_->switches(); }
  /// The smooth equations of a mode. @throws std::logic_error if there are no switches
  [[nodiscard]] System in_mode(const Mode& mode) const { return System(face_->in_mode(mode)); }
  /// Of the equations of a mode: the functions that decide, or their shares (switching.hpp), and their rates.
  void surfaces(double t, const State& x, std::span<double> values, std::span<double> rates) const {
    face_->surfaces(t, x, values, rates);
  }
  /// What of f is linear with constant coefficients, and its harmonic loads: read off the equations; nothing
  /// of a problem that is written for double alone, or branches.
  [[nodiscard]] program::LinearTerms linear_terms() const { return face_->linear_terms(); }
  /// The quantities that stay constant along every solution, at (t, x). False, and nothing is written, if
  /// the problem names none.
  [[nodiscard]] bool invariants(double t, const State& x, Eigen::VectorXd& values) const {
    return face_->invariants(t, x, values);
  }
  /// What each component cannot fall below nor exceed at later times, if it is within now; infinite where
  /// there is no bound. False, and nothing is written, if the problem names none.
  [[nodiscard]] bool bounds(State& lower, State& upper) const { return face_->bounds(lower, upper); }
  /// The right-hand side as a tape: called once, at time @p t. @throws std::invalid_argument as
  /// Direct::record()
  [[nodiscard]] Tape record(double t) const { return face_->record(t); }
  /// The Taylor coefficients of solutions, to the order @p order >= 1, through the tape: an object that
  /// refers to this one; see TapedTaylor.
  [[nodiscard]] TapedTaylor<System> taylor(int order) const { return {*this, order}; }

 private:
  using Face = detail::Face;
  explicit System(std::shared_ptr<const Face> face) : face_(std::move(face)) {}

  template <class Problem>
  static std::shared_ptr<const Face> face_of(Problem problem) {
    if constexpr (detail::CompiledOnce<Problem>)
      return detail::compiled_face(std::move(problem));
    else
      return std::make_shared<const detail::Compiled<Direct<Problem, Eigen::Dynamic>>>(
          Direct<Problem, Eigen::Dynamic>(std::move(problem)));
  }

  std::shared_ptr<const Face> face_;
};

}  // namespace nlmech::ivp
