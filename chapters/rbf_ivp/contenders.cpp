#include "chapters/rbf_ivp/contenders.hpp"

#include <fmt/format.h>

#include <cmath>
#include <span>
#include <utility>

#include "chapters/rbf_ivp/any_method.hpp"
#include "chapters/rbf_ivp/cases.hpp"
#include "nlmech/peers/ivp/registry.hpp"

namespace nlmech::chapters {
namespace {

/// A sweep of steps, in units of a scale. Quick: every other.
Contender by_steps(const char* name, std::optional<int> nodes, Kind kind, double scale,
                   std::span<const double> factors, bool quick, double shape = 0) {
  Contender c{name, nodes, kind, {}};
  for (std::size_t i = 0; i < factors.size(); i += quick ? 2 : 1) {
    ivp::Settings s{.step = scale * factors[i], .nodes = nodes};
    if (shape > 0) s.shape = shape / *s.step;
    c.settings.push_back({fmt::format("step {:.4g}", *s.step), s});
  }
  return c;
}

Contender by_tolerances(const std::string& name, Kind kind, bool quick) {
  Contender c{name, {}, kind, {}};
  for (int power = 4; power <= (quick ? 8 : 13); power += quick ? 4 : 1) {
    ivp::Settings s{.tolerance = std::pow(10, -power)};
    c.settings.push_back({fmt::format("tolerance {:.0e}", *s.tolerance), s});
  }
  return c;
}

constexpr double ladder[] = {2, 1, 0.5, 0.25};
constexpr double long_ladder[] = {1, 0.5, 0.25, 0.125};
constexpr double picard_ladder[] = {4, 2, 1, 0.5};
constexpr double runge_kutta_ladder[] = {1, 0.2, 0.04, 0.008};
constexpr double second_order_ladder[] = {0.2, 0.02, 0.004};
constexpr double first_order_ladder[] = {0.01, 0.001};

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

std::string Contender::label() const { return nodes ? fmt::format("{}, N = {}", name, *nodes) : name; }

std::vector<Contender> contenders(const StepScales& s, bool quick) {
  const double few = s.few_nodes, many = s.many_nodes;
  std::vector<Contender> all = {
      by_steps("rbf-coll", 7, Kind::radial, few, ladder, quick, s.few_shape),
      by_steps("rbf-coll", 35, Kind::radial, many, long_ladder, quick, s.many_shape),
      by_steps("lgl-coll", 7, Kind::polynomial, few, ladder, quick),
      by_steps("lgl-coll", 35, Kind::polynomial, many, long_ladder, quick),
      by_steps("radau-coll", 7, Kind::polynomial, few, ladder, quick),
      by_steps("radau-coll", 17, Kind::polynomial, many / 2, long_ladder, quick),
      by_steps("mcpi", 9, Kind::polynomial, few, picard_ladder, quick),
      by_steps("mcpi", 17, Kind::polynomial, few, picard_ladder, quick)};
  for (const char* name : {"euler", "backward-euler"})
    all.push_back(by_steps(name, {}, Kind::classical, few, first_order_ladder, quick));
  for (const char* name : {"explicit", "newmark", "hht", "generalized-alpha"})
    all.push_back(by_steps(name, {}, Kind::classical, few, second_order_ladder, quick));
  for (const char* name : {"rk4", "rk6"})
    all.push_back(by_steps(name, {}, Kind::classical, few, runge_kutta_ladder, quick));
  all.push_back(by_tolerances("ode45", Kind::explicit_, quick));
  for (const bool implicit : {false, true}) {
    for (const std::string& name : peers::all_peer_names()) {
      if (peers::peer_is_implicit(name) != implicit) continue;
      all.push_back(by_tolerances(name, implicit ? Kind::implicit : Kind::explicit_, quick));
      if (!peers::peer_available(name)) all.back().settings.clear();
    }
  }
  return all;
}

template <int n>
ivp::NamedIntegrator<n> integrator(const Contender& contender, const Setting& setting) {
  return any_integrator<n>(any_method(contender.name), setting.settings);
}

template ivp::NamedIntegrator<2> integrator<2>(const Contender&, const Setting&);
template ivp::NamedIntegrator<6> integrator<6>(const Contender&, const Setting&);

}  // namespace nlmech::chapters
