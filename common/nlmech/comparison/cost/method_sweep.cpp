#include "nlmech/comparison/cost/method_sweep.hpp"

#include <fmt/format.h>

#include <cmath>

#include "nlmech/comparison/any_method.hpp"
#include "nlmech/peers/ivp/registry.hpp"

namespace nlmech::comparison {

Kind kind_of(const ivp::MethodInfo& method) {
  using enum ivp::Family;
  switch (method.family) {
    case polynomials: return Kind::polynomial;
    case collocation: return Kind::own;
    case series: return Kind::series;
    case runge_kutta: return Kind::explicit_;
    case extrapolation: return Kind::extrapolation;
    case adams: return Kind::adams;
    case implicit: return Kind::implicit;
    case classical: break;
  }
  return Kind::classical;
}

std::string MethodSweep::label() const {
  if (points) return fmt::format("{}, p = {}", name, *points);
  return nodes ? fmt::format("{}, N = {}", name, *nodes) : name;
}

MethodSweep by_steps(const std::string& name, std::optional<int> nodes, Kind kind, double scale,
                     std::span<const double> factors, bool quick, double shape) {
  MethodSweep c{name, nodes, kind, {}};
  for (std::size_t i = 0; i < factors.size(); i += quick ? 2 : 1) {
    ivp::Settings s{.step = scale * factors[i], .nodes = nodes};
    if (shape > 0) s.shape = shape / *s.step;
    c.settings.push_back({fmt::format("step {:.4g}", *s.step), s});
  }
  return c;
}

MethodSweep by_tolerances(const std::string& name, Kind kind, bool quick) {
  MethodSweep c{name, {}, kind, {}};
  for (int power = 4; power <= (quick ? 8 : 13); power += quick ? 4 : 1) {
    ivp::Settings s{.tolerance = std::pow(10, -power)};
    c.settings.push_back({fmt::format("tolerance {:.0e}", *s.tolerance), s});
  }
  return c;
}

std::vector<MethodSweep> all_peers(bool quick) {
  std::vector<MethodSweep> all;
  for (const bool implicit : {false, true}) {
    for (const ivp::MethodInfo& peer : peers::peer_methods()) {
      if ((peer.family == ivp::Family::implicit) != implicit) continue;
      all.push_back(by_tolerances(std::string(peer.name), kind_of(peer), quick));
      if (!peer.is_available()) all.back().settings.clear();
    }
  }
  return all;
}

ivp::NamedIntegrator integrator(const MethodSweep& sweep, const Setting& setting) {
  return any_method(sweep.name).with(setting.settings);
}

}  // namespace nlmech::comparison
