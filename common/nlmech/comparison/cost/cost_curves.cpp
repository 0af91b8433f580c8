#include "nlmech/comparison/cost/cost_curves.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "nlmech/peers/ivp/registry.hpp"

namespace nlmech::comparison {
namespace {

/// A curve of a peer, of what its page is about, or else of ours.
scene::Side side_of(const Curve& curve) {
  // A curve may be of what is no method, and its name go on: "rbf-coll, N = 35".
  const auto peers = peers::peer_methods();
  if (std::ranges::find(peers, curve.name, &ivp::MethodInfo::name) != peers.end()) return scene::Side::peer;
  if (curve.kind == Kind::closed_form) return scene::Side::floor;
  return curve.kind <= Kind::series ? scene::Side::subject : scene::Side::ours;
}

}  // namespace

const Cost* best_of(const Curve& curve) {
  const Cost* best = nullptr;
  for (const Cost& c : curve.costs) {
    if (c.error && (best == nullptr || *c.error < *best->error)) best = &c;
  }
  return best;
}

const Curve& curve_of(const std::vector<Curve>& curves, const std::string& name) {
  for (const Curve& curve : curves) {
    if (curve.name == name) return curve;
  }
  throw std::out_of_range("there is no curve of " + name);
}

double least_error(const std::vector<Curve>& curves, const std::string& name) {
  const Cost* best = best_of(curve_of(curves, name));
  return best != nullptr ? *best->error : std::numeric_limits<double>::quiet_NaN();
}

std::vector<scene::MethodLine> method_lines(const std::vector<Curve>& curves) {
  std::vector<scene::MethodLine> lines;
  for (const Curve& curve : curves) {
    scene::MethodLine& line = lines.emplace_back();
    line.method = curve.name;
    line.group = static_cast<std::size_t>(curve.kind);
    line.side = side_of(curve);
    for (const Cost& c : curve.costs)
      line.attempts.push_back(
          {c.setting, c.status, c.error, c.time, {c.work.right_hand_sides, c.work.steps, c.work.rejected}});
  }
  return lines;
}

std::vector<scene::MethodGroup> method_groups(const std::string& own, const std::string& source) {
  // In the order of Kind. No picture has both closed forms and collocation by polynomials.
  return {{source, 2},
          {own, 0},
          {"closed form", 7},
          {"Taylor series", 1},
          {"polynomials, Picard", 7},
          {"fixed step, others", 6},
          {"Runge-Kutta, step control", 3},
          {"extrapolation", 6},
          {"Adams", 5},
          {"implicit, step control", 4}};
}

}  // namespace nlmech::comparison
