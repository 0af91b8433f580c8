/// @file
/// `two_body_series_ensemble_bench`: orbits in SIMD lanes against the same orbits one by one, at equal
/// achieved median error, and the multiply-adds alone; by Google Benchmark. Writes
/// results/bench/two_body_series_ensemble.json under the current folder; exit code 1 if a claim does not
/// hold.
#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "chapters/floor.hpp"
#include "chapters/speed.hpp"
#include "chapters/two_body_series/orbits/ellipses.hpp"
#include "nlmech/orbit/ensemble.hpp"

namespace {

using namespace nlmech;
namespace two_body = chapters::two_body_series;
using two_body::revolution;

/// Orbits over some twenty revolutions with reference final positions.
struct Orbits {
  std::string name;
  std::vector<orbit::PropagationRequest> flights;
  std::vector<orbit::Vector3<double>> ends;
  std::vector<double> errors;  ///< median errors at which times are compared
};

/// Ellipses about a point mass from the periapsis; reference in 50 digits.
Orbits ellipses(std::string name, double least, double largest) {
  Orbits orbits{std::move(name), {}, {}, {1e-9, 1e-12}};
  std::mt19937_64 random(21);
  for (int i = 0; i < 512; ++i) {
    const double e = least + (largest - least) * static_cast<double>(random() >> 11U) * 0x1p-53;
    const orbit::State start = two_body::on_ellipse(e);
    const double end = revolution * (19.25 + (i % 16 + 0.5) / 16);
    orbits.flights.push_back({start, end, {}});
    orbits.ends.push_back(two_body::state_in_50_digits(start, end, 1).position.cast<double>());
  }
  return orbits;
}

/// Low orbits in the field of the Earth to J6, in units of its radius. The reference is by doubles with
/// tolerance 1e-16, sufficient for errors of 1e-9.
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

using Shared = std::shared_ptr<const Orbits>;
using Way = std::function<std::vector<orbit::Solution>(double tolerance)>;

Way one_by_one(const Shared& orbits) {
  return [orbits](double tolerance) {
    std::vector<orbit::Solution> ends;
    for (const orbit::PropagationRequest& f : orbits->flights)
      ends.push_back(orbit::propagate(f.start, 0, f.until, f.gravity,
                                      orbit::AnalyticContinuation{.tolerance = tolerance}));
    return ends;
  };
}

Way in_lanes(const Shared& orbits, InstructionSet set) {
  return [orbits, set](double tolerance) {
    return orbit::propagate_all(orbits->flights, {.tolerance = tolerance, .threads = 1, .instructions = set});
  };
}

/// Multiply-adds of a step of order @p n: two sums of products and some twenty others per order about a point
/// mass (kernels/ensemble.hpp), products of 22 pairs of series in a field to J6 (acceleration.hpp).
double multiply_adds_of(const orbit::PropagationRequest& flight, double n) {
  return flight.gravity.degree() == 0 ? n * n + 20 * n : 11 * n * n;
}

/// Multiply-adds of all orbits.
double multiply_adds_of(const Orbits& orbits, const std::vector<orbit::Solution>& ends) {
  double count = 0;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    const auto steps = static_cast<double>(ends[i].statistics.steps),
               orders = static_cast<double>(ends[i].statistics.right_hand_sides);
    count += steps * multiply_adds_of(orbits.flights[i], orders / steps);
  }
  return count;
}

/// The loosest tolerance, by half decades, with a median error of at most @p wanted; nothing if there is
/// none.
std::optional<double> loosest(const Orbits& orbits, const Way& run, double wanted) {
  for (const double tolerance : chapters::half_decades(12, 34)) {
    const auto ends = run(tolerance);
    const auto error = chapters::median_error(ends.size(), [&](std::size_t i) {
      return std::optional((ends[i].x.position - orbits.ends[i]).norm());
    });
    if (error && *error <= wanted) return tolerance;
  }
  return std::nullopt;
}

/// Adds the orbits one by one, in lanes, and the multiply-adds of the lanes alone.
void add_rows(chapters::Speed& all, const Shared& orbits, double wanted) {
  const auto name_of = [&](const std::string& method) {
    return fmt::format("{}, {} to {:g}", orbits->name, method, wanted);
  };
  const std::string single = name_of("one by one");
  const Way alone = one_by_one(orbits);
  if (const auto tolerance = loosest(*orbits, alone, wanted))
    all.add(single, [alone, t = *tolerance] { return alone(t); });
  for (const auto& [set, least] : {std::pair{InstructionSet::avx2, 4}, {InstructionSet::avx512, 5}}) {
    if (!available(set)) continue;
    const std::string computed = name_of(fmt::format("lanes of {}", to_string(set)));
    const Way run = in_lanes(orbits, set);
    const auto tolerance = loosest(*orbits, run, wanted);
    if (!tolerance) continue;
    all.add(computed, [run, t = *tolerance] { return run(t); });
    const double count = multiply_adds_of(*orbits, run(*tolerance));
    all.add(computed + ", multiply-adds alone",
            [instructions = set, count] { return chapters::multiply_adds(instructions, count); });
    all.claim(computed, single, least, computed + " against one by one");
  }
}

void rows(chapters::Speed& all) {
  for (const Orbits& orbits :
       {ellipses("512 orbits, e = 0.1", 0.1, 0.1), ellipses("512 orbits, e = 0.7", 0.7, 0.7),
        ellipses("512 orbits, e in 0 to 0.9", 0, 0.9), low_orbits()}) {
    for (const double wanted : orbits.errors) add_rows(all, std::make_shared<const Orbits>(orbits), wanted);
  }
}

}  // namespace

int main(int argc, char** argv) {
  return nlmech::chapters::speed_main("two_body_series_ensemble", &rows, argc, argv);
}
