#include "nlmech/scene/cost/drawing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>

namespace nlmech::scene {
namespace {

/// Block of equal neighbours of the isotonic regression; its value is the mean.
struct Pool {
  double sum;
  std::size_t count;
  [[nodiscard]] double mean() const { return sum / static_cast<double>(count); }
};

}  // namespace

std::vector<double> spread(const std::vector<double>& wanted, double gap, double low, double high) {
  if (wanted.empty()) return {};
  const std::size_t n = wanted.size();
  if (n > 1) gap = std::min(gap, (high - low) / static_cast<double>(n - 1));
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return wanted[i]; });
  // Without the gaps below them, positions must not decrease: isotonic regression by pooling adjacent
  // violators.
  std::vector<Pool> pools;
  for (std::size_t k = 0; k < n; ++k) {
    pools.push_back({wanted[order[k]] - gap * static_cast<double>(k), 1});
    while (pools.size() > 1 && pools.back().mean() < pools[pools.size() - 2].mean()) {
      const Pool last = pools.back();
      pools.pop_back();
      pools.back() = {pools.back().sum + last.sum, pools.back().count + last.count};
    }
  }
  std::vector<double> places(n);
  const double highest = high - gap * static_cast<double>(n - 1);
  std::size_t k = 0;
  for (const Pool& pool : pools) {
    const double place = std::max(low, std::min(pool.mean(), highest));
    for (std::size_t i = 0; i < pool.count; ++i, ++k) places[order[k]] = place + gap * static_cast<double>(k);
  }
  return places;
}

