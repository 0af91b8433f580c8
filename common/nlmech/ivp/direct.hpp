/// @file
/// Adapts a problem to the interface that methods need: behind System, or without indirection for users and
/// benchmarks that want the right-hand side inlined into the method.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <concepts>
#include <limits>
#include <memory>
#include <span>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <vector>

#include "nlmech/ivp/series/taylor.hpp"
#include "nlmech/ivp/state.hpp"
#include "nlmech/program/dual.hpp"
#include "nlmech/program/linear_terms.hpp"
#include "nlmech/program/recorded.hpp"
#include "nlmech/program/variational.hpp"

namespace nlmech::ivp {

namespace detail {

/// Half of a state: positions or velocities.
template <class T, int n>
using HalfVector = Vector<T, n == Eigen::Dynamic ? Eigen::Dynamic : n / 2>;

/// True if the problem offers `acceleration(t, q, v, a)`.
template <class Problem>
concept GivesAcceleration = requires(const Problem& problem, double t,
                                     const HalfVector<double, Problem::dimension>& q,
                                     HalfVector<double, Problem::dimension>& a) {
  problem.acceleration(t, q, q, a);
};

/// True if the problem has a member `second_order()`, as typed equations do.
template <class Problem>
concept HasOrder = requires(const Problem& problem) {
  { problem.second_order() } -> std::same_as<bool>;
};

/// True if the problem offers `jacobian(t, x, j)`, which replaces the Jacobian by dual numbers.
template <class Problem>
concept GivesJacobian = requires(const Problem& problem, double t,
                                 const Vector<double, Problem::dimension>& x,
                                 Matrix<double, Problem::dimension, Problem::dimension>& j) {
  problem.jacobian(t, x, j);
};

/// True if the right-hand side can be evaluated in the dual numbers D.
template <class Problem, class D>
concept TakesDual = requires(const Problem& problem, const D& t, const Vector<D, Problem::dimension>& x,
                             Vector<D, Problem::dimension>& f) {
  problem(t, x, f);
};

/// True if the problem gives the times at which f is not smooth.
template <class Problem>
concept GivesDiscontinuities = requires(const Problem& problem, double t) {
  problem.discontinuities(t, t);
};

/// True if the problem consists of smooth parts, one for each choice of cells of some functions.
template <class Problem>
concept GivesSwitches = requires(const Problem& problem, const Mode& mode) {
  { problem.switches() } -> std::same_as<int>;
  { problem.is_rounded(0) } -> std::same_as<bool>;
  { problem.in_mode(mode) } -> std::same_as<Problem>;
};

/// @cond
/// Virtual interface of a problem behind System; see Direct.
class AnyProblem {
 public:
  AnyProblem() = default;
  AnyProblem(const AnyProblem&) = delete;
  AnyProblem& operator=(const AnyProblem&) = delete;
  virtual ~AnyProblem() = default;
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
  virtual bool is_rounded(int) const = 0;
  virtual std::shared_ptr<const AnyProblem> in_mode(const Mode&) const = 0;
  virtual void surfaces(double, const State&, std::span<double>, std::span<double>) const = 0;
  virtual void surfaces_along(double, const State&, const State&, std::span<double>) const = 0;
  virtual program::VariationalLayout layout() const = 0;
  virtual program::LinearTerms linear_terms() const = 0;
  virtual bool invariants(double, const State&, Eigen::VectorXd&) const = 0;
  virtual bool bounds(State&, State&) const = 0;
  virtual Tape record(double) const = 0;
  virtual machine_code::SeriesCodes& series_codes() const = 0;
};
/// Empty base for an inlined problem.
class NoInterface {};
/// @endcond

/// True if the problem has its own linear_terms(), as typed equations do.
template <class Problem>
concept GivesLinearTerms = requires(const Problem& problem) {
  { problem.linear_terms() } -> std::convertible_to<program::LinearTerms>;
};

/// True if the problem has code that its copies and modes share, as typed equations do.
template <class Problem>
concept GivesSeriesCodes = requires(const Problem& problem) {
  { problem.series_codes() } -> std::same_as<std::shared_ptr<machine_code::SeriesCodes>>;
};

/// True if the problem may have sensitivities in its state, as typed equations do.
template <class Problem>
concept GivesLayout = requires(const Problem& problem) {
  { problem.layout() } -> std::convertible_to<program::VariationalLayout>;
};

/// True if the problem gives quantities that stay constant along its solutions.
template <class Problem>
concept GivesInvariants = requires(const Problem& problem, double t,
                                   const Vector<double, Problem::dimension>& x) {
  problem.invariants(t, x);
};

/// True if the problem gives lower bounds of its components.
template <class Problem>
concept GivesLowerBounds = requires(const Problem& problem) {
  problem.lower_bounds();
};

/// True if the problem gives upper bounds of its components.
template <class Problem>
concept GivesUpperBounds = requires(const Problem& problem) {
  problem.upper_bounds();
};

/// True if the problem has a member `bounds(lower, upper)` that returns whether there are bounds.
template <class Problem>
concept GivesBounds = requires(const Problem& problem, State& bound) {
  { problem.bounds(bound, bound) } -> std::same_as<bool>;
};

/// Partial derivatives carried at once: all n for a fixed dimension, 8 for a dynamic one.
template <int n>
inline constexpr int lanes = n == Eigen::Dynamic ? 8 : n;

}  // namespace detail

// One of the two bases has no functions to override. NOLINTBEGIN(modernize-use-override)

/// Inlines a problem into a system. A problem is a callable
/// `template <class T> void operator()(const T& t, const Vector<T, m>& x, Vector<T, m>& dxdt) const` with
/// `static constexpr int dimension = m` (Eigen::Dynamic: also a member `int size() const`). It may offer:
///  - `acceleration(t, q, v, a)`, also a template on the scalar: a second-order problem with the state q,
///    then v. If there is a member `bool second_order() const`, it decides;
///  - `jacobian(t, x, j)` in double: replaces dual numbers;
///  - `std::vector<double> discontinuities(t0, t1) const`: times at which f or a derivative jumps, in the
///    direction of integration. Methods end a step at each of them. At such a time f is the limit from the
///    right;
///  - `int switches()`, `bool is_rounded(i)`, `in_mode(mode)`, `surfaces(t, x, values, rates)`: switching
///    functions of time and state, whether they switch at every integer or at zero, and the smooth equations
///    for each choice of their cells (switching.hpp);
///  - `invariants(t, x)` in double: a vector of quantities that stay constant along every solution;
///  - `lower_bounds()`, `upper_bounds()`: bounds that each component keeps at later times.
/// @tparam n dimension of the system: that of the problem, or Eigen::Dynamic, with which the members below
/// override those of AnyProblem
template <class Problem, int n = Problem::dimension>
class Direct final : public std::conditional_t<n == Eigen::Dynamic, detail::AnyProblem, detail::NoInterface> {
 public:
  static_assert(n == Problem::dimension || n == Eigen::Dynamic, "a problem has the dimension of its system");
  /// Number of components of the state, or Eigen::Dynamic.
  static constexpr int dimension = n;
  using State = std::conditional_t<n == Eigen::Dynamic, ivp::State, Vector<double, n>>;  ///< all components
  using Half = std::conditional_t<n == Eigen::Dynamic, ivp::State,
                                  detail::HalfVector<double, n>>;  ///< positions or velocities
  using Nodes = Matrix<double, n, Eigen::Dynamic>;                 ///< states at many nodes, one per column
  using Jacobian = Matrix<double, n, n>;                           ///< df/dx

