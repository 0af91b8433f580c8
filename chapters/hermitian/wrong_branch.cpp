#include <fmt/format.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "chapters/hermitian/scenes.hpp"
#include "nlmech/ivp/hermitian.hpp"
#include "nlmech/problems/van_der_pol.hpp"

namespace nlmech::chapters {
namespace {

using scene::Workshop;

constexpr double mu = 100, end = 200,
                 truth = 1.718587208019240655;  // at t = 200, by Taylor series in 70 digits

/// A fixed step with and without the test of its estimate.
struct Fate {
  double step = 0;
  std::string unchecked, checked;  ///< how the runs end
  double error = 0;                ///< of the unchecked run at the end; NaN if it fails
  double stopped = 0;              ///< where the checked run ends
};

struct Trace {
  std::vector<std::array<double, 2>> wrong;  ///< step 0.0625, not checked
  std::vector<std::array<double, 2>> right;  ///< steps chosen
  std::vector<Fate> fates;
};

constexpr double drawn_step = 0.0625;

Trace trace() {
  const ivp::System<2> system(problems::VanDerPol{.mu = mu});
  const ivp::State<2> x0(2, 0);
  Trace t;
  const auto keep = [](std::vector<std::array<double, 2>>& points) {
    return [&points](const ivp::Step<2>& s) {
      if (points.empty() || s.t1 - points.back()[0] > 0.2 || std::abs(s.x1[0] - points.back()[1]) > 0.02)
        points.push_back({s.t1, s.x1[0]});
      return true;
    };
  };
  static_cast<void>(ivp::integrate(
      system, x0, 0, end, ivp::Hermitian{.step = drawn_step, .branch_tolerance = HUGE_VAL}, keep(t.wrong)));
  static_cast<void>(ivp::integrate(system, x0, 0, end,
                                   ivp::Hermitian{.relative_tolerance = 1e-8, .absolute_tolerance = 1e-8},
                                   keep(t.right)));
  for (const double step : {0.25, 0.125, 0.0625, 0.03125, 0.015625, 0.0078125, 0.00390625, 0.001953125}) {
    const auto blind =
        ivp::integrate(system, x0, 0, end, ivp::Hermitian{.step = step, .branch_tolerance = HUGE_VAL});
    const auto seeing = ivp::integrate(system, x0, 0, end, ivp::Hermitian{.step = step});
    t.fates.push_back({step, std::string(to_string(blind.status.outcome())),
                       std::string(to_string(seeing.status.outcome())),
                       blind.status.ok() ? std::abs(blind.x[0] - truth) : NAN, seeing.t});
  }
  return t;
}

scene::Showing show(const Trace& t) {
  scene::Table data({{"run"}, {"t"}, {"x"}});
  for (const auto& [time, x] : t.right) data.add({std::string("right"), time, x});
  for (const auto& [time, x] : t.wrong) data.add({std::string("wrong"), time, x});
  scene::Table table({{"step", 4}, {"not checked"}, {"error at t = 200", 2}, {"checked"}, {"ends at t", 5}});
  double silent = 0, refused = 0, accepted = 0;
  for (const Fate& f : t.fates) {
    table.add({f.step, f.unchecked, std::isnan(f.error) ? scene::Cell() : scene::Cell(f.error), f.checked,
               f.stopped});
    if (f.unchecked == "success" && f.error > 0.1 && f.checked != "wrong_branch") ++silent;
    if (f.unchecked == "success" && f.error < 0.01 && f.checked != "success") ++refused;
    if (f.checked == "success") accepted = std::max(accepted, f.error);
  }
  scene::Showing showing;
  showing.figure = {
      std::move(data), "hermitian-wrong-branch", {{"heading", "Converged at every step, and wrong"}}};
  showing.table = std::move(table);
  showing.quantities = {
      scene::near("steps that err by more than 0.1 without notice", "1", silent, 0, 0, "each must be caught"),
      scene::near("steps that err by less than 0.01 and are refused", "1", refused, 0, 0, "none may be"),
      scene::at_most("greatest error of an accepted step", "1", accepted, 0.05,
                     "far below the amplitude of 2")};
  return showing;
}

}  // namespace

void add_wrong_branch(scene::Chapter& chapter) {
  const auto& run =
      chapter.add_run<Trace>("branches", "van der Pol, mu = 100, from (2, 0); Laier's operators", {},
                             [](Workshop&) { return trace(); });
  chapter.add({.name = "wrong-branch",
               .title = "Newton's iteration converges, and the solution is lost",
               .place = "our own",
               .needs = {&run},
               .show = [&run](Workshop& w) { return show(w.result(run)); }});
}

}  // namespace nlmech::chapters
