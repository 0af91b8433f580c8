/// @file
/// Peer libraries called through their own interfaces on equations in C++, for comparison in benchmarks.
#pragma once

#include <algorithm>
#include <array>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "nlmech/ivp/direct.hpp"
#include "nlmech/peers/ivp/native.hpp"
#include "nlmech/peers/ivp/odeint/odeint_direct.hpp"

namespace nlmech::chapters {

/// Integrates one problem by a library. @param x state at t0; overwritten by the state at t1
/// @return whether t1 was reached
using NativeRun = std::function<bool(double relative, double absolute, double t0, double t1, double* x)>;

/// One formula of a library.
struct NativePeer {
  std::string name;  ///< method name in nlmech, such as "gsl-rk8pd"
  NativeRun run;     ///< by the library's own step loop
};

/// Adapter: calls the right-hand side of a problem on plain arrays.
template <class Problem>
struct OnArrays {
  Problem p;  ///< the problem
  /// dx/dt.
  void operator()(const double* x, double* dxdt, double t) const {
    using State = Vector<double, Problem::dimension>;
    State slope;
    p(t, State(Eigen::Map<const State>(x)), slope);
    Eigen::Map<State>{dxdt} = slope;
  }
};

/// A problem for C libraries: right-hand side from @p Plain, Jacobian and time derivative from
/// ivp::Direct<Problem>.
template <class Problem, class Plain>
class NativeProblem {
 public:
  static constexpr int n = Problem::dimension;  ///< number of components
  /// Copies both arguments.
  NativeProblem(const Problem& problem, const Plain& plain) : direct_(problem), plain_(plain) {}
  /// Equations for a C library. They point to this object, which must outlive them.
  [[nodiscard]] peers::NativeEquations equations() { return {n, &rhs, &jacobian, this}; }

 private:
  using State = Vector<double, n>;
  static int rhs(double t, const double* x, double* f, void* data) {
    static_cast<const NativeProblem*>(data)->plain_(x, f, t);
    return 0;
  }
  static int jacobian(double t, const double* x, double* dfdx, double* dfdt, void* data) {
    const auto& direct = static_cast<const NativeProblem*>(data)->direct_;
    const State state = Eigen::Map<const State>(x);
    typename ivp::Direct<Problem>::Jacobian j;
    State slope;
    direct.jacobian(t, state, j);
    if (!direct.time_derivative(t, state, slope)) slope.setZero();
    Eigen::Map<Eigen::Matrix<double, n, n, Eigen::RowMajor>>{dfdx} = j;
    Eigen::Map<State>{dfdt} = slope;
    return 0;
  }
  ivp::Direct<Problem> direct_;
  Plain plain_;
};

/// A formula of Odeint on a state of n numbers.
template <std::size_t n, class Plain>
[[nodiscard]] NativeRun odeint_alone(const Plain& plain, peers::Odeint::Formula formula) {
  return [plain, formula](double relative, double absolute, double t0, double t1, double* x) {
    std::array<double, n> state;
    std::copy_n(x, n, state.begin());
    const bool there = peers::odeint_natively({formula, relative, absolute}, plain, t0, t1, state);
    std::copy_n(state.begin(), n, x);
    return there;
  };
}

/// A formula of GSL or CVODE. @param natively gsl_natively() or cvode_natively()
template <class Peer, class Shared, class Natively>
[[nodiscard]] NativePeer c_peer(typename Peer::Formula formula, const Shared& shared,
                                const Natively& natively) {
  return {std::string(Peer{formula}.name()),
          [=](double relative, double absolute, double t0, double t1, double* x) {
            return natively(Peer{formula, relative, absolute}, shared->equations(), t0, t1, x);
          }};
}

/// All compared formulas of GSL and CVODE; without a library that the build does not have.
template <class Problem, class Plain>
[[nodiscard]] std::vector<NativePeer> native_c_peers(const Problem& problem, const Plain& plain) {
  const auto shared = std::make_shared<NativeProblem<Problem, Plain>>(problem, plain);
  std::vector<NativePeer> all;
  using G = peers::Gsl::Formula;
  for (const auto formula : {G::rkf45, G::rk8pd, G::bsimp, G::msadams, G::msbdf}) {
    if (peers::gsl_available()) all.push_back(c_peer<peers::Gsl>(formula, shared, &peers::gsl_natively));
  }
  using C = peers::Cvode::Formula;
  for (const auto formula : {C::adams, C::bdf}) {
    if (peers::cvode_available())
      all.push_back(c_peer<peers::Cvode>(formula, shared, &peers::cvode_natively));
  }
  return all;
}

/// native_c_peers() and the explicit formulas of Odeint.
template <class Problem, class Plain>
[[nodiscard]] std::vector<NativePeer> native_peers(const Problem& problem, const Plain& plain) {
  std::vector<NativePeer> all = native_c_peers(problem, plain);
  using O = peers::Odeint::Formula;
  for (const auto formula : {O::dopri5, O::fehlberg78, O::bulirsch_stoer}) {
    if (peers::odeint_available())
      all.push_back(
          {std::string(peers::Odeint{formula}.name()), odeint_alone<Problem::dimension>(plain, formula)});
  }
  return all;
}

}  // namespace nlmech::chapters