  /// Stores a copy of the problem.
  explicit Direct(Problem problem) : problem_(std::move(problem)) {
    if constexpr (detail::GivesSeriesCodes<Problem>)
      series_codes_ = problem_.series_codes();
    else
      series_codes_ = std::make_shared<machine_code::SeriesCodes>();
  }

  /// Number of components of the state.
  [[nodiscard]] int size() const {
    if constexpr (m != Eigen::Dynamic) {
      return m;
    } else {
      return problem_.size();
    }
  }
  /// Does the problem give its acceleration?
  [[nodiscard]] bool second_order() const {
    if constexpr (detail::HasOrder<Problem>) {
      return problem_.second_order();
    } else {
      return detail::GivesAcceleration<Problem>;
    }
  }
  /// The problem itself.
  [[nodiscard]] const Problem& problem() const { return problem_; }

  /// dx/dt = f(t, x).
  void rhs(double t, const State& x, State& dxdt) const {
    dxdt.resize(size());
    if constexpr (n == m) {
      problem_(t, x, dxdt);
    } else {
      OwnState own, f;
      std::copy_n(x.data(), m, own.data());
      problem_(t, own, f);
      std::copy_n(f.data(), m, dxdt.data());
    }
  }

  /// The same at many nodes: column k of @p dxdt is f(times[k], column k of @p x).
  void rhs(std::span<const double> times, const Nodes& x, Nodes& dxdt) const {
    OwnState at_node(size()), f(size());
    const Eigen::Index rows = at_node.size();
    dxdt.resize(rows, x.cols());
    for (std::size_t k = 0; k < times.size(); ++k) {
      const Eigen::Index first = static_cast<Eigen::Index>(k) * rows;
      std::copy_n(x.data() + first, rows, at_node.data());
      problem_(times[k], at_node, f);
      std::copy_n(f.data(), rows, dxdt.data() + first);
    }
  }

