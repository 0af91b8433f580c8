#include "nlmech/comparison/choice/choice.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "nlmech/comparison/any_method.hpp"
#include "nlmech/support/stopwatch.hpp"

namespace nlmech::comparison {
namespace {

constexpr double loosest = 1e-3, tightest = 1e-13;  // tolerances
constexpr Rule rules[] = {{"stiff",
                           "stability would bound the steps of an explicit method",
                           [](const Features& f, double) { return f.stiffness > stiff_from; },
                           {"adaptive-collocation", "odeint-rosenbrock4", "cvode-bdf"}},
                          {"accelerations without velocities",
                           "a Nystroem method of order 12 costs the least for its order",
                           [](const Features& f, double) { return f.velocity_free && !f.switches; },
                           {"rkn1210", "dop853", "series", "adaptive-collocation"}},
                          {"few operations or many digits",
                           "Taylor series of high order take the longest steps",
                           [](const Features& f, double digits) {
                             return f.operations > 0 &&
                                    (f.operations <= most_operations || digits >= many_digits);
                           },
                           {"series", "dop853", "adaptive-collocation"}},
                          {"many operations",
                           "a Runge-Kutta method of order 8 costs the least a step",
                           [](const Features&, double) { return true; },
                           {"dop853", "series", "adaptive-collocation"}}};

/// Those methods of the rule that this build has and the request allows.
std::vector<std::string> candidates(const ChoiceRequest& q, const Features& f, double digits) {
  const auto has = [](const auto& names, const auto& name) {
    return std::ranges::find(names, name) != names.end();
  };
  const std::vector<std::string> built = built_method_names();
  std::vector<std::string> all;
  for (const std::string_view name : choice_rule(f, digits).methods) {
    const bool recorded = name != "series" || f.operations > 0;
    if (recorded && has(built, name) && (q.methods.empty() || has(q.methods, name))) all.emplace_back(name);
  }
  return all;
}

/// A short run from t0, which may be repeated for its time. Its covered share is 0 if the method fails or is
/// not for the problem. @param status gets the first failure
Ranked short_run(const ChoiceRequest& q, const std::string& method, double tolerance, int repeats,
                 Status& status) {
  constexpr std::int64_t steps = 4000;  // of one component
  constexpr double enough = 0.005;      // s
  Ranked r{method, tolerance};
  try {
    const auto run =
        any_method(method).with({.tolerance = tolerance, .absolute_tolerance = tolerance * q.absolute});
    for (int i = 0; i < repeats && (i == 0 || r.seconds < enough); ++i) {
      const ivp::Solution s = run(q.system, q.x0, q.t0, q.t1, {}, q.limits(steps));
      const Outcome outcome = s.status.outcome();
      if (!s.status.ok() && outcome != Outcome::step_limit && outcome != Outcome::time_limit) {
        if (status.ok()) status = s.status;
        return {method, tolerance};
      }
      r.covered = (s.t - q.t0) / (q.t1 - q.t0);
      r.seconds = i == 0 ? s.statistics.seconds : std::min(r.seconds, s.statistics.seconds);
      r.right_hand_sides = static_cast<double>(s.statistics.right_hand_sides);
    }
  } catch (const std::invalid_argument&) {
    return {method, tolerance};
  }
  r.seconds /= r.covered;
  r.right_hand_sides /= r.covered;
  return r;
}

/// Seconds of a right-hand side.
double right_hand_side_seconds(const ChoiceRequest& q) {
  ivp::State f(q.x0.size());
  const auto calls = [&](int count) {
    const Stopwatch watch;
    for (int i = 0; i < count; ++i) q.system.rhs(q.t0, q.x0, f);
    return watch.seconds() / count;
  };
  const double one = calls(1);
  return one > 1e-4 ? one : std::min(calls(200), calls(200));
}

}  // namespace

std::span<const Rule> choice_rules() { return rules; }

const Rule& choice_rule(const Features& features, double digits) {
  return *std::ranges::find_if(rules, [&](const Rule& rule) { return rule.holds(features, digits); });
}

std::string method_for(const ChoiceRequest& q, double tolerance) {
  const Probe probe = probe_problem(q);
  if (!probe.status.ok()) return "";
  Status status;
  for (const std::string& method : candidates(q, probe.features, -std::log10(tolerance))) {
    if (short_run(q, method, std::clamp(tolerance, tightest, loosest), 1, status).covered > 0) return method;
  }
  return "";
}

Chosen examine(const ChoiceRequest& q) {
  const Probe probe = probe_problem(q);
  Chosen c{.status = probe.status, .features = probe.features, .growth = {}};
  if (!c.status.ok()) return c;
  c.right_hand_side = right_hand_side_seconds(q);
  for (const std::string& method : candidates(q, c.features, c.digits)) {
    c.growth = growth_along(q, method);
    if (!(c.growth.covered > 0)) continue;
    c.condition = c.growth.factor / c.growth.covered;  // errors grow at least in proportion to the time
    break;
  }
  constexpr double roundings = 16 * std::numeric_limits<double>::epsilon();  // of some hundred steps
  c.possible = -std::log10(roundings * c.condition);
  return c;
}

Chosen choose(const ChoiceRequest& q, double digits, Chosen c) {
  c.digits = digits;
  if (!c.status.ok()) return c;
  constexpr double safety = 1. / 3;  // an error of one tolerance at any time, and those of the other steps
  const double tolerance = safety * std::pow(10, -std::min(digits, c.possible)) / c.condition;
  // More digits than the problem allows are no fault of a tolerance.
  c.missing = digits > c.possible ? 0 : std::max(0.0, std::log10(tightest / tolerance));
  Status status;
  for (const std::string& method : candidates(q, c.features, digits)) {
    const Ranked r = short_run(q, method, std::clamp(tolerance, tightest, loosest), 3, status);
    if (r.covered > 0) c.ranked.push_back(r);
  }
  if (c.ranked.empty()) c.status = status;
  return c;
}

}  // namespace nlmech::comparison
