/// @file
/// Commands of the chapter: `poles`, `zeros`, `response`, `step` and `optimal-gains` for a user-defined
/// spacecraft.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "chapters/gss_control/commands/spacecraft_file.hpp"
#include "chapters/gss_control/grids.hpp"
#include "nlmech/scene/program/options.hpp"
#include "nlmech/scene/program/typed.hpp"
#include "nlmech/spacecraft/control/closed_loop.hpp"
#include "nlmech/spacecraft/control/optimal_gains.hpp"
#include "nlmech/spacecraft/parameters.hpp"
#include "nlmech/spacecraft/plant/poles.hpp"
#include "nlmech/spacecraft/response.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::chapters::gss_control {
namespace {

using spacecraft::Complex;

/// Options common to all commands.
struct Craft {
  std::string file;           ///< empty: Table 3.1
  std::vector<double> gains;  ///< empty: no feedback
};

/// Declares --spacecraft and, with @p with_gains, --gains.
void declare_craft(scene::Options& options, Craft& craft, bool with_gains = true) {
  options.add(
      "--spacecraft", craft.file,
      "TOML file (- is standard input) with hub_inertia, mass_per_length, youngs_modulus, length, "
      "hub_radius, second_moment, tip_mass, tip_inertia in any consistent units; options and results "
      "have the same units. Default, also for missing keys: Table 3.1 in slug, ft, lb, s. Ends of the "
      "appendages: root_stiffness, a moment per radian (0: pinned; default 'clamped'), and tip_support: "
      "'free' (default), 'pinned', 'guided' or 'clamped' in the frame of the hub");
  if (with_gains)
    options.add("--gains", craft.gains, "k1,k2,k3 of u = -k1 (theta - theta_f) - k2 (r S0 - M0) - k3 theta'");
}

/// Parses frequencies: "w1,w2,...", or "LO:HI:N" for N logarithmically spaced frequencies from LO to HI.
std::vector<double> typed_frequencies(const char* option, const std::string& text) {
  if (text.find(':') == std::string::npos) {
    std::vector<double> all;
    for (const std::string& word : scene::typed_words(option, text)) {
      const double omega = scene::typed_number(option, word);
      if (omega == 0)
        throw InputError(fmt::format("{} {}: 0 is the double pole of a free body", option, text));
      all.push_back(omega);
    }
    return all;
  }
  const std::vector<std::string> parts = scene::split(text, ':');
  if (parts.size() != 3)
    throw InputError(fmt::format("{} {}: LO:HI:N needs three parts, not {}", option, text, parts.size()));
  const double low = scene::typed_positive(option, parts[0]), high = scene::typed_positive(option, parts[1]);
  const int n = scene::typed_whole(option, parts[2], 1, 10'000'000);
  if (n < 2 || !(high > low))
    throw InputError(fmt::format("{} {}: in LO:HI:N LO must be below HI, and N at least 2", option, text));
  return logarithmic(low, high, n);
}

/// Place on an appendage, with its text for column headers.
struct Place {
  std::string text;  ///< as typed
  double x = 0;      ///< distance from the rim of the hub
};

/// Parses places "x1,x2,..."; none for an empty text.
std::vector<Place> typed_places(const char* option, const std::string& text,
                                const spacecraft::Parameters& craft) {
  std::vector<Place> all;
  if (text.empty()) return all;
  for (const std::string& word : scene::typed_words(option, text)) {
    const double x = scene::typed_number(option, word);
    if (x < 0 || x > craft.length)
      throw InputError(fmt::format("{} {}: {} is not on the appendage; give a distance from 0 to {:.17g}",
                                   option, text, word, craft.length));
    all.push_back({word, x});
  }
  return all;
}

/// Declares --torque-on.
void declare_input(scene::Options& options, std::string& input) {
  options
      .add("--torque-on", input,
           "where the unit torque acts: hub, or tips for that torque on each of them; not with --gains")
      .one_of({"hub", "tips"});
}

/// Does the torque act on the tips? @throws InputError with gains
bool torque_on_tips(const std::string& input, const Craft& craft) {
  if (input == "tips" && !craft.gains.empty())
    throw InputError("--torque-on tips: the controller of --gains acts on the hub; leave one of them out");
  return input == "tips";
}

/// @throws InputError if the appendages swing freely, where @p what does not exist
void require_restored(const char* what, const spacecraft::Parameters& craft) {
  try {
    spacecraft::require_restored(craft, what);
  } catch (const std::invalid_argument& error) {
    throw InputError(error.what());
  }
}

/// Closed loop with the gains of --gains.
spacecraft::ClosedLoop typed_loop(const spacecraft::Parameters& craft, const std::vector<double>& gains) {
  const std::string typed = fmt::format("--gains {}", fmt::join(gains, ","));
  if (gains.size() != 3)
    throw InputError(fmt::format("{}: {} numbers; needs three, k1,k2,k3", typed, gains.size()));
  try {
    return {craft, {gains[0], gains[1], gains[2]}};
  } catch (const std::invalid_argument& error) {
    throw InputError(fmt::format("{}: {}", typed, error.what()));
  }
}

/// Times 0, DT, 2 DT, ... and T; without DT only 0 and T.
std::vector<double> typed_times(double until, const std::optional<double>& every) {
  std::vector<double> times = {0};
  if (every) {
    if (until / *every > 1e7) throw InputError(fmt::format("--every {}: more than 10 million rows", *every));
    // A last step shorter than a millionth of DT is due to rounding of T/DT and gets no row.
    for (int i = 1; i * *every < until - 1e-6 * *every; ++i) times.push_back(i * *every);
  }
  times.push_back(until);
  return times;
}

/// Options of `poles`, `zeros` and `response`.
struct FrequencyOptions {
  Craft craft;
  int count = 10;
  std::string at, omega, input = "hub";
};

void declare_poles(scene::Options& options, FrequencyOptions& typed) {
  declare_craft(options, typed.craft);
  options.add("--count", typed.count, "how many").range(1, 1000);
}

void declare_zeros(scene::Options& options, FrequencyOptions& typed) {
  declare_poles(options, typed);
  options.add("--at", typed.at, "place on the appendage, its distance from the rim");
}

void declare_response(scene::Options& options, FrequencyOptions& typed) {
  declare_craft(options, typed.craft);
  options.add("--omega", typed.omega, "w1,w2,... or LO:HI:N, N logarithmically spaced, rad/s").required();
  options.add("--at", typed.at, "places on the appendage x1,x2,..., their distances from the rim");
  declare_input(options, typed.input);
}

std::string table_of(const std::vector<Complex>& points, int count) {
  std::string text = "index,real,imag\n";
  for (std::size_t i = 0; i < std::min(std::size_t(count), points.size()); ++i)
    text += fmt::format("{},{:.17g},{:.17g}\n", i + 1, points[i].real() + 0., points[i].imag() + 0.);
  return text;
}

std::vector<Complex> on_axis(const spacecraft::Frequencies& f) {
  if (!f.status.ok()) throw Failure(f.status);
  std::vector<Complex> all;
  for (const double omega : f.omega) all.emplace_back(0, omega);
  return all;
}

std::string print_poles(const FrequencyOptions& typed) {
  const spacecraft::Parameters craft = read_spacecraft(typed.craft.file);
  if (typed.craft.gains.empty())
    return table_of(on_axis(spacecraft::poles(spacecraft::Plant(craft), typed.count)), typed.count);
  require_restored("--gains", craft);
  const spacecraft::LoopPoles found = typed_loop(craft, typed.craft.gains).poles(typed.count);
  if (!found.status.ok()) throw Failure(found.status);
  return table_of(found.s, typed.count);
}

/// The first zeros of y(x)/u with Im s >= 0, by modulus.
std::vector<Complex> deflection_zeros(const spacecraft::Plant& plant, double x, int count) {
  // The numbers of zeros and poles below a frequency are similar; the square is enlarged until it contains
  // enough zeros.
  const spacecraft::Frequencies guide = spacecraft::poles(plant, count);
  if (!guide.status.ok()) throw Failure(guide.status);
  double omega = 1.2 * guide.omega.back();
  std::vector<Complex> all;
  for (int k = 0; k < 12; ++k, omega *= 1.5) {
    const spacecraft::Zeros found = spacecraft::deflection_zeros(plant, x, omega);
    if (!found.status.ok()) throw Failure(found.status);
    all = found.s;  // with both zeros of a real pair
    // Above this modulus zeros may lie outside the square of z = s^2.
    const auto complete = std::count_if(all.begin(), all.end(),
                                        [omega](const Complex& s) { return std::abs(s) < 0.99 * omega; });
    if (complete >= count) break;
  }
  std::stable_sort(all.begin(), all.end(), [](const Complex& a, const Complex& b) {
    return std::abs(a) < std::abs(b) * (1 - 1e-14);
  });
  return all;
}

std::string print_zeros(const FrequencyOptions& typed) {
  const int count = typed.count;
  const spacecraft::Parameters craft = read_spacecraft(typed.craft.file);
  // Feedback from the hub does not move zeros, but invalid gains are still rejected.
  if (!typed.craft.gains.empty()) static_cast<void>(typed_loop(craft, typed.craft.gains));
  const spacecraft::Plant plant(craft);
  if (typed.at.empty()) return table_of(on_axis(spacecraft::hub_zeros(plant, count)), count);
  const std::vector<Place> places = typed_places("--at", typed.at, craft);
  if (places.size() != 1)
    throw InputError(fmt::format("--at {}: several places; give one, whose zeros are found", typed.at));
  if (places[0].x == 0)
    throw InputError(fmt::format(
        "--at {}: the deflection at the root is 0 for every s; give a distance above 0", typed.at));
  if (places[0].x == craft.length && craft.tip_stays())
    throw InputError(fmt::format("--at {}: the deflection of a held tip is 0 for every s", typed.at));
  const std::vector<Complex> found = deflection_zeros(plant, places[0].x, count);
  if (found.size() < std::size_t(count))
    throw Failure(
        Status::failure(Outcome::not_converged,
                        fmt::format("zeros: {} of {} found; give a smaller --count", found.size(), count)));
  return table_of(found, count);
}

std::string print_response(const FrequencyOptions& typed) {
  const spacecraft::Parameters craft = read_spacecraft(typed.craft.file);
  const std::vector<double> omega = typed_frequencies("--omega", typed.omega);
  const std::vector<Place> places = typed_places("--at", typed.at, craft);
  const spacecraft::Plant plant(craft);
  std::optional<spacecraft::ClosedLoop> loop;
  if (!typed.craft.gains.empty()) loop.emplace(typed_loop(craft, typed.craft.gains));
  const bool on_tips = torque_on_tips(typed.input, typed.craft);
  std::vector<double> x;
  std::string text = "omega,theta_re,theta_im";
  for (const Place& p : places) {
    text += fmt::format(",y@{0}_re,y@{0}_im", p.text);
    x.push_back(p.x);
  }
  text += '\n';
  std::vector<Complex> y(x.size());
  for (const double w : omega) {
    const Complex s(0, w);
    Complex theta;
    Outcome outcome = Outcome::success;
    if (loop) {
      const spacecraft::LoopResponse r = loop->response(s);
      theta = r.theta;
      outcome = r.outcome;
      for (std::size_t i = 0; i < x.size(); ++i) y[i] = loop->response(s, x[i]).deflection;
    } else {
      outcome = on_tips ? plant.tip_torque_response(s, x, theta, y) : plant.response(s, x, theta, y);
    }
    if (outcome != Outcome::success) throw Failure(plant.status(outcome, s));
    text += fmt::format("{:.17g},{:.17g},{:.17g}", w, theta.real() + 0., theta.imag() + 0.);
    for (const Complex& value : y)
      text += fmt::format(",{:.17g},{:.17g}", value.real() + 0., value.imag() + 0.);
    text += '\n';
  }
  return text;
}

/// Options of `step`.
struct StepOptions {
  Craft craft;
  std::string at, input = "hub";
  std::optional<double> angle, every;
  double until = 0;
};

void declare_step(scene::Options& options, StepOptions& typed) {
  declare_craft(options, typed.craft);
  options.add("--final-angle", typed.angle, "theta_f, rad (default 1)");
  options.add("--until", typed.until, "last time").positive().required();
  options.add("--every", typed.every, "time between rows (default: only the first and the last row)")
      .positive();
  options.add("--at", typed.at, "places on the appendage x1,x2,..., their distances from the rim");
  declare_input(options, typed.input);
}

spacecraft::TimeResponse respond(const StepOptions& typed, const spacecraft::Parameters& craft,
                                 const std::vector<double>& places) {
  const bool on_tips = torque_on_tips(typed.input, typed.craft);
  require_restored("step", craft);
  if (!typed.craft.gains.empty())
    return step_response(typed_loop(craft, typed.craft.gains), typed.angle.value_or(1), places);
  if (typed.angle) throw InputError(fmt::format("--final-angle {}: needs --gains k1,k2,k3", *typed.angle));
  return torque_response(spacecraft::Plant(craft), 1, places, {},
                         on_tips ? spacecraft::Input::tips : spacecraft::Input::hub);
}

std::string print_step(const StepOptions& typed) {
  const spacecraft::Parameters craft = read_spacecraft(typed.craft.file);
  const std::vector<double> times = typed_times(typed.until, typed.every);
  const std::vector<Place> places = typed_places("--at", typed.at, craft);
  std::vector<double> x;
  std::string text = "t,theta,theta_dot";
  for (const Place& p : places) {
    text += fmt::format(",y@{0},ydot@{0}", p.text);
    x.push_back(p.x);
  }
  text += '\n';
  const spacecraft::TimeResponse r = respond(typed, craft, x);
  if (!r.status.ok()) throw Failure(r.status);
  for (const double t : times) {
    if (const Status certain = certain_at(r, t); !certain.ok()) throw Failure(certain);
    text += fmt::format("{:.17g},{:.17g},{:.17g}", t, r.theta.value(t), r.theta_dot.value(t));
    for (std::size_t i = 0; i < x.size(); ++i)
      text += fmt::format(",{:.17g},{:.17g}", r.deflection[i].value(t), r.deflection_dot[i].value(t));
    text += '\n';
  }
  return text;
}

/// Options of `optimal-gains`.
struct OptimalOptions {
  Craft craft;
  spacecraft::CostWeights weights;
  bool pd = false;
};

void declare_optimal(scene::Options& options, OptimalOptions& typed) {
  declare_craft(options, typed.craft, false);
  options.add("--deflection-weight", typed.weights.deflection, "W, 1/length^2; 0 or more").required();
  options.add("--torque-weight", typed.weights.torque, "R, 1/torque^2").positive().required();
  options.add("--pd", typed.pd, "with k2 = 0: no feedback of the root load");
}

std::string print_optimal(const OptimalOptions& typed) {
  const spacecraft::Parameters craft = read_spacecraft(typed.craft.file);
  const spacecraft::CostWeights& w = typed.weights;
  if (w.deflection < 0)
    throw InputError(fmt::format("--deflection-weight {}: must not be negative", w.deflection));
  try {
    const spacecraft::OptimalGains best = typed.pd ? optimal_pd_gains(craft, w) : optimal_gains(craft, w);
    return fmt::format("k1,k2,k3,cost\n{:.17g},{:.17g},{:.17g},{:.17g}\n", best.gains.k1, best.gains.k2,
                       best.gains.k3, best.cost);
  } catch (const std::invalid_argument& error) {
    throw InputError(
        fmt::format("--deflection-weight {} --torque-weight {}: {}", w.deflection, w.torque, error.what()));
  }
}

}  // namespace