  /// df/dx by dual numbers, exact to rounding, or by the problem's own jacobian().
  void jacobian(double t, const State& x, Jacobian& j) const {
    if constexpr (detail::GivesJacobian<Problem>) {
      OwnJacobian own(size(), size());
      problem_.jacobian(t, OwnState(x), own);
      j = own;
    } else {
      by_dual_numbers(t, x, j);
    }
  }

  /// df/dt at fixed x, which Rosenbrock methods need: by dual numbers, exact to rounding.
  /// @return false, with nothing written, for a problem in double only
  [[nodiscard]] bool time_derivative(double t, const State& x, State& dfdt) const {
    using D = Dual<double, 1>;
    if constexpr (detail::TakesDual<Problem, D>) {
      Vector<D, m> argument(size()), value(size());
      dfdt.resize(size());
      for (int i = 0; i < size(); ++i) argument[i] = D(x[i]);
      problem_(D::variable(t, 0), argument, value);
      for (int i = 0; i < size(); ++i) dfdt[i] = value[i].partial[0];
      return true;
    } else {
      return false;
    }
  }

  /// f and its derivative along the solution, g = f_t + f_x f: x' and x'' there. For a second-order problem
  /// the lower half of f is the acceleration and that of g the jerk, 2 and 6 times a Taylor coefficient of
  /// the position. By dual numbers, exact to rounding.
  /// @return false, with nothing written, for a problem in double only
  [[nodiscard]] bool second_derivative(double t, const State& x, State& f, State& g) const {
    using D = Dual<double, 1>;
    if constexpr (detail::TakesDual<Problem, D>) {
      rhs(t, x, f);
      g.resize(size());
      Vector<D, m> argument(size()), value(size());
      for (int i = 0; i < size(); ++i) {
        argument[i] = D(x[i]);
        argument[i].partial[0] = f[i];
      }
      problem_(D::variable(t, 0), argument, value);
      for (int i = 0; i < size(); ++i) g[i] = value[i].partial[0];
      return true;
    } else {
      return false;
    }
  }

