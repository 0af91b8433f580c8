#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "chapters/rbf_inverse/commands/commands.hpp"
#include "chapters/rbf_inverse/commands/porkchop_file.hpp"
#include "chapters/rbf_inverse/lambert/porkchop_map.hpp"
#include "nlmech/orbit/transfer/lambert_partials.hpp"
#include "nlmech/scene/picture.hpp"
#include "nlmech/scene/program/files.hpp"
#include "nlmech/scene/program/this_process.hpp"
#include "nlmech/scene/program/typed.hpp"
#include "nlmech/support/degrees.hpp"
#include "nlmech/support/errors.hpp"
#include "nlmech/support/quoted_input.hpp"

namespace nlmech::chapters::rbf_inverse {
namespace {

/// Largest number of revolutions.
constexpr int most_revolutions = 1'000'000;

/// Options of `lambert`.
struct Arc {
  orbit::TransferProblem problem;
  std::optional<double> mu, radius;
  std::vector<double> plane, zonal;
  std::optional<int> revolutions;
  std::string branch, direction, method = "izzo";
  bool long_way = false, all = false, partials = false;
};

void declare_arc(scene::Options& options, Arc& a) {
  options.add("--from", a.problem.from, "x,y,z of the departure from the centre, in any consistent units")
      .required();
  options.add("--to", a.problem.to, "x,y,z of the arrival").required();
  options.add("--time", a.problem.time, "time of flight").positive().required();
  options
      .add("--mu", a.mu, fmt::format("gravitational parameter (default {}, the Earth's)", orbit::earth().mu))
      .positive();
  options.add("--long-way", a.long_way, "transfer by more than 180 degrees");
  options
      .add("--direction", a.direction,
           "direction of the motion about the z axis, in place of --long-way: prograde (x towards y) or "
           "retrograde")
      .one_of({"prograde", "retrograde"});
  options
      .add("--revolutions", a.revolutions,
           "number of complete revolutions before the arrival (default 0); with --all the largest number")
      .range(0, most_revolutions);
  options.add("--branch", a.branch, "of an arc of one or more revolutions; low: the smaller semi-major axis")
      .one_of({"low", "high"});
  options.add("--all", a.all,
              "print all arcs, a row each: short and long way, all numbers of revolutions that the time "
              "allows, both branches");
  options.add("--plane", a.plane,
              "nx,ny,nz: angular momentum of the motion, for positions 170 to 190 degrees apart. The arc "
              "stays in this plane through the departure; the arrival is projected onto it");
  options.add("--zonal", a.zonal, "zonal coefficients J2[,J3,...,J6] of the centre, with its axis along z");
  options.add("--radius", a.radius, "reference radius of the zonal terms").positive();
  options.add("--method", a.method, "izzo, or collocation by polynomials with 81 nodes (short way only)")
      .one_of({"izzo", "collocation"});
  options.add(
      "--partials", a.partials,
      "add the derivatives of both velocities: vx0_x0,vx0_y0,vx0_z0,vx0_x1,vx0_y1,vx0_z1,vx0_time, then "
      "those of vy0, vz0, vx1, vy1, vz1, by the departure x0,y0,z0, the arrival x1,y1,z1 and the time of "
      "flight");
}

std::string text_of(const orbit::Vector3<double>& v) { return fmt::format("{},{},{}", v[0], v[1], v[2]); }

void add_zonal_terms(const Arc& a, orbit::Gravity& gravity) {
  if (a.radius && a.zonal.empty())
    throw InputError(fmt::format("--radius {}: needs --zonal J2[,J3,...]", *a.radius));
  if (a.zonal.empty()) return;
  const std::string zonal = fmt::format("--zonal {}", fmt::join(a.zonal, ","));
  if (!a.radius) throw InputError(zonal + ": needs --radius R");
  if (a.zonal.size() > gravity.zonal.size())
    throw InputError(fmt::format("{}: {} numbers; J2 to J6 at most", zonal, a.zonal.size()));
  std::ranges::copy(a.zonal, gravity.zonal.begin());
  gravity.radius = *a.radius;
}

/// Rejects positions deep inside the Earth with its default mu in metres: other units are likely.
void refuse_other_units(const Arc& a) {
  constexpr double deep = 1e6;  // m
  if (a.mu || !(a.problem.from.stableNorm() < deep && a.problem.to.stableNorm() < deep)) return;
  throw InputError(fmt::format(
      "--from {} --to {}: without --mu lengths are metres about the Earth, and both are deep inside "
      "it; give --mu in your units (398600.4418 for kilometres and seconds)",
      text_of(a.problem.from), text_of(a.problem.to)));
}

orbit::TransferProblem problem_of(const Arc& a) {
  orbit::TransferProblem p = a.problem;
  p.gravity.mu = a.mu.value_or(orbit::earth().mu);
  for (const auto& [option, r] : {std::pair("--from", p.from), {"--to", p.to}}) {
    if (r.isZero(0))
      throw InputError(
          fmt::format("{} {}: is the centre of attraction; give another position", option, text_of(r)));
  }
  add_zonal_terms(a, p.gravity);
  refuse_other_units(a);
  return p;
}

/// Applies --plane. @returns distance of the arrival from the plane
double put_into_plane(const Arc& a, orbit::TransferProblem& p) {
  if (a.plane.empty()) return 0;
  const std::string typed = fmt::format("--plane {}", fmt::join(a.plane, ","));
  if (a.plane.size() != 3)
    throw InputError(fmt::format("{}: {} numbers; needs three, nx,ny,nz", typed, a.plane.size()));
  const orbit::Vector3<double> normal(a.plane[0], a.plane[1], a.plane[2]), arrival = p.to;
  if (normal.isZero(0)) throw InputError(typed + ": a normal cannot be 0");
  const orbit::Vector3<double> out1 = p.from / p.from.stableNorm(), out2 = p.to / p.to.stableNorm();
  const double angle = std::atan2(orbit::accurate_cross(out1, out2).norm(), out1.dot(out2)) / degree;
  if (angle < 170)
    throw InputError(
        fmt::format("{}: the positions are {:.6g} degrees apart and determine the plane; leave "
                    "it out (it is for 170 degrees and more)",
                    typed, angle));
  try {
    p = orbit::in_plane(p, normal);
  } catch (const std::invalid_argument& error) {
    throw InputError(typed + ": " + error.what());
  }
  return (arrival - p.to).stableNorm();
}

/// Sine of an angle that is 0 to within rounding.
constexpr double rounding = 8 * std::numeric_limits<double>::epsilon();

/// Angular momentum of the short way, up to a positive factor; 0 to within rounding if there is no plane.
orbit::Vector3<double> short_way_normal(const orbit::TransferProblem& p) {
  orbit::Vector3<double> h = orbit::accurate_cross(p.from / p.from.stableNorm(), p.to / p.to.stableNorm());
  if (!p.normal) return h;
  return h.norm() > rounding && h.dot(*p.normal) < 0 ? orbit::Vector3<double>(-*p.normal) : *p.normal;
}

/// Name of the direction of motion with the angular momentum @p h.
std::string direction_of(const orbit::Vector3<double>& h) {
  return std::abs(h[2]) <= rounding * h.norm() ? "polar" : h[2] > 0 ? "prograde" : "retrograde";
}

/// Is it the long way that --direction, --plane or --long-way ask for?
bool wants_long_way(const Arc& a, const orbit::TransferProblem& p) {
  const orbit::Vector3<double> h = short_way_normal(p);
  if (h.norm() <= rounding) return a.long_way;  // no plane, which the solver reports
  if (!a.direction.empty()) {
    const std::string found = direction_of(h);
    if (a.long_way)
      throw InputError(fmt::format("--direction {}: determines the way; leave out --long-way", a.direction));
    if (found == "polar")
      throw InputError(
          fmt::format("--direction {}: the plane of the arc contains the z axis, about which it "
                      "is neither prograde nor retrograde; use --long-way or leave it out",
                      a.direction));
    return found != a.direction;
  }
  return a.long_way != (p.normal && h.dot(*p.normal) < 0);
}

orbit::LambertArc arc_of(const Arc& a, const orbit::TransferProblem& p) {
  const int revolutions = a.revolutions.value_or(0);
  if (revolutions > 0 && a.branch.empty())
    throw InputError(fmt::format("--revolutions {}: needs --branch low or high", revolutions));
  if (revolutions == 0 && !a.branch.empty())
    throw InputError(fmt::format("--branch {}: needs --revolutions 1 or more", a.branch));
  return {wants_long_way(a, p), revolutions,
          a.branch == "high" ? orbit::LambertBranch::high : orbit::LambertBranch::low};
}

/// Collocation with polynomials, from a guess that rotates about the centre the short way.
orbit::Transfer by_collocation(const orbit::TransferProblem& p, const orbit::LambertArc& arc) {
  if (arc.revolutions > 0)
    throw InputError(
        fmt::format("--method collocation --revolutions {}: collocation has no initial guess for complete "
                    "revolutions; use --method izzo",
                    arc.revolutions));
  if (arc.long_way)
    throw InputError(
        "--method collocation --long-way: collocation finds only the short way; use --method izzo");
  constexpr int nodes = 81;
  orbit::Transfer t = orbit::collocate(p, {.nodes = nodes});
  if (!t.status.ok())
    t.status = Status::failure(t.status.outcome(),
                               fmt::format("lambert: collocation with {} nodes finds no transfer that "
                                           "integration confirms (the miss is {:.3g} "
                                           "where {:.3g} is allowed); use --method izzo",
                                           nodes, t.miss, orbit::largest_miss * p.to.stableNorm()));
  const orbit::Vector3<double> plane = orbit::cross(p.from, p.to);
  if (t.status.ok() && plane.dot(orbit::cross(p.from, t.v1)) < 0)
    t.status = Status::failure(Outcome::spurious_root,
                               "lambert: collocation converged to the long way; use --method izzo");
  return t;
}

/// Names and cells of --partials, each after a comma. @throws Failure where the derivatives do not exist
std::pair<std::string, std::string> partials_of(const orbit::TransferProblem& p, const orbit::Transfer& t) {
  const orbit::LambertPartials d = orbit::lambert_partials(p, t.v1);
  if (!d.status.ok()) throw Failure(d.status);
  Matrix<double, 6, 7> all;
  all << d.v1_by_r1, d.v1_by_r2, d.v1_by_time, d.v2_by_r1, d.v2_by_r2, d.v2_by_time;
  std::pair<std::string, std::string> text;
  for (Eigen::Index i = 0; i < 6; ++i) {
    Eigen::Index j = 0;
    for (const char* by : {"x0", "y0", "z0", "x1", "y1", "z1", "time"}) {
      text.first += fmt::format(",v{}{}_{}", "xyz"[i % 3], i / 3, by);
      text.second += fmt::format(",{:.17g}", all(i, j++));
    }
  }
  return text;
}

/// The arc by --method. @throws InputError if the positions do not determine a plane, or for an impossible
/// time
orbit::Transfer transfer(const Arc& a, const orbit::TransferProblem& p, const orbit::LambertArc& arc) {
  orbit::Transfer t;
  try {
    t = a.method == "izzo" ? orbit::corrected_transfer(p, arc) : by_collocation(p, arc);
  } catch (const std::invalid_argument& error) {
    throw InputError(error.what());
  }
  if (t.status.ok() && p.normal && p.gravity.degree() == 0) orbit::turn_into_plane(p, t);
  return t;
}

[[noreturn]] void refuse(const orbit::TransferProblem& p, const Status& status) {
  throw InputError(fmt::format("--from {} --to {} --time {}: {}", text_of(p.from), text_of(p.to), p.time,
                               status.sentence()));
}

/// Velocities and miss as cells. @param off distance of the arrival from the plane of --plane
std::string cells_of(const orbit::Transfer& t, double off) {
  return fmt::format("{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.3g}", t.v1[0], t.v1[1], t.v1[2],
                     t.v2[0], t.v2[1], t.v2[2], std::hypot(t.miss, off));
}

/// Rows of `--all`, and what became of them.
struct AllArcs {
  std::string rows;
  int failed = 0;
  Status first;  ///< the first failure
};

/// Adds the rows of one way, up to the number of revolutions that takes too long.
void add_arcs(const Arc& a, const orbit::TransferProblem& p, bool long_way, double off, AllArcs& all) {
  const orbit::Vector3<double> h = short_way_normal(p);
  const std::string direction = direction_of(long_way ? orbit::Vector3<double>(-h) : h);
  constexpr int many = 100'000;
  for (int m = 0; m <= a.revolutions.value_or(most_revolutions); ++m) {
    if (m > many && !a.revolutions)
      throw InputError(
          fmt::format("--time {}: allows more than {} revolutions; give the largest number "
                      "by --revolutions M",
                      p.time, many));
    for (const auto branch : {orbit::LambertBranch::low, orbit::LambertBranch::high}) {
      if (m == 0 && branch == orbit::LambertBranch::high) continue;
      const orbit::Transfer t = transfer(a, p, {long_way, m, branch});
      if (t.status.outcome() == Outcome::infeasible) return;
      const char* const name = m == 0 ? "" : branch == orbit::LambertBranch::low ? "low" : "high";
      all.rows += fmt::format("{},{},{},{},{},{}\n", long_way ? "long" : "short", direction, m, name,
                              t.status.ok() ? cells_of(t, off) : ",,,,,,", to_string(t.status.outcome()));
      if (!t.status.ok() && all.failed++ == 0) all.first = t.status;
    }
  }
}

/// Runs `lambert --all`.
int print_all(const Arc& a, const orbit::TransferProblem& p, double off) {
  if (a.long_way || !a.branch.empty() || a.method != "izzo")
    throw InputError(fmt::format("--all: prints every arc; leave out {}", a.long_way          ? "--long-way"
                                                                          : !a.branch.empty() ? "--branch"
                                                                                              : "--method"));
  if (short_way_normal(p).norm() <= rounding) refuse(p, transfer(a, p, {}).status);  // there is no plane
  AllArcs all;
  if (a.direction.empty() || !wants_long_way(a, p)) add_arcs(a, p, false, off, all);
  if (a.direction.empty() || wants_long_way(a, p)) add_arcs(a, p, true, off, all);
  scene::print_result("way,direction,revolutions,branch,vx0,vy0,vz0,vx1,vy1,vz1,miss,status\n" + all.rows);
  if (all.failed == 0) return 0;
  scene::print_message(
      fmt::format("rbf_inverse: {} of the arcs failed; the first: {}", all.failed, all.first.text()));
  return 1;
}

scene::Answer lambert(const Arc& a) {
  orbit::TransferProblem p = problem_of(a);
  const double off = put_into_plane(a, p);
  if (off > orbit::largest_miss * p.to.stableNorm())
    scene::print_message(
        fmt::format("rbf_inverse: the arrival is {:.6g} from the plane that is asked for; "
                    "arcs end at its projection onto it",
                    off));
  if (a.all) return print_all(a, p, off);
  const orbit::Transfer t = transfer(a, p, arc_of(a, p));
  if (t.status.outcome() == Outcome::outside_validity) refuse(p, t.status);
  if (!t.status.ok()) throw Failure(t.status);
  const auto [names, cells] = a.partials ? partials_of(p, t) : std::pair<std::string, std::string>();
  return fmt::format("vx0,vy0,vz0,vx1,vy1,vz1,miss{}\n{}{}\n", names, cells_of(t, off), cells);
}

/// Options of `porkchop`.
struct Grid {
  std::string file, grid;
  int threads = 0;
  bool plot = false;
};

void declare_grid(scene::Options& options, Grid& g) {
  options.add("orbits", g.file, "TOML: mu, [from], [to], [departures], [arrivals]; - is standard input")
      .required();
  options.add("--grid", g.grid, "NxM: departures and arrivals").required();
  options.add("--threads", g.threads, "number of threads; 0: one for each processor").range(0, 1024);
  options.add(
      "--plot", g.plot,
      "also draw the grid to <name of the TOML file>.svg in this folder; replaces only an older picture");
  options.footer(porkchop_keys());
}

/// Departures and arrivals of --grid NxM.
std::pair<int, int> counts_of(const std::string& grid) {
  const std::size_t place = grid.find('x');
  try {
    if (place != std::string::npos) {
      const auto whole = [](const std::string& half) {
        return scene::typed_whole("--grid", half, 1, 1'000'000);
      };
      return {whole(grid.substr(0, place)), whole(grid.substr(place + 1))};
    }
  } catch (const InputError&) {  // for one of the numbers; the message below names both
  }
  throw InputError(fmt::format("--grid {}: needs two whole numbers from 1 to 1000000, separated by x",
                               quoted_input(grid)));
}

/// Power of a thousand as unit for numbers up to @p largest, and the label with this unit.
std::pair<double, std::string> short_unit(double largest, const std::string& label) {
  if (!(largest >= 1e4 || (largest > 0 && largest < 1e-2))) return {1, label};
  const double exponent = 3 * std::floor(std::log10(largest) / 3);
  return {std::pow(10, exponent), fmt::format("{} in 10^{{{:.0f}}}", label, exponent)};
}

/// Labels without units, because those of the file are not known.
PorkchopAxes plain_axes(const orbit::Porkchop& grid) {
  PorkchopAxes axes{.heading = "Excess speeds by departure and arrival"};
  double latest = 0, least = HUGE_VAL;
  for (const auto* times : {&grid.departures, &grid.arrivals}) {
    for (const double t : *times) latest = std::max(latest, std::abs(t));
  }
  for (const orbit::PorkchopCell& cell : grid.cells) least = std::min(least, cell.v_departure);
  std::tie(axes.time, axes.departure) = short_unit(latest, axes.departure);
  axes.arrival = short_unit(latest, axes.arrival).second;
  std::tie(axes.speed_unit, axes.speed) = short_unit(4 * least, axes.speed);
  return axes;
}

/// Path of the plot: <name of the TOML file>.svg in the current folder.
std::filesystem::path picture_of(const Grid& g) {
  return (g.file == "-" ? "porkchop" : std::filesystem::path(g.file).stem().string()) + ".svg";
}

/// The plot, if requested; rejects a grid that cannot be plotted before the computation.
scene::Picture wanted_picture(const Grid& g, const orbit::PorkchopProblem& p) {
  if (!g.plot) return scene::Picture("");
  if (p.departures.count < 4 || p.arrivals.count < 4)
    throw InputError(fmt::format("--grid {}: --plot needs 4x4 or more", g.grid));
  for (const auto& [name, window] : {std::pair("departures", p.departures), {"arrivals", p.arrivals}}) {
    if (!(window.first < window.last))
      throw InputError(fmt::format("{}: --plot needs {} with first before last", g.file, name));
  }
  return scene::Picture(picture_of(g));
}

void porkchop(const Grid& g) {
  orbit::PorkchopProblem p = read_porkchop(scene::read_whole(g.file), g.file);
  std::tie(p.departures.count, p.arrivals.count) = counts_of(g.grid);
  const scene::Picture picture = wanted_picture(g, p);
  orbit::Porkchop grid;
  try {
    grid = orbit::porkchop(p, g.threads);
  } catch (const std::invalid_argument& error) {
    throw InputError(fmt::format("{}: {}", g.file, error.what()));
  }
  if (!grid.status.ok()) throw Failure(grid.status);
  if (std::ranges::none_of(grid.cells, &orbit::PorkchopCell::exists))
    scene::print_message(
        "rbf_inverse: no cell has a transfer: no arrival is later than its departure, or both positions are "
        "in the same direction from the centre");
  scene::print_result(porkchop_csv(grid));
  if (picture.wanted()) picture.draw([&] { return porkchop_map(grid, plain_axes(grid)); });
}

}  // namespace

void add_lambert_commands(scene::Commands& all) {
  all.add("lambert",
          "Solve Lambert's problem: the orbit from one position to another in a given time; prints as CSV "
          "vx0,vy0,vz0,vx1,vy1,vz1,miss (with --partials also their derivatives; with --all "
          "way,direction,revolutions,branch before and status after them). The departure is integrated by "
          "another method; a miss above a millionth of the distance is a failure",
          declare_arc, lambert);
  all.add("porkchop",
          "Print the excess speeds of transfers between two orbits over a grid of times as CSV: "
          "departure,arrival,v_departure,v_arrival,revolutions",
          declare_grid, porkchop);
}

}  // namespace nlmech::chapters::rbf_inverse
