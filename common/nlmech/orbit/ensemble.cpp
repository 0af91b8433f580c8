#include "nlmech/orbit/ensemble.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <stdexcept>

#include "nlmech/orbit/lanes.hpp"
#include "nlmech/orbit/zonal_lanes.hpp"
#include "nlmech/support/doubles.hpp"
#include "nlmech/support/sentences.hpp"
#include "nlmech/support/stopwatch.hpp"
#include "nlmech/support/threads.hpp"

namespace nlmech::orbit {
namespace {

const kernels::EnsembleKernel& kernel_for(InstructionSet set) {
  require_available(set);
#if defined(__x86_64__)
  if (set == InstructionSet::avx512) return kernels::avx512_ensemble;
  if (set == InstructionSet::avx2) return kernels::avx2_ensemble;
#endif
  return kernels::baseline_ensemble;
}

/// The order at which orbits of e = 0.1, 0.5 and 0.9 take the least time, measured from 1e-6 to 1e-17 with
/// AVX-512 and AVX2: 20, 21, 22, 24, 28 and 30 at 1e-8, -9, -10, -12, -15 and -17. An order beside it costs
/// 1 or 2 percent.
int order_for(double tolerance) {
  const auto half = static_cast<int>(std::lround((9.8 - 0.52 * std::log(tolerance)) / 2));
  return 2 * std::clamp(half, 6, kernels::most_ensemble_order / 2);
}

kernels::LaneSettings settings_of(const TaylorEnsemble& m) {
  kernels::LaneSettings s;
  s.order = m.order != 0 ? m.order : order_for(m.tolerance);
  s.wanted = 2 * std::log2(m.tolerance);
  s.longest = std::log2(std::max(1.5, std::log(m.tolerance / eps)));  // as in AnalyticContinuation
  s.last_weight = 2 * std::log2(s.order);
  s.last_power = 0.5 / (s.order - 1);
  s.before_weight = 2 * std::log2(s.order - 1);
  s.before_power = 0.5 / (s.order - 2);
  return s;
}

void check_options(const TaylorEnsemble& m, const InnerRows& rows) {
  if (!(m.tolerance >= 1e-18 && m.tolerance <= 0.1))
    throw invalid_argument("{}: tolerance must be from 1e-18 to 0.1, not {:g}", m.name, m.tolerance);
  if (m.order != 0 &&
      (m.order % 2 != 0 || m.order < kernels::least_ensemble_order || m.order > kernels::most_ensemble_order))
    throw invalid_argument("{}: order must be even, from {} to {}, not {}", m.name,
                           kernels::least_ensemble_order, kernels::most_ensemble_order, m.order);
  if (m.threads < 0 || m.threads > 1024)
    throw invalid_argument("{}: threads must be from 0 to 1024, not {}", m.name, m.threads);
  if (!(rows.every > 0)) throw invalid_argument("{}: every must be positive, not {:g}", m.name, rows.every);
}

/// Why a flight cannot begin.
Status refusal(const Flight& flight) {
  try {
    check(flight.start, "propagate_all");
    check(flight.gravity);
  } catch (const std::invalid_argument& error) {
    const bool finite = flight.start.position.allFinite() && flight.start.velocity.allFinite();
    const bool centre = finite && flight.start.position.isZero(0);
    return Status::failure(!finite  ? Outcome::non_finite
                           : centre ? Outcome::collision
                                    : Outcome::outside_validity,
                           error.what());
  }
  if (!std::isfinite(flight.until))
    return failed_with(Outcome::non_finite, "propagate_all: the end time must be finite, not {}",
                       flight.until);
  return {};
}

/// What all threads share: flights are handed out some at a time, and who flies which does not matter.
struct Ensemble {
  std::span<const Flight> flights;
  const TaylorEnsemble& method;
  const InnerRows& rows;
  const Limits& limits;
  const kernels::EnsembleKernel& kernel;
  kernels::LaneSettings settings;
  std::vector<Solution> solutions;
  std::vector<char> is_zonal;  // by flight; bytes, which threads write side by side
  Stopwatch watch;
  std::atomic<std::size_t> next = 0;

  [[nodiscard]] bool out_of_time() const {
    return std::isfinite(limits.seconds) && watch.seconds() > limits.seconds;
  }
  [[nodiscard]] Status too_late() const {
    return failed_with(Outcome::time_limit, "{}: {:g} seconds were used up; allow more", TaylorEnsemble::name,
                       limits.seconds);
  }

