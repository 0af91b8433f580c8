/// @file
/// `two_body_series_ratios_bench`: the printed ratios of run times of Tables 3.2 and 3.3, and of the text,
/// beside ours, by Google Benchmark. Writes results/ratios/two_body_series.json under the current folder.
#include <benchmark/benchmark.h>

#include <functional>
#include <string>
#include <vector>

#include "chapters/speed.hpp"
#include "chapters/two_body_series/orbits/published_runs.hpp"
#include "nlmech/scene/program/files.hpp"

namespace {

using namespace nlmech;
namespace two_body = chapters::two_body_series;
using two_body::Orbit;
using two_body::Propagator;

/// A piece of work that is measured.
struct Work {
  std::string name;
  std::function<void()> run;
};

/// Whose times are printed: not those of F and G.
constexpr Propagator timed[] = {Propagator::ode45, Propagator::rkn1210, Propagator::series};

std::vector<Work> works() {
  std::vector<Work> all;
  for (const Orbit& orbit : {two_body::low_orbit(), two_body::high_orbit()}) {
    for (const int orbits : two_body::revolutions) {
      for (const Propagator propagator : timed)
        all.push_back({table_of(orbit) + ", " + row_in_source(orbit, propagator, orbits),
                       timed_work(orbit, orbits, propagator)});
    }
  }
  return all;
}

/// The series over as many orbits.
std::map<std::string, std::string> references(const Orbit& orbit) {
  std::map<std::string, std::string> all;
  for (const int orbits : two_body::revolutions) {
    for (const Propagator propagator : timed)
      all.emplace(row_in_source(orbit, propagator, orbits), row_in_source(orbit, Propagator::series, orbits));
  }
  return all;
}

/// The method that the series is said to be faster than.
Propagator subject_of(const scene::PublishedValue& claim) {
  for (const Propagator propagator : timed) {
    if (claim.quantity == std::string("Analytic-Cont faster than ") + name_of(propagator) + " by")
      return propagator;
  }
  throw std::invalid_argument("no such claim is known: " + claim.name());
}

void add_claims(scene::TimeRatios& all, const Orbit& orbit,
                const std::vector<scene::PublishedValue>& published) {
  for (const scene::PublishedValue& claim : published) {
    if (claim.place != "claim-3.2.2" || claim.row != orbit.name) continue;
    std::vector<std::string> over;
    for (const int orbits : two_body::revolutions)
      over.push_back(row_in_source(orbit, subject_of(claim), orbits));
    all.claims.push_back(scene::mean_claim(claim, table_of(orbit), over, all.rows));
  }
}

int bench(int argc, char** argv) {
  chapters::begin_speed(argc, argv);
  const std::vector<scene::PublishedValue> published = scene::read_published(scene::data_folder());
  const std::vector<Work> all = works();
  const std::vector<scene::BenchSeries> series = chapters::measure_speed(all);
  scene::TimeRatios ratios;
  for (const Orbit& orbit : {two_body::low_orbit(), two_body::high_orbit()}) {
    for (auto& row : scene::compare_times(published, table_of(orbit), references(orbit), series))
      ratios.rows.push_back(row);
    add_claims(ratios, orbit, published);
  }
  return chapters::tell_ratios("two_body_series", ratios);
}

}  // namespace

int main(int argc, char** argv) {
  return nlmech::chapters::speed_main("two_body_series_ratios_bench", &bench, argc, argv);
}
