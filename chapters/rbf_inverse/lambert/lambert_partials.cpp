#include "nlmech/orbit/transfer/lambert_partials.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "nlmech/orbit/transfer/lambert.hpp"
#include "nlmech/scene/scene.hpp"

namespace nlmech::chapters::rbf_inverse::lambert_partials {
namespace {

using orbit::LambertArc;
using orbit::LambertBranch;
using orbit::Vector3;

/// Radii 1 and 1.5 in a time of 20, mu = 1: up to one revolution.
orbit::TransferProblem problem(double degrees) {
  const double angle = degrees * std::numbers::pi / 180;
  return {{1, 0, 0}, {1.5 * std::cos(angle), 1.5 * std::sin(angle), 0}, 20, {}};
}

/// Derivatives of one arc.
struct Row {
  double degrees;           ///< transfer angle without revolutions
  double in_plane, across;  ///< largest |d(v_1)/d(r_2)| in the plane, and that normal to it
  double by_g;              ///< 1/|G| = h/(r_1 r_2 |sin|)
  double by_differences;    ///< relative distance from central differences of solve_lambert()
};

Row derivatives(double degrees, const LambertArc& way) {
  const orbit::TransferProblem p = problem(degrees);
  const auto solve = [&](const Vector3<double>& to) {
    return solve_lambert({p.from, to, p.time, p.gravity.mu}, way).v1;
  };
  const Vector3<double> v1 = solve(p.to);
  const orbit::LambertPartials d = orbit::lambert_partials(p, v1);
  Matrix<double, 3> differences;
  const double step = 1e-5 * std::abs(std::sin(degrees * std::numbers::pi / 180));
  for (int j = 0; j < 3; ++j) {
    const Vector3<double> change = step * Vector3<double>::Unit(j);
    differences.col(j) = (solve(p.to + change) - solve(p.to - change)) / (2 * step);
  }
  const double h = orbit::cross(p.from, v1).norm();
  return {degrees, d.v1_by_r2.topLeftCorner<2, 2>().norm(), std::abs(d.v1_by_r2(2, 2)),
          h / (p.from.norm() * p.to.norm() * std::abs(std::sin(degrees * std::numbers::pi / 180))),
          (differences - d.v1_by_r2).norm() / d.v1_by_r2.norm()};
}

/// The arcs of one kind over the transfer angle.
struct Family {
  std::string name;
  int revolutions;
  LambertBranch branch;
  int style;
  std::vector<Row> rows = {};
};

std::vector<Family> measure(bool quick) {
  std::vector<Family> all = {{"no revolution", 0, LambertBranch::low, 1},
                             {"one, low", 1, LambertBranch::low, 2},
                             {"one, high", 1, LambertBranch::high, 3}};
  for (Family& f : all) {
    for (double degrees = 2; degrees < 360; degrees += quick ? 16 : 2) {
      if (degrees == 180) continue;
      f.rows.push_back(derivatives(degrees, {degrees > 180, f.revolutions, f.branch}));
    }
  }
  return all;
}

void put(const std::vector<Family>& all, scene::Show& show) {
  scene::Plot& plot = show.plots("Lambert's derivatives: only those across the plane are infinite at 180°");
  plot.size(1000, 450).columns({"panel", "curve", "degrees", "derivative"});
  double worst = 0, by_g = 0;
  for (const bool across : {false, true}) {
    scene::Panel& panel = plot.panel("transfer angle (degrees)", "|∂v_1/∂r_2| (√(μ/r_1^3))");
    panel.caption(across ? "across the plane" : "in the plane").x_range(0, 360).log_y(1e-2, 1e2);
    panel.key(across ? "off" : "top center font 'sans-serif,11'").set("xtics 60");
    for (const Family& f : all) {
      std::vector<double> x, y;
      for (const Row& r : f.rows) {
        if (!x.empty() && x.back() < 180 && r.degrees > 180) x.push_back(180), y.push_back(NAN);
        x.push_back(r.degrees);
        y.push_back(across ? r.across : r.in_plane);
        worst = std::max(worst, r.by_differences);
        by_g = std::max(by_g, std::abs(r.across / r.by_g - 1));
      }
      panel.curve(f.name, x, y, scene::lines(f.style));
    }
  }
  show.at_most(
      "largest distance from differences of the solver, relative", worst, 1e-5,
      "differences of 1e-5 of the distance from 0 or 180 degrees: its square times third derivatives, "
      "rounding over it");
  show.at_most("largest distance of the derivative across the plane from 1/G, relative", by_g, 1e-10,
               "1/G = h/(r_1 r_2 sin), by the angular momentum; rounding of the arcs and of the sine");
  const Row near = derivatives(179, {}), nearer = derivatives(179.9, {});
  show.near("growth of the derivative across from 179 to 179.9 degrees", nearer.across / near.across,
            nearer.by_g / near.by_g, 1e-9, "1/G");
  show.near("growth of those in the plane", nearer.in_plane / near.in_plane, 1, 0.05,
            "continuous through 180 degrees: a change of 0.9 degrees out of 180");
}

}  // namespace

std::vector<scene::Scene> scenes() {
  const scene::Result all(
      "lambert-partials",
      "distances 1 and 1.5, time 20, mu = 1; angles every 2 degrees, every 16 with --quick", measure);
  return {{.name = "lambert-partials",
           .title = "Derivatives of the departure velocity by the arrival position",
           .content = scene::Content(put, all)}};
}

}  // namespace nlmech::chapters::rbf_inverse::lambert_partials
