#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <boost/math/tools/roots.hpp>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "chapters/homotopy/paths/walked.hpp"
#include "nlmech/frames/named/frame_motion.hpp"
#include "nlmech/ivp/named/named_methods.hpp"
#include "nlmech/ivp/system.hpp"
#include "nlmech/scene/scene.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::chapters::homotopy::dynamic_buckling {
namespace {

using frames::FrameMotion;
using frames::FramePoint;
using Kind = FramePoint::Kind;

constexpr double periods = 12;      ///< of the slowest small motion, for which a load has to be borne
constexpr double narrowest = 5e-4;  ///< of a bracket of the load, relative

/// A frame that is loaded suddenly.
struct Subject {
  std::string file, name, motion;
  int elements;
};
const std::vector<Subject> subjects = {{"truss", "truss of two bars", "apex.y", 1},
                                       {"toggle", "toggle", "B.y", 2},
                                       {"half-shallow-arch", "shallow arch, half", "crown.y", 2}};

/// Where it goes under one load.
struct Ride {
  std::vector<double> times, drops;
  double greatest = 0;   ///< drop
  double imbalance = 0;  ///< of energy, over the greatest energy
  bool has_passed = false;
};

struct Measured {
  std::string name;
  double limit = 0, barrier = 0;
  double implicit = 0, explicit_ = 0;  ///< critical loads by both integrators
  double imbalance = 0;                ///< the worst of all rides
  double period = 0, bound_drop = 0;
  Ride below, above;                                ///< next to the critical load, by newmark
  std::vector<std::pair<double, double>> greatest;  ///< load over the limit load, drop over that at the limit
};

double slowest_frequency(const FrameMotion& motion) {
  const int n = motion.size() / 2;
  Eigen::MatrixXd j(2 * n, 2 * n);
  motion.jacobian(0, motion.rest(), j);
  const Eigen::VectorXd root = motion.frame().mass.cwiseSqrt();
  const Eigen::MatrixXd symmetric =
      -(root.asDiagonal() * j.bottomLeftCorner(n, n) * root.cwiseInverse().asDiagonal());
  return std::sqrt(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(symmetric).eigenvalues()[0]);
}

/// Moves the frame under a step load until a drop is passed or the time is over.
Ride ride(const frames::NamedFrame& frame, double load, Eigen::Index down, double far,
          const std::string& method, double step, double time) {
  const FrameMotion motion(frame, {.factor = load});
  const ivp::System system(motion);
  frames::FrameEnergies energies(motion);
  Ride out;
  const auto see = [&](const ivp::Step& s) {
    energies.take(s);
    out.times.push_back(s.t1);
    out.drops.push_back(-s.x1[down]);
    out.greatest = std::max(out.greatest, out.drops.back());
    out.has_passed = out.greatest > far;
    return !out.has_passed;
  };
  const auto run = ivp::named_integrator(method, {.step = step});
  const auto end = run(system, motion.rest(), 0, time, see, {});
  if (!end.status.ok() && end.status.outcome() != Outcome::interrupted) throw Failure(end.status);
  out.imbalance = energies.imbalance / energies.greatest;
  return out;
}

Measured measure(const Subject& s) {
  frames::FrameModel model = shipped_model(s.file);
  const frames::NamedFrame frame = build(model, s.elements);
  const Eigen::Index down = unknown_of(frame, s.motion);
  const frames::FramePaths paths = equilibrium_paths(frame, {});
  if (!paths.status.ok()) throw Failure(paths.status);
  const auto find = [&](Kind kind) {
    return std::find_if(paths.points.begin(), paths.points.end(),
                        [&](const FramePoint& p) { return p.kind == kind; });
  };
  const auto limit = find(Kind::maximum), lowest = find(Kind::minimum);
  if (limit == paths.points.end() || lowest == paths.points.end())
    throw Failure("no limit points: " + s.file);
  Measured out;
  out.name = s.name;
  out.limit = limit->load;
  out.barrier = barrier_load(frame, paths).value_or(0);
  const FrameMotion motion(frame, {});
  out.period = 2 * std::numbers::pi / slowest_frequency(motion);
  // Past the place of the minimum no equilibrium holds it back.
  const double far = -lowest->x[down], time = periods * out.period;
  out.bound_drop = -limit->x[down];
  const auto critical = [&](const std::string& method, double step, bool is_shown) {
    double low = 0.9 * out.barrier, high = 1.02 * out.limit;
    while (high - low > narrowest * out.limit) {
      const double load = (low + high) / 2;
      Ride r = ride(frame, load, down, far, method, step, time);
      out.imbalance = std::max(out.imbalance, r.imbalance);
      const bool has_passed = r.has_passed;
      if (is_shown) {
        out.greatest.emplace_back(load / out.limit, r.greatest / out.bound_drop);
        (has_passed ? out.above : out.below) = std::move(r);
      }
      (has_passed ? high : low) = load;
    }
    return (low + high) / 2;
  };
  out.implicit = critical("newmark", out.period / 120, true);
  out.explicit_ = critical("explicit", 0.8 / motion.highest_frequency(), false);
  return out;
}

std::vector<Measured> measure_all() {
  std::vector<Measured> all;
  for (const Subject& s : subjects) all.push_back(measure(s));
  return all;
}

/// Of the truss: the load whose unstable equilibrium has the energy of rest, U(d) = U'(d) d with
/// U = EA (l - L)^2/L.
double truss_load() {
  const double h = 0.5, length = std::hypot(1, h);
  const auto strain = [&](double d) { return std::pow(std::hypot(1, h - d) - length, 2) / length; };
  const auto load = [&](double d) { return 2 * (1 / std::hypot(1, h - d) - 1 / length) * (h - d); };
  const auto gap = [&](double d) { return strain(d) - load(d) * d; };
  std::uintmax_t most = 100;
  const auto root =
      boost::math::tools::toms748_solve(gap, 0.3, 0.5, boost::math::tools::eps_tolerance<double>(50), most);
  return load((root.first + root.second) / 2);
}

void put(const std::vector<Measured>& all, scene::Show& show) {
  scene::Plot& plot = show.plots("A sudden load buckles below the limit load");
  plot.size(960, 480).columns({"panel", "curve", "x", "y"});
  const Measured& toggle = all[1];
  scene::Panel& rides =
      plot.panel("time / slowest period", "drop of the toggle's apex / that at the limit load");
  rides.key("top left").x_range(0, periods).y_range(0, 3);
  const auto put_ride = [&](const Ride& r, const char* name, int style) {
    std::vector<double> times;
    for (const double t : r.times) times.push_back(t / toggle.period);
    std::vector<double> drops;
    for (const double d : r.drops) drops.push_back(d / toggle.bound_drop);
    rides.curve(name, times, drops, scene::lines(style));
  };
  put_ride(toggle.below, "just borne", 1);
  put_ride(toggle.above, "just not", 2);
  scene::Panel& loads = plot.panel("step load / limit load", "greatest drop / that at the limit load");
  loads.key("top left").x_range(0.6, 1.05).y_range(0, 5);
  loads.caption("lines: loads whose barrier has the energy of rest");
  for (std::size_t i = 0; i < all.size(); ++i) {
    auto points = all[i].greatest;
    std::sort(points.begin(), points.end());
    std::vector<double> x, y;
    for (const auto& [load, drop] : points) {
      x.push_back(load);
      y.push_back(drop);
    }
    loads.curve(all[i].name, x, y, scene::linespoints(static_cast<int>(i) + 1));
    loads.mark(all[i].barrier / all[i].limit);
  }
  // Half the bracket, and what an energy that is off by so much moves the load: it is the work W d at the
  // barrier that energy is measured by.
  const double exact = truss_load();
  show.near(
      "critical step load of the truss, newmark", all[0].implicit, exact, narrowest,
      "one degree of freedom: the barrier is the energy of rest; half a bracket and the energy's imbalance");
  show.near("critical step load of the truss, explicit", all[0].explicit_, exact, narrowest, "the same");
  for (std::size_t i = 1; i < all.size(); ++i) {
    const Measured& o = all[i];
    for (const auto& [name, load] : {std::pair{"newmark", o.implicit}, {"explicit", o.explicit_}})
      show.between(fmt::format("critical step load of the {}, {}, over the limit load", o.name, name),
                   load / o.limit, o.barrier / o.limit * (1 - narrowest), 1 + narrowest,
                   "not below the load whose barrier has the energy of rest, nor above the limit load");
  }
  double worst = 0;
  for (const Measured& o : all) worst = std::max(worst, o.imbalance);
  show.at_most("energy too much or missing, over the greatest energy", worst, 1e-3,
               "second order: 120 steps a period of the slowest motion");
  show.table(all, {{"frame", &Measured::name},
                   {"limit load", &Measured::limit, 8},
                   {"barrier / limit", [](const Measured& o) { return o.barrier / o.limit; }, 5},
                   {"newmark / limit", [](const Measured& o) { return o.implicit / o.limit; }, 4},
                   {"explicit / limit", [](const Measured& o) { return o.explicit_ / o.limit; }, 4},
                   {"energy imbalance", &Measured::imbalance, 2}});
}

}  // namespace

std::vector<scene::Scene> scenes() {
  const scene::Result loads(
      "dynamic-buckling-loads",
      fmt::format(
          "chapters/homotopy/frames at rest under a step load, without damping, lumped masses; borne if "
          "the frame does not pass its static minimum within {} of its slowest periods; loads by bisection",
          periods),
      measure_all);
  return {{.name = "dynamic-buckling",
           .title = "Critical step loads against static limit loads",
           .content = scene::Content(put, loads)}};
}

}  // namespace nlmech::chapters::homotopy::dynamic_buckling