namespace {

constexpr const char* small_font = "font sprintf(\"%s,%d\", font_family, font_size - 3)";
constexpr double letter = 6.1;  // average width in pixels of the small font

std::size_t letters(const std::string& text) {
  const auto begins = [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; };  // in UTF-8
  return static_cast<std::size_t>(std::ranges::count_if(text, begins));
}

constexpr std::size_t time_column = 5, work_column = 13;

/// Axes of a problem against a column of the data; positions in pixels from the upper left corner.
struct Axes {
  std::size_t problem, column;
  std::string label;
  bool named;  // are the curves named at their ends?
  double left, right, top, bottom;
};

struct Layout {
  double width, height;
  std::vector<Axes> axes;
};

/// Layout with names to the right of the axes and strips of the fastest methods below.
Layout layout_of(const Diagram& d) {
  std::size_t longest = 0;
  for (const InColour& c : d.chosen)
    longest = std::max(longest, letters(d.problems.front().lines[c.line].method));
  const double names = 34 + letter * static_cast<double>(longest);
  constexpr double strip = 150;  // strips with tics and label
  if (d.problems.size() == 1) {
    const bool work = !d.what.work_label.empty();
    const double width = work ? 1000 : 820, bottom = work ? 400 : 420;
    const double rest = width - 70 - names - (work ? 60 : 10), first = work ? 0.58 * rest : rest;
    Layout l{width, bottom + strip + 30, {{0, time_column, d.what.time, true, 70, 70 + first, 46, bottom}}};
    if (work) {
      const double left = 70 + first + names + 45;
      l.axes.push_back({0, work_column, d.what.work_label, false, left, width - 15, 46, bottom});
    }
    return l;
  }
  const bool rows = d.problems.size() > 2;
  const double height = rows ? 240 : 320;
  Layout l{1040, 0, {}};
  double top = 76;
  for (std::size_t p = 0; p < d.problems.size(); ++p) {
    const double left = p % 2 == 0 ? 62 : 574;
    l.axes.push_back({p, time_column, d.what.time, true, left, left + 456 - names, top, top + height});
    l.height = top + height + strip + 30;
    if (p % 2 == 1) top += height + strip + 46;
  }
  return l;
}

/// Number in a cell; 0 if there is none.
double number_in(const Cell& cell) {
  const auto* real = std::get_if<double>(&cell);
  const auto* whole = std::get_if<std::int64_t>(&cell);
  return real != nullptr ? *real : whole != nullptr ? static_cast<double>(*whole) : 0;
}

/// Range of a problem's drawn points in a column, with a margin.
std::pair<double, double> range_of(const Table& table, std::size_t problem, std::size_t column) {
  double low = HUGE_VAL, high = 0;
  for (const auto& row : table.rows()) {
    const double x = number_in(row[column]);
    const bool here = std::get<std::int64_t>(row[1]) == static_cast<std::int64_t>(problem) + 1;
    if (!here || !(x > 0) || std::holds_alternative<std::monostate>(row[4])) continue;
    low = std::min(low, x);
    high = std::max(high, x);
  }
  if (high == 0) return {0.1, 1};
  if (high < 30 * low)  // whole decades, for at least two tics
    return {std::pow(10, std::floor(std::log10(low))), std::pow(10, std::ceil(std::log10(high)))};
  return {low / 1.8, high * 1.5};
}

/// Draws the curves of a problem: grey ones, then coloured ones with the most important last.
void put_curves(const Diagram& d, const Axes& axes, Panel& panel) {
  const std::vector<MethodLine>& lines = d.problems[axes.problem].lines;
  bool empty = true;
  const auto put = [&](std::size_t i, const std::string& style) {
    const int block = d.blocks[axes.problem][i];
    if (block < 0) return;
    empty = false;
    panel.also(fmt::format(
        "data using \"{}\":\"digits\" every :::{}::{} with linespoints {} title {} noenhanced",
        d.data.columns()[axes.column].name, block, block, style, gnuplot_quoted(lines[i].method)));
  };
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (d.colour_of(i) != nullptr) continue;
    const bool alone = lines[i].attempts.size() == 1;  // a single point without a line
    put(i, fmt::format("linecolor rgb '#bdbdbd' linewidth 0.8 dashtype solid pointtype 7 pointsize {}",
                       alone ? 0.45 : 0.2));
  }
  for (std::size_t i = d.chosen.size(); i-- > 0;) {
    const InColour& c = d.chosen[i];
    const Side side = lines[c.line].side;
    put(c.line, fmt::format("linecolor rgb '{}' linewidth {} dashtype {} pointtype {} pointsize 0.65",
                            method_styles[c.colour].colour, side == Side::peer ? 1.6 : 2.4,
                            side == Side::peer ? "6" : "solid", method_styles[c.colour].symbol));
  }
  if (empty) panel.also("NaN notitle");  // draws only the axes
}

/// Height of a line of small text in digits.
double line_of_text(const Diagram& d, const Axes& axes) {
  return 16 * (d.what.most_digits - d.what.least_digits) / (axes.bottom - axes.top);
}

constexpr double leader_end = 1.02;  // across the axes

/// Dotted line from the end of a curve to its name at the right of the axes.
struct Leader {
  const InColour* line;
  double time;      ///< at its left end
  double from, to;  ///< digits at its ends
};

std::vector<Leader> leaders_of(const Diagram& d, const Axes& axes) {
  std::vector<Leader> leaders;
  std::vector<double> ends;
  for (const InColour& c : d.chosen) {
    const Attempt* best = d.problems[axes.problem].lines[c.line].best();
    if (best == nullptr) continue;
    ends.push_back(std::clamp(*best->digits(), d.what.least_digits, d.what.most_digits));
    leaders.push_back({&c, best->time.median, ends.back(), 0});
  }
  const auto places = spread(ends, line_of_text(d, axes), d.what.least_digits, d.what.most_digits);
  for (std::size_t k = 0; k < leaders.size(); ++k) leaders[k].to = places[k];
  return leaders;
}

