#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

#include "chapters/rbf_inverse/curves.hpp"
#include "chapters/rbf_inverse/scenes.hpp"
#include "chapters/rbf_inverse/transfer_runs.hpp"
#include "nlmech/orbit/kepler.hpp"

namespace nlmech::chapters {
namespace {

using orbit::CollocatedTransfer;
using orbit::Vector3;
using scene::Workshop;

/// Lagrange's F and G: where the orbit that leaves r_0 with a velocity is at a time.
orbit::State on_orbit(const Vector3<double>& v1, double time) {
  const orbit::TransferProblem p = printed_transfer();
  return orbit::propagate_kepler({p.from, v1}, time, p.gravity.mu).state;
}

/// Distance of a node from the orbit that leaves with v1: of its position, m, or velocity, m/s.
double off_orbit(const CollocatedTransfer& t, Eigen::Index node, const Vector3<double>& v1, bool velocity) {
  const orbit::State s = on_orbit(v1, t.times[node]);
  return (velocity ? t.velocities.col(node) - s.velocity : t.positions.col(node) - s.position).norm();
}

/// The largest of these over all nodes.
double largest_off(const CollocatedTransfer& t, const Vector3<double>& v1, bool velocity) {
  double worst = 0;
  for (Eigen::Index j = 0; j < t.times.size(); ++j) worst = std::max(worst, off_orbit(t, j, v1, velocity));
  return worst;
}

/// Which of the runs has the median miss.
std::size_t median_of(const std::vector<CollocatedTransfer>& all) {
  std::vector<std::size_t> order(all.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return all[a].miss < all[b].miss; });
  return order[order.size() / 2];
}

scene::Showing show_errors(const TransferRuns& runs, Workshop& w) {
  scene::Table table({{"method"},
                      {"terminal error x (m)", 2},
                      {"y (m)", 2},
                      {"z (m)", 2},
                      {"|.| (m)", 2},
                      {"initial velocity (m/s)", 2},
                      {"Newton's iterations"},
                      {"condition", 2}});
  const auto add = [&](const std::string& name, const orbit::Transfer& t, const scene::Cell& condition) {
    const Vector3<double> d = miss_vector(t.v1);
    std::optional<double> iterations;  // Izzo's method has none of Newton's
    if (t.statistics.newton_iterations > 0) iterations = static_cast<double>(t.statistics.newton_iterations);
    table.add({name, std::abs(d[0]), std::abs(d[1]), std::abs(d[2]), d.norm(), velocity_error(t.v1),
               scene::to_cell(iterations), condition});
  };
  table.add({"printed", 9.6e-3, 16.3e-3, 10.2e-3, std::hypot(9.6e-3, 16.3e-3, 10.2e-3), {}, {}, {}});
  const auto& printed = w.result(*runs.printed);
  const auto by_miss = [](const CollocatedTransfer& a, const CollocatedTransfer& b) {
    return a.miss < b.miss;
  };
  const auto [least, most] = std::minmax_element(printed.begin(), printed.end(), by_miss);
  const CollocatedTransfer& middle = printed[median_of(printed)];
  add("as printed, in seconds", printed.front(), printed.front().condition);
  add("as printed, median of twelve units of time", middle, middle.condition);
  add("as printed, best of twelve units of time", *least, least->condition);
  add("as printed, worst of twelve units of time", *most, most->condition);
  add("printed shape, D without loss of digits", w.result(*runs.printed_shape), {});
  add("Gaussian functions, c T = 3, D without loss of digits", w.result(*runs.stable), {});
  add("polynomials", w.result(*runs.polynomial), {});
  add("Izzo", w.result(*runs.izzo), {});
  const std::string program = "recorded: ";
  return {
      {},
      std::move(table),
      {scene::near("log10 of the condition of the printed functions", "1",
                   std::log10(printed.front().condition), 17.3, 0.05,
                   program + "1.9e17, as its logarithm; rounding is all there is"),
       {"best of twelve units of time, as printed", "m", least->miss, 0.05, 500,
        program + "4.7 m at best; a lottery of rounding around 57 m"},
       {"worst of twelve units of time, as printed", "m", most->miss, 50, 1e5, program + "1.8 km at worst"},
       scene::near("miss with the printed shape and all digits", "m", w.result(*runs.printed_shape).miss,
                   0.216, 0.7, program + "0.07, 0.20, 0.04 m with D from 60 digits; D in double has 12"),
       scene::at_most("miss with c T = 3 and all digits", "m", w.result(*runs.stable).miss, 1e-3,
                      "what the section claims, a millimetre"),
       scene::at_most("miss of polynomials", "m", w.result(*runs.polynomial).miss, 1e-4,
                      program + "4.9e-6 m; rounding"),
       scene::at_most("error of Izzo's initial velocity", "m/s", velocity_error(w.result(*runs.izzo).v1),
                      8e-9, "twelve digits of tools/oracles/rbf_inverse_lambert.py")}};
}

/// Components on the left: F and G from the velocity that the printed collocation found, and its nodes.
void draw_components(ControlCurves& curves, const CollocatedTransfer& printed, bool velocity) {
  curves.panel("time (s)", velocity ? "velocity (km/s)" : "position (1000 km)",
               "Components; F and G from the velocity found");
  const char* const names[] = {"x", "y", "z"};
  const double unit = velocity ? 1e3 : 1e6;
  for (int k = 0; k < 3; ++k) {
    curves.begin(fmt::format("{}, F and G", names[k]), fmt::format("l{}", k + 1));
    for (int i = 0; i <= 200; ++i) {
      const double t = 4320.0 * i / 200;
      const orbit::State s = on_orbit(printed.v1, t);
      curves.add(t, (velocity ? s.velocity[k] : s.position[k]) / unit);
    }
  }
  for (int k = 0; k < 3; ++k) {
    curves.begin(k == 0 ? "collocation as printed" : "", fmt::format("p{}", k + 1));
    for (Eigen::Index j = 0; j < printed.times.size(); ++j)
      curves.add(printed.times[j], (velocity ? printed.velocities : printed.positions)(k, j) / unit);
  }
  curves.with("key", "at screen 0.27, screen 0.01 center bottom maxrows 2 samplen 3 width -6");
  curves.with("yrange", velocity ? "[-8:8]" : "[-2:14]").with("xrange", "[0:4500]").with("xtics", "0,1000");
}

/// Differences on the right, and over them what a better matrix does.
void draw_differences(ControlCurves& curves, const TransferRuns& runs, Workshop& w, bool velocity) {
  const CollocatedTransfer &printed = w.result(*runs.as_printed), &nodes = w.result(*runs.polynomial);
  const Vector3<double>& izzo = w.result(*runs.izzo).v1;
  curves.panel("time (s)", velocity ? "difference (m/s)" : "difference (m)", "Differences");
  const auto add = [&](double t, double value) {
    if (value > 0) curves.add(t, value);  // the begin is the same
  };
  curves.begin("as printed, off F and G of its own velocity", "b1");
  for (Eigen::Index j = 0; j < printed.times.size(); ++j)
    add(printed.times[j], off_orbit(printed, j, printed.v1, velocity));
  curves.begin("that F and G, off Izzo's orbit", "l2");
  for (int i = 0; i <= 200; ++i) {
    const orbit::State a = on_orbit(printed.v1, 4320.0 * i / 200), b = on_orbit(izzo, 4320.0 * i / 200);
    add(4320.0 * i / 200, (velocity ? a.velocity - b.velocity : a.position - b.position).norm());
  }
  curves.begin("polynomial collocation, off Izzo's orbit", "b3");
  for (Eigen::Index j = 0; j < nodes.times.size(); ++j)
    add(nodes.times[j], off_orbit(nodes, j, izzo, velocity));
  curves.with("logy", "1").with("yrange", velocity ? "[1e-14:1e4]" : "[1e-10:1e6]");
  curves.with("xrange", "[0:4500]").with("xtics", "0,1000");
  curves.with("key", "at screen 0.78, screen 0.01 center bottom maxrows 3 samplen 3");
}

/// Position or velocity: the procedure of the text, and what Izzo's method and polynomials say of it.
scene::Showing show_history(const TransferRuns& runs, Workshop& w, bool velocity) {
  const CollocatedTransfer &printed = w.result(*runs.as_printed), &nodes = w.result(*runs.polynomial);
  const Vector3<double>& izzo = w.result(*runs.izzo).v1;
  const double own = largest_off(printed, printed.v1, velocity),
               others = largest_off(printed, izzo, velocity);
  ControlCurves curves(
      fmt::format("Nodes as printed are up to {:.1f} {} off their own orbit", own, velocity ? "m/s" : "m"),
      "time_of_flight_s");
  draw_components(curves, printed, velocity);
  draw_differences(curves, runs, w, velocity);
  curves.overall("width", "1000").overall("height", "520").overall("bottom", "0.31");
  const char* const unit = velocity ? "m/s" : "m";
  const std::string what = velocity ? "velocities" : "positions";
  const char* const lottery = "an independent program: 5 to 1800 m by unit of time, 0.2 m in all digits";
  // A metre over 4320 s, where the orbit turns in some hundred seconds near its begin, is 0.01 m/s at most.
  const double low = velocity ? 1e-5 : 0.02, high = velocity ? 1e2 : 2e4;
  scene::Showing showing;
  showing.figure = curves.take();
  showing.quantities = {
      {what + " as printed, off F and G of their own velocity", unit, own, low, high, lottery},
      {what + " as printed, off Izzo's orbit", unit, others, low, high, lottery},
      scene::at_most(what + " by polynomials, off Izzo's orbit", unit, largest_off(nodes, izzo, velocity),
                     velocity ? 1e-6 : 1e-3, "the section claims millimetres")};
  return showing;
}

/// The plane of the transfer, drawn: x along r_0, in thousands of kilometres.
scene::Showing show_geometry(const TransferRuns& runs, Workshop& w) {
  const orbit::TransferProblem p = printed_transfer();
  const orbit::Transfer& izzo = w.result(*runs.izzo);
  const Vector3<double> ex = p.from.normalized(), n = orbit::cross(p.from, izzo.v1).normalized(),
                        ey = orbit::cross<double>(n, ex);
  ControlCurves curves("Lambert's problem: two positions and a time make an orbit");
  curves.panel("in the plane of the orbit, along r_{0}, 1000 km", "across, 1000 km");
  const auto add = [&](const Vector3<double>& r) { curves.add(r.dot(ex) / 1e6, r.dot(ey) / 1e6); };
  const double period = 2 * std::acos(-1.0) / std::sqrt(p.gravity.mu) *
                        std::pow(orbit::reciprocal_axis(orbit::State{p.from, izzo.v1}, p.gravity.mu), -1.5);
  curves.begin("transfer, 4320 s", "l1");
  for (int i = 0; i <= 300; ++i) add(on_orbit(izzo.v1, p.time * i / 300).position);
  curves.begin("the rest of the ellipse", "l8");
  for (int i = 0; i <= 300; ++i) add(on_orbit(izzo.v1, p.time + (period - p.time) * i / 300).position);
  for (const auto& [name, end, look] :
       {std::tuple("r_{0}  at t_{0}", p.from, "l2"), {"r_{F}  at t_{F}", p.to, "l3"}}) {
    curves.begin(name, look);
    add({0, 0, 0});
    add(end);
  }
  // Both axes have the same scale.
  curves.with("key", "top left").with("xrange", "[-2:14]").with("yrange", "[-2.6:6.8]");
  const Vector3<double> e = orbit::eccentricity_vector(orbit::State{p.from, izzo.v1}, p.gravity.mu);
  scene::Showing showing;
  showing.figure = curves.take();
  showing.quantities = {
      // oracle: rbf_inverse_lambert short eccentricity
      scene::near("eccentricity of the transfer", "1", e.norm(), 0.96281, 1e-5,
                  "tools/oracles/rbf_inverse_lambert.py"),
      scene::near("periapsis of the transfer", "km",
                  (1 - e.norm()) / orbit::reciprocal_axis(orbit::State{p.from, izzo.v1}, p.gravity.mu) / 1000,
                  252, 1, "a (1 - e) by the same program"),
      scene::at_most("miss of the orbit drawn", "m", izzo.miss, 1e-6, "rounding, some kappa eps |r_F|")};
  return showing;
}

}  // namespace

