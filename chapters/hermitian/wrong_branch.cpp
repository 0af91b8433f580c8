#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "nlmech/ivp/hermitian/hermitian.hpp"
#include "nlmech/problems/texts.hpp"
#include "nlmech/scene/scene.hpp"

namespace nlmech::chapters::hermitian::wrong_branch {
namespace {

constexpr double mu = 100, end = 200,
                 reference = 1.718587208019240655;  // at t = 200, by Taylor series in 70 digits

/// Runs with one fixed step size, with and without the branch test.
struct Pair {
  double step;
  std::string unchecked, checked;  ///< outcomes of the runs
  std::optional<double> error;     ///< error of the unchecked run at the end; nothing if it fails
  double stopped;                  ///< time at which the checked run ends

  /// Does the unchecked run report success?
  [[nodiscard]] bool finishes() const { return unchecked == "success"; }
};

struct Point {
  double t, x;
};

struct Branches {
  std::vector<Point> wrong;  ///< fixed step size 0.0625, without branch test
  std::vector<Point> right;  ///< adaptive steps
  std::vector<Pair> pairs;
};

/// Integrates from (2, 0) to the end. @param points receives points for the figure; may be null
ivp::Solution run(const ivp::Hermitian& method, std::vector<Point>* points = nullptr) {
  const auto keep = [points](const ivp::Step& s) {
    if (points &&
        (points->empty() || s.t1 - points->back().t > 0.2 || std::abs(s.x1[0] - points->back().x) > 0.02))
      points->push_back({s.t1, s.x1[0]});
    return true;
  };
  return ivp::integrate(ivp::System(problems::TextProblem("van-der-pol", {{"mu", mu}})), {2, 0}, 0, end,
                        method, keep);
}

ivp::Hermitian unchecked(double step) { return {.step = step, .branch_tolerance = HUGE_VAL}; }

Branches compute() {
  Branches b;
  static_cast<void>(run(unchecked(0.0625), &b.wrong));
  static_cast<void>(run({.relative_tolerance = 1e-8, .absolute_tolerance = 1e-8}, &b.right));
  for (const double step : {0.25, 0.125, 0.0625, 0.03125, 0.015625, 0.0078125, 0.00390625, 0.001953125}) {
    const auto without_check = run(unchecked(step)), with_check = run({.step = step});
    b.pairs.push_back(
        {step, std::string(to_string(without_check.status.outcome())),
         std::string(to_string(with_check.status.outcome())),
         without_check.status.ok() ? std::optional(std::abs(without_check.x[0] - reference)) : std::nullopt,
         with_check.t});
  }
  return b;
}

void draw(const Branches& b, scene::Show& show) {
  scene::Table data({{"run"}, {"t"}, {"x"}});
  for (const Point& p : b.right) data.add({"right", p.t, p.x});
  for (const Point& p : b.wrong) data.add({"wrong", p.t, p.x});
  show.plot("Van der Pol: Newton's iteration converges, but to a wrong branch", "time (s)", "{/:Italic x}")
      .x_range(0, end)
      .set("bmargin 7")
      .key("at screen 0.55, screen 0.02 center bottom maxrows 2")
      .columns("Laier, adaptive steps, tolerance 10^{−8}", "t:(strcol('run') eq 'right' ? column('x') : NaN)",
               {"lines linewidth 3", 1})
      .columns("Laier, fixed step of 0.0625 s, without the branch check",
               "t:(strcol('run') eq 'wrong' ? column('x') : NaN)", {"lines dashtype 1", 5});
  show.figure().data(std::move(data));
}

void put(const Branches& b, scene::Show& show) {
  draw(b, show);
  show.table(b.pairs, {{"step", &Pair::step, 4},
                       {"not checked", &Pair::unchecked},
                       {"error at t = 200", &Pair::error, 2},
                       {"checked", &Pair::checked},
                       {"ends at t", &Pair::stopped, 5}});
  int silent = 0, refused = 0;
  double accepted = 0;
  for (const Pair& p : b.pairs) {
    const double error = p.error.value_or(NAN);
    if (p.finishes() && error > 0.1 && p.checked != "wrong_branch") ++silent;
    if (p.finishes() && error < 0.01 && p.checked != "success") ++refused;
    if (p.checked == "success") accepted = std::max(accepted, error);
  }
  show.equals("steps that err by more than 0.1 and are accepted", silent, 0, "each must be caught");
  show.equals("steps that err by less than 0.01 and are refused", refused, 0, "none may be");
  show.at_most("greatest error of an accepted step", accepted, 0.05, "far below the amplitude of 2");
}

}  // namespace

std::vector<scene::Scene> scenes() {
  const scene::Result result("branches", "van der Pol, mu = 100, from (2, 0); Laier's operators", compute);
  return {{.name = "wrong-branch",
           .title = "Newton's iteration converges to a wrong branch",
           .content = scene::Content(put, result)}};
}

}  // namespace nlmech::chapters::hermitian::wrong_branch
