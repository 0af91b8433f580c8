#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <ranges>
#include <string>
#include <vector>

#include "chapters/rbf_inverse/lambert/printed_transfer.hpp"
#include "nlmech/scene/scene.hpp"
#include "nlmech/support/stopwatch.hpp"

namespace nlmech::chapters::rbf_inverse::transfer {
namespace {

using orbit::CollocatedTransfer;
using orbit::TransferBasis;
using orbit::Vector3;

/// State of a transfer at one time.
struct Sample {
  double t;
  orbit::State state;
};
using Course = std::vector<Sample>;

/// State at a time of the orbit with the initial velocity @p v1, by Lagrange's F and G.
Sample on_orbit(const Vector3<double>& v1, double time) {
  const orbit::TransferProblem p = printed_transfer();
  return {time, orbit::propagate_kepler({p.from, v1}, time, p.gravity.mu).state};
}
Course orbit_between(const Vector3<double>& v1, double begin, double end, int samples) {
  Course course;
  for (int i = 0; i <= samples; ++i) course.push_back(on_orbit(v1, begin + (end - begin) * i / samples));
  return course;
}
Course nodes_of(const CollocatedTransfer& c) {
  Course course;
  for (Eigen::Index j = 0; j < c.times.size(); ++j)
    course.push_back({c.times[j], {c.positions.col(j), c.velocities.col(j)}});
  return course;
}

/// Plotted part of the state: positions or velocities.
struct Part {
  Vector3<double> orbit::State::*of;
  std::string name, unit, axis;
  double axis_unit, low, high;  ///< of the axis
  double least, most;           ///< range of the plotted differences
  double may_least, may_most;   ///< bounds of the differences of the nodes as printed
  double claimed;               ///< accuracy claimed in the text: millimetres
};
// One metre after 4320 s corresponds to at most 0.01 m/s, because the orbit turns within some hundred seconds
// near its start.
const Part positions{&orbit::State::position,
                     "positions",
                     "m",
                     "position (1000 km)",
                     1e6,
                     -2,
                     14,
                     1e-10,
                     1e6,
                     0.02,
                     2e4,
                     1e-3};
const Part velocities{
    &orbit::State::velocity, "velocities", "m/s", "velocity (km/s)", 1e3, -8, 8, 1e-14, 1e4, 1e-5, 1e2, 1e-6};

/// Distance at one time between a course and the orbit of an initial velocity.
struct Apart {
  double t, distance;
};
std::vector<Apart> off_orbit(const Course& course, const Vector3<double>& v1, const Part& part) {
  std::vector<Apart> all;
  for (const Sample& s : course)
    all.push_back({s.t, (s.state.*part.of - on_orbit(v1, s.t).state.*part.of).norm()});
  return all;
}

/// Draws the components: F and G from the initial velocity of the printed collocation, and its nodes.
void draw_components(scene::Panel& panel, const CollocatedTransfer& printed, const Part& part) {
  panel.caption("Components; F and G from the velocity found").x_range(0, 4500).set("xtics 0,1000");
  panel.y_range(part.low, part.high).set("bmargin at screen 0.31");
  panel.key("at screen 0.27, screen 0.01 center bottom maxrows 2 samplen 3 width -6");
  const auto component = [&](int k) {
    return [&part, k](const Sample& s) { return (s.state.*part.of)[k] / part.axis_unit; };
  };
  const Course smooth = orbit_between(printed.v1, 0, 4320, 200), nodes = nodes_of(printed);
  for (int k = 0; k < 3; ++k)
    panel.curve(fmt::format("{}, F and G", "xyz"[k]), smooth, &Sample::t, component(k), scene::lines(k + 1));
  for (int k = 0; k < 3; ++k)
    panel.curve(k == 0 ? "collocation as printed" : "", nodes, &Sample::t, component(k),
                scene::points(k + 1));
}

/// Figure of positions or velocities: the procedure of the text, compared with Izzo's method and polynomials.
void put_history(const CollocatedTransfer& printed, const CollocatedTransfer& polynomial,
                 const orbit::Transfer& izzo, const Part& part, scene::Show& show) {
  const std::vector<Apart> own = off_orbit(nodes_of(printed), printed.v1, part),
                           better = off_orbit(nodes_of(polynomial), izzo.v1, part);
  const auto largest = [&](const std::vector<Apart>& all) -> scene::Amount {
    return {std::ranges::max(all, {}, &Apart::distance).distance, part.unit};
  };
  scene::Plot& plot =
      show.plots(fmt::format("Printed nodes: up to {:.1f} {} from the orbit of their initial velocity",
                             largest(own).value, part.unit));
  plot.size(1000, 520).columns({"panel", "curve", "time_of_flight_s", "y"});
  draw_components(plot.panel("time (s)", part.axis), printed, part);
  // Right panel: differences, with those of polynomial collocation.
  scene::Panel& right = plot.panel("time (s)", fmt::format("difference ({})", part.unit));
  right.caption("Differences").log_y(part.least, part.most).x_range(0, 4500).set("xtics 0,1000");
  right.set("bmargin at screen 0.31").key("at screen 0.78, screen 0.01 center bottom maxrows 3 samplen 3");
  const auto curve = [&](const char* name, const std::vector<Apart>& all, const scene::CurveStyle& look) {
    const auto apart = [](const Apart& a) { return a.distance > 0; };  // omits the common start
    right.curve(name, all | std::views::filter(apart), &Apart::t, &Apart::distance, look);
  };
  curve("as printed, from F and G of its velocity", own, scene::linespoints(1));
  curve("F and G of its velocity, from Izzo's orbit",
        off_orbit(orbit_between(printed.v1, 0, 4320, 200), izzo.v1, part), scene::lines(2));
  curve("polynomial collocation, from Izzo's orbit", better, scene::linespoints(3));
  const char* const by_rounding = "regression value: 5 to 1800 m by unit of time, 0.2 m in all digits";
  show.between(part.name + " as printed, off F and G of their own velocity", largest(own), part.may_least,
               part.may_most, by_rounding);
  show.between(part.name + " as printed, off Izzo's orbit",
               largest(off_orbit(nodes_of(printed), izzo.v1, part)), part.may_least, part.may_most,
               by_rounding);
  show.at_most(part.name + " by polynomials, off Izzo's orbit", largest(better), part.claimed,
               "the section claims millimetres");
}

/// Draws the transfer in its plane: x along r_0, in thousands of kilometres.
void put_geometry(const orbit::Transfer& izzo, scene::Show& show) {
  const orbit::TransferProblem p = printed_transfer();
  const orbit::State start{p.from, izzo.v1};
  const double mu = p.gravity.mu, reciprocal = orbit::reciprocal_axis(start, mu),
               period = 2 * std::acos(-1.0) / std::sqrt(mu) * std::pow(reciprocal, -1.5),
               e = orbit::eccentricity_vector(start, mu).norm();
  const Vector3<double> ex = p.from.normalized(), n = orbit::cross(p.from, izzo.v1).normalized(),
                        ey = orbit::cross<double>(n, ex);
  scene::Panel& panel = show.plot("Lambert's problem: two positions and a time determine the velocities",
                                  "coordinate along r_{0} (1000 km)", "coordinate across r_{0} (1000 km)");
  show.figure().size(760, 480).columns({"panel", "curve", "x", "y"});
  panel.x_range(-2, 14).y_range(-2.6, 6.8).set("size ratio -1").key("below");
  const auto curve = [&](const std::string& name, const Course& course, int style) {
    const auto along = [](const Vector3<double>& axis) {
      return [axis](const Sample& s) { return s.state.position.dot(axis) / 1e6; };
    };
    panel.curve(name, course, along(ex), along(ey), scene::lines(style));
  };
  const Sample centre{0, {Vector3<double>::Zero(), Vector3<double>::Zero()}};
  curve("transfer, 4320 s", orbit_between(izzo.v1, 0, p.time, 300), 1);
  curve("the rest of the ellipse", orbit_between(izzo.v1, p.time, period, 300), 8);
  curve("r_{0}  at t_{0}", {centre, {0, start}}, 2);
  curve("r_{F}  at t_{F}", {centre, {p.time, {p.to, izzo.v2}}}, 3);
  // Velocities are drawn as the displacement in 300 s, radii by arrow heads at their ends.
  const auto arrow = [&](const Vector3<double>& from, const Vector3<double>& to, int style) {
    panel.set(
        fmt::format("arrow from {:.4f},{:.4f} to {:.4f},{:.4f} head filled size 0.35,18 front linestyle {} "
                    "dashtype solid",
                    from.dot(ex) / 1e6, from.dot(ey) / 1e6, to.dot(ex) / 1e6, to.dot(ey) / 1e6, style));
  };
  for (const auto& [at, v, name, above] :
       {std::tuple(p.from, izzo.v1, "{/:Bold v}_0", -0.4), {p.to, izzo.v2, "{/:Bold v}_F", 0.7}}) {
    const Vector3<double> tip = at + 300 * v;
    arrow(at, tip, 5);
    panel.note(name, tip.dot(ex) / 1e6, tip.dot(ey) / 1e6 + above);
  }
  arrow(0.95 * p.from, p.from, 2);
  arrow(0.95 * p.to, p.to, 3);
  // oracle: rbf_inverse_lambert short v? ?, short eccentricity
  const char* program = "tools/oracles/rbf_inverse_lambert.py, sixteen digits of the components";
  show.near("speed at t_0", {izzo.v1.norm(), "m/s"},
            std::hypot(2774.846990602542, 7217.023034335538, 1625.933890597796), 1e-12, program);
  show.near("speed at t_F", {izzo.v2.norm(), "m/s"},
            std::hypot(2318.442484931668, 5654.937801363560, 1551.140505838072), 1e-12, program);
  show.near("eccentricity of the transfer", e, 0.96281, 1e-5, "tools/oracles/rbf_inverse_lambert.py");
  show.near("periapsis of the transfer", {(1 - e) / reciprocal / 1000, "km"}, 252, 1,
            "a (1 - e) by the same program");
  show.at_most("miss of the orbit drawn", {izzo.miss, "m"}, 1e-6, "rounding, some kappa eps |r_F|");
}

/// Row of the table: errors of a method at the ends.
struct Row {
  std::string method;
  Vector3<double> miss;
  std::optional<double> velocity = {}, iterations = {}, condition = {};
};
Row row(const std::string& method, const orbit::Transfer& t, std::optional<double> condition = {}) {
  Row r{method, miss_vector(t.v1).cwiseAbs(), velocity_error(t.v1), {}, condition};
  // Izzo's method counts no Newton iterations.
  if (const auto n = t.statistics.newton_iterations; n > 0) r.iterations = static_cast<double>(n);
  return r;
}

/// Median over the runs of the modulus of a component of the miss, m.
double median_of_component(const std::vector<CollocatedTransfer>& runs, int k) {
  std::vector<double> all;
  for (const CollocatedTransfer& run : runs) all.push_back(std::abs(miss_vector(run.v1)[k]));
  return median(std::move(all));
}

void put_errors(std::vector<CollocatedTransfer> printed, const CollocatedTransfer& printed_shape,
                const CollocatedTransfer& stable, const CollocatedTransfer& polynomial,
                const orbit::Transfer& izzo, scene::Show& show) {
  const CollocatedTransfer in_seconds = printed.front();
  std::ranges::sort(printed, {}, &CollocatedTransfer::miss);
  // Rounding dominates and depends on the unit of time, so the median of twelve units is used.
  const CollocatedTransfer &least = printed.front(), &most = printed.back(),
                           &middle = printed[printed.size() / 2];
  std::vector<Row> rows = {{"printed", {}},
                           row("as printed, in seconds", in_seconds, in_seconds.condition),
                           row("as printed, median of twelve units of time", middle, middle.condition),
                           row("as printed, best of twelve units of time", least, least.condition),
                           row("as printed, worst of twelve units of time", most, most.condition),
                           row("printed shape, D without loss of digits", printed_shape),
                           row("Gaussian functions, c T = 3, D without loss of digits", stable),
                           row("polynomials", polynomial),
                           row("Izzo", izzo)};
  for (int k = 0; k < 3; ++k) {
    const std::string name = fmt::format("elgohary/table-5.4/Lambert/terminal boundary error {}", "xyz"[k]);
    rows[0].miss[k] = show.printed(name);
    show.measured(name, median_of_component(printed, k));
  }
  show.table(rows, {{"method", &Row::method},
                    {"terminal error x (m)", [](const Row& r) { return r.miss[0]; }, 2},
                    {"y (m)", [](const Row& r) { return r.miss[1]; }, 2},
                    {"z (m)", [](const Row& r) { return r.miss[2]; }, 2},
                    {"|.| (m)", [](const Row& r) { return r.miss.norm(); }, 2},
                    {"initial velocity (m/s)", &Row::velocity, 2},
                    {"Newton's iterations", &Row::iterations},
                    {"condition", &Row::condition, 2}});
  show.near("log10 of the condition of the printed functions", std::log10(in_seconds.condition), 17.3, 0.05,
            "regression value: 1.9e17, as its logarithm; determined by rounding");
  show.between("best of twelve units of time, as printed", {least.miss, "m"}, 0.05, 500,
               "regression value: 4.7 m at best; rounding scatters it around 57 m");
  show.between("worst of twelve units of time, as printed", {most.miss, "m"}, 50, 1e5,
               "regression value: 1.8 km at worst");
  show.near("miss with the printed shape and all digits", {printed_shape.miss, "m"}, 0.216, 0.7,
            "regression value: 0.07, 0.20, 0.04 m with D from 60 digits; D in double has 12");
  show.at_most("miss with c T = 3 and all digits", {stable.miss, "m"}, 1e-3,
               "what the section claims, a millimetre");
  show.at_most("miss of polynomials", {polynomial.miss, "m"}, 1e-4, "regression value: 4.9e-6 m; rounding");
  show.at_most("error of Izzo's initial velocity", {velocity_error(izzo.v1), "m/s"}, 8e-9,
               "twelve digits of tools/oracles/rbf_inverse_lambert.py");
}

/// Solves the equations of the section from its start.
/// @param shape c T; 0: as printed
/// @param length_unit m; 0: canonical
/// @param time_unit s; 0: canonical
CollocatedTransfer collocate(TransferBasis basis, double shape, double length_unit, double time_unit) {
  return orbit::collocate(printed_transfer(),
                          {.basis = basis,
                           .shape = shape,
                           .equations = orbit::TransferEquations::positions_and_velocities,
                           .guess = orbit::TransferGuess::line,
                           .length_unit = length_unit,
                           .time_unit = time_unit,
                           .largest_miss = 0.01});
}

std::vector<CollocatedTransfer> in_other_units(const CollocatedTransfer& in_seconds) {
  std::vector<CollocatedTransfer> all = {in_seconds};
  for (const double unit : time_units | std::views::drop(1))
    all.push_back(collocate(TransferBasis::gaussian, 0, 1, unit));
  return all;
}

}  // namespace

std::vector<scene::Scene> scenes() {
  const auto collocated = [](const char* name, const char* reading, TransferBasis basis, double shape,
                             double unit) {
    return scene::Result(name, reading, [=] { return collocate(basis, shape, unit, unit); });
  };
  const auto as_printed = collocated(
      "lambert-printed",
      "47 LGL nodes, Gaussian functions with c = (N + 3)/(4 T), 6N equations, Newton's iteration from a "
      "straight line; in metres and seconds",
      TransferBasis::gaussian, 0, 1);
  const scene::Result printed("lambert-printed-units", "the same in twelve units of time, seconds first",
                              in_other_units, as_printed);
  const auto printed_shape = collocated("lambert-printed-shape", "the printed shape, D without cancellation",
                                        TransferBasis::stable_gaussian, 0, 0);
  const auto stable = collocated("lambert-stable", "Gaussian functions with c T = 3, D without cancellation",
                                 TransferBasis::stable_gaussian, 3, 0);
  const auto polynomial =
      collocated("lambert-polynomial", "polynomials, the limit c = 0", TransferBasis::polynomial, 0, 0);
  const scene::Result izzo("lambert-izzo", "Izzo's method",
                           [] { return orbit::corrected_transfer(printed_transfer()); });
  const auto history = [&](const Part& part) {
    const auto put = [&part](const CollocatedTransfer& p, const CollocatedTransfer& q,
                             const orbit::Transfer& r,
                             scene::Show& show) { put_history(p, q, r, part, show); };
    return scene::Content(put, as_printed, polynomial, izzo);
  };
  return {{.name = "fig-5.19",
           .title = "Two positions and a time of flight determine the transfer orbit",
           .place = "Figure 5.19",
           .content = scene::Content(put_geometry, izzo)},
          {.name = "fig-5.20",
           .title = "Position on the transfer orbit",
           .place = "Figure 5.20",
           .content = history(positions)},
          {.name = "fig-5.21",
           .title = "Velocity on the transfer orbit",
           .place = "Figure 5.21",
           .content = history(velocities)},
          {.name = "table-5.4",
           .title = "Errors at the ends of the transfer: due to rounding, except with the stable basis",
           .place = "Table 5.4",
           .content = scene::Content(put_errors, printed, printed_shape, stable, polynomial, izzo)}};
}

}  // namespace nlmech::chapters::rbf_inverse::transfer