  /// The same with df/dx and dg/dx: by dual numbers of dual numbers, exact to rounding.
  [[nodiscard]] bool second_derivative(double t, const State& x, State& f, State& g, Jacobian& fx,
                                       Jacobian& gx) const {
    constexpr int lanes = detail::lanes<m>;
    using D = Dual<double, lanes>;
    using Along = Dual<D, 1>;
    if constexpr (detail::TakesDual<Problem, Along>) {
      Vector<D, m> inner(size()), slope(size());
      f.resize(size());
      g.resize(size());
      fx.resize(size(), size());
      gx.resize(size(), size());
      Vector<Along, m> argument(size()), value(size());
      for (int first = 0; first < size(); first += lanes) {
        for (int i = 0; i < size(); ++i) {
          const int lane = i - first;
          inner[i] = lane >= 0 && lane < lanes ? D::variable(x[i], lane) : D(x[i]);
        }
        problem_(D(t), inner, slope);
        for (int i = 0; i < size(); ++i) {
          argument[i] = Along(inner[i]);
          argument[i].partial[0] = slope[i];
        }
        problem_(Along::variable(D(t), 0), argument, value);
        for (int i = 0; i < size(); ++i) {
          f[i] = slope[i].value;
          g[i] = value[i].partial[0].value;
          for (int lane = 0; lane < lanes && first + lane < size(); ++lane) {
            fx(i, first + lane) = slope[i].partial[static_cast<std::size_t>(lane)];
            gx(i, first + lane) = value[i].partial[0].partial[static_cast<std::size_t>(lane)];
          }
        }
      }
      return true;
    } else {
      return false;
    }
  }

  /// Second-order problems: a(t, q, v). @throws std::logic_error if the problem gives no acceleration
  void acceleration(double t, const Half& q, const Half& v, Half& a) const {
    if constexpr (!detail::GivesAcceleration<Problem>) {
      throw std::logic_error("this problem gives no acceleration(t, q, v)");
    } else if constexpr (n == m) {
      a.resize(size() / 2);
      problem_.acceleration(t, q, v, a);
    } else {
      OwnHalf own_q, own_v, own;
      std::copy_n(q.data(), m / 2, own_q.data());
      std::copy_n(v.data(), m / 2, own_v.data());
      problem_.acceleration(t, own_q, own_v, own);
      a.resize(m / 2);
      std::copy_n(own.data(), m / 2, a.data());
    }
  }

  /// Times strictly between @p t0 and @p t1, in the direction of travel, where f or a derivative jumps.
  [[nodiscard]] std::vector<double> discontinuities(double t0, double t1) const {
    if constexpr (detail::GivesDiscontinuities<Problem>) {
      return problem_.discontinuities(t0, t1);
    } else {
      return {};
    }
  }

  /// Number of switching functions, whose cells select the equations. Methods integrate smooth equations
  /// only.
  [[nodiscard]] int switches() const {
    if constexpr (detail::GivesSwitches<Problem>) return problem_.switches();
    return 0;
  }
  /// Does switching function @p i switch at every integer? Others switch at zero.
  [[nodiscard]] bool is_rounded([[maybe_unused]] int i) const {
    if constexpr (detail::GivesSwitches<Problem>) return problem_.is_rounded(i);
    return false;
  }
  /// The smooth equations of a mode. @throws std::logic_error if the problem has no switches
  [[nodiscard]] std::shared_ptr<const detail::AnyProblem> in_mode(const Mode& mode) const {
    if constexpr (detail::GivesSwitches<Problem>)
      return std::make_shared<const Direct<Problem, Eigen::Dynamic>>(problem_.in_mode(mode));
    throw std::logic_error("this problem has no switches");
  }
  /// Switching functions, or shares (switching.hpp), of the equations of a mode, and their rates of change.
  void surfaces(double t, const State& x, std::span<double> values, std::span<double> rates) const {
    if constexpr (detail::GivesSwitches<Problem>) problem_.surfaces(t, OwnState(x), values, rates);
  }
  /// The derivatives of the switching functions of a mode along a @p direction of the state; nothing is
  /// written for a problem without layout().
  void surfaces_along([[maybe_unused]] double t, [[maybe_unused]] const State& x,
                      [[maybe_unused]] const State& direction,
                      [[maybe_unused]] std::span<double> derivatives) const {
    if constexpr (detail::GivesLayout<Problem>)
      problem_.surfaces_along(t, OwnState(x), OwnState(direction), derivatives);
  }
  /// Places of the unknowns and of their sensitivities, if there are any, in the state.
  [[nodiscard]] program::VariationalLayout layout() const {
    if constexpr (detail::GivesLayout<Problem>) return problem_.layout();
    return {size(), 0, second_order()};
  }