void add_transfer(scene::Chapter& chapter) {
  const TransferRuns runs = add_transfer_runs(chapter);
  chapter.add({.name = "fig-5.19",
               .title = "Two positions and a time of flight determine the transfer orbit",
               .place = "Figure 5.19",
               .needs = {runs.izzo},
               .show = [runs](Workshop& w) { return show_geometry(runs, w); }});
  for (const bool velocity : {false, true}) {
    chapter.add({.name = velocity ? "fig-5.21" : "fig-5.20",
                 .title = velocity ? "Velocity on the transfer orbit" : "Position on the transfer orbit",
                 .place = velocity ? "Figure 5.21" : "Figure 5.20",
                 .needs = {runs.as_printed, runs.izzo, runs.polynomial},
                 .show = [runs, velocity](Workshop& w) { return show_history(runs, w, velocity); }});
  }
  chapter.add(
      {.name = "table-5.4",
       .title = "Errors at the ends of the transfer: rounding decides, the stable basis does not mind",
       .place = "Table 5.4",
       .needs = {runs.printed, runs.printed_shape, runs.stable, runs.polynomial, runs.izzo},
       .show = [runs](Workshop& w) { return show_errors(runs, w); }});
  for (int k = 0; k < 3; ++k) {
    chapter.add(
        scene::Measurement{fmt::format("elgohary/table-5.4/Lambert/terminal boundary error {}", "xyz"[k]),
                           {runs.printed},
                           [runs, k](Workshop& w) {
                             // Rounding decides, and with it the unit of time: the median of twelve.
                             const auto& all = w.result(*runs.printed);
                             const Vector3<double> d = miss_vector(all[median_of(all)].v1);
                             return scene::Measured{std::abs(d[k]), {}};
                           }});
  }
}

}  // namespace nlmech::chapters
