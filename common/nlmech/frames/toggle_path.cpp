#include "nlmech/frames/toggle_path.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "nlmech/algebraic/symmetric_solver.hpp"
#include "nlmech/frames/loaded_frame.hpp"
#include "nlmech/support/sentences.hpp"
#include "nlmech/support/sign_change.hpp"

namespace nlmech::frames {
namespace {

using algebraic::CriticalPoint;
using algebraic::Path;
using Eigen::Index;
using Eigen::VectorXd;
using Kind = CriticalPoint::Kind;

constexpr std::int64_t most_steps = 5000;
constexpr double through = 2.2;  // in heights: past the mirrored configuration below the bases
constexpr double sway = antisymmetric_pole / 4;  // n of a column clamped and free to rotate: tan x = x
constexpr double bow = -4 * std::numbers::pi * std::numbers::pi;  // n of a column clamped at both ends

/// Calls use(unknown, mirrored unknown, sign of the mirror image) for every unknown.
template <class Use>
void for_mirrored(const Frame& frame, const Use& use) {
  const int last = static_cast<int>(frame.nodes().size()) - 1;
  for (int i = 0; i <= last; ++i) {
    for (const Motion motion : {Motion::x, Motion::y, Motion::rotation}) {
      const Index here = frame.unknown(i, motion), there = frame.unknown(last - i, motion);
      if (here >= 0 && there >= 0) use(here, there, motion == Motion::y ? 1. : -1.);
    }
  }
}

/// Is a displacement nearer to its mirror image than to the opposite of it?
bool is_symmetric(const Frame& frame, const VectorXd& v) {
  double product = 0;
  for_mirrored(frame, [&](Index here, Index there, double sign) { product += sign * v[here] * v[there]; });
  return product > 0;
}

/// The full toggle and its path from rest.
struct PathTracer {
  explicit PathTracer(Toggle whole, bool upwards)
      : toggle(make_frame((whole.full = true, whole))),
        equations(toggle.frame, toggle.load),
        path({.first = first_load(whole)}, equations, VectorXd::Zero(toggle.frame.size()), 0),
        status(path.start(upwards)) {}

  /// Load that lowers the apex by a twentieth of the height, or a twentieth of the buckling load, if smaller.
  static double first_load(const Toggle& t) {
    const double euler = -2 * sway * t.ei / (t.length * t.length) * (t.height / t.length);
    const Williams williams{.height = t.height, .length = t.length, .ea = t.ea, .ei = t.ei};
    return 0.05 * std::min(t.height * williams.stiffness(0.), euler);
  }
  [[nodiscard]] double drop() const { return -path.now().x[toggle.apex]; }
  [[nodiscard]] ToggleEvent event_of(const CriticalPoint& c) const {
    return {c.kind, c.point.load, -c.point.x[toggle.apex],
            c.kind != Kind::bifurcation || is_symmetric(toggle.frame, c.direction)};
  }

