#include "nlmech/spacecraft/control/optimal_gains.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "chapters/gss_control/craft.hpp"
#include "nlmech/scene/scene.hpp"
#include "nlmech/spacecraft/response.hpp"

namespace nlmech::chapters::gss_control::optimal_gains {
namespace {

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

/// Optimal k1 for given k2, k3: dJ/dk1 = 0 of the closed form is a pure cubic equation.
double best_k1(const spacecraft::Parameters& p, double k2, double k3, const CostWeights& w) {
  // J(k1) = a + b/k1 + c k1^2: three values give c and b.
  const double one = cost(p, {1, k2, k3}, w), two = cost(p, {2, k2, k3}, w), four = cost(p, {4, k2, k3}, w);
  // two - one = -b/2 + 3c, four - two = -b/4 + 12c.
  const double c = ((four - two) - (two - one) / 2) / 10.5, b = 2 * (3 * c - (two - one));
  return std::cbrt(b / (2 * c));
}

void draw(const spacecraft::Parameters& p, const CostWeights& w, scene::Show& show) {
  scene::Table data({{"k2", 3, true}, {"k3"}, {"excess"}});
  const OptimalGains full = spacecraft::optimal_gains(p, w), pd = optimal_pd_gains(p, w);
  const int n = show.quick() ? 41 : 81;
  for (int i = 0; i < n; ++i) {
    const double k2 = -1.9 + 16.9 * i / (n - 1);
    for (int j = 0; j < n; ++j) {
      const double k3 = 4 + 66. * j / (n - 1);
      const Gains gains{best_k1(p, k2, k3, w), k2, k3};
      data.add({k2, k3, cost(p, gains, w) / full.cost - 1});
    }
  }
  show.draw(std::move(data), "gss_control-cost-map",
            {{"heading", "Cost over the gains: flat about the optimum; PD control costs 6 % more"},
             {"height", "520"},
             {"optimum", fmt::format("{:.9g},{:.9g}", full.gains.k2, full.gains.k3)},
             {"pd", fmt::format("{:.9g},{:.9g}", pd.gains.k2, pd.gains.k3)}});
}

/// Cost by the residues of @p pairs poles; the truncation error of int u^2 is of the order 1/pairs.
double summed(const spacecraft::Parameters& p, const Gains& gains, const CostWeights& w, int pairs) {
  const std::array tip = {p.length};
  const auto r = step_response(spacecraft::ClosedLoop(p, gains), 1, tip, {.pairs = pairs});
  const spacecraft::ExponentialSum error({}, r.theta.poles(), r.theta.weights());
  return square_integral(error).value + w.deflection * square_integral(r.deflection[0]).value +
         w.torque * square_integral(r.torque).value;
}

/// Gains with their costs, in closed form and by the residues in time.
struct Row {
  double w;  ///< weight of the deflection
  const char* name;
  Gains gains;
  spacecraft::StepCosts closed;
  double cost, by_residues;

