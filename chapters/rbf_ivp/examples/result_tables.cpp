#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "chapters/printed_values.hpp"
#include "chapters/rbf_ivp/examples/rows.hpp"
#include "nlmech/scene/evidence/published.hpp"

namespace nlmech::chapters::rbf_ivp {
namespace {

/// What a row of the table says, in its own columns and in the figure's.
struct Line {
  std::string method, setting, published = "N/A", reading;
  scene::Verdict judged = scene::Verdict::context;
  std::optional<double> published_value = {};
  std::optional<Expected> scatter = {};  ///< of rounding noise, if the printed value is held against that
  std::string name = {};                 ///< as PublishedValue::name(); empty if no error is printed
  double nominal = 0, inferred = 0;
  double milliseconds = 0;
  Statistics statistics = {};

  [[nodiscard]] std::string verdict() const { return std::string(to_string(judged)); }
  [[nodiscard]] bool comes_out() const {
    return judged == scene::Verdict::reproduced || judged == scene::Verdict::reproduced_inferred;
  }
  [[nodiscard]] std::int64_t steps() const { return statistics.steps; }
  [[nodiscard]] std::int64_t right_hand_sides() const { return statistics.right_hand_sides; }
  /// Only where it can be told from the nominal one.
  [[nodiscard]] std::optional<double> inferred_if_apart() const {
    return std::abs(std::log10(inferred / nominal)) > 0.05 ? std::optional(inferred) : std::nullopt;
  }
};

using Records = std::vector<const Record*>;

std::vector<Line> lines(const Example& example, const Records& nominal, const Records& inferred,
                        const std::vector<const double*>& times) {
  const auto printed = printed_values(example.table);
  std::vector<Line> all;
  for (std::size_t i = 0; i < example.rows.size(); ++i) {
    const Row& row = example.rows[i];
    Line line{.method = row.method,
              .setting = row.setting,
              .reading = row.how,
              .nominal = row.nominal_error(*nominal[i]),
              .inferred = row.inferred_error(*inferred[i], example.made().inferred_end),
              .milliseconds = *times[i],
              .statistics = nominal[i]->statistics};
    if (!row.row.empty()) {
      line.name = fmt::format("elgohary/{}/{}/{}", example.table, row.row, example.quantity);
      const scene::PublishedValue& value = printed.at(line.name);
      line.published = value.printed;
      line.published_value = value.value;
      line.judged = scene::judge(value, {line.nominal, line.inferred}).verdict;
      if (line.judged == scene::Verdict::same_rounding) line.scatter = row.nominal;
      if (!value.reading.empty()) line.reading = value.reading;
    }
    all.push_back(std::move(line));
  }
  return all;
}

/// What the title says of the verdicts: "12 printed errors: 8 come out, 1 within roundings, 3 differ".
std::string outcome(const std::vector<Line>& lines) {
  const auto count = [&](auto which) { return std::ranges::count_if(lines, which); };
  const auto printed = count([](const Line& l) { return l.published_value.has_value(); });
  const auto exact = count(&Line::comes_out);
  const auto noise = count([](const Line& l) { return l.judged == scene::Verdict::same_rounding; });
  return fmt::format("{} printed errors: {} come out, {} within roundings, {} differ", printed, exact, noise,
                     printed - exact - noise);
}

/// Rows from the top of the picture.
void draw(const std::vector<Line>& lines, const std::string& example, scene::Show& show) {
  scene::Table data({{"row"},
                     {"method"},
                     {"published"},
                     {"differs"},
                     {"nominal"},
                     {"inferred"},
                     {"scatter_low"},
                     {"scatter_high"},
                     {"time_ms"}});
  std::string names;
  for (int row = 0; const Line& l : lines) {
    std::optional<double> differs, low, high;
    if (l.scatter) {
      low = l.scatter->recorded_low;
      high = l.scatter->recorded_high;
    } else if (!l.comes_out()) {
      differs = l.published_value;
    }
    data.add({++row, l.method, l.published_value, differs, l.nominal, l.inferred_if_apart(), low, high,
              l.milliseconds});
    names += fmt::format("{}{} {}", row > 1 ? ", " : "", scene::gnuplot_quoted(l.method), row);
  }
  scene::Plot& plot = show.plots(example + ", " + outcome(lines));
  const double bottom = static_cast<double>(lines.size()) + 0.7;
  plot.panel("RMS error", "")
      .place(0.16, 0.67, 0.13, 0.85)
      .y_range(bottom, 0.3)
      .log_x()
      .set("xtics 100")
      .set("ytics scale 0 (" + names + ")")
      .key("at screen 0.5, screen 0.925 center top maxrows 1 samplen 1")
      .also(
          "data using \"scatter_low\":\"row\":(column('scatter_high')-column('scatter_low')):(0) "
          "with vectors nohead linewidth 11 linecolor rgb '#c4c4c4' title 'roundings'")
      .columns("ours", "nominal:row", {"points pointtype 7 pointsize 1.1", 1})
      .columns("inferred", "inferred:row", {"points pointtype 5 pointsize 1", 4})
      .columns("printed", "published:row",
               {"points pointtype 6 pointsize 2 linewidth 1.6 linecolor rgb ink", 3})
      .columns("differs", "differs:row",
               {"points pointtype 2 pointsize 1.3 linewidth 1.8 linecolor rgb ink", 3});
  plot.panel("our time (ms)", "")
      .place(0.72, 0.97, 0.13, 0.85)
      .y_range(bottom, 0.3)
      .log_x()
      .set("xtics 10")
      .set("ytics 1")
      .set("format y ''")
      .columns("", "time_ms:row", {"points pointtype 13 pointsize 1.3", 5});
  plot.data(std::move(data));
}

void put(const Example& example, const std::vector<Line>& lines, scene::Show& show) {
  draw(lines, example.title, show);
  show.table(lines, {{"method", &Line::method},
                     {"setting", &Line::setting},
                     {"RMS error, nominal", &Line::nominal, 4},
                     {"RMS error, inferred", &Line::inferred, 4},
                     {"published", &Line::published},
                     {"verdict", &Line::verdict},
                     {"time (ms)", &Line::milliseconds, 2},
                     {"steps", &Line::steps},
                     {"right-hand sides", &Line::right_hand_sides},
                     {"reading", &Line::reading}});
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const Line& line = lines[i];
    const Row& row = example.rows[i];
    if (row.nominal) row.nominal->check("RMS error of " + line.method, line.nominal, show);
    if (row.inferred)
      row.inferred->check("RMS error of " + line.method + ", inferred reading", line.inferred, show);
    if (!line.name.empty()) show.measured(line.name, line.nominal, line.inferred);
  }
}

}  // namespace

scene::Scene result_table(const Example& example) {
  std::vector<scene::Result<Record>> nominal, inferred;
  std::vector<scene::Result<double>> times;
  for (const Row& row : example.rows) {
    nominal.push_back(example.nominal(row));
    inferred.push_back(example.inferred(row));
    times.push_back(example.time(row));
  }
  const auto show = [example](const Records& as_printed, const Records& as_inferred,
                              const std::vector<const double*>& milliseconds, scene::Show& to) {
    put(example, lines(example, as_printed, as_inferred, milliseconds), to);
  };
  return {.name = example.table,
          .title = example.title + ": step, error and time of each run, published beside ours",
          .place = "Table " + example.table.substr(6),
          .content = scene::Content(show, nominal, inferred, times)};
}

}  // namespace nlmech::chapters::rbf_ivp
