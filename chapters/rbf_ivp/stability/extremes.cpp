#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "chapters/rbf_ivp/examples/cases.hpp"
#include "chapters/rbf_ivp/stability/contestants.hpp"
#include "nlmech/comparison/any_method.hpp"
#include "nlmech/comparison/cost/accuracy.hpp"
#include "nlmech/problems/problem.hpp"
#include "nlmech/problems/texts.hpp"
#include "nlmech/scene/scene.hpp"

namespace nlmech::chapters::rbf_ivp::extremes {
namespace {

/// A linear oscillator whose force is no number from a time on.
struct Poisoned {
  static constexpr int dimension = 2;
  double from;    ///< time of the first bad force
  double poison;  ///< NaN or infinity

  template <class T>
  void acceleration(const T& t, const Vector<T, 1>& q, const Vector<T, 1>& /*v*/, Vector<T, 1>& a) const {
    a[0] = -q[0];
    if (value_of(t) >= from) a[0] += poison;
  }
  template <class T>
  void operator()(const T& t, const Vector<T, 2>& x, Vector<T, 2>& dxdt) const {
    problems::first_order_form(*this, t, x, dxdt);
  }
};

/// y'' = 3 y^5, which is y' = y^3 for methods that ask for accelerations.
struct BlowUpOfSecondOrder {
  static constexpr int dimension = 2;
  template <class T>
  void acceleration(const T& /*t*/, const Vector<T, 1>& q, const Vector<T, 1>& /*v*/, Vector<T, 1>& a) const {
    const T square = q[0] * q[0];
    a[0] = 3 * (square * square * q[0]);
  }
  template <class T>
  void operator()(const T& t, const Vector<T, 2>& x, Vector<T, 2>& dxdt) const {
    problems::first_order_form(*this, t, x, dxdt);
  }
};

/// What is asked: an interval, a step for who takes one, and what should come out.
struct Trial {
  ivp::System system;
  ivp::State x0;
  double t0, t1, step;
  std::function<double(const ivp::State&)> digits;  ///< of the end state; empty: there is no solution
};

constexpr std::int64_t most_steps = 100'000;

/// How it ended: digits, or an outcome.
struct End {
  Outcome outcome;
  std::optional<double> digits;
};

End attempt(const ivp::MethodInfo& method, const Trial& trial, const ivp::Settings& extra = {}) {
  ivp::Settings settings = extra;
  if (method.fixed_step()) {
    settings.step = trial.step;
  } else {
    settings.tolerance = 1e-6;
  }
  const auto s =
      method.with(settings)(trial.system, trial.x0, trial.t0, trial.t1, {}, ivp::Limits{.steps = most_steps});
  if (!s.status.ok()) return {s.status.outcome(), std::nullopt};
  return {Outcome::success, trial.digits ? std::optional(trial.digits(s.x)) : std::nullopt};
}

std::string words(const End& end) {
  if (end.outcome != Outcome::success) return std::string(to_string(end.outcome));
  if (!end.digits) return "success: wrong";  // where there is no solution
  return fmt::format("{:.1f} digits", *end.digits);
}

/// -log10 of the largest error.
std::function<double(const ivp::State&)> digits_against(const ivp::State& truth) {
  return [truth](const ivp::State& x) {
    return std::max(0.0, comparison::digits_of((x - truth).cwiseAbs().maxCoeff()));
  };
}

/// The columns of the table but the first.
struct Ends {
  std::string method;
  bool fixed_step;
  End blow_up, nan, infinity, underflow, nothing, backwards;
};

Ends ends_of(const ivp::MethodInfo& method) {
  const ivp::State rest{1, 0};
  const double P = duffing_period();
  const auto poisoned = [&](double poison) {
    return Trial{ivp::System(Poisoned{1, poison}), rest, 0, 2, 0.01, {}};
  };
  const Trial harmonic{ivp::System(Poisoned{HUGE_VAL, 0}),
                       rest,
                       1e16,
                       1e16 + 64,
                       0.5,
                       digits_against({std::cos(64.0), -std::sin(64.0)})};
  const ivp::System& duffing = free_duffing_case().system;
  const bool second_order = method.second_order_only;
  const End blow_up =
      second_order
          ? attempt(method, Trial{ivp::System(BlowUpOfSecondOrder{}), {1, 1}, 0, 1, 1e-3, {}})
          : attempt(method,
                    Trial{ivp::System(problems::TextProblem("blow-up")), ivp::State{1.0}, 0, 1, 1e-3, {}});
  return {std::string(method.name),
          method.fixed_step(),
          blow_up,
          attempt(method, poisoned(std::numeric_limits<double>::quiet_NaN())),
          attempt(method, poisoned(std::numeric_limits<double>::infinity())),
          attempt(method, harmonic),
          attempt(method, Trial{duffing, rest, 1, 1, 0.01, digits_against(rest)}),
          attempt(method, Trial{duffing, rest, P, 0, P / 1000, digits_against(rest)})};
}

std::vector<Ends> all_ends() {
  std::vector<Ends> all;
  for (const std::string& name : contestants()) {
    // It refuses problems that branch unannounced, as these do; its own chapter has its extreme cases.
    if (name == "series") continue;
    const ivp::MethodInfo& method = comparison::any_method(name);
    if (method.is_available()) all.push_back(ends_of(method));
  }
  return all;
}

/// Collocations far from what they are made for: over a period of the free Duffing oscillator.
struct Odd {
  std::string setting;
  End end;
};

std::vector<Odd> odd_settings() {
  const ivp::State rest{1, 0};
  const double P = duffing_period();
  std::vector<Odd> odd;
  const auto add = [&](const char* name, int nodes, double fraction, std::optional<double> relative_shape) {
    const double step = P * fraction;
    ivp::Settings settings{.nodes = nodes};
    std::string setting = fmt::format("{}, N = {}, h = {:g} P", name, nodes, fraction);
    if (relative_shape) {
      settings.shape = *relative_shape / step;
      setting += fmt::format(", c h = {:g}", *relative_shape);
    }
    const Trial trial{free_duffing_case().system, rest, 0, P, step, digits_against(rest)};
    odd.push_back({setting, attempt(comparison::any_method(name), trial, settings)});
  };
  for (const char* name : {"mcpi", "rbf-coll", "lgl-coll", "radau-coll"}) {
    add(name, 2, 0.001, std::nullopt);
    add(name, 200, 0.25, std::nullopt);
  }
  for (const double shape : {1e-6, 1e-4, 1e-2, 1.0, 1e2, 1e4, 1e6}) add("rbf-coll", 7, 0.1, shape);
  return odd;
}

scene::Table table_of(const std::vector<Ends>& all, const std::vector<Odd>& odd) {
  scene::Table table({{"method or setting"},
                      {"y' = y^3 past its end"},
                      {"NaN from t = 1 on"},
                      {"infinity from t = 1 on"},
                      {"t = 1e16"},
                      {"t0 = t1"},
                      {"free Duffing, backwards"},
                      {"free Duffing, a period"}});
  for (const Ends& e : all) {
    table.add({e.method, words(e.blow_up), words(e.nan), words(e.infinity), words(e.underflow),
               words(e.nothing), words(e.backwards), ""});
  }
  for (const Odd& o : odd) table.add({o.setting, "", "", "", "", "", "", words(o.end)});
  return table;
}

void put(const std::vector<Ends>& all, const std::vector<Odd>& odd, scene::Show& show) {
  show.table(table_of(all, odd));
  const auto successes = [&](const End Ends::*which) {
    return std::ranges::count(all, Outcome::success, [&](const Ends& e) { return (e.*which).outcome; });
  };
  show.at_most("methods that choose their steps and pass the end of y' = y^3",
               std::ranges::count_if(
                   all, [](const Ends& e) { return !e.fixed_step && e.blow_up.outcome == Outcome::success; }),
               0, "there is no solution beyond t = 1/2");
  const char* none = "there is no solution at the end";
  show.at_most("methods that report success: NaN", successes(&Ends::nan), 0, none);
  show.at_most("methods that report success: infinity", successes(&Ends::infinity), 0, none);
  show.at_most("methods that report success: steps that t = 1e16 cannot hold", successes(&Ends::underflow), 0,
               none);
  show.equals("methods that succeed over an interval without length", successes(&Ends::nothing),
              static_cast<double>(all.size()), "nothing is to be done");
  double least_backwards = HUGE_VAL;
  for (const Ends& e : all) least_backwards = std::min(least_backwards, e.backwards.digits.value_or(0));
  show.between("least digits backwards", least_backwards, 1, 16, "all of order 1 or more, 1000 steps");
}

}  // namespace

std::vector<scene::Scene> scenes() {
  const scene::Result ends("extreme-ends",
                           "steps 1e-3, 0.01, 0.01, 0.5, 0.01, P/1000; tolerance 1e-6 for methods that "
                           "choose; at most 100000 steps",
                           all_ends);
  const scene::Result odd("odd-collocations", "free Duffing from rest over a period; digits of the end state",
                          odd_settings);
  return {{.name = "extremes",
           .title = "How every method ends where there is no solution, and collocations at their limits",
           .content = scene::Content(put, ends, odd)}};
}

}  // namespace nlmech::chapters::rbf_ivp::extremes
