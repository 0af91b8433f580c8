#include "nlmech/scene/work_precision.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace nlmech::scene {
namespace {

constexpr const char* small_font = "font sprintf(\"%s,%d\", font_family, font_size - 3)";

/// Below rounding a double has no digits.
std::optional<double> digits_of(const Attempt& a) {
  if (!a.error) return {};
  return -std::log10(std::max(*a.error, std::numeric_limits<double>::epsilon() / 2));
}

const Attempt* best_of(const MethodLine& line) {
  const Attempt* best = nullptr;
  for (const Attempt& a : line.attempts) {
    if (a.error && (best == nullptr || *a.error < *best->error)) best = &a;
  }
  return best;
}

/// A line as it is drawn.
struct Drawn {
  std::size_t problem, number, group;  // the number stands at the method's best point, from 1
  int block;                           // of lines of the data, from 0
};

struct Data {
  Table table;
  std::vector<Drawn> lines;
  std::vector<std::pair<std::size_t, std::string>> legend;  // group and name, by number
};

/// Methods that have a point, in the order given, with their groups.
std::vector<std::pair<std::size_t, std::string>> legend_of(const std::vector<ProblemLines>& problems) {
  std::vector<std::pair<std::size_t, std::string>> legend;
  for (const ProblemLines& p : problems) {
    for (const MethodLine& line : p.lines) {
      const std::pair entry{line.group, line.method};
      if (best_of(line) != nullptr && std::ranges::find(legend, entry) == legend.end())
        legend.push_back(entry);
    }
  }
  return legend;
}

Data data_of(const WorkPrecision& what, const std::vector<ProblemLines>& problems) {
  std::vector<Column> columns = {{"line", 3, true}, {"problem"}, {"group"},      {"number"},
                                 {"digits"},        {"time_s"},  {"time_low_s"}, {"time_high_s"},
                                 {"best"},          {"status"},  {"method"},     {"setting"}};
  for (const std::string& w : what.work) columns.push_back({w});
  Data data{Table(std::move(columns)), {}, legend_of(problems)};
  int block = 0;
  for (std::size_t p = 0; p < problems.size(); ++p) {
    for (const MethodLine& line : problems[p].lines) {
      if (best_of(line) == nullptr) continue;
      const auto entry = std::ranges::find(data.legend, std::pair{line.group, line.method});
      const auto number = static_cast<std::size_t>(entry - data.legend.begin()) + 1;
      for (const Attempt& a : line.attempts) {
        std::vector<Cell> row = {block + 1,           p + 1,         line.group + 1,  number,
                                 digits_of(a),        a.time.median, a.time.smallest, a.time.largest,
                                 &a == best_of(line), a.status,      line.method,     a.setting};
        row.insert(row.end(), a.work.begin(), a.work.end());
        data.table.add(std::move(row));
      }
      data.lines.push_back({p, number, line.group, block++});
    }
  }
  return data;
}

/// Methods by group, to the right of the panels; lines as close as they must be for all to find room.
void put_legend(const WorkPrecision& what, const Data& data, double left, Panel& panel) {
  const auto in_group = [&](std::size_t g) {
    return std::ranges::any_of(data.legend, [g](const auto& entry) { return entry.first == g; });
  };
  double rows = what.rounding > 0 ? 1.5 : 0;
  for (std::size_t g = 0; g < what.groups.size(); ++g) rows += in_group(g) ? 1.35 : 0;
  rows += static_cast<double>(data.legend.size());
  const double pitch = std::min(0.94 / rows, 0.0255);
  double y = 0.955;
  const auto put = [&](const std::string& text, double x, const char* side, const std::string& colour) {
    panel.set(fmt::format("label {} at screen {:.4g}, screen {:.4g} {} noenhanced {} textcolor rgb {}",
                          gnuplot_quoted(text), x, y, side, small_font, colour));
  };
  for (std::size_t g = 0; g < what.groups.size(); ++g) {
    if (!in_group(g)) continue;
    const std::string colour = gnuplot_quoted(what.groups[g].colour);
    panel.set(fmt::format("label bold({}) at screen {:.4g}, screen {:.4g} left {} textcolor rgb {}",
                          gnuplot_quoted(what.groups[g].name), left, y, small_font, colour));
    y -= pitch;
    for (std::size_t k = 0; k < data.legend.size(); ++k) {
      if (data.legend[k].first != g) continue;
      put(std::to_string(k + 1), left + 0.022, "right", colour);
      put(data.legend[k].second, left + 0.03, "left", "ink");
      y -= pitch;
    }
    y -= 0.35 * pitch;
  }
  if (what.rounding <= 0) return;
  panel.set(fmt::format(
      "arrow from screen {:.4g}, screen {:.4g} to screen {:.4g}, screen {:.4g} nohead linestyle 11", left, y,
      left + 0.024, y));
  put("condition times rounding", left + 0.03, "left", "soft_ink");
}

/// The lines of a problem over a column, groups in front last, then the numbers.
void put_lines(const WorkPrecision& what, const Data& data, std::size_t problem, const std::string& column,
               Panel& panel) {
  const auto points = [&](const Drawn& d, const std::string& y) {
    return fmt::format("data using \"{}\":{} every :::{}::{}", column, y, d.block, d.block);
  };
  for (std::size_t g = what.groups.size(); g-- > 0;) {
    const MethodGroup& look = what.groups[g];
    for (const Drawn& d : data.lines) {
      if (d.problem != problem || d.group != g) continue;
      panel.also(
          fmt::format("{} with linespoints linecolor rgb '{}' linewidth {:g} dashtype solid pointtype {} "
                      "pointsize 0.55 notitle",
                      points(d, "\"digits\""), look.colour, look.width, look.symbol));
    }
  }
  // Numbers stand at four places about their points, so that neighbours keep apart.
  constexpr std::array places = {"1.1,0.35", "0.3,0.8", "-0.9,0.5", "-0.3,-0.8"};
  for (const Drawn& d : data.lines) {
    if (d.problem != problem) continue;
    panel.also(fmt::format("{} with labels boxed offset {} {} textcolor rgb '{}' notitle",
                           points(d, "(column('best') == 1 ? column('digits') : NaN):\"number\""),
                           places[d.number % 4], small_font, what.groups[d.group].colour));
  }
}

/// Least and greatest of what is drawn for a problem, with some room.
std::pair<double, double> range_of(const Table& table, std::size_t problem, std::size_t column) {
  double low = HUGE_VAL, high = 0;
  for (const auto& row : table.rows()) {
    const auto* real = std::get_if<double>(&row[column]);
    const auto* whole = std::get_if<std::int64_t>(&row[column]);
    const double x = real != nullptr ? *real : whole != nullptr ? static_cast<double>(*whole) : 0;
    const bool here = std::get<std::int64_t>(row[1]) == static_cast<std::int64_t>(problem) + 1;
    if (!here || !(x > 0) || std::holds_alternative<std::monostate>(row[4])) continue;
    low = std::min(low, x);
    high = std::max(high, x);
  }
  if (high == 0) return {0.1, 1};
  if (high < 30 * low)  // two tics at least
    return {std::pow(10, std::floor(std::log10(low))), std::pow(10, std::ceil(std::log10(high)))};
  return {low / 1.8, high * 2.2};
}

void draw(const WorkPrecision& what, const std::vector<ProblemLines>& problems, Data data, Show& show) {
  Plot& plot = show.plots(what.heading).size(1000, problems.size() > 2 ? 720 : 640);
  struct Axes {
    std::size_t problem, column;
    std::string label;
  };
  std::vector<Axes> all;
  for (std::size_t p = 0; p < problems.size(); ++p) all.push_back({p, 5, what.time});
  if (problems.size() == 1 && !what.work_label.empty()) all.push_back({0, 12, what.work_label});
  const std::size_t across = std::min<std::size_t>(all.size(), 2), down = (all.size() + across - 1) / across;
  const double width = across == 1 ? 0.69 : 0.31, height = down == 1 ? 0.76 : 0.335;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const double left = 0.085 + 0.4 * static_cast<double>(i % across);
    const double bottom = down == 1 ? 0.15 : i / across == 0 ? 0.565 : 0.11;
    const bool lowest = i + across >= all.size();
    auto [low, high] = range_of(data.table, all[i].problem, all[i].column);
    const bool over_time = all[i].column == 5;
    if (what.least_time && over_time) low = std::min(low, what.least_time->first / 4);
    Panel& panel = plot.panel(lowest ? all[i].label : "", i % across == 0 ? what.digits : "");
    panel.log_x()
        .set(fmt::format("xrange [{:.3g}:{:.3g}]", low, high))
        .set("xtics 10")
        .y_range(what.least_digits, what.most_digits)
        .key("off")
        .set("ytics 3");
    panel.set("style textbox opaque noborder fillcolor '#ffffff' margins 0.3,0.3");
    panel.place(left, left + width, bottom, bottom + height);
    panel.caption(problems[all[i].problem].problem);
    if (i == 0) put_legend(what, data, left + 0.4 * static_cast<double>(across - 1) + width + 0.02, panel);
    if (what.rounding > 0) panel.level(-std::log10(what.rounding));
    if (what.least_time && over_time) panel.mark(what.least_time->first, what.least_time->second);
    put_lines(what, data, all[i].problem, data.table.columns()[all[i].column].name, panel);
  }
  plot.data(std::move(data.table));
}

