#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "chapters/rbf_inverse/control/duffing_runs.hpp"
#include "nlmech/bvp/optimal_control/extremal.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::chapters::rbf_inverse::constraints {
namespace {

using bvp::DuffingCase;

/// A force over the time.
struct History {
  std::vector<double> t, f;

  [[nodiscard]] double peak() const {
    double peak = 0;
    for (const double value : f) peak = std::max(peak, std::abs(value));
    return peak;
  }
};
History sampled(const std::function<double(double)>& force) {
  constexpr int samples = 400;
  History h;
  for (int i = 0; i <= samples; ++i) {
    h.t.push_back(inferred * i / samples);
    h.f.push_back(force(h.t.back()));
  }
  return h;
}
/// Without bound f = -lambda2.
History force_of(const bvp::Solution& s) {
  return sampled([&](double t) { return -s.at(t)[3]; });
}

scene::Panel& begin_plot(const std::string& heading, scene::Show& show) {
  scene::Panel& panel = show.plot(heading, "time (s)", "force {/:Italic f} (1/s^{2})").key("top left");
  show.figure().size(760, 480).columns({"panel", "curve", "x", "y"});
  return panel;
}

/// An extremal under a bound on the force.
struct Bounded {
  std::optional<double> limit;
  bvp::Extremal extremal;
  History control = {};  ///< empty if there is no extremal

  [[nodiscard]] const Status& status() const { return extremal.solution.status; }
  /// Nothing if there is no extremal.
  [[nodiscard]] std::optional<double> first(Eigen::Index i) const {
    return status().ok() ? std::optional(extremal.solution.first()[i]) : std::nullopt;
  }
  [[nodiscard]] std::optional<double> found(double value) const {
    return status().ok() ? std::optional(value) : std::nullopt;
  }
};

/// Without bound, then with three of them.
std::vector<Bounded> bounded(const bvp::Multistart& found) {
  const bvp::ExtremalProblem problem = duffing_problem(printed_settings(DuffingCase::fixed));
  const bvp::Extremal& free = cheapest_of(found);
  std::vector<Bounded> all = {{{}, free, force_of(free.solution)}};
  for (const double limit : {15.0, 13.5, 8.0}) {
    const bvp::ConstraintPath path = bvp::control_bound_path(all.front().control.peak(), limit);
    Bounded& b = all.emplace_back(Bounded{limit, tighten(problem, start_from(free.solution), path)});
    if (!b.status().ok()) continue;
    const bvp::ExtremalProblem clipped = with_constraints(problem, path(1));
    b.control = sampled([&](double t) { return control_at(clipped, b.extremal.solution, t)[0]; });
  }
  return all;
}

void put_bounded(const std::vector<Bounded>& all, scene::Show& show) {
  scene::Panel& panel = begin_plot("A bounded force pumps longer at its limit", show).y_range(-20, 28);
  for (const Bounded& b : all) {
    if (b.status().ok())
      panel.curve(b.limit ? fmt::format("at most {:g}", *b.limit) : "no bound", b.control.t, b.control.f,
                  scene::lines(b.limit ? 0 : 8));
  }
  show.table(all,
             {{"bound of |f|", &Bounded::limit},
              {"status", [](const Bounded& b) { return to_string(b.status().outcome()); }},
              {"cost", [](const Bounded& b) { return b.found(b.extremal.cost); }, 10},
              {"lambda1(0)", [](const Bounded& b) { return b.first(2); }, 8},
              {"lambda2(0)", [](const Bounded& b) { return b.first(3); }, 8},
              {"miss of the integrated end", [](const Bounded& b) { return b.found(b.extremal.miss); }, 2}});
  const Bounded& at_15 = all[1];
  show.near("peak of the unbounded force", {all[0].control.peak(), "1/s^2"}, 16.409, 1e-3, "recorded");
  show.near("cost at 15", at_15.extremal.cost, 122.3004593, 1e-6,
            "recorded, its smoothing 1e-4 as well; steps of 0.01");
  show.near("lambda1(0) at 15", at_15.first(2).value_or(NAN), -21.30021353, 1e-5, "the same");
  show.near("lambda2(0) at 15", at_15.first(3).value_or(NAN), 0.9462278952, 1e-5, "the same");
  show.at_most("largest force at 15", {at_15.control.peak(), "1/s^2"}, 15, "the clip itself");
  show.equals("is a bound of 8 refused?", all[3].status().outcome() == Outcome::infeasible, 1,
              "less energy than the target's comes in: see the text");
}

/// An extremal through x1(T/2) = a value, its state and its co-state on both sides of that time.
struct Through {
  double value;
  bvp::Found found;
  bool cheapest;
  Eigen::VectorXd before = found.extremal.solution.at(inferred / 2, bvp::Side::before),
                  after = found.extremal.solution.at(inferred / 2, bvp::Side::after);

