#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "chapters/gss_control/craft.hpp"
#include "chapters/gss_control/scenes.hpp"
#include "nlmech/spacecraft/margins.hpp"
#include "nlmech/spacecraft/parseval.hpp"
#include "nlmech/spacecraft/response.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::chapters {
namespace {

using scene::Workshop;
using spacecraft::Complex;
using spacecraft::ExponentialSum;
using spacecraft::Gains;
using spacecraft::Parameters;
using spacecraft::Stability;

constexpr double eps = std::numeric_limits<double>::epsilon();

/// A spacecraft and gains at the end of what can be.
struct Extreme {
  std::string name;
  Parameters craft;
  Gains gains;
};

Parameters changed(double Parameters::*field, double factor) {
  Parameters p = craft(true);
  p.*field *= factor;
  return p;
}

std::vector<Extreme> stable_loops() {
  const Parameters p = craft(true);
  return {{"designed gains", p, designed_gains},
          {"k1 = 1e-9", p, {1e-9, 0, 16}},
          {"k1 = 1e9", p, {1e9, 0, 16}},
          {"k3 = 1e-6", p, {12, 0, 1e-6}},
          {"k3 = 1e6", p, {12, 0, 1e6}},
          {"k2 = -2 + 1e-3", p, {12, -2 + 1e-3, 16}},
          {"k2 = -2 + 1e-9", p, {12, -2 + 1e-9, 16}},
          {"k2 = 1e3", p, {12, 1e3, 16}},
          {"k2 = 1e9", p, {12, 1e9, 16}},
          {"beams 1e6 times as stiff", changed(&Parameters::second_moment, 1e6), designed_gains},
          {"beams 1e12 times as stiff", changed(&Parameters::second_moment, 1e12), designed_gains},
          {"beams 1e-6 times as stiff", changed(&Parameters::second_moment, 1e-6), designed_gains},
          {"beams 1e6 times as stiff, unit gains", changed(&Parameters::second_moment, 1e6), unit_gains},
          {"hub inertia 1e-6 times as large", changed(&Parameters::hub_inertia, 1e-6), designed_gains},
          {"hub inertia 1e6 times as large", changed(&Parameters::hub_inertia, 1e6), designed_gains},
          {"tip mass 1e6 times as large", changed(&Parameters::tip_mass, 1e6), designed_gains}};
}

/// int f^2 dt from 0 to infinity of a sum without a polynomial.
double square(const ExponentialSum& f) {
  std::vector<Complex> p, w;
  for (std::size_t i = 0; i < f.poles().size(); ++i) {
    for (const bool conjugate : {false, true}) {
      p.push_back(conjugate ? std::conj(f.poles()[i]) : f.poles()[i]);
      w.push_back(conjugate ? std::conj(f.weights()[i]) : f.weights()[i]);
    }
  }
  Complex sum = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    for (std::size_t j = 0; j < p.size(); ++j) sum -= w[i] * w[j] / (p[i] + p[j]);
  }
  return sum.real();
}

/// What rounding of the poles may do to square(): the decay of each is known to some eps of its modulus.
double rounding_of_square(const ExponentialSum& f) {
  double sum = 0;
  for (std::size_t i = 0; i < f.poles().size(); ++i) {
    const double decay = std::abs(f.poles()[i].real()), error = 8 * eps * std::abs(f.poles()[i]);
    sum += 2 * std::norm(f.weights()[i]) / std::max(decay, error) * std::min(1., error / decay);
  }
  return sum;
}

struct Trial {
  std::string name;
  Status status;
  std::size_t poles = 0;                     ///< that are summed
  double error = HUGE_VAL, rate = HUGE_VAL;  ///< relative misses of int e^2 and int theta'^2
  double rounding = 0;                       ///< allowance of the former
};

Trial attempt(const Extreme& e) {
  Trial t;
  t.name = e.name;
  const auto r = spacecraft::step_response(spacecraft::ClosedLoop(e.craft, e.gains), 1, {});
  t.status = r.status;
  if (!t.status.ok()) return t;
  t.poles = r.theta.poles().size();
  const auto costs = spacecraft::step_costs(e.craft, e.gains, 0);
  const ExponentialSum error({}, r.theta.poles(), r.theta.weights());  // theta begins with 1, its end
  t.error = std::abs(square(error) / costs.error - 1);
  t.rounding = rounding_of_square(error) / costs.error;
  t.rate = std::abs(square(r.theta_dot) / costs.rate - 1);
  return t;
}

/// Gains that do not settle, what must be said of them, and whether a loop must refuse them.
struct Bad {
  Gains gains;
  Stability verdict;
  bool refused;
};

