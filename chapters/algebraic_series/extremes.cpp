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
#include "chapters/algebraic_series/scenes.hpp"
#include "nlmech/problems/blow_up.hpp"
#include "nlmech/problems/duffing.hpp"
#include "nlmech/problems/van_der_pol.hpp"

namespace nlmech::chapters {
namespace {

using scene::Workshop;

/// One case.
struct Fate {
  std::string what, status;
  std::optional<double> error;  ///< greatest of the components at the end
  std::int64_t steps = 0;
  std::string remark;
};

/// Bessel's equation of order 0 in x, as a first-order system that is singular at x = 0.
struct SingularCentre {
  static constexpr int dimension = 2;
  template <class T>
  void operator()(const T& t, const Vector<T, 2>& x, Vector<T, 2>& dxdt) const {
    dxdt[0] = x[1];
    dxdt[1] = -x[1] / t - x[0];
  }
};

/// A force that sets in when the body has moved far enough: a branch on the state, which nothing announces.
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

template <int n>
Fate fate(std::string what, const ivp::System<n>& system, const ivp::State<n>& x0, double t0, double t1,
          const ivp::Series& method, const std::function<double(const ivp::State<n>&)>& error,
          std::string remark = {}) {
  Fate f{std::move(what), {}, {}, 0, std::move(remark)};
  try {
    const auto end = ivp::integrate(system, x0, t0, t1, method, {}, {.steps = 2'000'000});
    f.status = to_string(end.status.outcome());
    f.steps = end.statistics.steps;
    if (end.status.ok() && error) f.error = error(end.x);
  } catch (const std::invalid_argument&) {
    f.status = "refused";
  }
  return f;
}

template <int n>
std::function<double(const ivp::State<n>&)> against(const ivp::State<n>& truth) {
  return [truth](const ivp::State<n>& x) { return (x - truth).cwiseAbs().maxCoeff(); };
}

std::vector<Fate> fates() {
  std::vector<Fate> all;
  const auto& lorenz = lorenz_example();
  const ivp::State<3> at_one = lorenz.reference(1).cast<double>();
  all.push_back(fate<3>("Lorenz to t = 1, T = 0.1, N = 20", lorenz.system, lorenz.x0, 0, 1,
                        published_series(0.1, 20), against<3>(at_one),
                        "T below the radius, N too small: wrong, and no notice"));
  all.push_back(fate<3>("the same, T = 0.15", lorenz.system, lorenz.x0, 0, 1, published_series(0.15, 20),
                        against<3>(at_one), "T above the radius"));
  all.push_back(fate<3>("the same by the radius", lorenz.system, lorenz.x0, 0, 1, accurate_series(),
                        against<3>(at_one)));
  const auto& duffing = forced_duffing_example();
  all.push_back(fate<2>("forced Duffing to t = 100, T = 0.5, N = 20", duffing.system, duffing.x0, 0, 100,
                        published_series(0.5, 20), {}, "T close to the radius"));
  const problems::FourBodies bodies;
  const ivp::System<Eigen::Dynamic> four(bodies);
  const ivp::State<Eigen::Dynamic> begin = problems::FourBodies::initial_state();
  const double energy = bodies.invariants(0.0, problems::FourBodies::initial_state())[3];
  all.push_back(fate<Eigen::Dynamic>(
      "four bodies to t = 5000, through an encounter at 0.039", four, begin, 0, 5000, accurate_series(),
      [&](const ivp::State<Eigen::Dynamic>& x) {
        return std::abs(bodies.invariants(0.0, Vector<double, 24>(x))[3] / energy - 1);
      },
      "error: of the energy, relative"));
  const ivp::System<2> relaxation(problems::VanDerPol{.mu = 1000});
  all.push_back(fate<2>(
      "van der Pol, mu = 1000, to t = 2000", relaxation, {2, 0}, 0, 2000,
      {.relative_tolerance = 1e-12, .absolute_tolerance = 1e-12},
      [](const ivp::State<2>& x) { return std::abs(x[0] - 1.706167732170465008); },
      "stiff: steps bounded by stability"));
  all.push_back(fate<1>("y' = y^3 past its end", ivp::System<1>(problems::BlowUp{}), ivp::State<1>(1.0), 0, 1,
                        {.relative_tolerance = 1e-12, .absolute_tolerance = 1e-12}, {}));
  all.push_back(fate<2>("Bessel's equation into its singular point", ivp::System<2>(SingularCentre{}),
                        {1.0, 1.0}, 1, 0, {.relative_tolerance = 1e-12, .absolute_tolerance = 1e-12}, {}));
  all.push_back(fate<2>("Bessel's equation from its singular point", ivp::System<2>(SingularCentre{}),
                        {1.0, 0.0}, 0, 1, {.relative_tolerance = 1e-12, .absolute_tolerance = 1e-12}, {}));
  all.push_back(fate<2>("a branch on the state", ivp::System<2>(UnannouncedBranch{}), {0.0, 1.0}, 0, 1,
                        accurate_series(), {}, "no problem announces it"));
  const ivp::System<2> free(problems::Duffing{});
  const double period = problems::Duffing{}.period(1.0);
  for (const int order : {2, 10, 100}) {
    all.push_back(fate<2>(fmt::format("free Duffing over a period, order {}", order), free, {1, 0}, 0, period,
                          {.relative_tolerance = 1e-9, .absolute_tolerance = 1e-9, .order = order},
                          against<2>({1, 0}), "tolerance 1e-9"));
  }
  return all;
}

scene::Showing show(const std::vector<Fate>& all) {
  scene::Table table({{"case"}, {"status"}, {"error at the end", 2}, {"steps"}, {"remark"}});
  for (const Fate& f : all) table.add({f.what, f.status, scene::to_cell(f.error), f.steps, f.remark});
  const auto& of = [&](const std::string& what) -> const Fate& {
    return *std::find_if(all.begin(), all.end(), [&](const Fate& f) { return f.what == what; });
  };
  const auto error = [&](const std::string& what) { return of(what).error.value_or(NAN); };
  const auto refused =
      std::count_if(all.begin(), all.end(), [](const Fate& f) { return f.status == "refused"; });
  scene::Showing showing;
  showing.table = std::move(table);
  const double fixed = error("Lorenz to t = 1, T = 0.1, N = 20");
  showing.quantities = {
      {"error at t = 1 with the printed steps", "1", fixed, 0.1, 10,
       "tools/oracles/algebraic_series_motions.py: above 0.1 from t = 0.5, above 1 from 3.3"},
      scene::at_most("error by the radius", "1", error("the same by the radius"), 1e-11,
                     "rounding, amplified 30 times to t = 1"),
      scene::at_most("error of van der Pol's oscillator, mu = 1000", "1",
                     error("van der Pol, mu = 1000, to t = 2000"), 1e-9,
                     "tolerance 1e-12 in some hundred thousand steps that forget their errors"),
      scene::at_most("drift of the energy through the encounter", "1",
                     error("four bodies to t = 5000, through an encounter at 0.039"), 1e-11,
                     "rounding, where velocity and attraction are a hundred times larger"),
      scene::near("cases that are refused", "1", static_cast<double>(refused), 1, 0, "the branch alone")};
  return showing;
}

}  // namespace

void add_extremes(scene::Chapter& chapter) {
  const auto& run = chapter.add_run<std::vector<Fate>>(
      "extremes", "steps by the radius of convergence where none is given; at most 2 million steps", {},
      [](Workshop&) { return fates(); });
  chapter.add({.name = "extremes",
               .title = "Where a series ends: radius, encounters, stiffness, singular points, branches",
               .place = "our own",
               .needs = {&run},
               .show = [&run](Workshop& w) { return show(w.result(run)); }});
}

}  // namespace nlmech::chapters
