#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <ranges>
#include <string>
#include <vector>

#include "chapters/rbf_inverse/commands/commands.hpp"
#include "nlmech/bvp/continuation.hpp"
#include "nlmech/bvp/optimal_control/duffing.hpp"
#include "nlmech/scene/program/csv.hpp"
#include "nlmech/scene/program/typed.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::chapters::rbf_inverse {
namespace {

/// What was typed.
struct Words {
  std::string which, final_time, beta = "0.9", target, weights, bound;
};

Eigen::Vector2d pair(const char* option, const std::string& text) {
  const std::size_t comma = text.find(',');
  double first = 0, second = 0;
  if (comma == std::string::npos || !scene::parse_number(text.substr(0, comma), first) ||
      !scene::parse_number(text.substr(comma + 1), second))
    throw InputError(fmt::format("{} {}: two finite numbers with a comma between are needed", option, text));
  return {first, second};
}

bvp::DuffingCase case_of(const std::string& name) {
  std::string names;
  for (const bvp::DuffingCase which : bvp::duffing_cases()) {
    if (to_string(which) == name) return which;
    names += fmt::format("{}{}", names.empty() ? "" : " ", to_string(which));
  }
  throw InputError(fmt::format("--case {}: there are {}", name, names));
}

struct Request {
  bvp::DuffingSettings settings;
  std::optional<double> bound;  ///< of |f|
};

Request understand(const Words& words) {
  Request r;
  r.settings.which = case_of(words.which);
  r.settings.final_time = scene::typed_number("--final-time", words.final_time);
  if (!(r.settings.final_time >= 1e-6 && r.settings.final_time <= 1000))
    throw InputError(fmt::format("--final-time {}: must be from 1e-6 to 1000", words.final_time));
  r.settings.beta = scene::typed_number("--beta", words.beta);
  if (!(r.settings.beta >= 0 && r.settings.beta <= 1e6))
    throw InputError(fmt::format("--beta {}: must be from 0 to 1e6", words.beta));
  if (!words.target.empty()) {
    if (r.settings.which == bvp::DuffingCase::harmonic)
      throw InputError(
          fmt::format("--target {}: --case harmonic has its own, by Eq. 5.34; leave it out", words.target));
    r.settings.target = pair("--target", words.target);
    if (r.settings.target.cwiseAbs().maxCoeff() > 1e4)
      throw InputError(fmt::format("--target {}: larger than 1e4", words.target));
  }
  if (!words.weights.empty()) {
    using enum bvp::DuffingCase;
    const bvp::DuffingCase c = r.settings.which;
    if (c == fixed || c == harmonic || c == final_only)
      throw InputError(
          fmt::format("--weights {}: --case {} prescribes both states at the end, so there is no miss to "
                      "weight; leave it out",
                      words.weights, words.which));
    r.settings.weights = pair("--weights", words.weights);
    if (r.settings.weights.minCoeff() < 0)
      throw InputError(fmt::format("--weights {}: must not be negative", words.weights));
  }
  if (!words.bound.empty()) {
    r.bound = scene::typed_positive("--bound", words.bound);
  }
  return r;
}

/// Two minutes, starts and the last solve included.
constexpr double seconds_of_solves = 60;

/// The extremals that the own starts lead to, one at least.
std::vector<bvp::Found> unbounded(const bvp::DuffingSettings& settings) {
  const bvp::Multistart all = bvp::duffing_extremals(settings, {}, {}, {.seconds = seconds_of_solves});
  if (all.found.empty())
    throw Failure(Status::failure(
        Outcome::not_converged,
        fmt::format("duffing: none of {} starts led to an extremal that an integrator confirms ({} spurious "
                    "roots); try another final time or a smaller beta",
                    all.good + all.spurious + all.failed, all.spurious)));
  return all.found;
}

/// A power of two in which the bound is 8 to 16: the smoothing of a bounded control is 1e-4, whatever the
/// unit.
double unit_of(double bound) { return std::ldexp(1.0, std::ilogb(bound) - 3); }

/// The same task with states and forces in such a unit; powers of two change no digit.
bvp::DuffingSettings in_units(bvp::DuffingSettings s, double unit) {
  s.begin /= unit;
  s.target /= unit;
  s.amplitudes /= unit;
  s.beta *= unit * unit;
  return s;
}

/// The cheapest under the bound, from the cheapest ones without.
bvp::Extremal bounded(const bvp::DuffingSettings& settings, double bound) {
  const bvp::ExtremalProblem problem = duffing_problem(settings);
  std::optional<bvp::Extremal> best;
  Status failure;
  for (const bvp::Found& found : unbounded(settings) | std::views::take(3)) {
    const bvp::Extremal& free = found.extremal;
    double peak = 0;
    constexpr int samples = 1000;
    for (int i = 0; i <= samples; ++i)
      peak = std::max(peak, std::abs(free.solution.at(settings.final_time * i / samples)[3]));
    // A bound that does not bind, with room for what is between the samples.
    bvp::Extremal e = peak < 0.99 * bound
                          ? free
                          : tighten(problem, start_from(free.solution), bvp::control_bound_path(peak, bound));
    if (!e.solution.status.ok()) {
      if (failure.ok()) failure = e.solution.status;
    } else if (!best || e.cost < best->cost) {
      best = std::move(e);
    }
  }
  if (!best) throw Failure(failure);
  return *best;
}

std::string duffing(const Words& words) {
  const Request r = understand(words);
  const double unit = r.bound ? unit_of(*r.bound) : 1;
  const bvp::Extremal e =
      r.bound ? bounded(in_units(r.settings, unit), *r.bound / unit) : unbounded(r.settings).front().extremal;
  const Eigen::VectorXd first = e.solution.first() * unit, last = e.solution.last() * unit;
  // What is prescribed or vanishes comes out with the rounding of the solve.
  const auto shown = [](double value) { return std::abs(value) < 1e-20 ? 0.0 : value; };
  return fmt::format(
      "cost,x1_0,x2_0,lambda1_0,lambda2_0,x1_T,x2_T,miss\n"
      "{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g}\n",
      shown(e.cost * unit * unit), shown(first[0]), shown(first[1]), shown(first[2]), shown(first[3]),
      shown(last[0]), shown(last[1]), e.miss * unit);
}

}  // namespace

void add_duffing_command(CLI::App& app) {
  const auto words = std::make_shared<Words>();  // lives as long as the callback
  CLI::App* const command = app.add_subcommand(
      "duffing",
      "The cheapest force found that brings a Duffing oscillator to its end, as CSV: "
      "cost,x1_0,x2_0,lambda1_0,lambda2_0,x1_T,x2_T,miss; omega_n = 1, start 0,0 where prescribed");
  command
      ->add_option("--case", words->which,
                   "free, fixed, x1x1, x1x2, x2x1, x2x2 (what is prescribed at both ends), final-only, or "
                   "harmonic (amplitudes 1.5, 2, 3 at 3 rad/s)")
      ->required();
  command->add_option("--final-time", words->final_time, "T, seconds")->required();
  command->add_option("--beta", words->beta, "nonlinearity")->capture_default_str();
  command->add_option("--target", words->target, "x1,x2 at T; 5,2 without it");
  command->add_option("--weights", words->weights,
                      "s11,s22 of the miss that is not prescribed; 1,1 without it");
  command->add_option("--bound", words->bound, "largest |f|; none without it");
  command->callback([words] { scene::print_result(duffing(*words)); });
}

}  // namespace nlmech::chapters::rbf_inverse
