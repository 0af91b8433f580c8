#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <ranges>
#include <string>
#include <vector>

#include "chapters/rbf_inverse/printed_transfer.hpp"
#include "nlmech/orbit/kepler.hpp"
#include "nlmech/scene/scene.hpp"

namespace nlmech::chapters::rbf_inverse {
namespace {

using orbit::CollocatedTransfer;
using orbit::TransferBasis;
using orbit::Vector3;

/// Lagrange's F and G: where the orbit that leaves r_0 with a velocity is at a time.
orbit::State on_orbit(const Vector3<double>& v1, double time) {
  const orbit::TransferProblem p = printed_transfer();
  return orbit::propagate_kepler({p.from, v1}, time, p.gravity.mu).state;
}

/// Of a collocated transfer or of the orbit that leaves with a velocity: positions in m, or velocities in
/// m/s.
struct History {
  std::vector<double> t;
  std::vector<Vector3<double>> values;
};
const Vector3<double>& part_of(const orbit::State& s, bool velocity) {
  return velocity ? s.velocity : s.position;
}
History nodes_of(const CollocatedTransfer& c, bool velocity) {
  History h{{c.times.begin(), c.times.end()}, {}};
  for (const auto& column : (velocity ? c.velocities : c.positions).colwise()) h.values.emplace_back(column);
  return h;
}
History orbit_at(const Vector3<double>& v1, const std::vector<double>& times, bool velocity) {
  History h{times, {}};
  for (const double t : times) h.values.push_back(part_of(on_orbit(v1, t), velocity));
  return h;
}

/// The distance of two at the same times.
std::vector<double> distance(const History& a, const History& b) {
  std::vector<double> all;
  std::ranges::transform(a.values, b.values, std::back_inserter(all),
                         [](const auto& x, const auto& y) { return (x - y).norm(); });
  return all;
}
/// Of a collocated transfer's nodes from the orbit that leaves with a velocity.
std::vector<double> off_orbit(const CollocatedTransfer& c, const Vector3<double>& v1, bool velocity) {
  const History nodes = nodes_of(c, velocity);
  return distance(nodes, orbit_at(v1, nodes.t, velocity));
}

/// Times of smooth curves.
std::vector<double> samples() {
  std::vector<double> all;
  for (int i = 0; i <= 200; ++i) all.push_back(4320.0 * i / 200);
  return all;
}

/// Components on the left: F and G from the velocity that the printed collocation found, and its nodes.
void draw_components(scene::Panel& panel, const CollocatedTransfer& printed, bool velocity) {
  panel.caption("Components; F and G from the velocity found").x_range(0, 4500).set("xtics 0,1000");
  panel.y_range(velocity ? -8 : -2, velocity ? 8 : 14).set("bmargin at screen 0.31");
  panel.key("at screen 0.27, screen 0.01 center bottom maxrows 2 samplen 3 width -6");
  const auto curve = [&](const std::string& name, const History& h, int k, const scene::Look& look) {
    std::vector<double> y;
    for (const auto& value : h.values) y.push_back(value[k] / (velocity ? 1e3 : 1e6));
    panel.curve(name, h.t, y, look);
  };
  for (int k = 0; k < 3; ++k)
    curve(fmt::format("{}, F and G", "xyz"[k]), orbit_at(printed.v1, samples(), velocity), k,
          scene::lines(k + 1));
  for (int k = 0; k < 3; ++k)
    curve(k == 0 ? "collocation as printed" : "", nodes_of(printed, velocity), k, scene::points(k + 1));
}

/// Differences on the right, and over them what a better matrix does.
void draw_differences(scene::Panel& panel, const CollocatedTransfer& printed,
                      const CollocatedTransfer& polynomial, const Vector3<double>& izzo, bool velocity) {
  panel.caption("Differences").log_y(velocity ? 1e-14 : 1e-10, velocity ? 1e4 : 1e6);
  panel.x_range(0, 4500).set("xtics 0,1000").set("bmargin at screen 0.31");
  panel.key("at screen 0.78, screen 0.01 center bottom maxrows 3 samplen 3");
  const auto curve = [&](const std::string& name, const auto& times, const std::vector<double>& difference,
                         const scene::Look& look) {
    std::vector<double> t, y;
    for (std::size_t i = 0; i < difference.size(); ++i) {
      if (!(difference[i] > 0)) continue;  // the begin is the same
      t.push_back(*(times.begin() + static_cast<std::ptrdiff_t>(i)));
      y.push_back(difference[i]);
    }
    panel.curve(name, t, y, look);
  };
  curve("as printed, off F and G of its own velocity", printed.times,
        off_orbit(printed, printed.v1, velocity), scene::linespoints(1));
  curve("that F and G, off Izzo's orbit", samples(),
        distance(orbit_at(printed.v1, samples(), velocity), orbit_at(izzo, samples(), velocity)),
        scene::lines(2));
  curve("polynomial collocation, off Izzo's orbit", polynomial.times, off_orbit(polynomial, izzo, velocity),
        scene::linespoints(3));
}

/// Position or velocity: the procedure of the text, and what Izzo's method and polynomials say of it.
void put_history(const CollocatedTransfer& printed, const CollocatedTransfer& polynomial,
                 const orbit::Transfer& izzo, bool velocity, scene::Show& show) {
  const std::string unit = velocity ? "m/s" : "m", what = velocity ? "velocities" : "positions";
  const auto largest_off = [&](const CollocatedTransfer& c, const Vector3<double>& v1) {
    return scene::Amount(std::ranges::max(off_orbit(c, v1, velocity)), unit);
  };
  const scene::Amount own = largest_off(printed, printed.v1);
  scene::Plot& plot =
      show.plots(fmt::format("Nodes as printed are up to {:.1f} {} off their own orbit", own.value, unit));
  plot.size(1000, 520).columns({"panel", "curve", "time_of_flight_s", "y"});
  draw_components(plot.panel("time (s)", velocity ? "velocity (km/s)" : "position (1000 km)"), printed,
                  velocity);
  draw_differences(plot.panel("time (s)", velocity ? "difference (m/s)" : "difference (m)"), printed,
                   polynomial, izzo.v1, velocity);
  const char* const lottery = "an independent program: 5 to 1800 m by unit of time, 0.2 m in all digits";
  // A metre over 4320 s, where the orbit turns in some hundred seconds near its begin, is 0.01 m/s at most.
  const double low = velocity ? 1e-5 : 0.02, high = velocity ? 1e2 : 2e4;
  show.between(what + " as printed, off F and G of their own velocity", own, low, high, lottery);
  show.between(what + " as printed, off Izzo's orbit", largest_off(printed, izzo.v1), low, high, lottery);
  show.at_most(what + " by polynomials, off Izzo's orbit", largest_off(polynomial, izzo.v1),
               velocity ? 1e-6 : 1e-3, "the section claims millimetres");
}

/// The plane of the transfer, drawn: x along r_0, in thousands of kilometres.
void put_geometry(const orbit::Transfer& izzo, scene::Show& show) {
  const orbit::TransferProblem p = printed_transfer();
  const orbit::State start{p.from, izzo.v1};
  const double mu = p.gravity.mu, reciprocal = orbit::reciprocal_axis(start, mu),
               period = 2 * std::acos(-1.0) / std::sqrt(mu) * std::pow(reciprocal, -1.5),
               e = orbit::eccentricity_vector(start, mu).norm();
  const Vector3<double> ex = p.from.normalized(), n = orbit::cross(p.from, izzo.v1).normalized(),
                        ey = orbit::cross<double>(n, ex);
  scene::Panel& panel = show.plot("Lambert's problem: two positions and a time make an orbit",
                                  "in the plane of the orbit, along r_{0}, 1000 km", "across, 1000 km");
  show.figure().size(760, 480).columns({"panel", "curve", "x", "y"});
  panel.x_range(-2, 14).y_range(-2.6, 6.8).set("size ratio -1").key("top left");
  using Positions = std::vector<Vector3<double>>;
  const auto curve = [&](const std::string& name, const Positions& positions, int style) {
    panel.curve(
        name, positions, [&](const auto& r) { return r.dot(ex) / 1e6; },
        [&](const auto& r) { return r.dot(ey) / 1e6; }, scene::lines(style));
  };
  Positions arc, rest;
  for (int i = 0; i <= 300; ++i) {
    arc.push_back(on_orbit(izzo.v1, p.time * i / 300).position);
    rest.push_back(on_orbit(izzo.v1, p.time + (period - p.time) * i / 300).position);
  }
  curve("transfer, 4320 s", arc, 1);
  curve("the rest of the ellipse", rest, 8);
  curve("r_{0}  at t_{0}", {Vector3<double>::Zero(), p.from}, 2);
  curve("r_{F}  at t_{F}", {Vector3<double>::Zero(), p.to}, 3);
  // oracle: rbf_inverse_lambert short eccentricity
  show.near("eccentricity of the transfer", e, 0.96281, 1e-5, "tools/oracles/rbf_inverse_lambert.py");
  show.near("periapsis of the transfer", {(1 - e) / reciprocal / 1000, "km"}, 252, 1,
            "a (1 - e) by the same program");
  show.at_most("miss of the orbit drawn", {izzo.miss, "m"}, 1e-6, "rounding, some kappa eps |r_F|");
}

/// What a method errs at the ends.
struct Row {
  std::string method;
  Vector3<double> miss;
  std::optional<double> velocity = {}, iterations = {}, condition = {};

