#include <fmt/format.h>

#include <cmath>

#include "chapters/printed_values.hpp"
#include "chapters/rbf_ivp/examples/rows.hpp"
#include "nlmech/scene/published.hpp"

namespace nlmech::chapters::rbf_ivp {
namespace {

using scene::Workshop;

template <int n>
std::string name_in_source(const Example<n>& example, const Row<n>& row) {
  return fmt::format("elgohary/{}/{}/{}", example.table, row.reading.row, example.quantity);
}

template <int n>
scene::Measured measure(const Example<n>& example, const Row<n>& row, Workshop& w) {
  return {row.nominal_error(w), row.inferred_error(w, example.made().inferred_end)};
}

/// What a row of the table says, in its own columns and in the figure's.
struct Line {
  std::string method, setting, published, verdict, reading;
  std::optional<double> published_value;
  scene::Measured ours;
  double milliseconds;
  Statistics statistics;
};

template <int n>
std::vector<Line> lines(const Example<n>& example, Workshop& w) {
  const auto printed = printed_values(example.table);
  std::vector<Line> all;
  for (const Row<n>& row : example.rows) {
    const Record<n>& record = w.result(*row.nominal);
    Line line{row.reading.method,
              row.reading.setting,
              "N/A",
              "context",
              row.nominal->reading(),
              {},
              measure(example, row, w),
              w.result(*row.time),
              record.statistics};
    if (!row.reading.row.empty()) {
      const scene::PublishedValue& value = printed.at(name_in_source(example, row));
      line.published = value.printed;
      line.published_value = value.value;
      line.verdict = to_string(scene::judge(value, line.ours).verdict);
      line.reading = value.reading.empty() ? row.nominal->reading() : value.reading;
    }
    all.push_back(std::move(line));
  }
  return all;
}

scene::Table tabulate(const std::vector<Line>& lines) {
  scene::Table table({{"method"},
                      {"setting"},
                      {"RMS error, nominal", 4},
                      {"RMS error, inferred", 4},
                      {"published"},
                      {"verdict"},
                      {"time (ms)", 2},
                      {"steps"},
                      {"right-hand sides"},
                      {"reading"}});
  for (const Line& l : lines) {
    table.add({l.method, l.setting, scene::to_cell(l.ours.nominal), scene::to_cell(l.ours.inferred),
               l.published, l.verdict, l.milliseconds, l.statistics.steps, l.statistics.right_hand_sides,
               l.reading});
  }
  return table;
}

/// Rows from the top of the picture; an inferred error only where it can be told from the nominal one.
scene::Figure draw(const std::vector<Line>& lines, const std::string& example) {
  scene::Table data({{"row"}, {"method"}, {"published"}, {"nominal"}, {"inferred"}, {"time_ms"}});
  int within_ten_percent = 0, printed = 0;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const Line& l = lines[i];
    const bool apart = std::abs(std::log10(*l.ours.inferred / *l.ours.nominal)) > 0.05;
    data.add({std::int64_t(i) + 1, l.method, scene::to_cell(l.published_value), *l.ours.nominal,
              scene::to_cell(apart ? l.ours.inferred : std::nullopt), l.milliseconds});
    if (!l.published_value) continue;
    ++printed;
    within_ten_percent += std::abs(*l.ours.inferred / *l.published_value - 1) < 0.1 ? 1 : 0;
  }
  return {std::move(data),
          "rbf_ivp-results",
          {{"heading", fmt::format("{}: {} of {} printed errors come out within 10 %", example,
                                   within_ten_percent, printed)},
           {"rows", fmt::format("{}", lines.size())}}};
}

template <int n>
std::vector<scene::Quantity> promises(const Example<n>& example, Workshop& w) {
  std::vector<scene::Quantity> all;
  const auto promise = [&](const std::string& name, double value, const std::optional<Expected>& expected) {
    if (expected) all.push_back({name, "1", value, expected->low, expected->high, expected->reason});
  };
  for (const Row<n>& row : example.rows) {
    const auto [nominal, inferred] = measure(example, row, w);
    promise("RMS error of " + row.reading.method, *nominal, row.reading.nominal);
    promise("RMS error of " + row.reading.method + ", inferred reading", *inferred, row.reading.inferred);
  }
  return all;
}

template <int n>
void add(scene::Chapter& chapter, const Example<n>& example) {
  std::vector<const scene::AnyRun*> needs;
  for (const Row<n>& row : example.rows) {
    for (const scene::AnyRun* run : row.needs()) needs.push_back(run);
    needs.push_back(row.time);
    if (row.reading.row.empty()) continue;
    chapter.add(scene::Measurement{name_in_source(example, row), row.needs(),
                                   [example, row](Workshop& w) { return measure(example, row, w); }});
  }
  chapter.add({.name = example.table,
               .title = example.title + ": step, error and time of each run, published beside ours",
               .place = "Table " + example.table.substr(6),
               .needs = needs,
               .show = [example](Workshop& w) {
                 const std::vector<Line> all = lines(example, w);
                 return scene::Showing{draw(all, example.title), tabulate(all), promises(example, w)};
               }});
}

}  // namespace

void add_result_table(scene::Chapter& chapter, const Example<2>& example) { add(chapter, example); }

void add_result_table(scene::Chapter& chapter, const Example<6>& example) { add(chapter, example); }

}  // namespace nlmech::chapters::rbf_ivp