  /// Of one thread.
  void work() {
    detail::Lanes lanes(kernel, settings, rows, limits.steps);
    // Few flights are shared among all threads, and leave lanes idle: the first thread would take them all.
    const std::size_t threads = threads_for(method.threads),
                      portion = std::clamp<std::size_t>((flights.size() + threads - 1) / threads, 1, 16);
    std::size_t number = 0, end = 0;
    for (bool more = true; more || lanes.busy() > 0;) {
      while (more && lanes.free() > 0 && static_cast<std::size_t>(lanes.busy()) < portion) {
        if (number == end) {
          number = std::min(next.fetch_add(portion), flights.size());
          end = std::min(number + portion, flights.size());
          more = number < end;
          continue;
        }
        begin(number++, lanes);
      }
      if (lanes.busy() == 0) continue;
      lanes.run(solutions);
      if (out_of_time()) lanes.stop(too_late(), solutions);
    }
  }

  /// What work() has left: flights with zonal terms. One that fails is repeated by AnalyticContinuation, for
  /// a sentence in the user's units, and because it may arrive.
  void fly_the_rest() {
    std::vector<std::size_t> rest;
    for (std::size_t i = 0; i < is_zonal.size(); ++i) {
      if (is_zonal[i] != 0) rest.push_back(i);
    }
    if (rest.empty()) return;
    detail::fly_in_zonal_fields(
        flights, rest, method, rows, limits.steps, [this] { return out_of_time(); }, solutions);
    share_out(rest.size(), 1, method.threads, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        Solution& solution = solutions[rest[i]];
        if (!solution.status.ok()) repeat(rest[i], solution);
      }
    });
  }

 private:
  [[nodiscard]] double left() const { return std::max(0.0, limits.seconds - watch.seconds()); }
  /// By itself, if there is time; else it stays where it is.
  void repeat(std::size_t number, Solution& solution) const {
    if (!out_of_time()) {
      Solution again = alone(number, std::abs(solution.t));
      const bool is_behind = std::abs(again.t) < std::abs(solution.t);
      if (again.status.outcome() != Outcome::time_limit || !is_behind) {
        solution = std::move(again);
        return;
      }
    }
    solution.status = too_late();
  }
  /// @param shown up to where rows have been given already
  [[nodiscard]] Solution alone(std::size_t number, double shown) const {
    const Flight& flight = flights[number];
    auto count = std::max<std::int64_t>(1, static_cast<std::int64_t>(shown / rows.every));
    while (static_cast<double>(count) * rows.every <= shown) ++count;
    const double sign = flight.until < 0 ? -1 : 1, until = std::abs(flight.until);
    Observer observer;
    if (rows.sink) {
      observer = [&](const Step& step) {
        for (;; ++count) {
          const double t = static_cast<double>(count) * rows.every;
          if (!(t <= std::abs(step.t1) && until - t > 1e-9 * rows.every)) return true;
          rows.sink(number, sign * t, step.at(sign * t));
        }
      };
    }
    Limits own = limits;
    own.seconds = left();
    Solution solution = propagate(flight.start, 0, flight.until, flight.gravity,
                                  AnalyticContinuation{.tolerance = method.tolerance}, observer, own);
    solution.statistics.seconds = 0;
    return solution;
  }

  void begin(std::size_t number, detail::Lanes& lanes) {
    const Flight& flight = flights[number];
    Solution& solution = solutions[number];
    solution.x = flight.start;
    solution.status = refusal(flight);
    if (!solution.status.ok() || flight.until == 0) return;
    if (out_of_time()) {
      solution.status = too_late();
    } else if (flight.gravity.degree() > 0) {
      is_zonal[number] = 1;
    } else {
      lanes.take_in(number, flight);
    }
  }
};

}  // namespace

std::vector<Solution> propagate_all(std::span<const Flight> flights, const TaylorEnsemble& method,
                                    const InnerRows& rows, const Limits& limits) {
  check_options(method, rows);
  Ensemble ensemble{.flights = flights,
                    .method = method,
                    .rows = rows,
                    .limits = limits,
                    .kernel = kernel_for(method.instructions.value_or(best_instruction_set())),
                    .settings = settings_of(method),
                    .solutions = std::vector<Solution>(flights.size()),
                    .is_zonal = std::vector<char>(flights.size()),
                    .watch = {}};
  in_threads(std::min(threads_for(method.threads), flights.size()), [&ensemble] { ensemble.work(); });
  ensemble.fly_the_rest();
  return std::move(ensemble.solutions);
}

}  // namespace nlmech::orbit
