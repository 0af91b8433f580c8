#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "chapters/algebraic_series/departure.hpp"
#include "chapters/algebraic_series/examples.hpp"
#include "nlmech/problems/duffing.hpp"
#include "nlmech/problems/texts.hpp"
#include "nlmech/scene/scene.hpp"

namespace nlmech::chapters::algebraic_series::extremes {
namespace {

/// A table row: one run with its outcome.
struct Attempt {
  std::string what, status;
  std::optional<double> error;  ///< largest error of a component at the end
  std::int64_t steps = 0;
  std::string remark;
};

/// Bessel equation of order 0 as a first-order system, singular at t = 0.
struct SingularCentre {
  static constexpr int dimension = 2;
  template <class T>
  void operator()(const T& t, const Vector<T, 2>& x, Vector<T, 2>& dxdt) const {
    dxdt[0] = x[1];
    dxdt[1] = -x[1] / t - x[0];
  }
};

/// An oscillator whose stiffness doubles for x > 0.5: a branch on the state without a declared event.
struct UnannouncedBranch {
  static constexpr int dimension = 2;
  template <class T>
  void operator()(const T& /*t*/, const Vector<T, 2>& x, Vector<T, 2>& dxdt) const {
    dxdt[0] = x[1];
    if (value_of(x[0]) > 0.5) {
      dxdt[1] = -2 * x[0];
    } else {
      dxdt[1] = -x[0];
    }
  }
};

Attempt attempt(std::string what, const ivp::System& system, const ivp::State& x0, double t0, double t1,
                const ivp::Series& method, const std::function<double(const ivp::State&)>& error,
                std::string remark = {}) {
  Attempt a{std::move(what), {}, {}, 0, std::move(remark)};
  try {
    const auto end = ivp::integrate(system, x0, t0, t1, method, {}, {.steps = 2'000'000});
    a.status = to_string(end.status.outcome());
    a.steps = end.statistics.steps;
    if (end.status.ok() && error) a.error = error(end.x);
  } catch (const std::invalid_argument&) {
    a.status = "refused";
  }
  return a;
}

std::function<double(const ivp::State&)> against(const ivp::State& reference) {
  return [reference](const ivp::State& x) { return (x - reference).cwiseAbs().maxCoeff(); };
}

std::vector<Attempt> attempts() {
  std::vector<Attempt> all;
  const auto& lorenz = lorenz_example();
  const ivp::State at_one = lorenz.reference(1).cast<double>();
  all.push_back(attempt("Lorenz to t = 1, T = 0.1, N = 20", lorenz.system, lorenz.x0, 0, 1,
                        published_series(0.1, 20), against(at_one),
                        "T below the radius, N too small: wrong without a failure status"));
  all.push_back(attempt("the same, T = 0.15", lorenz.system, lorenz.x0, 0, 1, published_series(0.15, 20),
                        against(at_one), "T above the radius"));
  all.push_back(
      attempt("the same by the radius", lorenz.system, lorenz.x0, 0, 1, accurate_series(), against(at_one)));
  const auto& duffing = forced_duffing_example();
  all.push_back(attempt("forced Duffing to t = 100, T = 0.5, N = 20", duffing.system, duffing.x0, 0, 100,
                        published_series(0.5, 20), {}, "T close to the radius"));
  const problems::TextProblem bodies("bodies");
  const ivp::System four(bodies);
  const ivp::State& begin = bodies.initial_state();
  const double energy = bodies.invariants(0.0, begin)[3];
  all.push_back(attempt(
      "four bodies to t = 5000, through an encounter at 0.039", four, begin, 0, 5000, accurate_series(),
      [&](const ivp::State& x) { return std::abs(bodies.invariants(0.0, x)[3] / energy - 1); },
      "error: of the energy, relative"));
  const ivp::System relaxation(problems::TextProblem("van-der-pol", {{"mu", 1000}}));
  all.push_back(attempt(
      "van der Pol, mu = 1000, to t = 2000", relaxation, {2, 0}, 0, 2000,
      {.relative_tolerance = 1e-12, .absolute_tolerance = 1e-12},
      [](const ivp::State& x) { return std::abs(x[0] - 1.706167732170465008); },
      "stiff: steps bounded by stability"));
  all.push_back(attempt("y' = y^3 beyond its blow-up time", ivp::System(problems::TextProblem("blow-up")),
                        ivp::State{1.0}, 0, 1, {.relative_tolerance = 1e-12, .absolute_tolerance = 1e-12},
                        {}));
  all.push_back(attempt("Bessel's equation into its singular point", ivp::System(SingularCentre{}),
                        {1.0, 1.0}, 1, 0, {.relative_tolerance = 1e-12, .absolute_tolerance = 1e-12}, {}));
  all.push_back(attempt("Bessel's equation from its singular point", ivp::System(SingularCentre{}),
                        {1.0, 0.0}, 0, 1, {.relative_tolerance = 1e-12, .absolute_tolerance = 1e-12}, {}));
  all.push_back(attempt("a branch on the state", ivp::System(UnannouncedBranch{}), {0.0, 1.0}, 0, 1,
                        accurate_series(), {}, "not announced by the problem"));
  const ivp::System free(problems::TextProblem("duffing"));
  const double period = problems::Duffing{}.period(1.0);
  for (const int order : {2, 10, 100}) {
    all.push_back(attempt(fmt::format("free Duffing over a period, order {}", order), free, {1, 0}, 0, period,
                          {.relative_tolerance = 1e-9, .absolute_tolerance = 1e-9, .order = order},
                          against({1, 0}), "tolerance 1e-9"));
  }
  return all;
}

void put(const std::vector<Attempt>& all, scene::Show& show) {
  show.table(all, {{"case", &Attempt::what},
                   {"status", &Attempt::status},
                   {"error at the end", &Attempt::error, 2},
                   {"steps", &Attempt::steps},
                   {"remark", &Attempt::remark}});
  const auto error = [&](const std::string& what) {
    const auto found = std::ranges::find(all, what, &Attempt::what);
    return found == all.end() ? NAN : found->error.value_or(NAN);
  };
  show.between("error at t = 1 with the printed steps", error("Lorenz to t = 1, T = 0.1, N = 20"), 0.1, 10,
               "tools/oracles/algebraic_series_motions.py: above 0.1 from t = 0.5, above 1 from 3.3");
  show.at_most("error by the radius", error("the same by the radius"), 1e-11,
               "rounding, amplified 30 times to t = 1");
  show.at_most("error of van der Pol's oscillator, mu = 1000", error("van der Pol, mu = 1000, to t = 2000"),
               1e-9, "tolerance 1e-12 in some hundred thousand steps; the limit cycle damps errors");
  show.at_most("drift of the energy through the encounter",
               error("four bodies to t = 5000, through an encounter at 0.039"), 1e-11,
               "rounding, where velocity and attraction are a hundred times larger");
  show.equals("cases that are refused", std::ranges::count(all, "refused", &Attempt::status), 1,
              "the branch alone");
}

}  // namespace

std::vector<scene::Scene> scenes() {
  const scene::Result result(
      "extremes", "steps by the radius of convergence where none is given; at most 2 million steps",
      attempts);
  return {
      {.name = "extremes",
       .title =
           "Limits of the series: radius of convergence, encounters, stiffness, singular points, branches",
       .content = scene::Content(put, result)}};
}

}  // namespace nlmech::chapters::algebraic_series::extremes
