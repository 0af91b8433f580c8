/// @file
/// `algebraic_series_bench`: Taylor series against the fastest classical formula of high order, both compiled
/// with the problem, what the tape costs, and coefficients beside a plain loop; by Google Benchmark. Writes
/// results/bench/algebraic_series.json and tables/BENCH.md under the current folder; exit code 1 if a claim
/// is not held.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "chapters/speed.hpp"
#include "nlmech/ivp/series.hpp"
#include "nlmech/peers/ivp/odeint_direct.hpp"
#include "nlmech/problems/duffing.hpp"
#include "nlmech/problems/lorenz.hpp"
#include "nlmech/problems/reference_trajectory.hpp"
#include "nlmech/problems/three_mass_chain.hpp"
#include "nlmech/support/stopwatch.hpp"

namespace {

using namespace nlmech;

constexpr double wanted = 1e-9;  // nine digits
constexpr int end_times = 16;    // over which errors are medians

/// A piece of work that is measured.
struct Work {
  std::string name;
  std::function<void()> run;
};

/// A problem with the end of its solution in extended precision.
template <class Problem>
struct Case {
  static constexpr int n = Problem::dimension;
  std::string name;
  Problem problem;
  double end;
  std::vector<double> times;
  std::vector<Vector<long double, n>> states;

  Case(std::string label, const Problem& p, double until) : name(std::move(label)), problem(p), end(until) {
    const auto x0 = Problem::initial_state().template cast<long double>().eval();
    const problems::ReferenceTrajectory<long double, Problem> path(p, x0, 0, until);
    for (int i = 0; i < end_times; ++i) {
      times.push_back(until * (1 - 0.002 * i));
      states.push_back(path(times.back()));
    }
  }

