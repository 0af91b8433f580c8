#include <fmt/format.h>

#include <string>
#include <vector>

#include "chapters/printed_values.hpp"
#include "chapters/rbf_ivp/examples/rows.hpp"
#include "nlmech/scene/evidence/published.hpp"

namespace nlmech::chapters::rbf_ivp {
namespace {

/// A table row.
struct Line {
  std::string method, setting, published = "N/A", reading;
  scene::Verdict judged = scene::Verdict::context;
  std::string name = {};  ///< PublishedValue::name(); empty if no error is printed
  scene::Measured errors = {};
  double milliseconds = 0;
  Statistics statistics = {};

  std::string missing = {};  ///< what the text does not state, so that there is no nominal error

  /// The nominal error, or the reason why there is none.
  [[nodiscard]] scene::Cell nominal() const {
    return errors.nominal ? scene::Cell(*errors.nominal) : scene::Cell("cannot be run: " + missing);
  }
  [[nodiscard]] std::string verdict() const { return std::string(to_string(judged)); }
  [[nodiscard]] std::int64_t steps() const { return statistics.steps; }
  [[nodiscard]] std::int64_t right_hand_sides() const { return statistics.right_hand_sides; }
};

using Records = std::vector<const Record*>;

/// Nominal and inferred error; no nominal one if the text does not state all settings.
scene::Measured errors_of(const Example& example, const Row& row, const Record& literal,
                          const Record& inferred) {
  const Case& c = example.made();
  std::string setting = row.setting_text(c);
  if (!example.borrowed.empty()) setting += "; " + example.borrowed;
  return {*row.missing == '\0' ? std::optional(row.nominal_error(literal)) : std::nullopt,
          row.inferred_error(inferred, c.inferred_end), std::move(setting)};
}

std::vector<Line> lines(const Example& example, const Records& literal, const Records& inferred,
                        const std::vector<const double*>& times) {
  const auto printed = printed_values(example.table);
  std::vector<Line> all;
  for (std::size_t i = 0; i < example.rows.size(); ++i) {
    const Row& row = example.rows[i];
    Line line{.method = row.method,
              .setting = row.setting,
              .reading = {},
              .errors = errors_of(example, row, *literal[i], *inferred[i]),
              .milliseconds = *times[i],
              .statistics = literal[i]->statistics};
    line.reading = line.errors.setting;
    line.missing = row.missing;
    if (!row.row.empty()) {
      line.name = fmt::format("elgohary/{}/{}/{}", example.table, row.row, example.quantity);
      const scene::PublishedValue& value = printed.at(line.name);
      line.published = value.printed;
      line.judged = scene::verdict_on(value, line.errors).verdict;
      if (!value.reading.empty()) line.reading += "; " + value.reading;
    }
    all.push_back(std::move(line));
  }
  return all;
}

void put(const Example& example, const std::vector<Line>& lines, scene::Show& show) {
  show.table(lines, {{"method", &Line::method},
                     {"setting", &Line::setting},
                     {"RMS error, nominal", &Line::nominal, 4},
                     {"RMS error, inferred", [](const Line& l) { return l.errors.inferred; }, 4},
                     {"published", &Line::published},
                     {"verdict", &Line::verdict},
                     {"time (ms)", &Line::milliseconds, 2},
                     {"steps", &Line::steps},
                     {"right-hand sides", &Line::right_hand_sides},
                     {"reading", &Line::reading}});
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const Line& line = lines[i];
    const Row& row = example.rows[i];
    const scene::Measured& errors = line.errors;
    // The figures check the runs with the exact period.
    const std::optional<Expected>& nominal = row.literal_procedure ? row.literal : row.nominal;
    if (nominal && errors.nominal) nominal->check("RMS error of " + line.method, *errors.nominal, show);
    if (row.inferred)
      row.inferred->check("RMS error of " + line.method + ", inferred reading", *errors.inferred, show);
    if (!line.name.empty()) show.measured(line.name, errors.nominal, errors.inferred, errors.setting);
  }
}

}  // namespace

scene::Scene result_table(const Example& example) {
  std::vector<scene::Result<Record>> literal, inferred;
  std::vector<scene::Result<double>> times;
  for (const Row& row : example.rows) {
    literal.push_back(example.literal(row));
    inferred.push_back(example.inferred(row));
    times.push_back(example.time(row));
  }
  const auto show = [example](const Records& as_printed, const Records& as_inferred,
                              const std::vector<const double*>& milliseconds, scene::Show& to) {
    put(example, lines(example, as_printed, as_inferred, milliseconds), to);
  };
  return {.name = example.table,
          .title = example.title + ": step, error and time of each run, published and recomputed",
          .place = "Table " + example.table.substr(6),
          .content = scene::Content(show, literal, inferred, times)};
}

}  // namespace nlmech::chapters::rbf_ivp