  ToggleFrame toggle;
  LoadedFrame equations;
  Path path;
  Status status;
};

}  // namespace

TogglePath critical_points(const Toggle& toggle) {
  PathTracer tracer(toggle, true);
  TogglePath result;
  std::vector<CriticalPoint> found;
  const auto is_through = [&](const Path& path) {
    return tracer.drop() >= through * toggle.height && path.now().slope > 0 && path.now().negative == 0;
  };
  if (tracer.status.ok()) tracer.status = follow(tracer.path, is_through, most_steps, found);
  for (const CriticalPoint& c : found) result.events.push_back(tracer.event_of(c));
  if (!tracer.path.now().x.size()) return {{}, 0, std::move(tracer.status)};
  result.drop = tracer.drop();
  result.status = std::move(tracer.status);
  return result;
}

TogglePath first_critical_point(const Toggle& toggle, double load) {
  if (!std::isfinite(load)) throw invalid_argument("first_critical_point: load {}; it must be finite", load);
  TogglePath result;
  PathTracer tracer(toggle, load >= 0);
  std::vector<CriticalPoint> found;
  const auto is_there = [&](const Path& path) {
    return !found.empty() || std::abs(path.now().load) >= std::abs(load);
  };
  if (tracer.status.ok()) tracer.status = follow(tracer.path, is_there, most_steps, found);
  result.status = std::move(tracer.status);
  if (tracer.path.now().x.size() == 0) return result;
  result.drop = tracer.drop();
  if (!found.empty() && std::abs(found[0].point.load) < std::abs(load)) {
    result.events.push_back(tracer.event_of(found[0]));
    return result;
  }
  // First crossing of the load: before the limit point, if the last step passed one above the load.
  const algebraic::PathPoint last = found.empty() ? tracer.path.now() : found[0].point;
  algebraic::PathPoint end;
  if (result.status.ok() && load != 0 &&
      tracer.path.crossing(load, tracer.path.before(), last, end) == Outcome::success)
    result.drop = -end.x[tracer.toggle.apex];
  return result;
}

namespace {

/// Drops in (0, end) at which a member has the given n: roots of a parabola.
std::vector<double> drops_at(const Williams& w, double n, double end) {
  // EA/l (d h/l - 0.6 d^2/l) = -n EI/l^2
  const double needed = -n * w.ei / w.ea, square = w.height * w.height - 2.4 * needed;
  std::vector<double> drops;
  if (!(square > 0)) return drops;
  const double sum = w.height + std::sqrt(square);
  for (const double d : {2 * needed / sum, sum / 1.2}) {
    if (d > 0 && d < end) drops.push_back(d);
  }
  return drops;
}

/// The root of the slope between two drops, to the last bit.
double stationary_drop(const Williams& w, double low, double high) {
  const auto slope = [&](double drop) { return w.stiffness(drop); };
  return sign_change(slope, low, high);
}

}  // namespace

TogglePath critical_points(const Williams& w) {
  for (const double number : {w.height, w.length, w.ea, w.ei}) {
    if (!(number > 0 && std::isfinite(number)))
      throw invalid_argument(
          "critical_points: {} among height, length, EA, EI of the toggle; all are positive", number);
  }
  TogglePath result;
  result.drop = through * w.height;
  if (const auto poles = drops_at(w, antisymmetric_pole, result.drop); !poles.empty()) result.drop = poles[0];
  const auto add = [&](Kind kind, double drop, bool is_symmetric) {
    result.events.push_back({kind, w.load(drop), drop, is_symmetric});
  };
  // The load is smooth with few extrema; towards the pole it tends to minus infinity.
  constexpr int parts = 4000;
  double before = 0;
  bool rises = true;
  for (int i = 1; i <= parts; ++i) {
    const double drop = result.drop * (i < parts ? static_cast<double>(i) / parts : 1 - 1e-9);
    if (w.outcome(drop) != Outcome::success) break;
    if ((w.stiffness(drop) > 0) != rises) {
      add(rises ? Kind::maximum : Kind::minimum, stationary_drop(w, before, drop), true);
      rises = !rises;
    }
    before = drop;
  }
  for (const double drop : drops_at(w, sway, result.drop)) add(Kind::bifurcation, drop, false);
  for (const double drop : drops_at(w, bow, result.drop)) add(Kind::bifurcation, drop, true);
  std::sort(result.events.begin(), result.events.end(),
            [](const ToggleEvent& a, const ToggleEvent& b) { return a.drop < b.drop; });
  return result;
}

TogglePath first_critical_point(const Williams& toggle, double load) {
  if (!std::isfinite(load)) throw invalid_argument("first_critical_point: load {}; it must be finite", load);
  TogglePath result = critical_points(toggle);
  // From rest to the first point the load increases and the equilibrium is stable.
  double low = 0, high = result.events.empty() ? result.drop : result.events[0].drop;
  if (!result.events.empty() && result.events[0].load < load) {
    result.events.resize(1);
    result.drop = result.events[0].drop;
    return result;
  }
  result.events.clear();
  if (load < 0) low = -high;
  while ((load < 0 ? toggle.load(low) > load : toggle.load(high) < load) && high < 1e3 * toggle.length) {
    (load < 0 ? low : high) *= 2;
    if (load >= 0 && toggle.outcome(high) != Outcome::success) break;
  }
  for (int i = 0; i < 200; ++i) {
    const double middle = low + (high - low) / 2;
    if (!(middle > low && middle < high)) break;
    (toggle.load(middle) < load ? low : high) = middle;
  }
  result.drop = low;
  return result;
}

std::optional<Index> unstable_motions(const Toggle& toggle, const VectorXd& x) {
  Toggle half = toggle, full = toggle;
  half.full = false;
  full.full = true;
  const ToggleFrame of_half = make_frame(half), whole = make_frame(full);
  if (x.size() != of_half.frame.size())
    throw invalid_argument("unstable_motions: {} displacements for {} unknowns of the half toggle", x.size(),
                           of_half.frame.size());
  VectorXd all = VectorXd::Zero(whole.frame.size());
  for (int i = 0; i <= toggle.elements; ++i) {
    for (const Motion motion : {Motion::x, Motion::y, Motion::rotation}) {
      const Index from = of_half.frame.unknown(i, motion), to = whole.frame.unknown(i, motion);
      if (from < 0 || to < 0) continue;
      all[to] = x[from];
      const Index mirrored = whole.frame.unknown(2 * toggle.elements - i, motion);
      if (mirrored != to) all[mirrored] = motion == Motion::y ? x[from] : -x[from];
    }
  }
  Eigen::SparseMatrix<double> k;
  if (!whole.frame.tangent<double>(all, k).ok()) return std::nullopt;
  algebraic::SymmetricSolver solver;
  solver.take(k, algebraic::scale_of(k.diagonal()));
  if (!solver.is_finite()) return std::nullopt;
  const algebraic::Inertia inertia = solver.factorise();
  return inertia.negative + inertia.zero;
}

std::optional<Index> unstable_motions(const Williams& toggle, double drop) {
  if (toggle.outcome(drop) != Outcome::success) return std::nullopt;
  const double n = -toggle.compression(drop) * (toggle.length * toggle.length / toggle.ei);
  return (toggle.stiffness(drop) > 0 ? 0 : 1) + (n > sway ? 0 : 1) + (n > bow ? 0 : 1);
}

}  // namespace nlmech::frames