  /// The linear terms of f with constant coefficients, and its harmonic loads; none for a problem that
  /// branches or is in double only.
  [[nodiscard]] program::LinearTerms linear_terms() const {
    if constexpr (detail::GivesLinearTerms<Problem>) {
      return problem_.linear_terms();
    } else if constexpr (detail::TakesDual<Problem, program::Recorded> &&
                         !detail::GivesDiscontinuities<Problem>) {
      try {
        const program::Recording recording = program::record(problem_, 0, size(), false);
        return program::linear_terms(recording.graph, recording.slopes);
      } catch (const std::invalid_argument&) {
        // The right-hand side branches.
      }
    }
    return {Eigen::MatrixXd::Zero(size(), size()), {}};
  }

  /// The quantities that stay constant along every solution, at (t, x).
  /// @return false, with nothing written, if the problem gives none
  [[nodiscard]] bool invariants(double t, const State& x, Eigen::VectorXd& values) const {
    if constexpr (detail::GivesInvariants<Problem>) {
      if constexpr (n == m) {
        values = problem_.invariants(t, x);
      } else {
        values = problem_.invariants(t, OwnState(x));
      }
      return values.size() > 0;
    } else {
      return false;
    }
  }

  /// Bounds of each component at later times, valid if the state is within them now; infinite where there is
  /// no bound. @return false, with nothing written, if the problem gives none
  [[nodiscard]] bool bounds(State& lower, State& upper) const {
    constexpr bool has_lower = detail::GivesLowerBounds<Problem>,
                   has_upper = detail::GivesUpperBounds<Problem>;
    if constexpr (detail::GivesBounds<Problem>) {
      return problem_.bounds(lower, upper);
    } else if constexpr (has_lower || has_upper) {
      constexpr double infinity = std::numeric_limits<double>::infinity();
      lower = State::Constant(size(), -infinity);
      upper = State::Constant(size(), infinity);
      if constexpr (has_lower) lower = problem_.lower_bounds();
      if constexpr (has_upper) upper = problem_.upper_bounds();
      return true;
    } else {
      return false;
    }
  }

  /// Records the right-hand side as a tape; it is called once, at time @p t.
  /// @throws std::invalid_argument if the problem is in double only, branches on the state, or branches on
  /// the time without giving discontinuities
  [[nodiscard]] Tape record(double t) const {
    if constexpr (detail::TakesDual<Problem, program::Recorded>) {
      return program::record(problem_, t, size(), detail::GivesDiscontinuities<Problem>).tape();
    } else {
      throw std::invalid_argument(
          "series: this problem is written for double alone; make its call operator a template on the "
          "scalar");
    }
  }

  /// Machine code for the tapes of this problem, which runs in all threads share.
  [[nodiscard]] machine_code::SeriesCodes& series_codes() const { return *series_codes_; }

 private:
  static constexpr int m = Problem::dimension;
  using OwnState = Vector<double, m>;
  using OwnHalf = detail::HalfVector<double, m>;
  using OwnJacobian = Matrix<double, m, m>;

  void by_dual_numbers(double t, const State& x, Jacobian& j) const {
    constexpr int lanes = detail::lanes<m>;
    using D = Dual<double, lanes>;
    Vector<D, m> argument(size()), value(size());
    j.resize(size(), size());
    for (int first = 0; first < size(); first += lanes) {
      for (int i = 0; i < size(); ++i) {
        const int lane = i - first;
        argument[i] = lane >= 0 && lane < lanes ? D::variable(x[i], lane) : D(x[i]);
      }
      problem_(D(t), argument, value);
      for (int i = 0; i < size(); ++i) {
        for (int lane = 0; lane < lanes && first + lane < size(); ++lane)
          j(i, first + lane) = value[i].partial[static_cast<std::size_t>(lane)];
      }
    }
  }

  Problem problem_;
  std::shared_ptr<machine_code::SeriesCodes> series_codes_;
};
// NOLINTEND(modernize-use-override)

/// `Direct(problem)` is a Direct of the problem's own dimension.
template <class Problem>
Direct(Problem) -> Direct<Problem>;

}  // namespace nlmech::ivp
