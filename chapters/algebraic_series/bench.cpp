/// @file
/// `algebraic_series_bench`: Taylor series against the fastest classical formula of high order as its
/// library's manual runs it, both compiled with the problem, what our walk costs that library, what the tape
/// costs us, and coefficients beside a plain loop; by Google Benchmark. Writes
/// results/bench/algebraic_series.json under the current folder; exit code 1 if a claim is not held.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "chapters/plain_equations.hpp"
#include "chapters/speed.hpp"
#include "nlmech/ivp/series/series.hpp"
#include "nlmech/peers/ivp/odeint/odeint_direct.hpp"
#include "nlmech/peers/ivp/odeint/odeint_native.hpp"
#include "nlmech/problems/reference_trajectory.hpp"
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

/// To a time with a tolerance; nothing after a failure.
using Runner = std::function<std::optional<ivp::State>(double end, double tolerance)>;

/// A problem with the end of its solution in extended precision.
template <class Problem, class Plain>
struct Case {
  static constexpr int n = Problem::dimension;
  std::string name;
  Problem problem;
  Plain plain;  ///< the same equations as others write them
  ivp::State x0;
  double end;
  std::vector<double> times = {};
  std::vector<ivp::LongState> states = {};

  Case(std::string label, const Problem& p, const ivp::State& from, double until)
      : name(std::move(label)), problem(p), plain{p}, x0(from), end(until) {
    const problems::ReferenceTrajectory<long double, Problem> path(p, x0.cast<long double>(), 0, until);
    for (int i = 0; i < end_times; ++i) {
      times.push_back(until * (1 - 0.002 * i));
      states.push_back(path(times.back()));
    }
  }

  /// Median over the end times of the largest relative error of a component; nothing if a run fails.
  [[nodiscard]] std::optional<double> error(const Runner& run, double tolerance) const {
    std::vector<double> errors;
    for (std::size_t i = 0; i < times.size(); ++i) {
      const auto x = run(times[i], tolerance);
      if (!x) return std::nullopt;
      double largest = 0;
      for (int c = 0; c < n; ++c) {
        const long double truth = states[i][c];
        largest = std::max(largest, static_cast<double>(std::abs(((*x)[c] - truth) / truth)));
      }
      errors.push_back(largest);
    }
    return median(errors);
  }
};

/// A method of integrate().
template <class System, class Make>
Runner by_integrate(const System& system, const ivp::State& x0, const Make& make) {
  return [system, x0, make](double end, double tolerance) -> std::optional<ivp::State> {
    const auto s = ivp::integrate(system, x0, 0, end, make(tolerance));
    if (!s.status.ok()) return std::nullopt;
    return s.x;
  };
}

/// Odeint's own loop on its own state.
template <std::size_t n, class Plain>
Runner odeint_alone(const Plain& plain, const ivp::State& x0) {
  return [plain, x0](double end, double tolerance) -> std::optional<ivp::State> {
    std::array<double, n> x;
    std::copy(x0.begin(), x0.end(), x.begin());
    const peers::Odeint method{peers::Odeint::Formula::fehlberg78, tolerance, tolerance};
    if (!peers::odeint_natively(method, plain, 0, end, x)) return std::nullopt;
    return ivp::State(Eigen::Map<const Vector<double, static_cast<int>(n)>>(x.data()));
  };
}

std::vector<double> all_tolerances() {
  std::vector<double> all;
  for (int digits = 6; digits <= 15; ++digits) all.push_back(std::pow(10.0, -digits));
  return all;
}