Table tabulate(const WorkPrecision& what, const std::vector<ProblemLines>& problems) {
  const double scale = what.unit == "ms" ? 1e3 : what.unit == "ns" ? 1e9 : 1e6;
  std::vector<Column> columns;
  if (problems.size() > 1) columns.push_back({"problem"});
  const Column error = what.error.empty() ? Column{"digits"} : Column{what.error, 2};
  for (const Column& c : {Column{"method"}, Column{"setting"}, Column{"status"}, error,
                          Column{"time (" + what.unit + ")"}, Column{"from"}, Column{"to"}})
    columns.push_back(c);
  for (const std::string& w : what.work) columns.push_back({w});
  Table table(columns);
  for (const ProblemLines& p : problems) {
    for (const MethodLine& line : p.lines) {
      std::vector<Cell> begin;
      if (problems.size() > 1) begin.emplace_back(p.problem);
      begin.emplace_back(line.method);
      if (line.attempts.empty()) {
        std::vector<Cell> row = begin;
        row.insert(row.end(), {Cell(), "not in this build"});
        row.resize(columns.size());
        table.add(std::move(row));
      }
      for (const Attempt& a : line.attempts) {
        std::vector<Cell> row = begin;
        row.insert(row.end(), {a.setting, a.status, what.error.empty() ? digits_of(a) : a.error,
                               scale * a.time.median, scale * a.time.smallest, scale * a.time.largest});
        row.insert(row.end(), a.work.begin(), a.work.end());
        table.add(std::move(row));
      }
    }
  }
  return table;
}

}  // namespace

double MethodLine::least_error() const {
  const Attempt* best = best_of(*this);
  return best != nullptr ? *best->error : HUGE_VAL;
}

const MethodLine& ProblemLines::of(const std::string& method) const {
  const auto found = std::ranges::find(lines, method, &MethodLine::method);
  if (found == lines.end()) throw std::out_of_range("there is no line of " + method);
  return *found;
}

void show_work_precision(const WorkPrecision& what, const std::vector<ProblemLines>& problems, Show& show) {
  draw(what, problems, data_of(what, problems), show);
  show.table(tabulate(what, problems));
}

}  // namespace nlmech::scene
