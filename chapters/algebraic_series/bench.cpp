/// @file
/// `algebraic_series_bench`: Taylor series against the fastest classical formula of high order in its own
/// library loop, compiled with the problem; overhead of the nlmech step loop for that formula; by Google
/// Benchmark. Exit code 1 if a claim does not hold.
#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "chapters/native_peers.hpp"
#include "chapters/plain_equations.hpp"
#include "chapters/speed.hpp"
#include "nlmech/ivp/series/series.hpp"
#include "nlmech/peers/ivp/odeint/odeint_direct.hpp"
#include "nlmech/problems/reference_trajectory.hpp"

namespace {

using namespace nlmech;

constexpr double wanted = 1e-9;  // relative error
constexpr std::size_t end_times = 16;
constexpr auto fehlberg78 = peers::Odeint::Formula::fehlberg78;

/// Integrates to a time with a tolerance; returns the state, or nothing after a failure.
using Runner = std::function<std::optional<ivp::State>(double end, double tolerance)>;

/// Runner of a method by integrate().
template <class System, class Make>
Runner by_integrate(const System& system, const ivp::State& x0, const Make& make) {
  return [system, x0, make](double end, double tolerance) -> std::optional<ivp::State> {
    const auto s = ivp::integrate(system, x0, 0, end, make(tolerance));
    if (!s.status.ok()) return std::nullopt;
    return s.x;
  };
}

/// The largest relative error of a component.
double error_of(const ivp::State& found, const ivp::LongState& reference) {
  return static_cast<double>(((found.cast<long double>() - reference).array() / reference.array())
                                 .abs()
                                 .maxCoeff<Eigen::PropagateNaN>());
}

/// Adds the series, and the library formula alone and in the nlmech loop. Each uses the fastest tolerance
/// whose median error over the end times is at most `wanted`.
/// @param least claimed speed ratio of the series to the library
template <class Problem>
void add_rivals(chapters::Speed& all, const std::string& name, const ivp::State& x0, double end,
                double least) {
  const Problem problem;
  const problems::ReferenceTrajectory<long double, Problem> path(problem, x0.cast<long double>(), 0, end);
  const auto median_of = [&](const Runner& run, double tolerance) {
    return chapters::median_error(end_times, [&](std::size_t i) -> std::optional<double> {
      const double time = end * (1 - 0.002 * static_cast<double>(i));
      const auto x = run(time, tolerance);
      return x ? std::optional(error_of(*x, path(time))) : std::nullopt;
    });
  };
  const auto add = [&](const std::string& label, const Runner& run, const Runner& first) {
    const auto error = [&](double tolerance) -> std::optional<double> {
      if (first && !median_of(first, tolerance)) return std::nullopt;
      return median_of(run, tolerance);
    };
    all.add(chapters::fastest(label, chapters::half_decades(12, 30, 2), wanted, error,
                              [run, end](double tolerance) { return run(end, tolerance); }));
  };
  const auto series = [](double tolerance) {
    return ivp::Series{.relative_tolerance = tolerance, .absolute_tolerance = tolerance};
  };
  const ivp::Direct direct(problem);
  const std::string by_series = name + ", series", in_loop = name + ", odeint-fehlberg78 in our loop",
                    alone = name + ", odeint-fehlberg78 alone";
  add(by_series, by_integrate(ivp::System(problem), x0, series), {});
  if (peers::odeint_available()) {
    const Runner stepped = by_integrate(direct, x0, [](double tolerance) {
      return peers::OdeintDirect{{fehlberg78, tolerance, tolerance}};
    });
    const auto native = chapters::odeint_alone<Problem::dimension>(problem, fehlberg78);
    add(in_loop, stepped, {});
    // The library's own loop may not terminate: skip tolerances that fail in the nlmech loop.
    add(
        alone,
        [native, x0](double until, double tolerance) -> std::optional<ivp::State> {
          ivp::State x = x0;
          if (!native(tolerance, tolerance, 0, until, x.data())) return std::nullopt;
          return x;
        },
        stepped);
  }
  all.claim(by_series, alone, least);
  all.claim(in_loop, alone, 0.5);  // at most twice the time in the nlmech loop
}

void rows(chapters::Speed& all) {
  add_rivals<chapters::PlainDuffing>(all, "duffing", {1, 0}, 500, 2.5);
  add_rivals<chapters::PlainChain>(all, "three-masses", ivp::State::Zero(6), 200, 3.6);
  add_rivals<chapters::PlainLorenz>(all, "lorenz", {0, 1, 0}, 20, 3.0);
}

}  // namespace

int main(int argc, char** argv) {
  return nlmech::chapters::speed_main("algebraic_series", &rows, argc, argv);
}
