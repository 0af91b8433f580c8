#include "nlmech/spacecraft/optimal_gains.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "chapters/gss_control/craft.hpp"
#include "chapters/gss_control/scenes.hpp"
#include "nlmech/spacecraft/parseval.hpp"
#include "nlmech/spacecraft/response.hpp"

namespace nlmech::chapters {
namespace {

using scene::Workshop;
using spacecraft::CostWeights;
using spacecraft::Gains;
using spacecraft::OptimalGains;

// R = 1/144. oracle: gss_control_loop optimum k* at *, optimum cost *, PD optimum *, * cost at *
struct Known {
  double w;
  Gains full;
  double full_cost;
  Gains pd;
  double pd_cost, designed, unit;
};
constexpr std::array known = {Known{0,
                                    {12, 0, 20.8400191938},
                                    1.73666826615,
                                    {12, 0, 20.8400191938},
                                    1.73666826615,
                                    1.797672917,
                                    12.12322338},
                              Known{100,
                                    {12, 4.82952499282, 31.9283386251},
                                    2.66069488543,
                                    {4.55260668488, 0, 12.8362319884},
                                    2.81953458248,
                                    5.161126448,
                                    12.37236809},
                              Known{1000,
                                    {12, 18.7466651844, 52.0146602067},
                                    4.33455501723,
                                    {1.54306938056, 0, 7.47309009948},
                                    4.84300329826,
                                    35.43220823,
                                    14.61467044}};

double worst(const Gains& a, const Gains& b) {
  const auto off = [](double x, double y) { return std::abs(x - y) / std::max(1., std::abs(y)); };
  return std::max({off(a.k1, b.k1), off(a.k2, b.k2), off(a.k3, b.k3)});
}

/// The gain k1 that is best with these k2, k3: dJ/dk1 = 0 of the closed form is a cubic with one term.
double best_k1(const spacecraft::Parameters& p, double k2, double k3, const CostWeights& w) {
  // J(k1) = a + b/k1 + c k1^2: three values give c and b.
  const double one = cost(p, {1, k2, k3}, w), two = cost(p, {2, k2, k3}, w), four = cost(p, {4, k2, k3}, w);
  // two - one = -b/2 + 3c, four - two = -b/4 + 12c.
  const double c = ((four - two) - (two - one) / 2) / 10.5, b = 2 * (3 * c - (two - one));
  return std::cbrt(b / (2 * c));
}

scene::Figure map(const spacecraft::Parameters& p, const CostWeights& w, bool quick) {
  scene::Table data({{"k2", 3, true}, {"k3"}, {"excess"}});
  const double least = optimal_gains(p, w).cost;
  const int n = quick ? 41 : 81;
  for (int i = 0; i < n; ++i) {
    const double k2 = -1.9 + 16.9 * i / (n - 1);
    for (int j = 0; j < n; ++j) {
      const double k3 = 4 + 66. * j / (n - 1);
      const Gains gains{best_k1(p, k2, k3, w), k2, k3};
      data.add({k2, k3, cost(p, gains, w) / least - 1});
    }
  }
  const OptimalGains full = optimal_gains(p, w), pd = optimal_pd_gains(p, w);
  return {std::move(data),
          "gss_control-cost-map",
          {{"heading", "A flat valley: plain PD control costs 6 % more"},
           {"height", "520"},
           {"optimum", fmt::format("{:.9g},{:.9g}", full.gains.k2, full.gains.k3)},
           {"pd", fmt::format("{:.9g},{:.9g}", pd.gains.k2, pd.gains.k3)}}};
}

void add_row(scene::Table& table, double w, const char* name, const spacecraft::Parameters& p,
             const Gains& gains, int pairs_for_quadrature) {
  const CostWeights weights{w, 1 / 144.};
  const spacecraft::StepCosts closed = step_costs(p, gains, p.length);
  const auto sum = costs_by_quadrature(p, gains, p.length, pairs_for_quadrature);
  table.add({w, name, gains.k1, gains.k2, gains.k3, closed.error, closed.deflection, closed.torque,
             cost(p, gains, weights), sum.error + w * sum.deflection + weights.torque * sum.torque});
}

scene::Showing show(bool quick) {
  const spacecraft::Parameters p = craft(true);
  scene::Table table({{"W"},
                      {"gains"},
                      {"k1", 9},
                      {"k2", 9},
                      {"k3", 9},
                      {"int e^2", 6},
                      {"int y(L)^2", 6},
                      {"int u^2", 6},
                      {"cost", 9},
                      {"cost by quadrature", 9}});
  std::vector<scene::Quantity> quantities;
  const int modes = quick ? 32 : 64;
  for (const Known& k : known) {
    const CostWeights weights{k.w, 1 / 144.};
    const OptimalGains full = optimal_gains(p, weights), pd = optimal_pd_gains(p, weights);
    const auto name = [&](const char* what) { return fmt::format("{}, W = {}", what, k.w); };
    const char* digits = "minimised by tools/oracles/gss_control_loop.py, twelve digits";
    quantities.push_back(scene::at_most(name("optimal gains against known ones"), "1",
                                        worst(full.gains, k.full), 1e-11, digits));
    quantities.push_back(scene::at_most(name("optimal PD gains against known ones"), "1",
                                        worst(pd.gains, k.pd), 1e-11, digits));
    quantities.push_back(scene::near(name("optimal cost"), "s", full.cost, k.full_cost, 1e-11, digits));
    quantities.push_back(scene::near(name("optimal PD cost"), "s", pd.cost, k.pd_cost, 1e-11, digits));
    quantities.push_back(scene::near(name("cost of the designed gains"), "s",
                                     cost(p, designed_gains, weights), k.designed, 1e-9,
                                     "tools/oracles/gss_control_loop.py, ten digits"));
    quantities.push_back(scene::near(name("cost of the unit gains"), "s", cost(p, unit_gains, weights),
                                     k.unit, 1e-9, "tools/oracles/gss_control_loop.py, ten digits"));
    const auto sum = costs_by_quadrature(p, full.gains, p.length, modes);
    quantities.push_back(scene::near(
        name("optimal cost by quadrature over frequency"), "s",
        sum.error + k.w * sum.deflection + weights.torque * sum.torque, k.full_cost, quick ? 1e-5 : 2e-6,
        "Parseval's integral of the exact transfer functions, its tail extrapolated "
        "from so many modes"));
    add_row(table, k.w, "optimal", p, full.gains, modes);
    if (k.w > 0) add_row(table, k.w, "optimal PD", p, pd.gains, modes);
    add_row(table, k.w, "designed", p, designed_gains, modes);
    add_row(table, k.w, "unit", p, unit_gains, modes);
  }
  const CostWeights hundred{100, 1 / 144.};
  const OptimalGains full = optimal_gains(p, hundred);
  // oracle: gss_control_loop optimum k* at W = 100
  for (const auto& [name, value, reference] :
       {std::tuple{"k1", full.gains.k1, 12.}, std::tuple{"k2", full.gains.k2, 4.82952499282},
        std::tuple{"k3", full.gains.k3, 31.9283386251}})
    quantities.push_back(scene::near(fmt::format("optimal {}, W = 100", name), "1", value, reference, 1e-11,
                                     "tools/oracles/gss_control_loop.py, twelve digits"));
  // oracle: gss_control_loop optimum cost at W = 100, PD optimum cost at W = 100, optimum cost at W = 0,
  // designed cost at W = 0
  const double pd_over = optimal_pd_gains(p, hundred).cost / full.cost - 1;
  quantities.push_back(scene::near("excess of the PD optimum, W = 100", "1", pd_over,
                                   2.81953458248 / 2.66069488543 - 1, 1e-9, "the two costs above"));
  const double by_hand = cost(p, designed_gains, {0, 1 / 144.}) / optimal_gains(p, {0, 1 / 144.}).cost - 1;
  quantities.push_back(scene::near("excess of the designed gains, W = 0", "1", by_hand,
                                   1.797672917 / 1.73666826615 - 1, 1e-6, "the two costs above"));
  // The text's own gains as the best for some weights: k2 = 0 is optimal only for W = 0.
  const auto response = step_response(spacecraft::ClosedLoop(p, full.gains), 1, std::array{p.length});
  const auto e = extremes(response.theta, 0, 60);
  quantities.push_back({"overshoot of the optimum, W = 100", "1", e.largest.value - 1, 0, 0.3,
                        "between none and that of a well-damped second-order system"});
  return {map(p, hundred, quick), table, quantities};
}

}  // namespace

void add_optimal_gains(scene::Chapter& chapter) {
  chapter.add({.name = "optimal-gains",
               .title = "The cost over the gains: designed, unit, optimal, PD",
               .place = "our own",
               .needs = {},
               .show = [](Workshop& w) { return show(w.quick()); }});
}

}  // namespace nlmech::chapters