  Row(std::string name, Vector3<double> error) : method(std::move(name)), miss(std::move(error)) {}
  Row(std::string name, const orbit::Transfer& t)
      : method(std::move(name)), miss(miss_vector(t.v1).cwiseAbs()), velocity(velocity_error(t.v1)) {
    if (t.statistics.newton_iterations > 0)  // Izzo's method has none of Newton's
      iterations = static_cast<double>(t.statistics.newton_iterations);
  }
  Row(std::string name, const CollocatedTransfer& t, double cond)
      : Row(std::move(name), static_cast<const orbit::Transfer&>(t)) {
    condition = cond;
  }
};

void put_errors(std::vector<CollocatedTransfer> printed, const CollocatedTransfer& printed_shape,
                const CollocatedTransfer& stable, const CollocatedTransfer& polynomial,
                const orbit::Transfer& izzo, scene::Show& show) {
  const CollocatedTransfer in_seconds = printed.front();
  std::ranges::sort(printed, {}, &CollocatedTransfer::miss);
  // Rounding decides, and with it the unit of time: the median of twelve.
  const CollocatedTransfer &least = printed.front(), &most = printed.back(),
                           &middle = printed[printed.size() / 2];
  Vector3<double> in_print;
  for (int k = 0; k < 3; ++k) {
    const std::string name = fmt::format("elgohary/table-5.4/Lambert/terminal boundary error {}", "xyz"[k]);
    in_print[k] = show.printed(name);
    show.measured(name, std::abs(miss_vector(middle.v1)[k]));
  }
  const std::vector<Row> rows = {{"printed", in_print},
                                 {"as printed, in seconds", in_seconds, in_seconds.condition},
                                 {"as printed, median of twelve units of time", middle, middle.condition},
                                 {"as printed, best of twelve units of time", least, least.condition},
                                 {"as printed, worst of twelve units of time", most, most.condition},
                                 {"printed shape, D without loss of digits", printed_shape},
                                 {"Gaussian functions, c T = 3, D without loss of digits", stable},
                                 {"polynomials", polynomial},
                                 {"Izzo", izzo}};
  show.table(rows, {{"method", &Row::method},
                    {"terminal error x (m)", [](const Row& r) { return r.miss[0]; }, 2},
                    {"y (m)", [](const Row& r) { return r.miss[1]; }, 2},
                    {"z (m)", [](const Row& r) { return r.miss[2]; }, 2},
                    {"|.| (m)", [](const Row& r) { return r.miss.norm(); }, 2},
                    {"initial velocity (m/s)", &Row::velocity, 2},
                    {"Newton's iterations", &Row::iterations},
                    {"condition", &Row::condition, 2}});
  show.near("log10 of the condition of the printed functions", std::log10(in_seconds.condition), 17.3, 0.05,
            "recorded: 1.9e17, as its logarithm; rounding is all there is");
  show.between("best of twelve units of time, as printed", {least.miss, "m"}, 0.05, 500,
               "recorded: 4.7 m at best; a lottery of rounding around 57 m");
  show.between("worst of twelve units of time, as printed", {most.miss, "m"}, 50, 1e5,
               "recorded: 1.8 km at worst");
  show.near("miss with the printed shape and all digits", {printed_shape.miss, "m"}, 0.216, 0.7,
            "recorded: 0.07, 0.20, 0.04 m with D from 60 digits; D in double has 12");
  show.at_most("miss with c T = 3 and all digits", {stable.miss, "m"}, 1e-3,
               "what the section claims, a millimetre");
  show.at_most("miss of polynomials", {polynomial.miss, "m"}, 1e-4, "recorded: 4.9e-6 m; rounding");
  show.at_most("error of Izzo's initial velocity", {velocity_error(izzo.v1), "m/s"}, 8e-9,
               "twelve digits of tools/oracles/rbf_inverse_lambert.py");
}

/// What the section does. @param time_unit s
CollocatedTransfer collocate_as_printed(double time_unit) {
  return orbit::collocate(printed_transfer(),
                          {.basis = TransferBasis::gaussian,
                           .equations = orbit::TransferEquations::positions_and_velocities,
                           .guess = orbit::TransferGuess::line,
                           .length_unit = 1,
                           .time_unit = time_unit,
                           .largest_miss = 0.01});
}

std::vector<CollocatedTransfer> in_other_units(const CollocatedTransfer& in_seconds) {
  std::vector<CollocatedTransfer> all = {in_seconds};
  for (const double unit : time_units | std::views::drop(1)) all.push_back(collocate_as_printed(unit));
  return all;
}

/// The same equations in canonical units with another basis. @param shape c T
scene::Result<CollocatedTransfer> other(const char* name, const char* reading, TransferBasis basis,
                                        double shape) {
  return {name, reading, [basis, shape] {
            return orbit::collocate(printed_transfer(),
                                    {.basis = basis,
                                     .shape = shape,
                                     .equations = orbit::TransferEquations::positions_and_velocities,
                                     .guess = orbit::TransferGuess::line,
                                     .largest_miss = 0.01});
          }};
}

}  // namespace

std::vector<scene::Scene> transfer() {
  const scene::Result as_printed(
      "lambert-printed",
      "47 LGL nodes, Gaussian functions with c = (N + 3)/(4 T), 6N equations, Newton's iteration from a "
      "straight line; in metres and seconds",
      [] { return collocate_as_printed(1); });
  const scene::Result printed("lambert-printed-units", "the same in twelve units of time, seconds first",
                              in_other_units, as_printed);
  const auto printed_shape = other("lambert-printed-shape", "the printed shape, D without cancellation",
                                   TransferBasis::stable_gaussian, 0);
  const auto stable = other("lambert-stable", "Gaussian functions with c T = 3, D without cancellation",
                            TransferBasis::stable_gaussian, 3);
  const auto polynomial =
      other("lambert-polynomial", "polynomials, the limit c = 0", TransferBasis::polynomial, 0);
  const scene::Result izzo("lambert-izzo", "Izzo's method",
                           [] { return orbit::corrected_transfer(printed_transfer()); });
  const auto history = [&](bool velocity) {
    const auto put = [velocity](const CollocatedTransfer& p, const CollocatedTransfer& q,
                                const orbit::Transfer& r,
                                scene::Show& show) { put_history(p, q, r, velocity, show); };
    return scene::Content(put, as_printed, polynomial, izzo);
  };
  return {{.name = "fig-5.19",
           .title = "Two positions and a time of flight determine the transfer orbit",
           .place = "Figure 5.19",
           .content = scene::Content(put_geometry, izzo)},
          {.name = "fig-5.20",
           .title = "Position on the transfer orbit",
           .place = "Figure 5.20",
           .content = history(false)},
          {.name = "fig-5.21",
           .title = "Velocity on the transfer orbit",
           .place = "Figure 5.21",
           .content = history(true)},
          {.name = "table-5.4",
           .title = "Errors at the ends of the transfer: rounding decides, the stable basis does not mind",
           .place = "Table 5.4",
           .content = scene::Content(put_errors, printed, printed_shape, stable, polynomial, izzo)}};
}

}  // namespace nlmech::chapters::rbf_inverse
