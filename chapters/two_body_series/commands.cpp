#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "chapters/two_body_series/ensemble/propagate_all.hpp"
#include "chapters/two_body_series/orbits/orbits.hpp"
#include "chapters/two_body_series/series/accuracy.hpp"
#include "chapters/two_body_series/series/trajectory.hpp"
#include "chapters/two_body_series/stm/sensitivities.hpp"
#include "nlmech/orbit/elements.hpp"
#include "nlmech/scene/program/csv.hpp"
#include "nlmech/scene/program/files.hpp"
#include "nlmech/scene/program/options.hpp"
#include "nlmech/scene/program/this_process.hpp"
#include "nlmech/scene/program/typed.hpp"
#include "nlmech/support/degrees.hpp"
#include "nlmech/support/errors.hpp"
#include "nlmech/support/quoted_input.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::chapters::two_body_series {
namespace {

void declare_mu(scene::Options& options, std::optional<double>& mu) {
  options.add("--mu", mu, fmt::format("gravitational parameter (default {}, the Earth's)", earth_mu))
      .positive();
}

std::string text_of(const orbit::Vector3<double>& v) { return fmt::format("{},{},{}", v[0], v[1], v[2]); }

void refuse_centre(const orbit::State& s) {
  if (s.position.isZero(0))
    throw InputError(fmt::format("--position {}: is the centre of attraction; give another position",
                                 text_of(s.position)));
}

/// Throws InputError if the state suggests wrong units. Called after all other checks.
void refuse_other_units(const std::string& typed, const orbit::State& s, const std::optional<double>& mu) {
  const std::string why = mu ? "" : inside_the_earth(s);
  if (!why.empty()) throw InputError(fmt::format("{}: {}", typed, why));
}

void check_rows(double until, double every) {
  if (std::abs(until) / every > 1e7) throw input_error("--every {}: more than 10 million rows", every);
}

/// Options of a state, or of a file of states.
struct TypedStates {
  std::vector<double> position, velocity;
  std::string states;
  std::optional<double> mu;
};

/// @param columns of the file that may be missing
void declare_states(scene::Options& options, TypedStates& s, const char* columns) {
  options.add("--position", s.position, "position x,y,z from the centre, in any consistent units");
  options.add("--velocity", s.velocity, "velocity x,y,z");
  options.add("--states", s.states,
              fmt::format("CSV file of states (columns x,y,z,vx,vy,vz, optional {}, in any order and case); "
                          "other columns are passed through; - is standard input",
                          columns));
  declare_mu(options, s.mu);
}

/// Options of `propagate`.
struct Propagation : TypedStates {
  std::optional<double> until, every, radius, tolerance, limit;
  std::vector<double> zonal;
  std::string method = "series", covariance, at, events;
  std::optional<int> threads;
  bool stm = false;
};

void declare_propagation(scene::Options& options, Propagation& p) {
  declare_states(options, p, "mu and until");
  options.add("--until", p.until, "final time, from 0; negative: backwards");
  options
      .add("--every", p.every,
           "time between rows (default: the first and the last row; with --states the last)")
      .positive();
  options.add("--at", p.at,
              "times of the rows T1,T2,... on one side of 0, or a CSV file with the column t, in place of "
              "--until and --every; - is standard input");
  options.add(
      "--events", p.events,
      "add a row at each of these: nodes (z = 0), apsides, altitude=H (|r| = R + H, with the --radius "
      "R, without --mu and --radius the Earth's), separated by commas; the column event names them");
  options.add("--zonal", p.zonal, "zonal coefficients J2[,J3,...,J6] of the centre, with its axis along z");
  options.add("--radius", p.radius, "reference radius of the zonal terms and altitudes").positive();
  options.add("--method", p.method, "kepler is the closed form").one_of({"series", "rkn1210", "kepler"});
  options
      .add("--tolerance", p.tolerance,
           "error per step, relative to |r| and |v| (default 1e-15). About a point mass rows are compared "
           "with Kepler's solution: fewer than six correct digits give a warning, none a failure")
      .range(1e-18, 0.1);
  options.add("--threads", p.threads, "number of threads for --states (default: one for each processor)")
      .range(1, 1024);
  options.add(
      "--stm", p.stm,
      "add the state-transition matrix to each row: phi_11,phi_12,...,phi_66, phi_ij = d x_i(t)/d x_j(0) "
      "in the order x,y,z,vx,vy,vz");
  options.add(
      "--covariance", p.covariance,
      "CSV file of the initial covariance, six rows of x,y,z,vx,vy,vz in the units of the state; adds "
      "the propagated one to each row: p_11,p_12,...,p_66; - is standard input");
  options.limit(p.limit, "--states");
}

Sensitivities sensitivities_of(const Propagation& p) {
  if (p.covariance == "-" && p.states == "-")
    throw InputError("--covariance -: standard input contains the states; give a file");
  Sensitivities columns{p.stm, std::nullopt};
  if (!p.covariance.empty()) columns.initial_root = read_covariance(p.covariance);
  return columns;
}

orbit::Gravity gravity_of(const Propagation& p) {
  orbit::Gravity gravity{.mu = p.mu.value_or(earth_mu)};
  if (p.radius && p.zonal.empty() && p.events.find("altitude") == std::string::npos)
    throw input_error("--radius {}: needs --zonal J2[,J3,...], or --events altitude=H", *p.radius);
  if (p.zonal.empty()) return gravity;
  const std::string zonal = fmt::format("--zonal {}", fmt::join(p.zonal, ","));
  if (!p.radius) throw InputError(zonal + ": needs --radius R");
  if (p.zonal.size() > gravity.zonal.size())
    throw input_error("{}: {} numbers; J2 to J6 at most", zonal, p.zonal.size());
  std::ranges::copy(p.zonal, gravity.zonal.begin());
  gravity.radius = *p.radius;
  if (p.method == "kepler")
    throw input_error("{}: --method kepler is for a point mass; use series or rkn1210", zonal);
  return gravity;
}

void check_method(const Propagation& p) {
  if (p.method == "kepler" && p.tolerance)
    throw input_error("--tolerance {}: --method kepler is exact to rounding; leave it out", *p.tolerance);
}

/// Times of --at in the direction of the run, each once. @throws InputError
std::vector<double> times_of(const std::string& typed) {
  const bool is_file = typed == "-" || std::filesystem::exists(typed) ||
                       std::string_view("0123456789+-.").find(typed.front()) == std::string_view::npos;
  std::vector<double> times =
      is_file ? scene::parse_numbers(scene::read_whole(typed), typed == "-" ? "standard input" : typed, {"t"})
                    .column[0]
              : scene::typed_numbers("--at", typed);
  if (times.empty()) throw input_error("--at {}: has no times", quoted_input(typed));
  const auto [first, last] = std::ranges::minmax(times);
  if (first < 0 && last > 0)
    throw input_error("--at {}: has times before and after 0; ask for each side in a run of its own",
                      quoted_input(typed));
  std::ranges::sort(times, {}, [](double t) { return std::abs(t); });
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

/// Refuses options that --at replaces.
void check_at(const Propagation& p) {
  if (p.at.empty()) return;
  const auto refuse = [&](const std::string& other) {
    throw input_error("{}: --at {} gives the times of the rows; leave out one of the two", other,
                      quoted_input(p.at));
  };
  if (p.until) refuse(fmt::format("--until {}", *p.until));
  if (p.every) refuse(fmt::format("--every {}", *p.every));
  if (!p.events.empty()) refuse(fmt::format("--events {}", quoted_input(p.events)));
}

/// Events of --events. @throws InputError
std::vector<NamedEvent> events_of(const Propagation& p) {
  constexpr std::string_view altitude = "altitude=";
  std::vector<NamedEvent> events;
  if (p.events.empty()) return events;
  for (const std::string& piece : scene::split(p.events, ',')) {
    const std::string name = scene::trimmed(piece);
    if (name == "nodes") {
      events.push_back({name, {orbit::EventKind::node}});
    } else if (name == "apsides") {
      events.push_back({name, {orbit::EventKind::apsis}});
    } else if (name.starts_with(altitude)) {
      if (p.mu && !p.radius)
        throw input_error("--events {}: needs --radius R, from which the altitude counts",
                          quoted_input(name));
      const double radius = p.radius.value_or(orbit::earth().radius);
      double height = 0;
      if (const std::string text = name.substr(altitude.size()); !scene::parse_number(text, height))
        throw input_error("--events {}: {}", quoted_input(name), scene::number_fault(text));
      const double distance = radius + height;
      if (!(distance > 0 && std::isfinite(distance)))
        throw input_error("--events {}: is at the distance {} from the centre; must be above {}",
                          quoted_input(name), distance, -radius);
      events.push_back({name, {orbit::EventKind::distance, distance}});
    } else {
      throw input_error("--events {}: there is no event {}; give nodes, apsides, altitude=H",
                        quoted_input(p.events), quoted_input(name));
    }
    const orbit::Event& last = events.back().event;
    for (std::size_t i = 0; i + 1 < events.size(); ++i) {
      if (events[i].event.kind == last.kind && events[i].event.distance == last.distance)
        throw input_error("--events {}: {} is there twice", quoted_input(p.events), quoted_input(name));
    }
  }
  return events;
}

void refuse_both(const TypedStates& s) {
  for (const auto& [option, typed] : {std::pair("--position", &s.position), {"--velocity", &s.velocity}}) {
    if (!typed->empty())
      throw input_error("{} {}: --states {} contains the states; give only one of the two", option,
                        fmt::join(*typed, ","), s.states);
  }
}

/// Runs `propagate --states`.
int propagate_all(const Propagation& p) {
  refuse_both(p);
  for (const auto& [option, typed] : {std::pair("--at", &p.at), {"--events", &p.events}}) {
    if (!typed->empty())
      throw input_error("{} {}: needs one --position; --states takes --every", option, quoted_input(*typed));
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
  r.seconds = p.limit.value_or(r.seconds);
  r.columns = sensitivities_of(p);
  if (p.until && p.every) check_rows(*p.until, *p.every);
  return print_orbits(r);
}

/// Value of --position or --velocity. @throws InputError if it has not three numbers
orbit::Vector3<double> vector_of(const char* option, const std::vector<double>& typed) {
  if (typed.empty()) throw input_error("{} x,y,z is needed, or --states FILE.csv for many orbits", option);
  if (typed.size() != 3)
    throw input_error("{} {}: {} numbers; 3 are needed", option, fmt::join(typed, ","), typed.size());
  return {typed[0], typed[1], typed[2]};
}

/// State of --position and --velocity. @throws InputError
orbit::State state_of(const TypedStates& s) {
  orbit::State state{vector_of("--position", s.position), vector_of("--velocity", s.velocity)};
  refuse_centre(state);
  return state;
}

scene::Answer propagate(const Propagation& p) {
  check_at(p);
  if (!p.states.empty()) return propagate_all(p);
  if (p.threads) throw input_error("--threads {}: needs --states", *p.threads);
  const orbit::State start = state_of(p);
  if (!p.until && p.at.empty()) throw InputError("--until T is needed, or --at T1,T2,...");
  const std::vector<double> at = p.at.empty() ? std::vector<double>() : times_of(p.at);
  OrbitRequest r{.start = start,
                 .time = at.empty() ? *p.until : at.back(),
                 .every = p.every,
                 .at = at,
                 .events = events_of(p),
                 .gravity = gravity_of(p),
                 .seconds = p.limit.value_or(scene::Options::default_limit)};
  if (p.every) check_rows(*p.until, *p.every);
  check_method(p);
  refuse_other_units("--position " + text_of(start.position), start, p.mu);
  r.tolerance = p.tolerance.value_or(r.tolerance);
  r.columns = sensitivities_of(p);
  if (r.columns.any()) {
    if (!p.events.empty())
      throw input_error("--events {}: rows at events have no matrix; leave out {}", quoted_input(p.events),
                        p.stm ? "--stm" : "--covariance");
    return rows_with_columns(r, p.method);
  }
  if (p.method == "series") return rows_of_series(r);
  return p.method == "rkn1210" ? rows_of_rkn1210(r) : rows_of_kepler(r);
}

/// Runs @p work and converts std::invalid_argument to an InputError that names the options.
template <class Work>
auto about(const std::string& options, const Work& work) {
  try {
    return work();
  } catch (const std::invalid_argument& error) {
    throw InputError(options + ": " + error.what());
  }
}

void declare_elements_of(scene::Options& options, TypedStates& s) { declare_states(options, s, "mu"); }

scene::Answer elements(const TypedStates& s) {
  if (!s.states.empty()) {
    refuse_both(s);
    return print_elements(s.states, s.mu);
  }
  const orbit::State at = state_of(s);
  const double mu = s.mu.value_or(earth_mu);
  const std::string place = "--position " + text_of(at.position);
  const std::string cells = about(fmt::format("{} --velocity {} --mu {}", place, text_of(at.velocity), mu),
                                  [&] { return element_cells(at, mu); });
  refuse_other_units(place, at, s.mu);
  return fmt::format("{}\n{}\n", element_columns, cells);
}

/// Options of `state`; angles in degrees.
struct TypedElements {
  std::optional<double> a, p, q, e;
  double i = 0, raan = 0, argp = 0;
  std::optional<double> nu, eccentric_anomaly, mean_anomaly, time_since_periapsis, mu;
};

void declare_elements(scene::Options& options, TypedElements& t) {
  options.add("--a", t.a, "semi-major axis, negative for hyperbolas");
  options.add("--p", t.p, "semi-latus rectum, in place of --a, for any conic").positive();
  options
      .add("--q", t.q, "periapsis distance, in place of --a, or of --e, which is inaccurate near a parabola")
      .positive();
  options.add("--e", t.e, "eccentricity, 0 or more; needed unless --a and --q are given");
  options.add("--i", t.i, "inclination in degrees").range(0, 180);
  options.add("--raan", t.raan, "longitude of the ascending node in degrees").range(-360, 360);
  options.add("--argp", t.argp, "argument of the periapsis in degrees").range(-360, 360);
  options.add("--nu", t.nu, "true anomaly in degrees (default 0)").range(-360, 360);
  options.add(
      "--eccentric-anomaly", t.eccentric_anomaly,
      "eccentric anomaly in degrees, in place of --nu; for hyperbolas the hyperbolic anomaly times 180/pi");
  options.add("--mean-anomaly", t.mean_anomaly,
              "mean anomaly in degrees, in place of --nu, not for parabolas");
  options.add("--time-since-periapsis", t.time_since_periapsis,
              "time since the periapsis, in place of --nu, for any conic");
  declare_mu(options, t.mu);
}

/// The given ones of these options with their values, as text.
std::string given(std::initializer_list<std::pair<const char*, std::optional<double>>> options) {
  std::string text;
  for (const auto& [name, value] : options) {
    if (value) text += fmt::format("{}{} {}", text.empty() ? "" : " ", name, *value);
  }
  return text;
}

std::string shape_of(const TypedElements& t) {
  return given({{"--a", t.a}, {"--p", t.p}, {"--q", t.q}, {"--e", t.e}});
}

std::string place_of(const TypedElements& t) {
  return given({{"--nu", t.nu},
                {"--eccentric-anomaly", t.eccentric_anomaly},
                {"--mean-anomaly", t.mean_anomaly},
                {"--time-since-periapsis", t.time_since_periapsis}});
}

/// The conic from two of a, p, q and e. @throws InputError for other combinations
orbit::Conic conic_of(const TypedElements& t) {
  const std::string shape = shape_of(t);
  if (!t.a && !t.p && !t.q) throw InputError("--a A, --p P or --q Q is needed");
  if (t.a && t.q && !t.p && !t.e) {
    const orbit::Conic conic{*t.q, *t.q / *t.a};
    if (!(conic.one_minus_e <= 1) || conic.one_minus_e == 0)
      throw InputError(shape + ": no conic has these; a must be at least q, or negative for hyperbolas");
    return conic;
  }
  if (static_cast<int>(t.a.has_value()) + static_cast<int>(t.p.has_value()) +
          static_cast<int>(t.q.has_value()) >
      1)
    throw InputError(shape + ": give one of --a, --p and --q with --e, or --a and --q alone");
  if (!t.e) throw InputError(shape + ": needs --e E");
  if (*t.e < 0) throw InputError(fmt::format("--e {}: must be 0 or more", *t.e));
  if (t.a) return {about(shape, [&] { return orbit::from_axis(*t.a, *t.e); }).periapsis_distance, 1 - *t.e};
  return {t.q ? *t.q : *t.p / (1 + *t.e), 1 - *t.e};
}

orbit::State state_on(const orbit::Conic& conic, const TypedElements& t) {
  const orbit::Orientation o{sine_cosine_of_degrees(t.i), sine_cosine_of_degrees(t.raan),
                             sine_cosine_of_degrees(t.argp)};
  const double mu = t.mu.value_or(earth_mu);
  if (t.time_since_periapsis) return orbit::state_at_time(conic, o, *t.time_since_periapsis, mu);
  if (t.eccentric_anomaly) {
    const double anomaly = *t.eccentric_anomaly;
    return conic.one_minus_e < 0
               ? orbit::state_at_hyperbolic_anomaly(conic, o, anomaly * degree, mu)
               : orbit::state_at_eccentric_anomaly(conic, o, sine_cosine_of_degrees(anomaly / 2), mu);
  }
  if (t.mean_anomaly) {
    const double turned = conic.one_minus_e > 0 ? std::remainder(*t.mean_anomaly, 360) : *t.mean_anomaly;
    return orbit::state_at_mean_anomaly(conic, o, turned * degree, mu);
  }
  return orbit::state_at_true_anomaly(conic, o, sine_cosine_of_degrees(t.nu.value_or(0) / 2), mu);
}

/// Change of the position, relative to the distance, if e and nu are replaced by the next doubles.
double lost_by_rounding(const TypedElements& t, const orbit::State& s) {
  double lost = 0;
  for (std::optional<double> TypedElements::*member : {&TypedElements::e, &TypedElements::nu}) {
    TypedElements next = t;
    std::optional<double>& number = next.*member;
    if (!number || (member == &TypedElements::e && *number == 1)) continue;  // exactly a parabola
    number = std::nextafter(*number, HUGE_VAL);
    try {
      const orbit::State beside = state_on(conic_of(next), next);
      lost += (beside.position - s.position).stableNorm() / s.position.stableNorm();
    } catch (const std::exception&) {
      return 1;  // the next double is a parabola or beyond an asymptote
    }
  }
  return lost;
}

std::string state(const TypedElements& t) {
  const orbit::Conic conic = conic_of(t);
  const std::string shape = shape_of(t), place = place_of(t);
  if (static_cast<int>(t.nu.has_value()) + static_cast<int>(t.eccentric_anomaly.has_value()) +
          static_cast<int>(t.mean_anomaly.has_value()) +
          static_cast<int>(t.time_since_periapsis.has_value()) >
      1)
    throw InputError(place + ": give only one of these");
  const orbit::State s =
      about(place.empty() ? shape : shape + " " + place, [&] { return state_on(conic, t); });
  refuse_other_units(shape, s, t.mu);
  if (const double lost = lost_by_rounding(t, s); lost > 1e-6)
    scene::print_message(fmt::format(
        "two_body_series: {} {}: rounding of e or nu changes the position by {:.1g} of its distance; --a and "
        "--q with --time-since-periapsis, as printed by elements, determine it to rounding",
        shape, place, lost));
  return fmt::format("x,y,z,vx,vy,vz\n{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g}\n", s.position[0],
                     s.position[1], s.position[2], s.velocity[0], s.velocity[1], s.velocity[2]);
}

}  // namespace

void commands(scene::Commands& all) {
  all.add("propagate",
          "Propagate an orbit; prints t,x,y,z,vx,vy,vz as CSV (with --states: "
          "row,t,x,y,z,vx,vy,vz,...,status), and "
          "with --stm and --covariance their columns",
          declare_propagation, propagate);
  all.add("elements",
          fmt::format(
              "Print the classical elements of a state, angles in degrees, as CSV: {} (with --states: "
              "row,a,...,status). The command state recovers the state from a, q (for parabolas q and e = "
              "1), the angles and time_since_periapsis",
              element_columns),
          declare_elements_of, elements);
  all.add("state", "Print the state of given classical elements as CSV: x,y,z,vx,vy,vz", declare_elements,
          state);
}

}  // namespace nlmech::chapters::two_body_series
