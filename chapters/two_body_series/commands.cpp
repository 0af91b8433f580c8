#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "chapters/two_body_series/ensemble/propagate_all.hpp"
#include "chapters/two_body_series/orbits/orbits.hpp"
#include "chapters/two_body_series/series/trajectory.hpp"
#include "nlmech/orbit/elements.hpp"
#include "nlmech/scene/catalogue/shard.hpp"
#include "nlmech/scene/program/options.hpp"
#include "nlmech/support/errors.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::chapters::two_body_series {
namespace {

constexpr double degree = std::numbers::pi / 180;

/// A state and what attracts.
struct TypedState {
  orbit::State at;
  double mu = earth_mu;
};

void declare_mu(scene::Options& options, double& mu) {
  options.add("--mu", mu, "gravitational parameter").positive();
}

void declare_state(scene::Options& options, TypedState& s) {
  options.add("--position", s.at.position, "x,y,z from the centre, in any consistent units").required();
  options.add("--velocity", s.at.velocity, "its rate, x,y,z").required();
  declare_mu(options, s.mu);
}

std::string text_of(const orbit::Vector3<double>& v) { return fmt::format("{},{},{}", v[0], v[1], v[2]); }

void refuse_centre(const orbit::State& s) {
  if (s.position.isZero(0))
    throw InputError(
        fmt::format("--position {}: is the centre, where the attraction has no bound", text_of(s.position)));
}

void check_rows(double until, double every) {
  if (std::abs(until) / every > 1e7) throw input_error("--every {}: more than 10 million rows", every);
}

/// `propagate`
struct Propagation {
  std::vector<double> position, velocity;
  std::optional<double> mu, until;
  std::optional<double> every, radius, tolerance, limit;
  std::vector<double> zonal;
  std::string method = "series", states, shard;
  std::optional<int> threads;
};

void declare_propagation(scene::Options& options, Propagation& p) {
  options.add("--position", p.position, "x,y,z from the centre, in any consistent units");
  options.add("--velocity", p.velocity, "its rate, x,y,z");
  options.add(
      "--states", p.states,
      "CSV file in their place: columns x,y,z,vx,vy,vz, and mu and until if they differ, in any order and "
      "case; others are handed on; - is standard input");
  options.add("--mu", p.mu, fmt::format("gravitational parameter; the Earth's, {}, without it", earth_mu))
      .positive();
  options.add("--until", p.until, "time at which it ends, from 0; negative runs backwards");
  options
      .add("--every", p.every,
           "rows at this distance in time; without it the first and the last, of --states the last")
      .positive();
  options.add("--zonal", p.zonal, "J2[,J3,...,J6] of the centre, the axis along z");
  options.add("--radius", p.radius, "that the zonal terms refer to").positive();
  options.add("--method", p.method, "kepler is the closed form").one_of({"series", "rkn1210", "kepler"});
  options.add("--tolerance", p.tolerance, "of a step, relative to |r| and |v|; 1e-15 without it")
      .range(1e-18, 0.1);
  options.add("--threads", p.threads, "of --states, how many; without it one a processor").range(1, 1024);
  options.add("--shard", p.shard, "of --states, i/n: the i-th of n disjoint parts, for merge");
  options.limit(p.limit, "--states");
}

orbit::Gravity gravity_of(const Propagation& p) {
  orbit::Gravity gravity{.mu = p.mu.value_or(earth_mu)};
  if (p.radius && p.zonal.empty())
    throw input_error("--radius {}: means nothing without --zonal J2[,J3,...]", *p.radius);
  if (p.zonal.empty()) return gravity;
  const std::string zonal = fmt::format("--zonal {}", fmt::join(p.zonal, ","));
  if (!p.radius) throw InputError(zonal + ": needs --radius R");
  if (p.zonal.size() > gravity.zonal.size())
    throw input_error("{}: {} numbers; J2 to J6 at most", zonal, p.zonal.size());
  std::ranges::copy(p.zonal, gravity.zonal.begin());
  gravity.radius = *p.radius;
  if (p.method == "kepler")
    throw input_error("{}: --method kepler is about a point mass; use series or rkn1210", zonal);
  return gravity;
}

void check_method(const Propagation& p) {
  if (p.method == "kepler" && p.tolerance)
    throw input_error("--tolerance {}: --method kepler has none, it is exact to rounding", *p.tolerance);
}

/// Orbits of a file.
int propagate_all(const Propagation& p) {
  for (const auto& [option, typed] : {std::pair("--position", &p.position), {"--velocity", &p.velocity}}) {
    if (!typed->empty())
      throw input_error("{} {}: --states {} has the states; give one of both", option, fmt::join(*typed, ","),
                        p.states);
  }
  if (p.method == "rkn1210")
    throw input_error("--method rkn1210: --states takes series or kepler; rkn1210 takes one --position");
  check_method(p);
  CatalogueRequest r;
  r.file = p.states;
  r.until = p.until;
  r.mu = p.mu;
  r.every = p.every;
  r.field = gravity_of(p);
  r.method = p.method;
  r.tolerance = p.tolerance.value_or(r.tolerance);
  r.threads = p.threads.value_or(0);
  r.shard = p.shard;
  r.seconds = p.limit.value_or(r.seconds);
  if (p.until && p.every) check_rows(*p.until, *p.every);
  return print_orbits(r);
}

/// One of the options for one orbit.
orbit::Vector3<double> vector_of(const char* option, const std::vector<double>& typed) {
  if (typed.empty()) throw input_error("{} x,y,z is needed, or --states FILE.csv for many orbits", option);
  if (typed.size() != 3)
    throw input_error("{} {}: {} numbers; 3 are needed", option, fmt::join(typed, ","), typed.size());
  return {typed[0], typed[1], typed[2]};
}

scene::Answer propagate(const Propagation& p) {
  if (!p.states.empty()) return propagate_all(p);
  if (p.threads) throw input_error("--threads {}: is about --states", *p.threads);
  if (!p.shard.empty()) throw input_error("--shard {}: is about --states", p.shard);
  const orbit::State start{vector_of("--position", p.position), vector_of("--velocity", p.velocity)};
  refuse_centre(start);
  if (!p.until) throw InputError("--until T is needed");
  OrbitRequest r{.start = start,
                 .time = *p.until,
                 .every = p.every,
                 .gravity = gravity_of(p),
                 .seconds = p.limit.value_or(scene::Options::usual_limit)};
  if (p.every) check_rows(*p.until, *p.every);
  check_method(p);
  r.tolerance = p.tolerance.value_or(r.tolerance);
  if (p.method == "series") return rows_of_series(r);
  return p.method == "rkn1210" ? rows_of_rkn1210(r) : rows_of_kepler(r);
}

/// `merge`
struct Parts {
  std::vector<std::string> files;
};

void declare_parts(scene::Options& options, Parts& parts) {
  options.add("parts", parts.files, "files written by propagate --shard").required();
}

int merge(const Parts& parts) {
  scene::print_merged(parts.files);
  return 0;
}

/// Complaints about numbers that make no orbit together.
template <class Work>
auto about(const std::string& options, const Work& work) {
  try {
    return work();
  } catch (const std::invalid_argument& error) {
    throw InputError(options + ": " + error.what());
  }
}

std::string elements(const TypedState& s) {
  refuse_centre(s.at);
  const auto e = about(fmt::format("--position {} --velocity {} --mu {}", text_of(s.at.position),
                                   text_of(s.at.velocity), s.mu),
                       [&] { return orbit::elements_of(s.at, s.mu); });
  const double period = e.period(s.mu);
  if (e.semi_major_axis > 0 && std::isfinite(e.semi_major_axis) && !(period > 0 && std::isfinite(period)))
    throw InputError(
        fmt::format("--mu {:g}: the period is beyond the range of doubles; choose other units", s.mu));
  return fmt::format("a,e,i,raan,argp,nu,period\n{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g}\n",
                     e.semi_major_axis, e.eccentricity, e.inclination / degree, e.ascending_node / degree,
                     e.periapsis_argument / degree, e.true_anomaly / degree, period);
}

/// `state`; angles in degrees.
struct TypedElements {
  std::optional<double> a, p;
  double e = 0, i = 0, raan = 0, argp = 0, nu = 0, mu = earth_mu;
};

void declare_elements(scene::Options& options, TypedElements& t) {
  options.add("--a", t.a, "semi-major axis, negative for hyperbolas");
  options.add("--p", t.p, "semi-latus rectum in its place, for parabolas or any conic").positive();
  options.add("--e", t.e, "eccentricity, 0 or more").required();
  options.add("--i", t.i, "inclination in degrees").range(0, 180);
  options.add("--raan", t.raan, "longitude of the ascending node in degrees").range(-360, 360);
  options.add("--argp", t.argp, "argument of the periapsis in degrees").range(-360, 360);
  options.add("--nu", t.nu, "true anomaly in degrees").range(-360, 360);
  declare_mu(options, t.mu);
}

std::string state(const TypedElements& t) {
  if (!t.a && !t.p) throw InputError("--a A or --p P is needed");
  if (t.a && t.p) throw InputError(fmt::format("--a {} --p {}: give one of them", *t.a, *t.p));
  if (t.e < 0) throw InputError(fmt::format("--e {}: must be 0 or more", t.e));
  const std::string shape =
      t.a ? fmt::format("--a {} --e {}", *t.a, t.e) : fmt::format("--p {} --e {}", *t.p, t.e);
  orbit::Elements all = about(shape, [&] {
    return t.a ? orbit::from_axis(*t.a, t.e)
               : orbit::Elements{.semi_latus_rectum = *t.p, .eccentricity = t.e};
  });
  all.inclination = t.i * degree;
  all.ascending_node = t.raan * degree;
  all.periapsis_argument = t.argp * degree;
  all.true_anomaly = t.nu * degree;
  const orbit::State s =
      about(fmt::format("{} --nu {}", shape, t.nu), [&] { return orbit::state_of(all, t.mu); });
  return fmt::format("x,y,z,vx,vy,vz\n{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g}\n", s.position[0],
                     s.position[1], s.position[2], s.velocity[0], s.velocity[1], s.velocity[2]);
}

}  // namespace

void commands(scene::Commands& all) {
  all.add(
      "propagate",
      "Where an orbit leads to, as CSV: t,x,y,z,vx,vy,vz; many of a file: row,t,x,y,z,vx,vy,vz,...,status",
      declare_propagation, propagate);
  all.add("merge", "Joins all shards of one run over --states, given in any order, to what one run writes",
          declare_parts, merge);
  all.add("elements",
          "The classical elements of a state, angles in degrees: a,e,i,raan,argp,nu,period as CSV",
          declare_state, elements);
  all.add("state", "The state of classical elements: x,y,z,vx,vy,vz as CSV", declare_elements, state);
}

}  // namespace nlmech::chapters::two_body_series
