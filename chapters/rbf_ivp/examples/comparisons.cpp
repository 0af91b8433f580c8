#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "chapters/rbf_ivp/examples/histories.hpp"

namespace nlmech::chapters::rbf_ivp {
namespace {

constexpr double visible = 0.05;  // of the amplitude: visible difference from the reference

/// Kinds of points in the data.
constexpr int line = 0, step_end = 1;

void add_reference(scene::Table& data, const Record& record, const Case& c, int component) {
  for (const auto& drawn : record.window)
    data.add({0, line, drawn.t, static_cast<double>(c.reference(drawn.t)[component])});
}

void add_method(scene::Table& data, int number, const Record& record, double window_start, int component) {
  for (const auto& drawn : record.window) data.add({number, line, drawn.t, drawn.x[component]});
  for (const auto& value : record.values) {
    if (!value.end || value.t < window_start) continue;
    data.add({number, step_end, value.t, value.x[component]});
  }
}

/// Largest error over the window, in amplitudes.
double distance(const Record& record, const Case& c, int component) {
  double greatest = 0;
  for (const auto& drawn : record.window) {
    const auto reference = static_cast<double>(c.reference(drawn.t)[component]);
    greatest = std::max(greatest, std::abs(drawn.x[component] - reference) / c.amplitude[component]);
  }
  return greatest;
}

using Records = std::vector<const Record*>;

/// Draws the reference (first data block) and the runs. Symbols drawn first are larger, so that none is
/// hidden.
void draw(const std::vector<std::string>& labels, double start, double end, scene::Panel& panel) {
  panel.place(0.12, 0.97, 0.13, 0.79).set("title offset 0,2.4").x_range(start, end);
  panel.key("at screen 0.535, screen 0.91 center top horizontal maxrows 2 samplen 2.5");
  const auto of = [](int kind) {
    return fmt::format("(column('kind') == {} ? column('t_s') : NaN):x", kind);
  };
  panel.columns("reference", of(line), {"lines linecolor rgb '#c9c9c9' linewidth 9 dashtype solid", 1}, 0);
  const int count = static_cast<int>(labels.size());
  const auto size = [count](int i) { return 0.6 + 0.1 * (count - i); };
  for (int i = 1; i <= count; ++i) panel.columns("", of(line), {"lines linewidth 1.4", i}, i);
  for (int i = 1; i <= count; ++i)
    panel.columns("", of(step_end), {fmt::format("points pointsize {:.2f}", size(i)), i}, i);
  for (int i = 1; const std::string& label : labels)
    panel.also(fmt::format("keyentry with linespoints linestyle {} linewidth 1.4 pointsize 0.9 title '{}'",
                           i++, label));
}

void put(const Example& example, const Comparison& figure, const Records& records, scene::Show& show) {
  const Case& c = example.made();
  scene::Table data({{"curve", 3, true}, {"kind"}, {"t_s"}, {"x"}});
  add_reference(data, *records.front(), c, figure.component);
  int off = 0;
  for (int number = 0; const Record* record : records) {
    add_method(data, ++number, *record, c.t1 - example.window, figure.component);
    off += distance(*record, c, figure.component) > visible ? 1 : 0;
  }
  scene::Panel& panel = show.plot(fmt::format("{}: {} of {} runs deviate visibly from {}", example.title, off,
                                              records.size(), figure.symbol),
                                  "{/:Italic t} (s)", figure.symbol);
  std::vector<std::string> labels = figure.methods;
  if (!figure.also_inferred.empty())
    labels.emplace_back("inferred");  // a longer label would not fit into two rows
  draw(labels, c.t1 - example.window, c.t1, panel);
  show.figure().data(std::move(data));
  for (std::size_t i = 0; i < figure.methods.size(); ++i) {
    const Row& row = example.row(figure.methods[i]);
    if (row.nominal)
      row.nominal->check("RMS error of " + figure.methods[i], row.nominal_error(*records[i]), show);
  }
}

}  // namespace

scene::Scene comparison(const Example& example, const Comparison& figure) {
  std::vector<scene::Result<Record>> results;
  for (const std::string& method : figure.methods) results.push_back(example.nominal(example.row(method)));
  if (!figure.also_inferred.empty()) results.push_back(example.inferred(example.row(figure.also_inferred)));
  const auto show = [example, figure](const Records& records, scene::Show& to) {
    put(example, figure, records, to);
  };
  return {.name = fmt::format("fig-4.{}", figure.figure),
          .title = fmt::format("{}: {} by all methods over the last {:.3g} s", example.title, figure.symbol,
                               example.window),
          .place = fmt::format("Figure 4.{}", figure.figure),
          .content = scene::Content(show, results)};
}

}  // namespace nlmech::chapters::rbf_ivp
