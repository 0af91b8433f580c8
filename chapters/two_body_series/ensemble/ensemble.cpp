#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "chapters/two_body_series/orbits/ellipses.hpp"
#include "nlmech/orbit/ensemble.hpp"
#include "nlmech/orbit/kepler.hpp"
#include "nlmech/scene/scene.hpp"
#include "nlmech/support/doubles.hpp"
#include "nlmech/support/stopwatch.hpp"

namespace nlmech::chapters::two_body_series::ensemble {
namespace {

/// Orbits from their periapsis over some twenty revolutions, and where they end.
struct Orbits {
  std::string name;
  std::vector<orbit::Flight> flights;
  std::vector<orbit::Vector3<double>> ends;
};

/// Eccentricities uniform between two bounds, in random order.
Orbits orbits(const std::string& name, double least, double largest, std::size_t count) {
  Orbits o{name, {}, {}};
  std::mt19937_64 random(21);
  for (std::size_t i = 0; i < count; ++i) {
    // As many numbers as the generator's own, so that every library draws the same.
    const double share = static_cast<double>(random() >> 11U) * 0x1p-53;
    const double time = revolution * (19.25 + (static_cast<double>(i % 16) + 0.5) / 16);
    o.flights.push_back({on_ellipse(least + (largest - least) * share), time, {}});
    const auto end = state_in_50_digits(o.flights.back().start, time, 1);
    o.ends.emplace_back(end.position.cast<double>());
  }
  return o;
}

/// A way to move them all, by one thread.
struct Way {
  std::string name;
  std::function<std::vector<orbit::Solution>(std::span<const orbit::Flight>, double tolerance)> run;
};

std::vector<orbit::Solution> one_by_one(std::span<const orbit::Flight> flights, double tolerance) {
  std::vector<orbit::Solution> ends;
  for (const orbit::Flight& f : flights)
    ends.push_back(orbit::propagate(f.start, 0, f.until, f.gravity,
                                    orbit::AnalyticContinuation{.tolerance = tolerance}));
  return ends;
}

Way in_lanes(InstructionSet set) {
  return {fmt::format("lanes, {}", to_string(set)),
          [=](std::span<const orbit::Flight> flights, double tolerance) {
            return orbit::propagate_all(flights, {.tolerance = tolerance, .threads = 1, .instructions = set});
          }};
}

std::vector<Way> ways() {
  std::vector<Way> all = {{"one by one", one_by_one}};
  for (const InstructionSet set : {InstructionSet::baseline, InstructionSet::avx2, InstructionSet::avx512}) {
    if (available(set)) all.push_back(in_lanes(set));
  }
  return all;
}

/// All orbits, one way, one tolerance.
struct Run {
  std::string orbits, way;
  double tolerance;
  double error;    ///< median of |dr|/a
  double steps;    ///< an orbit
  double seconds;  ///< an orbit
};

Run run_of(const Orbits& o, const Way& way, double tolerance, int repeats) {
  const auto ends = way.run(o.flights, tolerance);
  std::vector<double> errors;
  double steps = 0;
  const auto count = static_cast<double>(ends.size());
  for (std::size_t i = 0; i < ends.size(); ++i) {
    errors.push_back((ends[i].x.position - o.ends[i]).norm());
    steps += static_cast<double>(ends[i].statistics.steps) / count;
  }
  const double seconds = time_repeats([&] { (void)way.run(o.flights, tolerance); }, repeats).median;
  return {o.name, way.name, tolerance, median(errors), steps, seconds / count};
}

/// The loosest tolerance, by half decades, with which the median error is at most wanted.
std::optional<Run> to_reach(const Orbits& o, const Way& way, double wanted, int repeats) {
  // No way here leaves less than its tolerance.
  for (int half = static_cast<int>(std::lround(-2 * std::log10(wanted))); half <= 34; ++half) {
    const double tolerance = std::pow(10, -0.5 * half);
    if (run_of(o, way, tolerance, 1).error <= wanted) return run_of(o, way, tolerance, repeats);
  }
  return std::nullopt;
}

/// A row of the table.
struct Comparison {
  std::string orbits, way;
  double wanted;
  Run run;
  double gain;  ///< over one by one
};

struct Outcome {
  std::vector<Comparison> table;
  std::vector<Run> sweep, spread;
  double worst = 0;    ///< error at the default tolerance in units of the bound of the header
  int other_bits = 0;  ///< orbits that come out otherwise in other company
};

std::vector<Comparison> compare(const std::vector<Orbits>& all, bool quick) {
  std::vector<Comparison> rows;
  for (const Orbits& o : all) {
    for (const double wanted : {1e-9, 1e-12}) {
      double single = 0;
      for (const Way& way : ways()) {
        const auto run = to_reach(o, way, wanted, quick ? 1 : 3);
        if (!run) continue;
        if (single == 0) single = run->seconds;
        rows.push_back({o.name, way.name, wanted, *run, single / run->seconds});
      }
    }
  }
  return rows;
}

double worst_error(const Orbits& o) {
  double worst = 0;
  const auto ends = orbit::propagate_all(o.flights);
  for (std::size_t i = 0; i < ends.size(); ++i) {
    const auto n = static_cast<double>(ends[i].statistics.steps);
    const double r = o.ends[i].norm(),
                 kappa = orbit::kepler_condition(o.flights[i].start, o.flights[i].until, 1).position;
    const double bound = kappa * (2 * n * 1e-15 + (8 + std::sqrt(n)) * eps) * r;
    worst = std::max(worst, (ends[i].x.position - o.ends[i]).norm() / bound);
  }
  return worst;
}

bool same_bits(const orbit::Solution& a, const orbit::Solution& b) {
  const auto bits = [](double x) { return std::bit_cast<std::uint64_t>(x); };
  for (int i = 0; i < 3; ++i) {
    if (bits(a.x.position[i]) != bits(b.x.position[i]) || bits(a.x.velocity[i]) != bits(b.x.velocity[i]))
      return false;
  }
  return true;
}

/// Each orbit among all, against itself alone, backwards in the list, with three threads, and in the other
/// width.
int other_bits(const Orbits& o) {
  const auto all = orbit::propagate_all(o.flights);
  std::vector<orbit::Flight> backwards(o.flights.rbegin(), o.flights.rend());
  const auto turned = orbit::propagate_all(backwards, {.threads = 3});
  orbit::TaylorEnsemble other;
  if (best_instruction_set() == InstructionSet::avx512) other.instructions = InstructionSet::avx2;
  const auto narrow = orbit::propagate_all(o.flights, other);
  int count = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto alone = orbit::propagate_all(std::span(&o.flights[i], 1));
    const bool same = same_bits(all[i], alone[0]) && same_bits(all[i], turned[all.size() - 1 - i]) &&
                      same_bits(all[i], narrow[i]);
    count += same ? 0 : 1;
  }
  return count;
}

Outcome measure(bool quick) {
  const std::size_t count = quick ? 32 : 96;
  const std::vector<Orbits> all = {orbits("e = 0.1", 0.1, 0.1, count), orbits("e = 0.7", 0.7, 0.7, count),
                                   orbits("e in 0 to 0.9", 0, 0.9, count)};
  Outcome m;
  m.table = compare(all, quick);
  for (const Way& way : ways()) {
    for (int decade = 6; decade <= 16; decade += quick ? 5 : 2)
      m.sweep.push_back(run_of(all[2], way, std::pow(10, -decade), quick ? 1 : 3));
    for (const double half : {0., 0.15, 0.3, 0.45}) {
      Run run = run_of(orbits("", 0.45 - half, 0.45 + half, count), way, 1e-15, quick ? 1 : 3);
      run.error = 2 * half;  // what the panel is drawn against
      m.spread.push_back(run);
    }
  }
  for (const Orbits& o : all) {
    m.worst = std::max(m.worst, worst_error(o));
    m.other_bits += other_bits(o);
  }
  return m;
}

scene::Table data_of(const Outcome& m) {
  scene::Table data({{"line", 3, true}, {"x"}, {"time_us"}, {"time_ns a step"}, {"steps"}, {"tolerance"}});
  for (const Way& way : ways()) {
    for (const auto& [kind, runs] : {std::pair("errors", &m.sweep), {"spread", &m.spread}}) {
      for (const Run& r : *runs) {
        if (r.way == way.name)
          data.add({fmt::format("{}, {}", way.name, kind), r.error, 1e6 * r.seconds,
                    1e9 * r.seconds / r.steps, r.steps, r.tolerance});
      }
    }
  }
  return data;
}

void put(const Outcome& m, scene::Show& show) {
  show.table(m.table, {{"orbits", &Comparison::orbits},
                       {"wanted", &Comparison::wanted, 1},
                       {"way", &Comparison::way},
                       {"tolerance", [](const Comparison& c) { return c.run.tolerance; }, 2},
                       {"error", [](const Comparison& c) { return c.run.error; }, 2},
                       {"steps an orbit", [](const Comparison& c) { return c.run.steps; }, 4},
                       {"time_us an orbit", [](const Comparison& c) { return 1e6 * c.run.seconds; }},
                       {"time_one by one over it", &Comparison::gain}});
  scene::Plot& plot =
      show.plots("In lanes of a register an orbit takes a tenth of the time, whatever its neighbours are");
  plot.size(1000, 460).data(data_of(m));
  scene::Panel& left = plot.panel("time an orbit (µs), e in 0 to 0.9", "median error |dr|/a");
  left.log_x(1, 500).log_y(1e-14, 1e-3).set("bmargin at screen 0.25").key("off");
  scene::Panel& right =
      plot.panel("spread of the eccentricities about 0.45", "time of a step and orbit (ns)");
  right.x_range(-0.05, 0.95).log_y(10, 1000).set("xtics 0.3").set("bmargin at screen 0.25");
  right.key("at screen 0.5, screen 0.01 center bottom maxrows 1 samplen 3");
  int line = 0;
  for (const Way& way : ways()) {
    left.columns(way.name, "time_us:x", {"linespoints", line + 1}, 2 * line);
    right.columns(way.name, "x:(column('time_ns a step'))", {"linespoints", line + 1}, 2 * line + 1);
    ++line;
  }
  show.equals("orbits with other bits in other company", m.other_bits, 0,
              "no lane knows of another: alone, in another order, by three threads, in AVX2 lanes");
  show.at_most("largest error over the bound of the method", m.worst, 1,
               "condition times (2 n tolerance + (8 + sqrt n) eps), against Kepler's equation in 50 digits");
}

}  // namespace

std::vector<scene::Scene> scenes() {
  const scene::Result outcome(
      "ensemble",
      "96 orbits with a = 1 from their periapsis over 19.3 to 20.2 revolutions; a loosest "
      "tolerance by half decades for each error; median of repeats",
      measure);
  return {{.name = "ensemble",
           .title = "What an orbit costs among many",
           .content = scene::Content(put, outcome)}};
}

}  // namespace nlmech::chapters::two_body_series::ensemble
