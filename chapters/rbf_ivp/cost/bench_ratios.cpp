/// @file
/// `rbf_ivp_ratios_bench`: ratios of run times of Tables 4.2, 4.4 and 4.6, printed and measured, by Google
/// Benchmark. Writes results/ratios/rbf_ivp.json under the current folder.
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "chapters/rbf_ivp/examples/rows.hpp"
#include "chapters/speed.hpp"
#include "nlmech/scene/program/files.hpp"
#include "nlmech/support/errors.hpp"

namespace {

using namespace nlmech;
using scene::PublishedValue;

constexpr const char* reference_method = "RBF-Coll-2";  // 35 nodes, long steps

/// Printed row of a method, such as "RK4-1 (P/10)" for "RK4-1".
std::string row_of(const std::vector<PublishedValue>& printed, const std::string& method) {
  for (const PublishedValue& value : printed) {
    if (value.row == method || value.row.starts_with(method + " (")) return value.row;
  }
  throw std::invalid_argument("no seconds are printed for " + method);
}

scene::TimeRatios compare(chapters::Speed& speed) {
  const std::vector<PublishedValue> published = scene::read_published(scene::data_folder());
  const chapters::rbf_ivp::Example examples[] = {chapters::rbf_ivp::free_duffing_rows(),
                                                 chapters::rbf_ivp::impact_rows(),
                                                 chapters::rbf_ivp::three_mass_rows()};
  // The runs of each table. A failed run has no meaningful time.
  for (const chapters::rbf_ivp::Example& example : examples) {
    const chapters::rbf_ivp::Case& c = example.made();
    for (const chapters::rbf_ivp::Row& row : example.rows) {
      const ivp::Solution once = row.procedure(c, c.t1, {});
      if (!once.status.ok()) throw Failure(once.status);
      const auto printed = scene::printed_seconds(published, example.table);
      speed.add(example.table + ", " + row_of(printed, row.method),
                [&c, procedure = row.procedure] { return procedure(c, c.t1, {}); });
    }
  }
  const std::vector<scene::BenchSeries> series = speed.measure();
  scene::TimeRatios ratios;
  for (const chapters::rbf_ivp::Example& example : examples) {
    const auto printed = scene::printed_seconds(published, example.table);
    std::map<std::string, std::string> references;
    for (const PublishedValue& value : printed)
      references.emplace(value.row, row_of(printed, reference_method));
    for (auto& row : scene::compare_times(published, example.table, references, series))
      ratios.rows.push_back(row);
  }
  return ratios;
}

}  // namespace

int main(int argc, char** argv) { return nlmech::chapters::ratios_main("rbf_ivp", &compare, argc, argv); }
