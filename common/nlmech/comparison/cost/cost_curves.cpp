#include "nlmech/comparison/cost/cost_curves.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <stdexcept>
#include <utility>

namespace nlmech::comparison {
namespace {

constexpr std::array foremost_first = {Kind::own,        Kind::closed_form, Kind::series,    Kind::radial,
                                       Kind::polynomial, Kind::classical,   Kind::explicit_, Kind::implicit};

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
    const auto* group = std::ranges::find(foremost_first, curve.kind);
    scene::MethodLine& line = lines.emplace_back();
    line.method = curve.name;
    line.group = static_cast<std::size_t>(group - foremost_first.begin());
    for (const Cost& c : curve.costs)
      line.attempts.push_back(
          {c.setting, c.status, c.error, c.time, {c.work.right_hand_sides, c.work.steps, c.work.rejected}});
  }
  return lines;
}

std::vector<scene::MethodGroup> method_groups(const std::string& own) {
  return {{own, "#000000", 15, 2.8},
          {"closed form", "#000000", 15, 2.6},
          {"Taylor series", "#D55E00", 13, 2.6},
          {"radial functions", "#D55E00", 5, 2.6},
          {"polynomials, Picard", "#0072B2", 7, 2},
          {"fixed step, others", "#7F7F7F", 2, 1},
          {"step control, explicit", "#009E73", 9, 1.4},
          {"step control, implicit", "#CC79A7", 11, 1.4}};
}

}  // namespace nlmech::comparison
