#include "nlmech/comparison/choice/choice.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <stdexcept>

#include "nlmech/comparison/any_method.hpp"
#include "nlmech/comparison/reference/verification.hpp"
#include "nlmech/support/errors.hpp"
#include "nlmech/support/sentences.hpp"
#include "nlmech/support/stopwatch.hpp"

namespace nlmech::comparison {
namespace {

// Coarse tolerances, for steps limited by the solution alone; the second pair is for problems where coarse
// steps converge to wrong roots.
constexpr ivp::Settings coarse[] = {{.tolerance = 1e-3, .absolute_tolerance = 1e-6},
                                    {.tolerance = 1e-6, .absolute_tolerance = 1e-12}};

/// Spectral radius of a matrix; 0 if an entry is not finite.
double spectral_radius(const Eigen::MatrixXd& j) {
  constexpr int most_components = 32;  // eigenvalues cost O(n^3)
  if (!j.allFinite()) return 0;
  if (j.rows() <= most_components) return j.eigenvalues().cwiseAbs().maxCoeff();
  // Power iteration; the mean over several powers covers a complex pair.
  constexpr int powers = 32, counted = 16;
  Eigen::VectorXd v = Eigen::VectorXd::LinSpaced(j.rows(), 1, 2);
  double growth = 0;
  for (int k = 0; k < powers; ++k) {
    v = (j * v.normalized()).eval();
    if (!(v.norm() > 0)) return 0;
    if (k >= powers - counted) growth += std::log(v.norm());
  }
  return std::exp(growth / counted);
}

/// The recorded equations, for switching ones those of one mode; nothing if they cannot be recorded.
std::optional<Tape> tape_of(const ivp::System& system, double t) {
  const auto modes = static_cast<std::size_t>(system.switches());
  try {
    return (modes > 0 ? system.in_mode(ivp::Mode(modes, 1)) : system).record(t);
  } catch (const std::invalid_argument&) {
    return {};
  }
}

/// Takes coarse steps. @param stiffness receives Features::stiffness
Status coarse_steps(const ChoiceRequest& q, const ivp::Settings& settings, double& stiffness) {
  const Eigen::Index n = q.x0.size();
  ivp::Jacobian j(n, n);
  std::vector<double> units;  // |h| rho of the sampled steps
  int steps = 0;
  const ivp::Observer sample = [&](const ivp::Step& step) {
    constexpr int dense = 24;  // samples each of the first steps, then every second, third, ...
    ++steps;
    if (steps % (1 + steps / dense) != 0) return true;
    q.system.jacobian(step.t1, step.x1, j);
    units.push_back(spectral_radius(j) * std::abs(step.t1 - step.t0));
    return true;
  };
  const ivp::Limits limits{
      .steps = std::clamp<std::int64_t>(2000 / n, 60, 400), .seconds = 2, .largest_step = q.largest_step};
  const auto run = any_method("adaptive-collocation").with(settings);
  Status status = run(q.system, q.x0, q.t0, q.t1, sample, limits).status;
  // If the step limit ends the run, skip its first half: these steps still grow from a small initial one.
  const auto begin = units.begin() + (status.ok() ? 0 : static_cast<std::ptrdiff_t>(units.size() / 2));
  if (begin != units.end())
    stiffness = std::accumulate(begin, units.end(), 0.0) / static_cast<double>(units.end() - begin);
  return status;
}

/// Are the equations q'' = a(t, q)? Decided by the recorded equations, else by the Jacobian at two states.
bool has_velocity_free_accelerations(const ivp::System& system, double t, const ivp::State& x) {
  if (!system.second_order()) return false;
  const int half = system.size() / 2;
  if (const std::optional<Tape> tape = tape_of(system, t)) return !tape->depends(half, half);
  ivp::Jacobian j(system.size(), system.size());
  for (const double shift : {0.0, 0.1}) {  // the entries may vanish at rest or at a point of symmetry
    system.jacobian(t, (x.array() + shift).matrix(), j);
    if (!j.bottomRightCorner(half, half).isZero(0)) return false;
  }
  return true;
}

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

/// Methods of the rule that this build has and the request allows.
std::vector<std::string> candidates(const ChoiceRequest& q, const Features& f, double digits) {
  std::vector<std::string> all;
  for (const std::string_view name : choice_rule(f, digits).methods) {
    const bool allowed = q.methods.empty() || std::ranges::find(q.methods, name) != q.methods.end();
    const bool recorded = name != "series" || f.operations > 0;
    if (!name.empty() && allowed && recorded && any_method(name).is_available()) all.emplace_back(name);
  }
  return all;
}

/// A short run from t0, repeated at most @p repeats times to measure its time. The covered share is 0 if the
/// method fails or does not apply to the problem. @param status receives the first failure
Ranked short_run(const ChoiceRequest& q, const std::string& method, double tolerance, int repeats,
                 Status& status) {
  constexpr std::int64_t steps = 4000;  // for one component
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

/// Error growth from six times to the last of them, by amplification() along a run of @p method; unknown with
/// more than 64 components.
ErrorGrowth growth_along(const ChoiceRequest& q, const std::string& method) {
  constexpr Eigen::Index most_components = 64;  // each costs two runs an interval
  constexpr int intervals = 6;
  constexpr double most_seconds = 10;  // for all runs; matters if right-hand sides are expensive
  constexpr double tolerance = 1e-11;  // far below the perturbations of amplification()
  if (q.x0.size() > most_components) return {};
  const ivp::Limits limits = q.limits(40'000);
  const auto run = any_method(method).with(
      {.tolerance = tolerance, .absolute_tolerance = tolerance * std::min(q.absolute, 1.0)});
  ReferenceRequest request{q.x0.cast<long double>(), q.t0, {}};
  Reference along;
  along.size = q.x0.cwiseAbs();
  const auto add = [&](double t, const ivp::State& x) {
    request.times.push_back(t);
    along.states.conservativeResize(x.size(), along.states.cols() + 1);
    along.states.rightCols(1) = x.cast<long double>();
  };
  const ivp::Observer observe = [&](const ivp::Step& step) {
    along.size = along.size.cwiseMax(step.x1.cwiseAbs());
    const double part = (step.t1 - q.t0) / (q.t1 - q.t0) * intervals;
    if (part >= static_cast<double>(request.times.size() + 1) && step.t1 != q.t1) add(step.t1, step.x1);
    return true;
  };
  const ivp::Solution end = run(q.system, q.x0, q.t0, q.t1, observe, limits);
  if (request.times.empty() || end.t != request.times.back()) add(end.t, end.x);
  if (end.t == q.t0 || !end.x.allFinite()) return {};
  along.first.compute = [&](const ReferenceRequest& part, double seconds, StatesAt& states) {
    ivp::Limits these = limits;
    these.seconds = seconds;
    ivp::Solution s = run(q.system, part.x0.cast<double>(), part.t0, part.times.back(), {}, these);
    states = s.x.cast<long double>();
    if (s.status.outcome() != Outcome::outside_validity) return s.status;
    // If only the perturbed run of switching equations fails, the unperturbed state replaces its result: no
    // growth.
    states = along.states.col(std::ranges::find(request.times, part.times.back()) - request.times.begin());
    return Status();
  };
  const double absolute = q.absolute * std::min(1.0, along.size.maxCoeff());
  const Eigen::MatrixXd weight = (along.states.cast<double>().array().abs() + absolute).matrix();
  Eigen::MatrixXd moved;
  const Eigen::VectorXd first = (q.x0.array().abs() + absolute).matrix();
  if (!amplification(request, along, first, weight, most_seconds, moved).ok()) return {};
  const auto size = along.size.array().max(absolute / 10);
  return {std::max(1.0, (moved.rightCols(1).array() / size).maxCoeff()),
          std::abs((end.t - q.t0) / (q.t1 - q.t0))};
}

/// Seconds of one right-hand side.
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

/// "9 digits where errors grow 4.8 times"
std::string accuracy(const MethodChoice& c) {
  if (!(c.growth.covered > 0)) return fmt::format("{:.3g} digits", c.digits);
  return fmt::format("{:.3g} digits, errors amplified {:.2g} times", c.digits, c.condition);
}

/// "not stiff (...); smooth, operations: 5": the features that the rules use.
std::string features_text(const Features& f) {
  const std::string operations =
      f.operations > 0 ? fmt::format("operations: {}", f.operations) : "not recorded as series";
  return fmt::format("{} (spectral radius times accurate step: {:.2g}); {}, {}",
                     f.stiffness > stiff_from ? "stiff" : "not stiff", f.stiffness,
                     f.switches ? "switches" : "smooth", operations);
}

/// "280 right-hand sides; ran 12 % of the time"
std::string short_run_text(const Ranked& r, const MethodChoice& c) {
  const double percent = 100 * r.covered;
  std::string text = fmt::format("about {:.2g} right-hand sides; test run over ", r.right_hand_sides);
  text += percent > 99.9 ? "the whole interval"
                         : fmt::format("{:.{}g} % of the interval", percent, percent < 10 ? 1 : 2);
  if (c.missing > 0.05) text += fmt::format("; its tightest tolerance lacks {:.1g} digits", c.missing);
  return text;
}

}  // namespace

bool depends_on_time(const ivp::System& system, double t, const ivp::State& x) {
  if (const std::optional<Tape> tape = tape_of(system, t)) return tape->depends_on_time();
  ivp::State dfdt(x.size());
  return !system.time_derivative(t, x, dfdt) || !dfdt.isZero(0);
}

ivp::Limits ChoiceRequest::limits(std::int64_t steps) const {
  return {.steps = std::max<std::int64_t>(50, steps / x0.size()), .seconds = 2, .largest_step = largest_step};
}

Probe probe_problem(const ChoiceRequest& q) {
  Probe probe;
  Features& f = probe.features;
  f.velocity_free = has_velocity_free_accelerations(q.system, q.t0, q.x0);
  f.switches = q.system.switches() > 0;
  const std::optional<Tape> tape = tape_of(q.system, q.t0);
  f.operations = tape ? std::max(1, tape->instructions()) : 0;
  for (const ivp::Settings& settings : coarse) {
    probe.status = coarse_steps(q, settings, f.stiffness);
    const Outcome outcome = probe.status.outcome();
    if (outcome == Outcome::step_limit || outcome == Outcome::time_limit) probe.status = {};
    if (probe.status.ok()) break;
  }
  return probe;
}

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

MethodChoice examine(const ChoiceRequest& q) {
  const Probe probe = probe_problem(q);
  MethodChoice c{.status = probe.status, .features = probe.features, .growth = {}};
  if (!c.status.ok()) return c;
  c.right_hand_side = right_hand_side_seconds(q);
  for (const std::string& method : candidates(q, c.features, c.digits)) {
    c.growth = growth_along(q, method);
    if (!(c.growth.covered > 0)) continue;
    c.condition = c.growth.factor / c.growth.covered;  // errors grow at least in proportion to the time
    break;
  }
  constexpr double roundings =
      16 * std::numeric_limits<double>::epsilon();  // accumulated by a few hundred steps
  c.possible = -std::log10(roundings * c.condition);
  return c;
}

MethodChoice choose(const ChoiceRequest& q, double digits, MethodChoice c) {
  c.digits = digits;
  if (!c.status.ok()) return c;
  constexpr double safety = 1. / 3;  // the condition is that of a single error; steps add theirs
  const double tolerance = safety * std::pow(10, -std::min(digits, c.possible)) / c.condition;
  // Digits beyond those possible are missing because of rounding, not because of the tolerance.
  c.missing = digits > c.possible ? 0 : std::max(0.0, std::log10(tightest / tolerance));
  Status status;
  for (const std::string& method : candidates(q, c.features, digits)) {
    const Ranked r = short_run(q, method, std::clamp(tolerance, tightest, loosest), 3, status);
    if (r.covered > 0) c.ranked.push_back(r);
  }
  if (c.ranked.empty()) c.status = status;
  return c;
}

std::string choice_rows(const MethodChoice& c) {
  if (!c.status.ok()) throw Failure(c.status);
  if (c.ranked.empty())
    throw Failure(failed_with(Outcome::outside_validity, "no method of this build suits the problem"));
  const Rule& rule = choice_rule(c.features, c.digits);
  std::string why = fmt::format("{}; {}; {}: {}; a right-hand side takes {:.2g} s", accuracy(c),
                                features_text(c.features), rule.name, rule.reason, c.right_hand_side);
  if (c.ranked.front().method != rule.methods.front())
    why += fmt::format("; {} fails or is absent from this build", rule.methods.front());
  std::string text = "rank,method,tolerance,seconds,reason\n";
  for (std::size_t i = 0; i < c.ranked.size(); ++i) {
    const Ranked& r = c.ranked[i];
    text += fmt::format("{},{},{:.1e},{:.3g},{}\n", i + 1, r.method, r.tolerance, r.seconds,
                        quoted_cell(fmt::format("{}; {}", why, short_run_text(r, c))));
    why = "next by the same rule";
  }
  return text;
}

std::string choice_remark(const MethodChoice& c) {
  if (c.digits <= c.possible) return "";
  return fmt::format(
      "the problem multiplies errors by {:.2g}, so that rounding alone leaves about {:.2g} of the {:.3g} "
      "digits",
      c.condition, std::max(0.0, c.possible), c.digits);
}

std::string shell_line(const std::vector<std::string>& words) {
  constexpr const char* plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_=+.,:/@%";
  std::string line;
  for (const std::string& word : words) {
    if (!line.empty()) line += ' ';
    if (!word.empty() && word.find_first_not_of(plain) == std::string::npos) {
      line += word;
    } else if (word.find_first_of("\"$`\\!") == std::string::npos) {
      line += '"' + word + '"';
    } else {
      line += '\'';
      for (const char c : word) line += c == '\'' ? "'\\''" : std::string(1, c);
      line += '\'';
    }
  }
  return line;
}

std::string quoted_cell(std::string_view text) {
  std::string cell = "\"";
  for (const char c : text) cell += c == '"' ? "\"\"" : std::string(1, c);
  return cell + '"';
}

}  // namespace nlmech::comparison