void commands(scene::Commands& all) {
  all.add("poles",
          "Print the poles of theta/u, or with --gains of the closed loop, as CSV: index,real,imag (1/s); "
          "imaginary part 0 or more, in order of modulus, without the double pole at 0",
          declare_poles, print_poles);
  all.add("zeros",
          "Print the zeros of theta/u, or with --at of y/u at that place, as CSV: index,real,imag (1/s); "
          "imaginary part 0 or more, in order of modulus; gains do not change them",
          declare_zeros, print_zeros);
  all.add("response",
          "Print theta/u and y/u at s = j omega, or with --gains theta/theta_f and y/theta_f, as CSV: "
          "omega,theta_re,theta_im,y@X_re,y@X_im,...",
          declare_response, print_response);
  all.add("step",
          "Print the motion from rest under a unit torque, or with --gains to a target angle, computed by "
          "residues, as CSV: "
          "t,theta,theta_dot,y@X,ydot@X; in the spacecraft's units, s, rad and ft for Table 3.1",
          declare_step, print_step);
  all.add("optimal-gains",
          "Print the gains that minimise int (theta - theta_f)^2 + W y(L)^2 + R u^2 dt for a rotation by 1 "
          "rad, as CSV: "
          "k1,k2,k3,cost",
          declare_optimal, print_optimal);
}

}  // namespace nlmech::chapters::gss_control
