/// @file
/// Libraries as their manuals run them, on equations in C++: what benchmarks compare with.
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

/// A library on one problem. @return did it get from t0 to t1? x is the state, to the end in place
using NativeRun = std::function<bool(double relative, double absolute, double t0, double t1, double* x)>;

/// One formula of a library.
struct NativePeer {
  std::string name;  ///< as in our interface: "gsl-rk8pd"
  NativeRun run;     ///< from the library's own loop
};

/// A problem's own equation on plain arrays, where nobody writes it down anew.
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

/// A problem for C libraries: the equations written for arrays, the Jacobian by dual numbers.
template <class Problem, class Plain>
class NativeProblem {
 public:
  static constexpr int n = Problem::dimension;  ///< components
  /// Takes copies.
  NativeProblem(const Problem& problem, const Plain& plain) : direct_(problem), plain_(plain) {}
  /// For a library; this object outlives it.
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

/// A formula of Odeint on an array of n numbers.
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

/// Formulas of GSL and CVODE.
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

/// These, and the explicit formulas of Odeint.
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
