/// @file
/// Libraries as their manuals run them, on the chapter's problems: what benchmarks compare with.
#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "chapters/rbf_ivp/examples/cases.hpp"
#include "nlmech/comparison/cost/accuracy.hpp"
#include "nlmech/comparison/cost/contenders.hpp"
#include "nlmech/ivp/direct.hpp"
#include "nlmech/peers/ivp/native.hpp"
#include "nlmech/peers/ivp/odeint/odeint_native.hpp"
#include "nlmech/support/stopwatch.hpp"

namespace nlmech::chapters::rbf_ivp {

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

/// An example whose equations our methods get compiled too, as the libraries do: its own are a text.
template <class Problem>
[[nodiscard]] Case compiled(Case c, const Problem& problem) {
  c.system = ivp::System(problem);
  return c;
}

/// A problem for C libraries: the equations written for arrays, the Jacobian by dual numbers.
template <class Problem, class Plain>
class NativeProblem {
 public:
  static constexpr int n = Problem::dimension;  ///< components
  /// Takes copies.
  NativeProblem(const Problem& problem, const Plain& plain) : direct_(problem), plain_(plain) {}
  /// For a library; this object outlives it.
  [[nodiscard]] peers::NativeEquations equations() { return {n, &rhs, &jacobian, this}; }
  /// The equations.
  [[nodiscard]] const Plain& plain() const { return plain_; }

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

/// Formulas of GSL and CVODE.
template <class Problem, class Plain>
[[nodiscard]] std::vector<NativePeer> native_c_peers(const Problem& problem, const Plain& plain) {
  const auto shared = std::make_shared<NativeProblem<Problem, Plain>>(problem, plain);
  std::vector<NativePeer> all;
  using G = peers::Gsl::Formula;
  for (const auto formula : {G::rkf45, G::rk8pd, G::bsimp, G::msadams, G::msbdf}) {
    if (!peers::gsl_available()) break;
    all.push_back(
        {std::string(peers::Gsl{formula}.name()),
         [shared, formula](double relative, double absolute, double t0, double t1, double* x) {
           return peers::gsl_natively({formula, relative, absolute}, shared->equations(), t0, t1, x);
         }});
  }
  using C = peers::Cvode::Formula;
  for (const auto formula : {C::adams, C::bdf}) {
    if (!peers::cvode_available()) break;
    all.push_back(
        {std::string(peers::Cvode{formula}.name()),
         [shared, formula](double relative, double absolute, double t0, double t1, double* x) {
           return peers::cvode_natively({formula, relative, absolute}, shared->equations(), t0, t1, x);
         }});
  }
  return all;
}

/// These, and the explicit formulas of Odeint.
template <class Problem, class Plain>
[[nodiscard]] std::vector<NativePeer> native_peers(const Problem& problem, const Plain& plain) {
  std::vector<NativePeer> all = native_c_peers(problem, plain);
  using O = peers::Odeint::Formula;
  for (const auto formula : {O::dopri5, O::fehlberg78, O::bulirsch_stoer}) {
    if (!peers::odeint_available()) break;
    all.push_back(
        {std::string(peers::Odeint{formula}.name()),
         [plain, formula](double relative, double absolute, double t0, double t1, double* x) {
           std::array<double, Problem::dimension> state;
           std::copy_n(x, state.size(), state.begin());
           const bool there = peers::odeint_natively({formula, relative, absolute}, plain, t0, t1, state);
           std::copy_n(state.begin(), state.size(), x);
           return there;
         }});
  }
  return all;
}

/// In pieces between kinks of the right-hand side, as a user of a library would do who knows of them.
[[nodiscard]] inline NativeRun between(NativeRun run, std::vector<double> kinks) {
  return [run = std::move(run), kinks = std::move(kinks)](double relative, double absolute, double t0,
                                                          double t1, double* x) {
    double from = t0;
    for (const double kink : kinks) {
      if (kink <= from || kink >= t1) continue;
      if (!run(relative, absolute, from, kink, x)) return false;
      from = kink;
    }
    return run(relative, absolute, from, t1, x);
  };
}

/// Median of the example's error over runs to 16 times in the last tenth of the way; nothing if one fails.
[[nodiscard]] inline std::optional<double> native_error(const Case& c, const NativeRun& run,
                                                        double tolerance) {
  constexpr int times = 16;
  std::vector<double> errors;
  for (int i = 0; i < times; ++i) {
    const double end = c.t1 - (c.t1 - c.t0) / 10 * i / (times - 1);
    ivp::State x = c.x0;
    if (!run(tolerance, tolerance, c.t0, end, x.data())) return std::nullopt;
    const ivp::LongState truth = c.reference(end);
    errors.push_back(c.error ? c.error(x, truth) : comparison::relative_error(x, truth, c.amplitude));
  }
  return median(errors);
}

/// A library at its fastest.
struct FastestNative {
  std::function<void()> run;  ///< one integration
  double seconds;             ///< of it
};

/// The fastest tolerance at which a library alone has the wanted error; nothing if none has.
/// @param walked the same formula in our walk: alone it is tried at those tolerances that come to an end
/// there, with at most a hundred times the wanted error, since nothing stops it elsewhere
[[nodiscard]] inline std::optional<FastestNative> fastest_alone(const Case& c, const NativeRun& run,
                                                                const comparison::Contender& walked,
                                                                double wanted) {
  std::optional<FastestNative> best;
  for (const comparison::Setting& setting : walked.settings) {
    const auto there =
        comparison::accuracy_of(c, comparison::integrator(walked, setting), {.steps = 2'000'000});
    if (!there.error || *there.error > 100 * wanted) continue;
    const double tolerance = *setting.settings.tolerance;
    const auto error = native_error(c, run, tolerance);
    if (!error || !(*error <= wanted)) continue;
    const auto once = [&c, run, tolerance] {
      ivp::State x = c.x0;
      static_cast<void>(run(tolerance, tolerance, c.t0, c.t1, x.data()));
    };
    const double seconds = time_repeats(once, 5).smallest;
    if (!best || seconds < best->seconds) best = FastestNative{once, seconds};
  }
  return best;
}

}  // namespace nlmech::chapters::rbf_ivp
