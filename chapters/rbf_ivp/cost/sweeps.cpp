#include "chapters/rbf_ivp/cost/sweeps.hpp"

#include "chapters/rbf_ivp/examples/cases.hpp"

namespace nlmech::chapters::rbf_ivp {
namespace {

using comparison::by_steps;
using comparison::Kind;
using comparison::MethodSweep;

constexpr double few_node_factors[] = {2, 1, 0.5, 0.25};
constexpr double many_node_factors[] = {1, 0.5, 0.25, 0.125};
constexpr double picard_factors[] = {4, 2, 1, 0.5};
constexpr double runge_kutta_factors[] = {1, 0.2, 0.04, 0.008};
constexpr double second_order_factors[] = {0.2, 0.02, 0.004};
constexpr double first_order_factors[] = {0.01, 0.001};

}  // namespace

StepScales free_duffing_steps() {
  const double period = duffing_period();
  return {.few_nodes = period / 10,
          .many_nodes = period,
          .few_shape = 0.77 * period / 10,
          .many_shape = 34 / 4.0};
}

StepScales impact_steps() {
  return {.few_nodes = 0.5, .many_nodes = 6, .few_shape = 0.66 * 0.5, .many_shape = 34 / 4.0};
}

StepScales three_mass_steps() {
  return {.few_nodes = 0.625, .many_nodes = 20, .few_shape = 0.35 * 0.625, .many_shape = 0.39 * 20};
}

std::vector<MethodSweep> sweeps(const StepScales& s, bool quick) {
  const double few = s.few_nodes, many = s.many_nodes;
  std::vector<MethodSweep> all = {
      by_steps("rbf-coll", 7, Kind::source, few, few_node_factors, quick, s.few_shape),
      by_steps("rbf-coll", 35, Kind::source, many, many_node_factors, quick, s.many_shape),
      by_steps("lgl-coll", 7, Kind::polynomial, few, few_node_factors, quick),
      by_steps("lgl-coll", 35, Kind::polynomial, many, many_node_factors, quick),
      by_steps("radau-coll", 7, Kind::polynomial, few, few_node_factors, quick),
      by_steps("radau-coll", 17, Kind::polynomial, many / 2, many_node_factors, quick),
      by_steps("mcpi", 9, Kind::polynomial, few, picard_factors, quick),
      by_steps("mcpi", 17, Kind::polynomial, few, picard_factors, quick)};
  for (const char* name : {"euler", "backward-euler"})
    all.push_back(by_steps(name, {}, Kind::classical, few, first_order_factors, quick));
  for (const char* name : {"explicit", "newmark", "hht", "generalized-alpha"})
    all.push_back(by_steps(name, {}, Kind::classical, few, second_order_factors, quick));
  for (const char* name : {"rk4", "rk6"})
    all.push_back(by_steps(name, {}, Kind::classical, few, runge_kutta_factors, quick));
  all.push_back(comparison::by_tolerances("adaptive-collocation", Kind::own, quick));
  all.push_back(comparison::by_tolerances("ode45", Kind::explicit_, quick));
  for (const MethodSweep& peer : comparison::all_peers(quick)) all.push_back(peer);
  return all;
}

}  // namespace nlmech::chapters::rbf_ivp
