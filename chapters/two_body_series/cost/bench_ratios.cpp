/// @file
/// `two_body_series_ratios_bench`: ratios of run times of Tables 3.2 and 3.3 and of the text, printed and
/// measured, by Google Benchmark. Writes results/ratios/two_body_series.json under the current folder.
#include <map>
#include <stdexcept>
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

/// Propagators with printed times; none are printed for F and G.
constexpr Propagator timed[] = {Propagator::ode45, Propagator::rkn1210, Propagator::series};

/// The method compared with the series in a published claim. @throws std::invalid_argument for an unknown
/// claim
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

scene::TimeRatios compare(chapters::Speed& speed) {
  const std::vector<Orbit> all_orbits = {two_body::low_orbit(), two_body::high_orbit()};
  std::map<std::string, std::map<std::string, std::string>> references;  // the series over as many orbits
  for (const Orbit& orbit : all_orbits) {
    for (const int orbits : two_body::revolutions) {
      for (const Propagator propagator : timed) {
        const std::string row = row_in_source(orbit, propagator, orbits);
        references[table_of(orbit)].emplace(row, row_in_source(orbit, Propagator::series, orbits));
        speed.add(table_of(orbit) + ", " + row, timed_work(orbit, orbits, propagator));
      }
    }
  }
  const std::vector<scene::PublishedValue> published = scene::read_published(scene::data_folder());
  const std::vector<scene::BenchSeries> series = speed.measure();
  scene::TimeRatios ratios;
  for (const Orbit& orbit : all_orbits) {
    for (auto& row : scene::compare_times(published, table_of(orbit), references[table_of(orbit)], series))
      ratios.rows.push_back(row);
    add_claims(ratios, orbit, published);
  }
  return ratios;
}

}  // namespace

int main(int argc, char** argv) {
  return nlmech::chapters::ratios_main("two_body_series", &compare, argc, argv);
}
