#include "nlmech/comparison/cost/contenders.hpp"

#include <fmt/format.h>

#include <cmath>

#include "nlmech/comparison/any_method.hpp"
#include "nlmech/peers/ivp/registry.hpp"

namespace nlmech::comparison {

namespace {

Kind kind_of(peers::Family family) {
  switch (family) {
    case peers::Family::runge_kutta: return Kind::explicit_;
    case peers::Family::extrapolation: return Kind::extrapolation;
    case peers::Family::adams: return Kind::adams;
    case peers::Family::implicit: break;
  }
  return Kind::implicit;
}

}  // namespace

Kind kind_of(const AnyMethod& method) {
  const std::string& name = method.name;
  if (method.peer) return kind_of(peers::peer_family(name));
  if (name == "adaptive-collocation") return Kind::own;
  if (name == "series") return Kind::series;
  if (name == "rbf-coll" || name == "mcpi" || name == "lgl-coll" || name == "radau-coll")
    return Kind::polynomial;
  return method.info.steps == ivp::Steps::chosen ? Kind::explicit_ : Kind::classical;
}

std::string Contender::label() const {
  if (points) return fmt::format("{}, p = {}", name, *points);
  return nodes ? fmt::format("{}, N = {}", name, *nodes) : name;
}

Contender by_steps(const std::string& name, std::optional<int> nodes, Kind kind, double scale,
                   std::span<const double> factors, bool quick, double shape) {
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

std::vector<Contender> all_peers(bool quick) {
  std::vector<Contender> all;
  for (const bool implicit : {false, true}) {
    for (const std::string& name : peers::all_peer_names()) {
      if (peers::peer_is_implicit(name) != implicit) continue;
      all.push_back(by_tolerances(name, kind_of(any_method(name)), quick));
      if (!peers::peer_available(name)) all.back().settings.clear();
    }
  }
  return all;
}

ivp::NamedIntegrator integrator(const Contender& contender, const Setting& setting) {
  return any_integrator(any_method(contender.name), setting.settings);
}

}  // namespace nlmech::comparison
