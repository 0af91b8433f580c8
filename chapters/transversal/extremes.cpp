#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "chapters/transversal/oscillators.hpp"
#include "nlmech/ivp/transversal/mtl.hpp"
#include "nlmech/problems/reference_trajectory.hpp"
#include "nlmech/problems/texts.hpp"
#include "nlmech/scene/scene.hpp"

namespace nlmech::chapters::transversal::extremes {
namespace {

using ivp::Mtl;
using ivp::MtlLinear;
/// A table row: one run with its outcome.
struct RunEnd {
  std::string what, how, status;
  std::optional<double> error;  ///< error of the position at the end; nothing after a failure
  std::int64_t evaluations = 0;
};

/// The settings as text, such as "p = 3, h = 0.05, A zero, estimate to 1e-03".
std::string words(const Mtl& m) {
  std::string text = fmt::format("p = {}, h = {:.4g}, A {}", m.points, m.step, to_string(m.linear));
  if (m.error_tolerance > 0) text += fmt::format(", estimate to {:.0e}", m.error_tolerance);
  return text;
}

/// The method of the source: no error estimate.
Mtl blind(Mtl m) {
  m.error_tolerance = 0;
  return m;
}

template <class Problem>
RunEnd run_to_end(const std::string& what, const Problem& problem, const ivp::State& x0, double end,
                  double reference, const Mtl& method) {
  const auto s = ivp::integrate(ivp::System(problem), x0, 0, end, method);
  RunEnd f{
      what, words(method), std::string(to_string(s.status.outcome())), {}, s.statistics.right_hand_sides};
  if (s.status.ok()) f.error = std::abs(s.x[0] - reference);
  return f;
}

void add_van_der_pol(std::vector<RunEnd>& all, bool quick) {
  const auto add = [&](double mu, double end, double reference, const Mtl& method) {
    all.push_back(run_to_end(fmt::format("van der Pol, mu = {:g}, to t = {:g}", mu, end),
                             problems::TextProblem("van-der-pol", {{"mu", mu}}), {2, 0}, end, reference,
                             method));
  };
  constexpr double ten = 1.872808279858089700, hundred = 1.718587208019240655,
                   thousand = 1.706167732170465008;
  add(10, 40, ten, blind({.step = 0.05}));
  add(10, 40, ten, blind({.step = 0.01}));
  add(10, 40, ten, blind({.step = 0.01, .linear = MtlLinear::jacobian}));
  // Slow phase of the solution, up to t = 20.
  const problems::TextProblem slow("van-der-pol", {{"mu", 100}});
  const problems::ReferenceTrajectory<long double, problems::TextProblem> creeping(slow, {2, 0}, 0, 20);
  const auto before_the_leap = static_cast<double>(creeping(20)[0]);
  for (const MtlLinear linear : {MtlLinear::given, MtlLinear::zero, MtlLinear::jacobian})
    add(100, 20, before_the_leap, blind({.step = 0.05, .linear = linear}));
  add(100, 200, hundred, blind({.step = 0.05}));
  add(100, 200, hundred, blind({.step = 0.05, .linear = MtlLinear::zero}));
  add(100, 200, hundred, {.step = 0.05, .linear = MtlLinear::zero, .error_tolerance = 1e-3});
  add(100, 200, hundred, blind({.step = 0.05, .linear = MtlLinear::jacobian}));
  add(100, 200, hundred, {.step = 0.05, .linear = MtlLinear::jacobian, .error_tolerance = 1e-3});
  add(100, 200, hundred, {.step = 0.002, .linear = MtlLinear::jacobian, .error_tolerance = 1e-3});
  if (!quick)
    add(100, 200, hundred, {.step = 0.0005, .linear = MtlLinear::jacobian, .error_tolerance = 1e-3});
  add(1000, 2000, thousand, blind({.step = 0.5, .linear = MtlLinear::zero}));
  add(1000, 2000, thousand, blind({.step = 0.5, .linear = MtlLinear::jacobian}));
  add(1000, 2000, thousand, blind({.step = 0.125, .linear = MtlLinear::zero}));
  add(1000, 2000, thousand, blind({.step = 0.125, .linear = MtlLinear::jacobian}));
  add(1000, 2000, thousand, {.step = 0.125, .linear = MtlLinear::zero, .error_tolerance = 1e-3});
  add(1000, 2000, thousand, {.step = 0.125, .linear = MtlLinear::jacobian, .error_tolerance = 1e-3});
}

void add_fast(std::vector<RunEnd>& all) {
  for (const double m : {1., 1e3}) {
    const problems::TextProblem problem("driven-duffing", {{"stiffness", 1e6}, {"hardening", m}});
    for (const bool smooth : {true, false}) {
      const double x0 = smooth ? 1e-6 : 1;
      const Reference reference(problem, {x0, 0}, 0, 1);
      for (const double h : {1. / 3, 0.01, 5e-4}) {
        const std::string what = fmt::format("Duffing, w = 1000, m = {:g}, {} start, to t = 1", m,
                                             smooth ? "smooth" : "oscillatory");
        all.push_back(
            run_to_end(what, problem, {x0, 0}, 1, static_cast<double>(reference(1)[0]), blind({.step = h})));
        if (smooth && all.back().error) *all.back().error /= x0;  // relative error
      }
    }
  }
}

void add_linear(std::vector<RunEnd>& all) {
  for (const double z : {10., 1e3, 1e6}) {
    const problems::TextProblem problem("linear", {{"natural_frequency", 1e3}});
    const double h = z / 1e3, end = 3 * h;
    all.push_back(run_to_end(fmt::format("linear oscillator, w h = {:g}, one block", z), problem, {1, 0}, end,
                             std::cos(1e3 * end), blind({.step = h})));
  }
  // K = C = 0: force only, solution x = 1 + (1 - cos 2 t)/4.
  const problems::TextProblem bare("driven-duffing", {{"stiffness", 0}, {"hardening", 0}, {"frequency", 2}});
  all.push_back(run_to_end("K = C = 0 under a force", bare, {1, 0}, 12, 1 + (1 - std::cos(24.)) / 4,
                           blind({.step = 1})));
}

// Equidistant points of high degree: the block equations have a root far from the solution.
void add_far_root(std::vector<RunEnd>& all) {
  for (const double allowed : {0., 1e-2}) {
    const Mtl method{.step = 0.4, .points = 8, .error_tolerance = allowed};
    all.push_back(run_to_end("Duffing, x'' + x + x^3 = cos t, to t = 50",
                             problems::TextProblem("driven-duffing"), {1, 0}, 50, 1.203734404401093362708,
                             method));
  }
}

std::vector<RunEnd> run_ends(bool quick) {
  std::vector<RunEnd> all;
  add_van_der_pol(all, quick);
  add_far_root(all);
  add_fast(all);
  add_linear(all);
  return all;
}

void put(const std::vector<RunEnd>& all, scene::Show& show) {
  show.table(all, {{"case", &RunEnd::what},
                   {"how", &RunEnd::how},
                   {"status", &RunEnd::status},
                   {"error of x at the end", &RunEnd::error, 2},
                   {"right-hand sides", &RunEnd::evaluations}});
  const auto error = [&](const std::string& what, const Mtl& method) {
    const auto found =
        std::ranges::find_if(all, [&](const RunEnd& f) { return f.what == what && f.how == words(method); });
    return found == all.end() ? NAN : found->error.value_or(NAN);
  };
  // Silent failures: success with an error estimate, and a large error.
  const auto silent = std::ranges::count_if(all, [](const RunEnd& f) {
    return f.how.find("estimate") != std::string::npos && f.status == "success" && *f.error > 0.1;
  });
  show.equals("runs with an estimate that report success far from the solution", silent, 0,
              "the estimate stops them");
  show.between("runs that end with wrong_branch", std::ranges::count(all, "wrong_branch", &RunEnd::status), 2,
               10, "at least both of mu = 1000 with steps that cannot resolve the fast transition");
  show.between("error of p = 8, h = 0.4, without an estimate",
               error("Duffing, x'' + x + x^3 = cos t, to t = 50", blind({.step = 0.4, .points = 8})), 10, 1e9,
               "the solution stays below 2: a root of the equations of a block that is none of the problem");
  show.at_most("error of van der Pol's oscillator, mu = 10, h = 0.01",
               error("van der Pol, mu = 10, to t = 40", blind({.step = 0.01})), 1e-5,
               "order 4 with mu h = 0.1; measured 1e-7");
  show.at_most(
      "error of the creeping phase with the Jacobian, mu = 100, h = 0.05",
      error("van der Pol, mu = 100, to t = 20", blind({.step = 0.05, .linear = MtlLinear::jacobian})), 1e-6,
      "measured 4e-9 with a stabilised linear part");
  show.at_most("relative error of the smooth start, h = 1/3",
               error("Duffing, w = 1000, m = 1, smooth start, to t = 1", blind({.step = 1. / 3})), 1e-12,
               "linear to 18 digits: exact to 333 roundings of the phase");
  show.between("error of the oscillatory start, h = 0.01",
               error("Duffing, w = 1000, m = 1, oscillatory start, to t = 1", blind({.step = 0.01})), 1e-5,
               2e-3, "the frequency's shift 3 m/(8 w) = 3.75e-4 is what sampling at w h = 10 can miss");
  show.at_most("error of the oscillatory start, h = 0.0005",
               error("Duffing, w = 1000, m = 1, oscillatory start, to t = 1", blind({.step = 5e-4})), 1e-6,
               "regression value: 1e-6 to 1e-8 below w h = 0.6");
  show.at_most("error of the linear oscillator, w h = 1e6",
               error("linear oscillator, w h = 1e+06, one block", blind({.step = 1e3})), 1e-8,
               "3e6 roundings of the angle: 7e-10, and as much by squaring");
  show.at_most("error without spring and damper", error("K = C = 0 under a force", blind({.step = 1})), 1e-13,
               "a hundred roundings");
}

}  // namespace

std::vector<scene::Scene> scenes() {
  const scene::Result result("extremes", "van der Pol from (2, 0); Duffing x'' + 1e6 x + m x^3 = cos t",
                             run_ends);
  return {{.name = "extremes",
           .title = "MTL on stiff and fast problems: exact results, and bounded wrong ones",
           .content = scene::Content(put, result)}};
}

}  // namespace nlmech::chapters::transversal::extremes
