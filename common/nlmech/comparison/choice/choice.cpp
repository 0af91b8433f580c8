#include "nlmech/comparison/choice/choice.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "nlmech/comparison/any_method.hpp"
#include "nlmech/comparison/choice/growth.hpp"
#include "nlmech/problems/duffing.hpp"
#include "nlmech/support/stopwatch.hpp"

namespace nlmech::comparison {
namespace {

constexpr std::size_t most_rivals = 5;
constexpr double hopeless = 0.9;  // log10 of the factor behind the first, from which a method does not run
constexpr double tie = 1.1;       // a peer that leads by less is no faster
constexpr double budget = 2e5;    // of a run, in units of Measured: two milliseconds or so
constexpr double enough = 0.005;  // s, after which a run is not repeated for its time

/// A run of a method on a part of the way.
struct Part {
  bool refused = false;
  Status status;
  double seen = 0, cost = 0, seconds = 0;
};

Part run_part(const Question& q, const Expectation& e, double end, double most_cost) {
  Part part;
  try {
    const auto run = any_integrator(
        any_method(e.method), {.tolerance = e.tolerance, .absolute_tolerance = e.tolerance * q.absolute});
    const ivp::Solution s = run(q.system, q.x0, q.t0, end, {}, e.limits(most_cost, q.largest_step));
    part.seen = (s.t - q.t0) / (q.t1 - q.t0);
    part.cost = e.cost * static_cast<double>(std::max<std::int64_t>(s.statistics.right_hand_sides, 1));
    part.seconds = s.statistics.seconds;
    const Outcome outcome = s.status.outcome();
    if (outcome != Outcome::step_limit && outcome != Outcome::time_limit) part.status = s.status;
  } catch (const std::invalid_argument&) {
    part.refused = true;
  }
  return part;
}

/// What is expected of both: the runs, and what problems alike say, which knows whether digits are delivered,
/// two to one. Where a fast motion has died out, or not begun, a part of the way says little of the rest, and
/// problems alike count the more, the shorter the part.
void weigh(const Features& features, std::vector<Ranked>& ranked) {
  constexpr double of_runs = 2. / 3, stiff = 1;
  const Ranked first = ranked.front();
  const double weight =
      of_runs * (features.stiffness < stiff ? 1 : std::pow(std::min(first.seen, 1.0), 0.25));
  for (Ranked& r : ranked)
    r.cost =
        first.cost * std::pow(r.cost / first.cost, weight) * std::pow(r.behind / first.behind, 1 - weight);
}

/// Seconds of a right-hand side.
double right_hand_side_seconds(const Question& q) {
  ivp::State x = q.x0, f(q.x0.size());
  const auto calls = [&](int count) {
    const Stopwatch watch;
    for (int i = 0; i < count; ++i) q.system.rhs(q.t0, x, f);
    return watch.seconds() / count;
  };
  const double one = calls(1);
  return one > 1e-4 ? one : std::min(calls(200), calls(200));
}

}  // namespace

std::vector<Ranked> rank_methods(const Question& q, const Features& features, const Evidence& evidence,
                                 Status& status) {
  std::vector<Ranked> ranked;
  double end = q.t1, best = budget, first = 0;
  std::size_t rivals = 0;
  for (const Expectation& e : expectations(evidence, features, q.level)) {
    if (!q.among.has(e.method)) continue;
    const double place = e.behind + e.short_of;
    if (rivals == most_rivals || (rivals > 0 && place > first + hopeless)) break;
    const double most = rivals == 0 ? best : 2 * best;
    Part part = run_part(q, e, end, most);
    if (part.refused) continue;
    for (int again = 0; q.timed && again < 2 && part.seconds < enough; ++again)
      part.seconds = std::min(part.seconds, run_part(q, e, end, most).seconds);
    if (!part.status.ok() || !(part.seen > 0)) {
      if (status.ok()) status = part.status;
      continue;
    }
    if (rivals++ == 0) {
      // The others run as far as the first came.
      first = place;
      end = part.seen < 1 ? q.t0 + part.seen * (q.t1 - q.t0) : q.t1;
      best = part.cost;
    }
    best = std::min(best, part.cost * std::abs((end - q.t0) / (q.t1 - q.t0)) / part.seen);
    const double cost = part.cost / part.seen * std::pow(10, e.short_of);
    ranked.push_back(
        {e.method, e.tolerance, cost, part.seen, part.seconds, std::pow(10, e.behind), e.short_of});
  }
  if (ranked.empty()) return ranked;
  status = {};
  weigh(features, ranked);
  std::ranges::stable_sort(ranked, {},
                           [](const Ranked& r) { return r.cost * (any_method(r.method).peer ? tie : 1); });
  return ranked;
}

Chosen looked_at(const Question& q, const Evidence& evidence) {
  Chosen c;
  c.look = look_at_problem(q.system, q.x0, q.t0, q.t1, q.largest_step);
  c.status = c.look.status;
  if (!c.status.ok()) return c;
  c.alike = most_alike(evidence, c.look.features, 3);
  c.right_hand_side = right_hand_side_seconds(q);
  for (const Expectation& e : expectations(evidence, c.look.features, q.level)) {
    if (!q.among.has(e.method)) continue;
    const Growth growth = growth_along(q, e);
    if (!(growth.seen > 0)) continue;
    // Of a part of the way: errors grow at least as the way does.
    c.condition = growth.factor / growth.seen;
    c.condition_seen = growth.seen;
    c.condition_is_bound = growth.at_least;
    break;
  }
  constexpr double roundings = 16 * std::numeric_limits<double>::epsilon();  // of some hundred steps
  c.possible = -std::log10(roundings * c.condition);
  return c;
}

Chosen choose(Question q, double digits, const Evidence& evidence, Chosen c) {
  c.digits = digits;
  if (!c.status.ok()) return c;
  q.level = std::min(digits, c.possible) + std::log10(c.condition);
  q.timed = true;
  c.ranked = rank_methods(q, c.look.features, evidence, c.status);
  return c;
}

bool Among::has(const std::string& method) const {
  return methods.empty() || std::ranges::find(methods, method) != methods.end();
}

double unit_seconds() {
  constexpr int calls = 2000;
  const ivp::System system{problems::Duffing{}};
  ivp::State x = problems::Duffing::initial_state(), f;
  const Timing time = time_repeats(
      [&] {
        for (int i = 0; i < calls; ++i) {
          system.rhs(0, x, f);
          x += 1e-12 * f;
        }
      },
      9);
  return time.smallest / calls;
}

}  // namespace nlmech::comparison