  [[nodiscard]] double cost() const { return found.extremal.cost; }
  [[nodiscard]] double jump() const { return std::abs(after[3] - before[3]); }
};

std::vector<Through> through(bool quick) {
  const bvp::DuffingStarts fewer = {
      .constants = false, .unforced = 6, .pumps = 1, .direct = 3, .random = 0, .driven = 0};
  std::vector<Through> all;
  for (const double value : {0.0, 1.0, -1.0}) {
    bvp::DuffingSettings settings = printed_settings(DuffingCase::fixed);
    settings.waypoints = {{inferred / 2, 0, value}};
    const bvp::Multistart some = duffing_extremals(settings, quick ? fewer : bvp::DuffingStarts{});
    if (some.found.empty())
      throw Failure(fmt::format("no extremal through x1({:g}) = {:g} was found", inferred / 2, value));
    for (const bvp::Found& f : some.found) all.push_back({value, f, &f == &some.found.front()});
  }
  return all;
}

void put_through(const std::vector<Through>& all, const bvp::Multistart& free, scene::Show& show) {
  scene::Panel& panel = begin_plot("A prescribed position makes the force's slope jump", show);
  const auto curve = [&](const std::string& name, const bvp::Extremal& e, int style) {
    const History h = force_of(e.solution);
    panel.curve(name, h.t, h.f, scene::lines(style));
  };
  curve("no point between", cheapest_of(free), 8);
  const double known[] = {284.305667, 362.325047, 228.250180};
  std::size_t i = 0;
  for (const Through& t : all) {
    if (!t.cheapest) continue;
    curve(fmt::format("{{/:Italic x}}_{{1}}(1) = {:g}", t.value), t.found.extremal, 0);
    show.at_most(fmt::format("cost through {:g}", t.value), t.cost(), known[i++] * (1 + 1e-7),
                 "recorded; the lower one of the two counts");
  }
  show.at_most("largest jump of lambda2", std::ranges::max(all, {}, &Through::jump).jump(), 1e-9,
               "x2 is not prescribed there: its co-state is continuous");
  show.table(all, {{"x1(1) =", &Through::value},
                   {"cost", &Through::cost, 10},
                   {"kind", [](const Through& t) { return to_string(t.found.extremal.second_order.kind); }},
                   {"starts that led to it", [](const Through& t) { return t.found.hits; }},
                   {"lambda1(1-)", [](const Through& t) { return t.before[2]; }, 8},
                   {"lambda1(1+)", [](const Through& t) { return t.after[2]; }, 8},
                   {"jump of lambda2", &Through::jump, 2}});
}

}  // namespace

std::vector<scene::Scene> scenes() {
  const scene::Result<bvp::Multistart> free = extremals(DuffingCase::fixed);
  const scene::Result bounds(
      "bounded-force",
      "fixed case, T = 2; the limit is brought down to its value with a wide smoothing, then that to 1e-4",
      bounded, free);
  const scene::Result points(
      "through-a-point", "fixed case, T = 2, x1 prescribed at t = 1 too; the program's own starts", through);
  return {{.name = "bounded-control",
           .title = "The fixed case under a bound on the force, by continuation",
           .content = scene::Content(put_bounded, bounds)},
          {.name = "interior-point",
           .title = "A position prescribed at half the time: the co-state jumps",
           .content = scene::Content(put_through, points, free)}};
}

}  // namespace nlmech::chapters::rbf_inverse::constraints
