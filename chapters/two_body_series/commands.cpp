#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "chapters/two_body_series/orbits/orbits.hpp"
#include "chapters/two_body_series/series/trajectory.hpp"
#include "nlmech/orbit/elements.hpp"
#include "nlmech/scene/program/command_line.hpp"
#include "nlmech/scene/program/csv.hpp"
#include "nlmech/scene/program/typed.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::chapters::two_body_series {
namespace {

constexpr double degree = std::numbers::pi / 180;

/// What was typed.
struct Words {
  std::string position, velocity, until, every, mu, zonal, radius, method = "series", tolerance, limit = "60";
  std::string a, p, e, i = "0", raan = "0", argp = "0", nu = "0";
};

double mu_of(const Words& words) {
  return words.mu.empty() ? earth_mu : scene::typed_positive("--mu", words.mu);
}

orbit::Vector3<double> vector(const char* option, const std::string& text) {
  const std::vector<double> all = scene::typed_numbers(option, text);
  if (all.size() != 3)
    throw InputError(fmt::format("{} {}: {} numbers where x,y,z are needed", option, text, all.size()));
  return {all[0], all[1], all[2]};
}

orbit::State state_of(const Words& words) {
  orbit::State s{vector("--position", words.position), vector("--velocity", words.velocity)};
  if (s.position.isZero(0))
    throw InputError(
        fmt::format("--position {}: is the centre, where the attraction has no bound", words.position));
  return s;
}

orbit::Gravity gravity_of(const Words& words) {
  orbit::Gravity gravity{.mu = mu_of(words)};
  if (words.zonal.empty() != words.radius.empty())
    throw InputError(words.zonal.empty()
                         ? fmt::format("--radius {}: means nothing without --zonal J2[,J3,...]", words.radius)
                         : fmt::format("--zonal {}: needs --radius R", words.zonal));
  if (words.zonal.empty()) return gravity;
  const std::vector<double> all = scene::typed_numbers("--zonal", words.zonal);
  if (all.size() > gravity.zonal.size())
    throw InputError(fmt::format("--zonal {}: {} numbers; J2 to J6 at most", words.zonal, all.size()));
  std::copy(all.begin(), all.end(), gravity.zonal.begin());
  gravity.radius = scene::typed_positive("--radius", words.radius);
  return gravity;
}

OrbitRequest understand(const Words& words) {
  OrbitRequest r;
  r.start = state_of(words);
  r.time = scene::typed_number("--until", words.until);
  r.gravity = gravity_of(words);
  if (!words.every.empty()) {
    r.every = scene::typed_positive("--every", words.every);
    if (std::abs(r.time) / *r.every > 1e7)
      throw InputError(fmt::format("--every {}: more than 10 million rows", words.every));
  }
  if (!words.tolerance.empty()) {
    r.tolerance = scene::typed_number("--tolerance", words.tolerance);
    if (!(r.tolerance >= 1e-18 && r.tolerance <= 0.1))
      throw InputError(fmt::format("--tolerance {}: must be from 1e-18 to 0.1", words.tolerance));
  }
  r.seconds = scene::typed_positive("--limit", words.limit);
  return r;
}

std::string propagate(const Words& words) {
  const OrbitRequest r = understand(words);
  if (words.method == "series") return rows_of_series(r);
  if (words.method == "rkn1210") return rows_of_rkn1210(r);
  if (words.method != "kepler")
    throw InputError(fmt::format("--method {}: there are series, rkn1210 and kepler", words.method));
  if (!words.zonal.empty())
    throw InputError(
        fmt::format("--zonal {}: --method kepler is about a point mass; use series or rkn1210", words.zonal));
  if (!words.tolerance.empty())
    throw InputError(
        fmt::format("--tolerance {}: --method kepler has none, it is exact to rounding", words.tolerance));
  return rows_of_kepler(r);
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

std::string elements(const Words& words) {
  const orbit::State s = state_of(words);
  const double mu = mu_of(words);
  const auto e = about(fmt::format("--position {} --velocity {}{}", words.position, words.velocity,
                                   words.mu.empty() ? "" : " --mu " + words.mu),
                       [&] { return orbit::elements_of(s, mu); });
  const double period = e.period(mu);
  if (e.semi_major_axis > 0 && std::isfinite(e.semi_major_axis) && !(period > 0 && std::isfinite(period)))
    throw InputError(
        fmt::format("--mu {:g}: the period is beyond the range of doubles; choose other units", mu));
  return fmt::format("a,e,i,raan,argp,nu,period\n{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g}\n",
                     e.semi_major_axis, e.eccentricity, e.inclination / degree, e.ascending_node / degree,
                     e.periapsis_argument / degree, e.true_anomaly / degree, period);
}

/// An angle in degrees: one turn either way.
double typed_angle(const char* option, const std::string& text) {
  const double value = scene::typed_number(option, text);
  if (std::abs(value) > 360)
    throw InputError(fmt::format("{} {}: must be from -360 to 360 degrees", option, text));
  return value;
}

std::string state(const Words& words) {
  const double mu = mu_of(words), e = scene::typed_number("--e", words.e);
  if (words.a.empty() == words.p.empty())
    throw InputError(words.a.empty() ? "--a A or --p P is needed"
                                     : fmt::format("--a {} --p {}: give one of them", words.a, words.p));
  if (e < 0) throw InputError(fmt::format("--e {}: must be 0 or more", words.e));
  const double i = scene::typed_number("--i", words.i);
  if (i < 0 || i > 180) throw InputError(fmt::format("--i {}: must be from 0 to 180 degrees", words.i));
  const double raan = typed_angle("--raan", words.raan), argp = typed_angle("--argp", words.argp),
               nu = typed_angle("--nu", words.nu);
  const std::string shape = words.a.empty() ? fmt::format("--p {} --e {}", words.p, words.e)
                                            : fmt::format("--a {} --e {}", words.a, words.e);
  const auto conic = about(shape, [&] {
    if (words.a.empty())
      return orbit::Elements{.semi_latus_rectum = scene::typed_positive("--p", words.p), .eccentricity = e};
    return orbit::from_axis(scene::typed_number("--a", words.a), e);
  });
  orbit::Elements all = conic;
  all.inclination = i * degree;
  all.ascending_node = raan * degree;
  all.periapsis_argument = argp * degree;
  all.true_anomaly = nu * degree;
  const orbit::State s =
      about(fmt::format("{} --nu {}", shape, words.nu), [&] { return orbit::state_of(all, mu); });
  return fmt::format("x,y,z,vx,vy,vz\n{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g}\n", s.position[0],
                     s.position[1], s.position[2], s.velocity[0], s.velocity[1], s.velocity[2]);
}

/// A command that prints what @p work makes of its words.
CLI::App* add(CLI::App& app, const char* name, const char* help, const std::shared_ptr<Words>& words,
              std::string (*work)(const Words&)) {
  CLI::App* command = app.add_subcommand(name, help);
  command->add_option("--mu", words->mu, "gravitational parameter; 3.986004418e14 without it");
  command->callback([words, work] { scene::print_result(work(*words)); });
  return command;
}

void add_state_options(CLI::App& command, Words& words) {
  command.add_option("--position", words.position, "x,y,z from the centre, in any consistent units")
      ->required();
  command.add_option("--velocity", words.velocity, "its rate, x,y,z")->required();
}

void add_propagate_command(CLI::App& app) {
  const auto words = std::make_shared<Words>();  // lives as long as the callback
  CLI::App* command =
      add(app, "propagate", "Where an orbit leads to, as CSV: t,x,y,z,vx,vy,vz", words, propagate);
  add_state_options(*command, *words);
  command->add_option("--until", words->until, "time at which it ends, from 0; negative runs backwards")
      ->required();
  command->add_option("--every", words->every,
                      "rows at this distance in time; without it the first and the last");
  command->add_option("--zonal", words->zonal, "J2[,J3,...,J6] of the centre, the axis along z");
  command->add_option("--radius", words->radius, "that the zonal terms refer to");
  command->add_option("--method", words->method, "series, rkn1210, or kepler in closed form")
      ->capture_default_str();
  command->add_option("--tolerance", words->tolerance,
                      "of a step, relative to |r| and |v|, 1e-18 to 0.1; 1e-15 without it");
  command->add_option("--limit", words->limit, "wall time in seconds, at most")->capture_default_str();
}

void add_elements_command(CLI::App& app) {
  const auto words = std::make_shared<Words>();
  CLI::App* command =
      add(app, "elements",
          "The classical elements of a state, angles in degrees: a,e,i,raan,argp,nu,period as CSV", words,
          elements);
  add_state_options(*command, *words);
}

void add_state_command(CLI::App& app) {
  const auto words = std::make_shared<Words>();
  CLI::App* command =
      add(app, "state", "The state of classical elements: x,y,z,vx,vy,vz as CSV", words, state);
  command->add_option("--a", words->a, "semi-major axis, negative for hyperbolas");
  command->add_option("--p", words->p, "semi-latus rectum in its place, for parabolas or any conic");
  command->add_option("--e", words->e, "eccentricity")->required();
  command->add_option("--i", words->i, "inclination in degrees")->capture_default_str();
  command->add_option("--raan", words->raan, "longitude of the ascending node in degrees")
      ->capture_default_str();
  command->add_option("--argp", words->argp, "argument of the periapsis in degrees")->capture_default_str();
  command->add_option("--nu", words->nu, "true anomaly in degrees")->capture_default_str();
}

}  // namespace

void commands(CLI::App& app) {
  add_propagate_command(app);
  add_elements_command(app);
  add_state_command(app);
}

}  // namespace nlmech::chapters::two_body_series
