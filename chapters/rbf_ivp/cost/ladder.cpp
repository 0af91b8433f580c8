#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "chapters/rbf_ivp/cost/sweeps.hpp"
#include "chapters/rbf_ivp/examples/cases.hpp"
#include "nlmech/comparison/cost/cost_curves.hpp"
#include "nlmech/problems/texts.hpp"
#include "nlmech/scene/scene.hpp"

namespace nlmech::chapters::rbf_ivp::ladder {
namespace {

using comparison::Cost;
using comparison::Kind;

constexpr double nine_digits = 1e-9;

/// A problem that does not say that it is of second order.
template <class Problem>
struct FirstOrder {
  static constexpr int dimension = Problem::dimension;
  Problem problem;
  [[nodiscard]] int size() const { return problem.size(); }
  template <class T>
  void operator()(const T& t, const Vector<T, dimension>& x, Vector<T, dimension>& dxdt) const {
    problem(t, x, dxdt);
  }
};

/// One step of the way, with the cheapest setting that has nine digits, or else its most accurate one.
struct Rung {
  std::string what;
  std::optional<Cost> cost;
};

Rung rung(std::string what, const comparison::Curve& curve) {
  const Cost* found = nullptr;
  for (const Cost& c : curve.costs) {
    if (c.error && *c.error <= nine_digits && (found == nullptr || c.time.median < found->time.median))
      found = &c;
  }
  if (found == nullptr) found = comparison::best_of(curve);
  return {std::move(what), found != nullptr ? std::optional(*found) : std::nullopt};
}

template <class Problem>
std::vector<Rung> climb(const Problem& problem, const Case& c, const StepScales& s, bool quick) {
  constexpr double ladder[] = {1, 0.5, 0.25, 0.125};
  const auto one = [&](const Case& example, const comparison::Contender& contender) {
    return comparison::cost_curves(example, {contender}, quick).front();
  };
  const auto ours = comparison::by_tolerances("adaptive-collocation", Kind::own, quick);
  Case first_order = c;
  first_order.system = ivp::System(FirstOrder<Problem>{problem});
  return {rung("the dissertation: Gaussians at 35 LGL nodes, Newton",
               one(c, comparison::by_steps("rbf-coll", 35, Kind::source, s.many_nodes, ladder, quick,
                                           s.many_shape))),
          rung("polynomials at the same nodes",
               one(c, comparison::by_steps("lgl-coll", 35, Kind::polynomial, s.many_nodes, ladder, quick))),
          rung("left end and 16 Radau nodes", one(c, comparison::by_steps("radau-coll", 17, Kind::polynomial,
                                                                          s.many_nodes / 2, ladder, quick))),
          rung("sweeps in place of Newton's iteration, steps and order under an estimate",
               one(first_order, ours)),
          rung("accelerations as unknowns: adaptive-collocation", one(c, ours)),
          rung("for comparison: odeint-dopri5",
               one(c, comparison::by_tolerances("odeint-dopri5", Kind::explicit_, quick)))};
}

/// The ladder on both problems.
struct Ladders {
  std::vector<Rung> duffing, chain;
};

scene::Table table_of(const Ladders& ladders) {
  scene::Table table({{"problem"},
                      {"method"},
                      {"error"},
                      {"right-hand sides"},
                      {"time (ms)"},
                      {"time a step (us)"},
                      {"times faster"}});
  const auto add = [&](const char* problem, const std::vector<Rung>& rungs) {
    double before = 0;
    for (const Rung& r : rungs) {
      if (!r.cost) {
        table.add({problem, r.what, {}, {}, {}, {}, {}});
        continue;
      }
      const double now = r.cost->time.median;
      table.add({problem, r.what, r.cost->error, r.cost->work.right_hand_sides, 1e3 * now,
                 1e6 * now / static_cast<double>(r.cost->work.steps),
                 before > 0 ? scene::Cell(before / now) : scene::Cell()});
      before = now;
    }
  };
  add("free Duffing, 500 s", ladders.duffing);
  add("three masses, 200 s", ladders.chain);
  return table;
}

void draw(const Ladders& ladders, scene::Show& show) {
  scene::Panel& panel = show.plot("Sweeps and accelerations save most of the time",
                                  "median run time at nine digits (s); the Gaussians have fewer", "");
  panel.log_x().y_range(6.6, 0.4).set("lmargin 27").key("at graph 0.02, graph 0.99 left top samplen 2");
  panel.set(
      "ytics ('Gaussians, 35 LGL nodes' 1, 'polynomials, same nodes' 2, 'left end, 16 Radau nodes' 3, "
      "'sweeps, step control' 4, 'adaptive-collocation' 5, 'beside: odeint-dopri5' 6)");
  panel.set("arrow from graph 0, first 5.5 to graph 1, first 5.5 nohead linestyle 11");
  scene::Table data({{"problem"}, {"rung"}, {"time_s"}, {"time_low_s"}, {"time_high_s"}, {"error"}});
  const auto add = [&](int problem, const char* name, const std::vector<Rung>& rungs, int style) {
    for (int number = 0; const Rung& r : rungs) {
      ++number;
      if (r.cost)
        data.add({problem, number, r.cost->time.median, r.cost->time.smallest, r.cost->time.largest,
                  r.cost->error});
    }
    const auto of = [problem](const char* which) {
      return fmt::format(
          "(int(column('problem')) == {} && int(column('rung')) {} ? column('time_s') : NaN):rung", problem,
          which);
    };
    panel.columns(name, of("< 6"), {"linespoints dashtype solid", style});
    panel.columns("", of("== 6"), scene::points(style));
  };
  add(1, "free oscillator, 500 s", ladders.duffing, 5);
  add(2, "three masses, 200 s", ladders.chain, 1);
  show.figure().size(760, 360).data(std::move(data));
}

void put(const Ladders& ladders, scene::Show& show) {
  draw(ladders, show);
  show.table(table_of(ladders));
  const auto work = [](const std::vector<Rung>& rungs) {
    const auto& ours = rungs[rungs.size() - 2].cost;  // the last one is the yardstick
    return ours ? static_cast<double>(ours->work.right_hand_sides) : NAN;
  };
  // Recorded with fixed steps chosen by hindsight: 16 nodes, 10.8 sweeps a step of P, 105
  // steps; control of steps and the estimate are not to cost more than twice that, nor can they halve it.
  show.between("right-hand sides for nine digits, free Duffing", work(ladders.duffing), 0.9e4, 7.2e4,
               "half to four times the recorded ones with the best fixed step: 1.8e4");
  show.between("right-hand sides for nine digits, three masses", work(ladders.chain), 1.5e3, 1.2e4,
               "the same nodes and sweeps: some 3e3 at the best fixed step");
}

}  // namespace

std::vector<scene::Scene> scenes() {
  const scene::Result run(
      "times-ladder",
      "the cheapest of a few steps or of the tolerances 1e-4 to 1e-13 with nine digits, the most accurate "
      "one where none has them; one thread, median of repeats",
      [](bool quick) {
        return Ladders{
            climb(problems::TextProblem("duffing"), free_duffing_case(), free_duffing_steps(), quick),
            climb(problems::TextProblem("three-dof"), three_mass_case(), three_mass_steps(), quick)};
      });
  return {{.name = "ladder",
           .title = "From the dissertation's algorithm to the adaptive integrator, step by step",
           .content = scene::Content(put, run)}};
}

}  // namespace nlmech::chapters::rbf_ivp::ladder
