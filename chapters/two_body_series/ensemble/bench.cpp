/// @file
/// `two_body_series_ensemble_bench`: orbits in lanes against the same orbits one by one, at equal achieved
/// median error, and beside them the multiply-adds alone; by Google Benchmark. Writes
/// results/bench/two_body_series_ensemble.json under the current folder; exit code 1 if a claim is not held.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "chapters/floor.hpp"
#include "chapters/speed.hpp"
#include "nlmech/orbit/ensemble.hpp"
#include "nlmech/orbit/kepler.hpp"
#include "nlmech/support/extended_real.hpp"
#include "nlmech/support/stopwatch.hpp"

namespace {

using namespace nlmech;
using Real = ExtendedReal<50>;

/// Orbits from their periapsis over some twenty revolutions, and where they end.
struct Orbits {
  std::string name;
  std::vector<orbit::Flight> flights;
  std::vector<orbit::Vector3<double>> ends;
  std::vector<double> errors;  ///< median ones that are compared
};

constexpr double revolution = 6.283185307179586;

/// About a point mass; the ends in 50 digits.
Orbits ellipses(std::string name, double least, double largest) {
  Orbits orbits{std::move(name), {}, {}, {1e-9, 1e-12}};
  std::mt19937_64 random(21);
  for (int i = 0; i < 512; ++i) {
    const double e = least + (largest - least) * static_cast<double>(random() >> 11U) * 0x1p-53;
    const orbit::State start{{1 - e, 0, 0}, {0, std::sqrt((1 + e) / (1 - e)), 0}};
    orbits.flights.push_back({start, revolution * (19.25 + (i % 16 + 0.5) / 16), {}});
    const orbit::BasicState<Real> s{start.position.cast<Real>(), start.velocity.cast<Real>()};
    const auto c = orbit::lagrange_coefficients(s, Real(orbits.flights.back().until), Real(1));
    orbits.ends.push_back(orbit::moved(s, c).position.cast<double>());
  }
  return orbits;
}

/// Low ones in the field of the Earth to J6, in units of its radius; the ends are as exact as doubles are,
/// which is enough for 1e-9.
Orbits low_orbits() {
  Orbits orbits{"512 low orbits, J2 to J6", {}, {}, {1e-9}};
  orbit::Gravity field = orbit::earth(6);
  field.mu = field.radius = 1;
  for (int i = 0; i < 512; ++i) {
    const double r = 1.1 + 0.1 * i / 512, v = std::sqrt((1 + 0.02 * (i % 7) / 7) / r), slope = 0.3 * (i % 11);
    const orbit::State start{{r, 0, 0}, {0, v * std::cos(slope), v * std::sin(slope)}};
    orbits.flights.push_back({start, revolution * 1.2 * 19.25, field});
    const orbit::AnalyticContinuation fine{.tolerance = 1e-16};
    orbits.ends.push_back(orbit::propagate(start, 0, orbits.flights.back().until, field, fine).x.position);
  }
  return orbits;
}

using Way = std::function<std::vector<orbit::Solution>(const Orbits&, double tolerance)>;

std::vector<orbit::Solution> one_by_one(const Orbits& orbits, double tolerance) {
  std::vector<orbit::Solution> ends;
  for (const orbit::Flight& f : orbits.flights)
    ends.push_back(orbit::propagate(f.start, 0, f.until, f.gravity,
                                    orbit::AnalyticContinuation{.tolerance = tolerance}));
  return ends;
}

Way in_lanes(InstructionSet set, int threads) {
  return [=](const Orbits& orbits, double tolerance) {
    return orbit::propagate_all(orbits.flights,
                                {.tolerance = tolerance, .threads = threads, .instructions = set});
  };
}

/// Multiply-adds of a step of order @p n: about a point mass two sums of products and some twenty others an
/// order (kernels/ensemble.hpp), in a field to J6 the products of 22 pairs of series (acceleration.hpp).
double multiply_adds_of(const orbit::Flight& flight, double n) {
  return flight.gravity.degree() == 0 ? n * n + 20 * n : 11 * n * n;
}

/// A piece of work that is measured.
struct Work {
  std::string name;
  std::function<void()> run;
  double tolerance = 0;  ///< at which it is done
};

/// With the loosest tolerance, by half decades, whose median error is as wanted.
std::optional<Work> work_to(const Orbits& orbits, const std::string& way, const Way& run, double wanted) {
  for (int half = 12; half <= 34; ++half) {
    const double tolerance = std::pow(10, -0.5 * half);
    const auto ends = run(orbits, tolerance);
    std::vector<double> errors;
    double steps = 0;
    for (std::size_t i = 0; i < ends.size(); ++i) {
      errors.push_back((ends[i].x.position - orbits.ends[i]).norm());
      steps += static_cast<double>(ends[i].statistics.steps) / static_cast<double>(ends.size());
    }
    if (!(median(errors) <= wanted)) continue;
    const std::string name = fmt::format("{}, {} to {:g}", orbits.name, way, wanted);
    const double seconds =
        time_repeats([&] { (void)run(orbits, tolerance); }, 5).smallest / static_cast<double>(ends.size());
    fmt::print("{}: tolerance {:.1e}, error {:.1e}, {:.1f} steps, {:.2f} us an orbit, {:.1f} ns a step\n",
               name, tolerance, median(errors), steps, 1e6 * seconds, 1e9 * seconds / steps);
    return Work{name,
                [&orbits, run, tolerance] {
                  auto all = run(orbits, tolerance);
                  benchmark::DoNotOptimize(all);
                },
                tolerance};
  }
  return std::nullopt;
}

/// The multiply-adds of the orbits in lanes, and nothing else.
Work floor_of(const Orbits& orbits, InstructionSet set, double tolerance, const std::string& name) {
  double count = 0;
  const auto ends = in_lanes(set, 1)(orbits, tolerance);
  for (std::size_t i = 0; i < ends.size(); ++i) {
    const auto steps = static_cast<double>(ends[i].statistics.steps),
               orders = static_cast<double>(ends[i].statistics.right_hand_sides);
    count += steps * multiply_adds_of(orbits.flights[i], orders / steps);
  }
  return {name + ", multiply-adds alone",
          [set, count] {
            double sum = chapters::multiply_adds(set, count);
            benchmark::DoNotOptimize(sum);
          },
          tolerance};
}

int bench(int argc, char** argv) {
  chapters::begin_speed(argc, argv);
  const std::vector<Orbits> all_orbits = {ellipses("512 orbits, e = 0.1", 0.1, 0.1),
                                          ellipses("512 orbits, e = 0.7", 0.7, 0.7),
                                          ellipses("512 orbits, e in 0 to 0.9", 0, 0.9), low_orbits()};
  std::vector<Work> all;
  std::vector<scene::SpeedClaim> claims;
  for (const Orbits& orbits : all_orbits) {
    for (const double wanted : orbits.errors) {
      const auto single = work_to(orbits, "one by one", one_by_one, wanted);
      if (!single) continue;
      all.push_back(*single);
      const auto add = [&](InstructionSet set, double least) {
        if (!available(set)) return;
        const auto ours =
            work_to(orbits, fmt::format("lanes of {}", to_string(set)), in_lanes(set, 1), wanted);
        if (!ours) return;
        all.push_back(*ours);
        all.push_back(floor_of(orbits, set, ours->tolerance, ours->name));
        claims.push_back({fmt::format("{} against one by one", ours->name), ours->name, single->name, least});
      };
      add(InstructionSet::avx2, 4);
      add(InstructionSet::avx512, 5);
    }
  }
  return chapters::judge_speed("two_body_series_ensemble", claims, chapters::measure_speed(all));
}

}  // namespace

int main(int argc, char** argv) {
  return nlmech::chapters::speed_main("two_body_series_ensemble_bench", &bench, argc, argv);
}