  Row(const spacecraft::Parameters& p, const CostWeights& weights, const char* of, const Gains& k)
      : w(weights.deflection),
        name(of),
        gains(k),
        closed(step_costs(p, k, p.length)),
        cost(spacecraft::cost(p, k, weights)),
        by_residues(4 * summed(p, k, weights, 128) / 3 - summed(p, k, weights, 32) / 3) {}
  [[nodiscard]] double k1() const { return gains.k1; }
  [[nodiscard]] double k2() const { return gains.k2; }
  [[nodiscard]] double k3() const { return gains.k3; }
  [[nodiscard]] double error() const { return closed.error; }
  [[nodiscard]] double deflection() const { return closed.deflection; }
  [[nodiscard]] double torque() const { return closed.torque; }
};

/// Checks the gains against the references; returns rows of the table.
std::vector<Row> check(const Known& k, const spacecraft::Parameters& p, scene::Show& show) {
  const CostWeights weights{k.w, 1 / 144.};
  const OptimalGains full = spacecraft::optimal_gains(p, weights), pd = optimal_pd_gains(p, weights);
  const auto row = [&](const char* name, const Gains& gains) { return Row(p, weights, name, gains); };
  std::vector<Row> rows = {row("optimal", full.gains)};
  if (k.w > 0) rows.push_back(row("optimal PD", pd.gains));
  rows.push_back(row("designed", designed_gains));
  rows.push_back(row("unit", unit_gains));
  const auto name = [&](const char* what) { return fmt::format("{}, W = {}", what, k.w); };
  const char* digits = "minimised by tools/oracles/gss_control_loop.py, twelve digits";
  const char* ten = "tools/oracles/gss_control_loop.py, ten digits";
  show.near(name("optimal k1"), full.gains.k1, k.full.k1, 1e-11, digits);
  show.near(name("optimal k2"), full.gains.k2, k.full.k2, 1e-11, digits);
  show.near(name("optimal k3"), full.gains.k3, k.full.k3, 1e-11, digits);
  show.near(name("optimal PD k1"), pd.gains.k1, k.pd.k1, 1e-11, digits);
  show.near(name("optimal PD k3"), pd.gains.k3, k.pd.k3, 1e-11, digits);
  show.near(name("optimal cost"), {full.cost, "s"}, k.full_cost, 1e-11, digits);
  show.near(name("optimal PD cost"), {pd.cost, "s"}, k.pd_cost, 1e-11, digits);
  show.near(name("cost of the designed gains"), {cost(p, designed_gains, weights), "s"}, k.designed, 1e-9,
            ten);
  show.near(name("cost of the unit gains"), {cost(p, unit_gains, weights), "s"}, k.unit, 1e-9, ten);
  show.near(name("optimal cost by residues"), {rows.front().by_residues, "s"}, k.full_cost, 1e-4,
            "the sum over 128 poles, extrapolated from 32 and 128: the next order of 1/pairs");
  return rows;
}

void put(scene::Show& show) {
  const spacecraft::Parameters p = craft(true);
  const CostWeights hundred{100, 1 / 144.}, none{0, 1 / 144.};
  draw(p, hundred, show);
  std::vector<Row> rows;
  for (const Known& k : known) {
    const std::vector<Row> more = check(k, p, show);
    rows.insert(rows.end(), more.begin(), more.end());
  }
  show.table(rows, {{"W", &Row::w},
                    {"gains", &Row::name},
                    {"k1", &Row::k1, 9},
                    {"k2", &Row::k2, 9},
                    {"k3", &Row::k3, 9},
                    {"int e^2", &Row::error, 6},
                    {"int y(L)^2", &Row::deflection, 6},
                    {"int u^2", &Row::torque, 6},
                    {"cost", &Row::cost, 9},
                    {"cost by residues", &Row::by_residues, 5}});
  const OptimalGains full = spacecraft::optimal_gains(p, hundred);
  // oracle: gss_control_loop optimum cost at W = 100, PD optimum cost at W = 100, optimum cost at W = 0,
  // designed cost at W = 0
  show.near("excess of the PD optimum, W = 100", optimal_pd_gains(p, hundred).cost / full.cost - 1,
            2.81953458248 / 2.66069488543 - 1, 1e-9, "the two costs above");
  show.near("excess of the designed gains, W = 0",
            cost(p, designed_gains, none) / spacecraft::optimal_gains(p, none).cost - 1,
            1.797672917 / 1.73666826615 - 1, 1e-6, "the two costs above");
  // The gains of the text have k2 = 0, which is optimal only for W = 0.
  const auto response = step_response(spacecraft::ClosedLoop(p, full.gains), 1, std::array{p.length});
  show.between("overshoot of the optimum, W = 100", extremes(response.theta, 0, 60).largest.value - 1, 0, 0.3,
               "between none and that of a well-damped second-order system");
}

}  // namespace

std::vector<scene::Scene> scenes() {
  return {{.name = "optimal-gains",
           .title = "Cost over the gains: designed, unit, optimal, PD",
           .place = "our own, for what section 3.1.4 leaves open",
           .content = scene::Content(put)}};
}

}  // namespace nlmech::chapters::gss_control::optimal_gains