/// The fastest tolerance of a sweep that has the wanted digits; nothing if none has.
template <class Case>
std::optional<Work> fastest(const Case& c, const std::string& label, const Runner& runner,
                            const std::vector<double>& tolerances = all_tolerances()) {
  std::optional<Work> best;
  double least = HUGE_VAL;
  for (const double tolerance : tolerances) {
    const auto error = c.error(runner, tolerance);
    if (!error || !(*error <= wanted)) continue;
    const auto run = [runner, tolerance, end = c.end] {
      auto x = runner(end, tolerance);
      benchmark::DoNotOptimize(x);
    };
    const double seconds = time_repeats(run, 5).smallest;
    if (seconds < least) {
      least = seconds;
      best = Work{fmt::format("{}, {}", c.name, label), run};
      fmt::print("{}, tolerance {:.0e}: error {:.1e}, {:.1f} us\n", best->name, tolerance, *error,
                 1e6 * seconds);
    }
  }
  return best;
}

constexpr const char *alone = "odeint-fehlberg78 alone", *in_our_walk = "odeint-fehlberg78 in our walk";

/// Odeint as its manual runs it, and in our walk; alone with those tolerances alone of which it comes back
/// there.
template <class Case>
void add_odeint(std::vector<Work>& all, const Case& c) {
  if (!peers::odeint_available()) return;
  const Runner walked = by_integrate(ivp::Direct(c.problem), c.x0, [](double tolerance) {
    return peers::OdeintDirect{{peers::Odeint::Formula::fehlberg78, tolerance, tolerance}};
  });
  std::vector<double> safe;
  for (const double tolerance : all_tolerances()) {
    if (c.error(walked, tolerance)) safe.push_back(tolerance);
  }
  if (const auto work = fastest(c, in_our_walk, walked)) all.push_back(*work);
  if (const auto work = fastest(c, alone, odeint_alone<Case::n>(c.plain, c.x0), safe)) all.push_back(*work);
}

/// Ours inlined, ours through the tape, and the library.
template <class Problem, class Plain>
void add_rivals(std::vector<Work>& all, const Case<Problem, Plain>& c) {
  const auto series = [](double tolerance) {
    return ivp::Series{.relative_tolerance = tolerance, .absolute_tolerance = tolerance};
  };
  const auto add = [&](const char* label, const auto& system) {
    if (const auto work = fastest(c, label, by_integrate(system, c.x0, series))) all.push_back(*work);
  };
  add("series inlined", ivp::Direct(c.problem));
  add("series through the tape", ivp::System(c.problem));
  add_odeint(all, c);
}

/// The recurrence of Filipich and Rosales, Eqs. 67 and 68, as one would write it down.
void lorenz_loop(double* a, double* b, double* c, int order) {
  const chapters::PlainLorenz p;
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
  static const ivp::System system{chapters::PlainLorenz{}};
  static const ivp::Direct direct{chapters::PlainLorenz{}};
  const ivp::State x{-3, 2, 21};
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
    add(problem + ", series inlined", problem + ", " + alone, least);
    add(problem + ", " + in_our_walk, problem + ", " + alone,
        0.5);  // a library pays for our walk: at most so much again
    add(problem + ", series through the tape", problem + ", series inlined",
        0.4);  // at most 2.5 times the time
  }
  add("coefficients to order 24, unrolled", "coefficients to order 24, plain loop", 1.5);
  add("coefficients to order 100, tape", "coefficients to order 100, plain loop", 1.1);
  return out;
}

int bench(int argc, char** argv) {
  chapters::begin_speed(argc, argv);

  std::vector<Work> all;
  using chapters::PlainChain, chapters::PlainDuffing, chapters::PlainLorenz;
  add_rivals(all, Case<PlainDuffing, PlainDuffing>("duffing", {}, {1, 0}, 500));
  add_rivals(all, Case<PlainChain, PlainChain>("three-masses", {}, ivp::State::Zero(6), 200));
  add_rivals(all, Case<PlainLorenz, PlainLorenz>("lorenz", {}, {0, 1, 0}, 20));
  add_coefficients(all);
  return chapters::judge_speed("algebraic_series", claims(all), chapters::measure_speed(all));
}

}  // namespace

int main(int argc, char** argv) {
  return nlmech::chapters::speed_main("algebraic_series_bench", &bench, argc, argv);
}
