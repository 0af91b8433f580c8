/// @file
/// `rbf_ivp_ratios_bench`: the printed ratios of run times of Tables 4.2, 4.4 and 4.6 beside ours, by Google
/// Benchmark. Writes results/ratios/rbf_ivp.json under the current folder.
#include <benchmark/benchmark.h>

#include <functional>
#include <string>
#include <vector>

#include "chapters/rbf_ivp/examples/rows.hpp"
#include "chapters/speed.hpp"
#include "nlmech/scene/program/files.hpp"

namespace {

using namespace nlmech;
using scene::PublishedValue;

constexpr const char* reference_method = "RBF-Coll-2";  // 35 nodes, a step of its own choice

/// A piece of work that is measured.
struct Work {
  std::string name;
  std::function<void()> run;
};

/// "RK4-1 (P/10)" of "RK4-1": the method is followed by its setting.
std::string row_of(const std::vector<PublishedValue>& printed, const std::string& method) {
  for (const PublishedValue& value : printed) {
    if (value.row == method || value.row.starts_with(method + " (")) return value.row;
  }
  throw std::invalid_argument("no seconds are printed for " + method);
}

/// The runs of a table, those of which it shows errors. A method that fails here would have no time worth
/// printing.
void add_works(std::vector<Work>& all, const chapters::rbf_ivp::Example& example,
               const std::vector<PublishedValue>& printed) {
  for (const chapters::rbf_ivp::Row& row : example.rows) {
    const chapters::rbf_ivp::Case& c = example.made();
    const ivp::Solution once = row.procedure(c, c.t1, {});
    if (!once.status.ok()) throw Failure(once.status);
    all.push_back({example.table + ", " + row_of(printed, row.method), [&c, procedure = row.procedure] {
                     auto end = procedure(c, c.t1, {});
                     benchmark::DoNotOptimize(end);
                   }});
  }
}

std::map<std::string, std::string> references(const std::vector<PublishedValue>& printed) {
  std::map<std::string, std::string> all;
  for (const PublishedValue& value : printed) all.emplace(value.row, row_of(printed, reference_method));
  return all;
}

int bench(int argc, char** argv) {
  chapters::begin_speed(argc, argv);
  const std::vector<PublishedValue> published = scene::read_published(scene::data_folder());
  const auto printed = [&published](const std::string& table) {
    return scene::printed_seconds(published, table);
  };
  const auto duffing = chapters::rbf_ivp::free_duffing_rows(), impact = chapters::rbf_ivp::impact_rows();
  const auto masses = chapters::rbf_ivp::three_mass_rows();
  std::vector<Work> all;
  add_works(all, duffing, printed(duffing.table));
  add_works(all, impact, printed(impact.table));
  add_works(all, masses, printed(masses.table));
  const std::vector<scene::BenchSeries> series = chapters::measure_speed(all);
  scene::TimeRatios ratios;
  for (const std::string& table : {duffing.table, impact.table, masses.table}) {
    for (auto& row : scene::compare_times(published, table, references(printed(table)), series))
      ratios.rows.push_back(row);
  }
  return chapters::tell_ratios("rbf_ivp", ratios);
}

}  // namespace

int main(int argc, char** argv) {
  return nlmech::chapters::speed_main("rbf_ivp_ratios_bench", &bench, argc, argv);
}
