#include "nlmech/orbit/transfer/lambert_partials.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "nlmech/scene/scene.hpp"

namespace nlmech::chapters::rbf_inverse::lambert_partials {
namespace {

using orbit::LambertArc;
using orbit::LambertBranch;
using orbit::Vector3;

/// Derivatives of the velocity at the departure by the arrival, of one arc.
struct Row {
  double degrees;           ///< transfer angle without revolutions
  double in_plane, across;  ///< norm of those in the plane; the one normal to it
  double by_g;              ///< 1/|G| = h/(r_1 r_2 |sin|)
  double by_differences;    ///< relative distance from central differences of solve_lambert()
};

/// Radii 1 and 1.5 in a time of 20, mu = 1: up to one revolution.
Row derivatives(double degrees, const LambertArc& arc) {
  const double angle = degrees * std::numbers::pi / 180, sine = std::abs(std::sin(angle));
  const orbit::TransferProblem p{{1, 0, 0}, {1.5 * std::cos(angle), 1.5 * std::sin(angle), 0}, 20, {}};
  const auto solve = [&](const Vector3<double>& to) {
    return solve_lambert({p.from, to, p.time, p.gravity.mu}, arc).v1;
  };
  const Vector3<double> v1 = solve(p.to);
  const Matrix<double, 3> exact = orbit::lambert_partials(p, v1).v1_by_r2;
  Matrix<double, 3> differences;
  const double step = 1e-5 * sine;
  for (int j = 0; j < 3; ++j) {
    const Vector3<double> change = step * Vector3<double>::Unit(j);
    differences.col(j) = (solve(p.to + change) - solve(p.to - change)) / (2 * step);
  }
  return {degrees, exact.topLeftCorner<2, 2>().norm(), std::abs(exact(2, 2)),
          orbit::cross(p.from, v1).norm() / (1.5 * sine), (differences - exact).norm() / exact.norm()};
}

/// The arcs of one kind over the transfer angle.
struct Family {
  std::string name;
  int revolutions;
  LambertBranch branch;
  std::vector<Row> rows = {};
};

std::vector<Family> measure(bool quick) {
  std::vector<Family> all = {{"no revolution", 0, LambertBranch::low},
                             {"one, low", 1, LambertBranch::low},
                             {"one, high", 1, LambertBranch::high}};
  for (Family& f : all) {
    for (double degrees = 2; degrees < 360; degrees += quick ? 16 : 2) {
      if (degrees != 180) f.rows.push_back(derivatives(degrees, {degrees > 180, f.revolutions, f.branch}));
    }
  }
  return all;
}

void put(const std::vector<Family>& all, scene::Show& show) {
  scene::Plot& plot = show.plots("Lambert's derivatives: infinite at 180° across the plane alone");
  plot.size(1000, 450).columns({"panel", "curve", "degrees", "derivative"});
  for (const auto& [name, value] :
       {std::pair("in the plane", &Row::in_plane), {"across the plane", &Row::across}}) {
    scene::Panel& panel = plot.panel("transfer angle (degrees)", "|∂v_1/∂r_2| (√(μ/r_1^3))");
    panel.caption(name).x_range(0, 360).log_y(1e-2, 1e2).key("bottom center").set("xtics 60");
    for (const Family& f : all) panel.curve(f.name, f.rows, &Row::degrees, value);
  }
  double worst = 0, by_g = 0;
  for (const Family& f : all) {
    for (const Row& r : f.rows) {
      worst = std::max(worst, r.by_differences);
      by_g = std::max(by_g, std::abs(r.across / r.by_g - 1));
    }
  }
  show.at_most(
      "largest distance from differences of the solver, relative", worst, 1e-5,
      "differences of 1e-5 of the distance from 0 or 180 degrees: its square times third derivatives, "
      "rounding over it");
  show.at_most("largest distance of the derivative across the plane from 1/G, relative", by_g, 1e-10,
               "1/G = h/(r_1 r_2 sin), by the angular momentum; rounding of the arcs and of the sine");
  show.near("growth of those in the plane", derivatives(179.9, {}).in_plane / derivatives(179, {}).in_plane,
            1, 0.05, "continuous through 180 degrees: a change of 0.9 degrees out of 180");
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
