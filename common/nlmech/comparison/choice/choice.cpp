#include "nlmech/comparison/choice/choice.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "nlmech/comparison/any_method.hpp"
#include "nlmech/comparison/choice/expectation.hpp"
#include "nlmech/problems/duffing.hpp"
#include "nlmech/support/stopwatch.hpp"

namespace nlmech::comparison {
namespace {

constexpr std::size_t most_rivals = 5;
constexpr double hopeless = 0.9;  // log10 of the factor behind the first, from which a method does not run
constexpr double tie = 1.1;       // a peer that leads by less is no faster
constexpr double budget = 1e5;    // of a run, in units of Measured: a millisecond or so
constexpr double seconds = 0.25;  // of a run, where right-hand sides are expensive

/// A run of a method on a part of the way.
struct Part {
  bool refused = false;
  Status status;
  double seen = 0, cost = 0, seconds = 0;
};

template <int m>
Part run_part(const Question<m>& q, const Expectation& e, double end, double most_cost) {
  Part part;
  const double steps = most_cost / (e.cost * e.right_hand_sides);
  const ivp::Limits limits{.steps = static_cast<std::int64_t>(std::clamp(steps, 8.0, 1e8)),
                           .seconds = seconds};
  try {
    const auto run = any_integrator<m>(
        any_method(e.method), {.tolerance = e.tolerance, .absolute_tolerance = e.tolerance * q.absolute});
    const ivp::Solution<m> s = run(q.system, q.x0, q.t0, end, {}, limits);
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

/// Seconds of a right-hand side.
template <int m>
double right_hand_side_seconds(const Question<m>& q) {
  ivp::State<m> x = q.x0, f(q.x0.size());
  const auto calls = [&](int count) {
    const Stopwatch watch;
    for (int i = 0; i < count; ++i) q.system.rhs(q.t0, x, f);
    return watch.seconds() / count;
  };
  const double one = calls(1);
  return one > 1e-4 ? one : std::min(calls(200), calls(200));
}

}  // namespace

template <int m>
std::vector<Ranked> rank_methods(const Question<m>& q, const Features& features, const Evidence& evidence,
                                 Status& status) {
  std::vector<Ranked> ranked;
  double end = q.t1, best = budget * q.effort, first = 0;
  std::size_t rivals = 0;
  for (const Expectation& e : expectations(evidence, features, q.level)) {
    if (!q.among.has(e.method)) continue;
    const double place = e.behind + e.short_of;
    if (rivals == most_rivals || (rivals > 0 && place > first + hopeless)) break;
    const Part part = run_part(q, e, end, rivals == 0 ? best : 2 * best);
    if (part.refused) continue;
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
  std::ranges::stable_sort(ranked, {},
                           [](const Ranked& r) { return r.cost * (any_method(r.method).peer ? tie : 1); });
  if (!ranked.empty()) status = {};
  return ranked;
}

template <int m>
double condition_along(const Question<m>& q, const std::string& method, double& seen) {
  // Far above the errors of the runs, and small against the solution.
  constexpr double tolerance = 1e-9, moved = 1e-5;
  const auto run = any_integrator<m>(
      any_method(method),
      {.tolerance = tolerance, .absolute_tolerance = tolerance * std::min(q.absolute, 1.0)});
  const ivp::Limits limits{.steps = static_cast<std::int64_t>(20'000 * q.effort), .seconds = seconds};
  ivp::State<m> middle = q.x0, size = q.x0.cwiseAbs();
  double half = q.t0, last = q.t0;
  const double way = q.t1 - q.t0;
  const ivp::Observer<m> see = [&](const ivp::Step<m>& step) {
    size = size.cwiseMax(step.x1.cwiseAbs());
    if (std::abs(step.t1 - q.t0) <= std::abs(way) / 2) {
      half = step.t1;
      middle = step.x1;
    }
    last = step.t1;
    return true;
  };
  const ivp::Solution<m> straight = run(q.system, q.x0, q.t0, q.t1, see, limits);
  seen = std::abs((straight.t - q.t0) / way);
  if (!(seen > 0)) return 1;
  double worst = 1;
  for (const auto& [t, x] : {std::pair(q.t0, q.x0), std::pair(half, middle)}) {
    for (const bool turned : {false, true}) {
      ivp::State<m> begin = x;
      for (Eigen::Index i = 0; i < x.size(); ++i) {
        const double by = moved * (q.absolute * std::max(size[i], 1e-3) + std::abs(x[i]));
        begin[i] += turned && i % 2 == 1 ? -by : by;
      }
      const ivp::Solution<m> other = run(q.system, begin, t, straight.t, {}, limits);
      if (!other.status.ok()) continue;
      for (Eigen::Index i = 0; i < x.size(); ++i) {
        if (size[i] > 0) worst = std::max(worst, std::abs(other.x[i] - straight.x[i]) / (moved * size[i]));
      }
    }
  }
  return worst;
}

template <int m>
Chosen choose(Question<m> q, double digits, const Evidence& evidence) {
  constexpr double roundings = 16 * std::numeric_limits<double>::epsilon();  // of some hundred steps
  Chosen c;
  c.digits = digits;
  c.look = look_at_problem<m>(q.system, q.x0, q.t0, q.t1);
  c.status = c.look.status;
  if (!c.status.ok()) return c;
  c.alike = most_alike(evidence, c.look.features, 3);
  c.right_hand_side = right_hand_side_seconds(q);
  q.level = digits;
  for (const Expectation& e : expectations(evidence, c.look.features, digits)) {
    if (!q.among.has(e.method)) continue;
    c.condition = condition_along(q, e.method, c.condition_seen);
    if (c.condition_seen > 0) break;
  }
  c.possible = -std::log10(roundings * c.condition);
  q.level = std::min(digits, c.possible) + std::log10(c.condition);
  c.ranked = rank_methods(q, c.look.features, evidence, c.status);
  return c;
}

bool Among::has(const std::string& method) const {
  return methods.empty() || std::ranges::find(methods, method) != methods.end();
}

double unit_seconds() {
  constexpr int calls = 2000;
  const ivp::System<2> system{problems::Duffing{}};
  ivp::State<2> x = problems::Duffing::initial_state(), f;
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

template std::vector<Ranked> rank_methods<1>(const Question<1>&, const Features&, const Evidence&, Status&);
template Chosen choose<1>(Question<1>, double, const Evidence&);
template double condition_along<1>(const Question<1>&, const std::string&, double&);
template std::vector<Ranked> rank_methods<2>(const Question<2>&, const Features&, const Evidence&, Status&);
template Chosen choose<2>(Question<2>, double, const Evidence&);
template double condition_along<2>(const Question<2>&, const std::string&, double&);
template std::vector<Ranked> rank_methods<3>(const Question<3>&, const Features&, const Evidence&, Status&);
template Chosen choose<3>(Question<3>, double, const Evidence&);
template double condition_along<3>(const Question<3>&, const std::string&, double&);
template std::vector<Ranked> rank_methods<4>(const Question<4>&, const Features&, const Evidence&, Status&);
template Chosen choose<4>(Question<4>, double, const Evidence&);
template double condition_along<4>(const Question<4>&, const std::string&, double&);
template std::vector<Ranked> rank_methods<6>(const Question<6>&, const Features&, const Evidence&, Status&);
template Chosen choose<6>(Question<6>, double, const Evidence&);
template double condition_along<6>(const Question<6>&, const std::string&, double&);
template std::vector<Ranked> rank_methods<Eigen::Dynamic>(const Question<Eigen::Dynamic>&, const Features&,
                                                          const Evidence&, Status&);
template Chosen choose<Eigen::Dynamic>(Question<Eigen::Dynamic>, double, const Evidence&);
template double condition_along<Eigen::Dynamic>(const Question<Eigen::Dynamic>&, const std::string&, double&);
}  // namespace nlmech::comparison