  /// Median over the end times of the largest relative error of a component; nothing if a run fails.
  template <class System, class Method>
  [[nodiscard]] std::optional<double> error(const System& system, const Method& method) const {
    std::vector<double> errors;
    for (std::size_t i = 0; i < times.size(); ++i) {
      const auto s = ivp::integrate(system, Problem::initial_state(), 0, times[i], method);
      if (!s.status.ok()) return std::nullopt;
      double largest = 0;
      for (int c = 0; c < n; ++c) {
        const long double truth = states[i][c];
        largest = std::max(largest, static_cast<double>(std::abs((s.x[c] - truth) / truth)));
      }
      errors.push_back(largest);
    }
    std::sort(errors.begin(), errors.end());
    return (errors[end_times / 2 - 1] + errors[end_times / 2]) / 2;
  }
};

/// The fastest tolerance of the sweep that has the wanted digits; nothing if none has.
template <class Problem, class System, class Make>
std::optional<Work> fastest(const Case<Problem>& c, const System& system, const std::string& label,
                            const Make& make) {
  std::optional<Work> best;
  double least = HUGE_VAL;
  for (int digits = 6; digits <= 15; ++digits) {
    const double tolerance = std::pow(10.0, -digits);
    const auto method = make(tolerance);
    const auto error = c.error(system, method);
    if (!error || *error > wanted) continue;
    const auto run = [system, method, end = c.end] {
      auto solution = ivp::integrate(system, Problem::initial_state(), 0, end, method);
      benchmark::DoNotOptimize(solution);
    };
    const double seconds = time_repeats(run, 5).smallest;
    if (seconds < least) {
      least = seconds;
      best = Work{fmt::format("{}, {}", c.name, label), run};
      fmt::print("{}, tolerance 1e-{}: error {:.1e}, {:.1f} us\n", best->name, digits, *error, 1e6 * seconds);
    }
  }
  return best;
}

/// Ours inlined, ours through the tape, and the library inlined.
template <class Problem>
void add_rivals(std::vector<Work>& all, const Case<Problem>& c) {
  const auto series = [](double tolerance) {
    return ivp::Series{.relative_tolerance = tolerance, .absolute_tolerance = tolerance};
  };
  const auto add = [&all](const std::optional<Work>& work) {
    if (work) all.push_back(*work);
  };
  add(fastest(c, ivp::Direct(c.problem), "series inlined", series));
  add(fastest(c, ivp::System(c.problem), "series through the tape", series));
  if (!peers::odeint_available()) return;
  add(fastest(c, ivp::Direct(c.problem), "odeint-fehlberg78 inlined", [](double tolerance) {
    peers::OdeintDirect method;
    method.formula = peers::Odeint::Formula::fehlberg78;
    method.relative_tolerance = method.absolute_tolerance = tolerance;
    return method;
  }));
}

/// The recurrence of Filipich and Rosales, Eqs. 67 and 68, as one would write it down.
void lorenz_loop(double* a, double* b, double* c, int order) {
  const problems::Lorenz p;
  for (int i = 0; i < order; ++i) {
    double s = 0, z = 0;
    for (int j = 0; j <= i; ++j) {
      s += a[j] * c[i - j];
      z += a[j] * b[i - j];
    }
    a[i + 1] = p.sigma * (b[i] - a[i]) / (i + 1);
    b[i + 1] = (p.r * a[i] - b[i] - s) / (i + 1);
    c[i + 1] = (z - p.b * c[i]) / (i + 1);
  }
}

/// The coefficients of one step of the Lorenz equations, three ways.
void add_coefficients(std::vector<Work>& all) {
  static const ivp::System system{problems::Lorenz{}};
  static const ivp::Direct direct{problems::Lorenz{}};
  const ivp::State<3> x(-3, 2, 21);
  for (const int order : {8, 16, 24, 32, 40, 64, 100}) {
    const auto name = [order](const char* way) {
      return fmt::format("coefficients to order {}, {}", order, way);
    };
    all.push_back({name("plain loop"), [order, x, c = std::vector<double>(303)]() mutable {
                     for (int i = 0; i < 3; ++i) c[101 * static_cast<std::size_t>(i)] = x[i];
                     lorenz_loop(c.data(), c.data() + 101, c.data() + 202, order);
                     benchmark::DoNotOptimize(c.data());
                     benchmark::ClobberMemory();
                   }});
    const auto expand = [x](auto taylor) {
      taylor.begin_segment(0, x);
      return [taylor, x]() mutable {
        taylor.expand(0, x);
        benchmark::DoNotOptimize(taylor.coefficients(0)[taylor.order()]);
        benchmark::ClobberMemory();
      };
    };
    all.push_back({name("tape"), expand(system.taylor(order))});
    if (order <= unrolled::most_order) all.push_back({name("unrolled"), expand(direct.taylor(order))});
  }
}

std::vector<scene::SpeedClaim> claims(const std::vector<Work>& all) {
  std::vector<scene::SpeedClaim> out;
  const auto has = [&all](const std::string& name) {
    return std::any_of(all.begin(), all.end(), [&](const Work& w) { return w.name == name; });
  };
  const auto add = [&](const std::string& fast, const std::string& slow, double least) {
    if (has(fast) && has(slow)) out.push_back({fmt::format("{} against {}", fast, slow), fast, slow, least});
  };
  for (const auto& [name, least] : {std::pair{"duffing", 1.7}, {"three-masses", 3.6}, {"lorenz", 3.0}}) {
    const std::string problem = name;
    add(problem + ", series inlined", problem + ", odeint-fehlberg78 inlined", least);
    add(problem + ", series through the tape", problem + ", series inlined",
        0.4);  // at most 2.5 times the time
  }
  add("coefficients to order 24, unrolled", "coefficients to order 24, plain loop", 1.5);
  add("coefficients to order 100, tape", "coefficients to order 100, plain loop", 1.3);
  return out;
}

int bench(int argc, char** argv) {
  chapters::begin_speed(argc, argv);

  std::vector<Work> all;
  add_rivals(all, Case("duffing", problems::Duffing{}, 500));
  add_rivals(all, Case("three-masses", problems::ThreeMassChain{}, 200));
  add_rivals(all, Case("lorenz", problems::Lorenz{}, 20));
  add_coefficients(all);
  return chapters::judge_speed("algebraic_series", claims(all), chapters::measure_speed(all));
}

}  // namespace

int main(int argc, char** argv) {
  return nlmech::chapters::speed_main("algebraic_series_bench", &bench, argc, argv);
}