/// How many of them end as they must; a row each.
double judge_bad(scene::Table& table) {
  double right = 0;
  for (const Bad& bad : {Bad{{12, -2, 16}, Stability::marginal, true},
                         {{12, -2.1, 16}, Stability::unstable, true},
                         {{-1, 0, 16}, Stability::unstable, true},
                         {{12, 0, -1}, Stability::unstable, true},
                         {{12, 0, 0}, Stability::marginal, false},
                         {{0, 0, 16}, Stability::marginal, false}}) {
    const auto said = spacecraft::stability(bad.gains);
    bool refused = false;
    try {
      const spacecraft::ClosedLoop loop(craft(true), bad.gains);
    } catch (const std::invalid_argument&) {
      refused = true;
    }
    right += said.verdict == bad.verdict && refused == bad.refused ? 1 : 0;
    const char* word = said.verdict == Stability::marginal ? "marginal" : "unstable";
    table.add({fmt::format("k1 = {:g}, k2 = {:g}, k3 = {:g}", bad.gains.k1, bad.gains.k2, bad.gains.k3),
               fmt::format("{}{}", word, refused ? ", refused" : ""),
               {},
               {},
               {}});
  }
  return right;
}

/// Unstable ones of the first five poles, just below and just above the delay margin, all loops together.
struct Delays {
  double below = 0, above = 0;
  double margin = 0, expected = 0;  ///< with designed gains, s; pi/(2 omega) of the highest mode
};

Delays delays(scene::Table& table) {
  Delays all;
  for (const Gains& gains : {designed_gains, unit_gains, Gains{12, -1.9, 16}, Gains{12, 1e3, 16}}) {
    const spacecraft::ClosedLoop loop(craft(true), gains);
    const auto margins = spacecraft::margins(loop, 5);
    const auto low = spacecraft::delayed_poles(loop, 0.999 * margins.delay_margin, 5),
               high = spacecraft::delayed_poles(loop, 1.001 * margins.delay_margin, 5);
    for (const Status& status : {margins.status, low.status, high.status}) {
      if (!status.ok()) throw Failure(status);
    }
    all.below += low.unstable;
    all.above += high.unstable;
    table.add({fmt::format("k1 = {:g}, k2 = {:g}, k3 = {:g}, delay {:.3g} ms", gains.k1, gains.k2, gains.k3,
                           1e3 * margins.delay_margin),
               fmt::format("{} and {} unstable of 5", low.unstable, high.unstable),
               {},
               {},
               {}});
    if (gains.k1 == designed_gains.k1 && gains.k2 == 0) {
      all.margin = margins.delay_margin;
      all.expected = std::numbers::pi / (2 * loop.poles(5).s.back().imag());
    }
  }
  return all;
}

scene::Showing show() {
  scene::Table table({{"loop"},
                      {"status"},
                      {"poles summed"},
                      {"int e^2, relative miss", 2},
                      {"int theta'^2, relative miss", 2}});
  double found = 0, error = 0, rate = 0;
  const std::vector<Extreme> loops = stable_loops();
  for (const Extreme& e : loops) {
    const Trial t = attempt(e);
    found += t.status.ok() ? 1 : 0;
    error = std::max(error, t.error / (1e-9 + t.rounding));
    rate = std::max(rate, t.rate);
    table.add({t.name, std::string(to_string(t.status.outcome())), static_cast<std::int64_t>(t.poles),
               t.error, t.rate});
  }
  const double bad = judge_bad(table);
  const Delays d = delays(table);
  return {{},
          table,
          {scene::near("stable loops whose motion is found", "1", found, static_cast<double>(loops.size()), 0,
                       "k1, k3 > 0 and k2 > -2 are stable"),
           scene::at_most("largest miss of int theta'^2, relative", "1", rate, 1e-9,
                          "k1/(2 k3) by Parseval's theorem; sums leave out 1e-9 of their largest terms"),
           scene::at_most("largest miss of int e^2, over 1e-9 and rounding", "1", error, 1,
                          "the closed form; a decay is known to 8 eps of the pole's modulus"),
           scene::near("bad gains that end as they must", "1", bad, 6, 0,
                       "marginal without k1 or k3 or at k2 = -2; unstable below, and with k1 or k3 below 0"),
           scene::near("unstable poles at 0.999 of the delay margins, four loops", "1", d.below, 0, 0,
                       "no pole has reached the axis"),
           scene::near("unstable poles at 1.001 of the delay margins, four loops", "1", d.above, 4, 0,
                       "a pair has crossed it in each"),
           scene::near("delay margin of five modes, designed gains", "s", d.margin, d.expected, 1e-2,
                       "pi/(2 omega) of the highest mode, for k2 = 0 and little damping")}};
}

}  // namespace

void add_loop_extremes(scene::Chapter& chapter) {
  chapter.add({.name = "extremes-loop",
               .title = "Extreme closed loops: gains, stiff beams, delays",
               .place = "our own",
               .needs = {},
               .show = [](Workshop&) { return show(); }});
}

}  // namespace nlmech::chapters