/// Draws the names to the right of the axes, each joined to the end of its curve.
void put_names(const Diagram& d, const Axes& axes, Panel& panel) {
  for (const Leader& leader : leaders_of(d, axes)) {
    const MethodLine& line = d.problems[axes.problem].lines[leader.line->line];
    const MethodStyle& style = method_styles[leader.line->colour];
    panel.set(
        fmt::format("arrow from first {:.6g}, first {:.6g} to graph {}, first {:.6g} nohead linecolor rgb "
                    "'{}' linewidth 0.6 dashtype 3",
                    leader.time, leader.from, leader_end, leader.to, style.colour));
    panel.set(fmt::format(
        "label {} at graph 1.03, first {:.6g} left noenhanced {} textcolor rgb '{}' point "
        "linecolor rgb '{}' pointtype {} pointsize 0.65 offset 0.8,-0.15",
        gnuplot_quoted(line.method), leader.to, small_font, style.colour, style.colour, style.symbol));
  }
}

/// Draws the fastest method at each number of digits, in rows below the axes.
void put_leads(const Diagram& d, const Axes& axes, const Layout& layout, Panel& panel) {
  const ProblemLines& problem = d.problems[axes.problem];
  const auto rankings = rankings_of(problem);
  std::size_t longest = 0;
  for (const Ranking& ranking : rankings)
    longest = std::max(longest, ranking.first ? letters(problem.lines[*ranking.first].method) : 6);
  double y = axes.bottom + 76;
  const auto put = [&](const std::string& text, double x, const char* side, const std::string& colour) {
    panel.set(fmt::format("label {} at screen {:.4f}, screen {:.4f} {} noenhanced {} textcolor rgb {}",
                          gnuplot_quoted(text), x / layout.width, 1 - y / layout.height, side, small_font,
                          colour));
  };
  const double names = axes.left + 34, margins = names + 16 + letter * static_cast<double>(longest);
  put("digits", axes.left + 20, "right", "soft_ink");
  put("fastest", names, "left", "soft_ink");
  for (const Ranking& ranking : rankings) {
    y += 17;
    put(fmt::format("{:g}", ranking.digits), axes.left + 20, "right", "ink");
    const InColour* colour = ranking.first ? d.colour_of(*ranking.first) : nullptr;
    put(ranking.first ? problem.lines[*ranking.first].method : "no method", names, "left",
        colour != nullptr ? gnuplot_quoted(method_styles[colour->colour].colour) : "soft_ink");
    if (ranking.first) put(ranking.margin(problem), margins, "left", "ink");
  }
}

/// Place of a text at a level.
struct Corner {
  bool right, below;
};

constexpr const char* rounding_text = "one rounding of the data";

/// Number of points and leaders that the text of a level covers at a corner.
/// @param low, high range of the abscissa
std::ptrdiff_t covered(const Diagram& d, const Axes& axes, double low, double high, double level,
                       Corner corner) {
  const double width = 0.02 + letter * static_cast<double>(letters(rounding_text)) / (axes.right - axes.left);
  const double left = corner.right ? 1 - width : 0, right = left + width;
  const double height = line_of_text(d, axes), bottom = corner.below ? level - height : level,
               top = bottom + height;
  const auto across = [&](double time) { return std::log(time / low) / std::log(high / low); };
  const auto within = [&](const Attempt& attempt) {
    if (!attempt.digits()) return false;
    const double u = across(attempt.time.median), digits = *attempt.digits(), margin = 0.3 * height;
    return u >= left && u <= right && digits > bottom - margin && digits < top + margin;
  };
  const auto passes = [&](const Leader& leader) {
    const double start = across(leader.time);
    const auto at = [&](double u) {
      return leader.from + (leader.to - leader.from) * (u - start) / (leader_end - start);
    };
    const auto [least, most] = std::minmax({at(std::max(left, start)), at(right)});
    return start < right && most > bottom && least < top;
  };
  std::ptrdiff_t count = std::ranges::count_if(leaders_of(d, axes), passes);
  for (const MethodLine& line : d.problems[axes.problem].lines)
    count += std::ranges::count_if(line.attempts, within);
  return count;
}

