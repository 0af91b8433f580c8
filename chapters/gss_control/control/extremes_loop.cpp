#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "chapters/gss_control/craft.hpp"
#include "nlmech/scene/scene.hpp"
#include "nlmech/spacecraft/control/margins.hpp"
#include "nlmech/spacecraft/control/parseval.hpp"
#include "nlmech/spacecraft/response.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::chapters::gss_control::extremes_loop {
namespace {

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

/// A row of the table. Empty where there is nothing to say.
struct Row {
  std::string loop, status;
  scene::Cell poles = {}, error = {}, rate = {};
};

struct Trial {
  std::string name;
  Status status;
  std::size_t poles = 0;                     ///< that are summed
  double error = HUGE_VAL, rate = HUGE_VAL;  ///< relative misses of int e^2 and int theta'^2
  double rounding = 0;                       ///< allowance of the former

  [[nodiscard]] Row row() const {
    return {name, std::string(to_string(status.outcome())), poles, error, rate};
  }
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

std::string words(const Gains& k) { return fmt::format("k1 = {:g}, k2 = {:g}, k3 = {:g}", k.k1, k.k2, k.k3); }

/// Gains that do not settle, what must be said of them, and whether a loop must refuse them.
struct Bad {
  Gains gains;
  Stability verdict;
  bool refused;
};
constexpr std::array bad_gains = {
    Bad{{12, -2, 16}, Stability::marginal, true}, Bad{{12, -2.1, 16}, Stability::unstable, true},
    Bad{{-1, 0, 16}, Stability::unstable, true},  Bad{{12, 0, -1}, Stability::unstable, true},
    Bad{{12, 0, 0}, Stability::marginal, false},  Bad{{0, 0, 16}, Stability::marginal, false}};

/// How many of them end as they must; a row each.
int judge_bad(std::vector<Row>& rows) {
  int right = 0;
  for (const Bad& bad : bad_gains) {
    const auto said = spacecraft::stability(bad.gains);
    bool refused = false;
    try {
      const spacecraft::ClosedLoop loop(craft(true), bad.gains);
    } catch (const std::invalid_argument&) {
      refused = true;
    }
    if (said.verdict == bad.verdict && refused == bad.refused) ++right;
    const std::string word = said.verdict == Stability::marginal ? "marginal" : "unstable";
    rows.push_back({words(bad.gains), word + (refused ? ", refused" : "")});
  }
  return right;
}

/// Unstable ones of the first five poles, just below and just above the delay margin, all loops together.
struct Delays {
  int below = 0, above = 0;
  double margin = 0, expected = 0;  ///< with designed gains, s; pi/(2 omega) of the highest mode
};

Delays delays(std::vector<Row>& rows) {
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
    rows.push_back({fmt::format("{}, delay {:.3g} ms", words(gains), 1e3 * margins.delay_margin),
                    fmt::format("{} and {} unstable of 5", low.unstable, high.unstable)});
    if (gains.k1 == designed_gains.k1 && gains.k2 == 0) {
      all.margin = margins.delay_margin;
      all.expected = std::numbers::pi / (2 * loop.poles(5).s.back().imag());
    }
  }
  return all;
}

void put(scene::Show& show) {
  std::vector<Row> rows;
  int found = 0;
  double error = 0, rate = 0;
  const std::vector<Extreme> loops = stable_loops();
  for (const Extreme& e : loops) {
    const Trial t = attempt(e);
    if (t.status.ok()) ++found;
    error = std::max(error, t.error / (1e-9 + t.rounding));
    rate = std::max(rate, t.rate);
    rows.push_back(t.row());
  }
  const int bad = judge_bad(rows);
  const Delays d = delays(rows);
  show.table(rows, {{"loop", &Row::loop},
                    {"status", &Row::status},
                    {"poles summed", &Row::poles},
                    {"int e^2, relative miss", &Row::error, 2},
                    {"int theta'^2, relative miss", &Row::rate, 2}});
  show.equals("stable loops whose motion is found", found, static_cast<double>(loops.size()),
              "k1, k3 > 0 and k2 > -2 are stable");
  show.at_most("largest miss of int theta'^2, relative", rate, 1e-9,
               "k1/(2 k3) by Parseval's theorem; sums leave out 1e-9 of their largest terms");
  show.at_most("largest miss of int e^2, over 1e-9 and rounding", error, 1,
               "the closed form; a decay is known to 8 eps of the pole's modulus");
  show.equals("bad gains that end as they must", bad, 6,
              "marginal without k1 or k3 or at k2 = -2; unstable below, and with k1 or k3 below 0");
  show.equals("unstable poles at 0.999 of the delay margins, four loops", d.below, 0,
              "no pole has reached the axis");
  show.equals("unstable poles at 1.001 of the delay margins, four loops", d.above, 4,
              "a pair has crossed it in each");
  show.near("delay margin of five modes, designed gains", {d.margin, "s"}, d.expected, 1e-2,
            "pi/(2 omega) of the highest mode, for k2 = 0 and little damping");
}

}  // namespace

std::vector<scene::Scene> scenes() {
  return {{.name = "extremes-loop",
           .title = "Extreme closed loops: gains, stiff beams, delays",
           .content = scene::Content(put)}};
}

}  // namespace nlmech::chapters::gss_control::extremes_loop