/// Draws the level of digits that one rounding of the data permits, with its text where it covers least.
void put_rounding(const Diagram& d, const Axes& axes, double low, double high, Panel& panel) {
  const double level = -std::log10(d.what.rounding);
  panel.level(level);
  if (!axes.named) return;
  constexpr Corner corners[] = {{false, false}, {true, false}, {false, true}, {true, true}};
  const Corner corner =
      *std::ranges::min_element(corners, {}, [&](Corner c) { return covered(d, axes, low, high, level, c); });
  panel.set(fmt::format("label '{}' at graph {}, first {:.6g} {} offset 0,{} {} textcolor rgb soft_ink",
                        rounding_text, corner.right ? 0.99 : 0.01, level, corner.right ? "right" : "left",
                        corner.below ? -0.5 : 0.5, small_font));
}

/// Number of grey curves.
std::size_t grey_of(const Diagram& d) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < d.problems.front().lines.size(); ++i) {
    const bool drawn = std::ranges::any_of(d.blocks, [i](const auto& of) { return of[i] >= 0; });
    count += drawn && d.colour_of(i) == nullptr ? 1 : 0;
  }
  return count;
}

/// Legend of colours, line styles and the level.
std::string explanation(const Diagram& d) {
  const auto has = [&](Side side) {
    return std::ranges::any_of(
        d.chosen, [&](const InColour& c) { return d.problems.front().lines[c.line].side == side; });
  };
  std::string text;
  const auto say = [&text](const std::string& sentence) { text += (text.empty() ? "" : "  ") + sentence; };
  if (has(Side::peer)) say("Solid: this suite.  Dashed: peers.");
  if (const std::size_t grey = grey_of(d); grey > 0)
    say(fmt::format("Grey: {} other method{}.", grey, grey == 1 ? "" : "s"));
  const auto above = [&](const MethodLine& line) { return line.least_error() < d.what.rounding; };
  if (std::ranges::any_of(d.problems, [&](const auto& p) { return std::ranges::any_of(p.lines, above); }))
    say("Points above the level: rounding errors below the worst case.");
  return text;
}

}  // namespace

Figure drawn(Diagram d) {
  const WorkPrecision& what = d.what;
  const Layout layout = layout_of(d);
  Plot plot(what.heading);
  plot.size(static_cast<int>(layout.width), static_cast<int>(layout.height));
  for (const Axes& axes : layout.axes) {
    auto [low, high] = range_of(d.data, axes.problem, axes.column);
    const bool over_time = axes.column == time_column;
    if (what.least_time && over_time) low = std::min(low, what.least_time->first / 7);
    Panel& panel = plot.panel(axes.label, axes.left < 100 ? what.digits : "");
    panel.log_x()
        .set(fmt::format("xrange [{:.3g}:{:.3g}]", low, high))
        .set("xtics 10")
        .y_range(what.least_digits, what.most_digits)
        .key("off")
        .set("ytics 3");
    panel.place(axes.left / layout.width, axes.right / layout.width, 1 - axes.bottom / layout.height,
                1 - axes.top / layout.height);
    if (layout.axes.size() == 1) panel.set("title offset 0,-0.5");  // otherwise it touches the edge
    panel.caption(d.problems[axes.problem].problem);
    if (what.rounding > 0) put_rounding(d, axes, low, high, panel);
    if (what.least_time && over_time) panel.mark(what.least_time->first, what.least_time->second);
    if (axes.named) {
      put_names(d, axes, panel);
      put_leads(d, axes, layout, panel);
    }
    if (&axes == &layout.axes.front())
      panel.set(fmt::format(
          "label {} at screen {:.4f}, screen {:.4f} left noenhanced {} textcolor rgb soft_ink",
          gnuplot_quoted(explanation(d)), axes.left / layout.width, 14 / layout.height, small_font));
    put_curves(d, axes, panel);
  }
  return {std::move(d.data), "", {{"answers", "curves"}}, plot.prelude(), plot.script()};
}

}  // namespace nlmech::scene
