#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "chapters/rbf_ivp/examples/histories.hpp"

namespace nlmech::chapters::rbf_ivp {
namespace {

using scene::Workshop;

constexpr double visible = 0.05;  // of the amplitude: a curve that far from the reference is seen to be off

/// Which points of the data are what.
enum Kind : std::int64_t { line = 0, step_end = 1 };

template <int n>
void add_reference(scene::Table& data, const Record<n>& record, const Case<n>& c, int component) {
  for (const auto& drawn : record.window)
    data.add(
        {std::int64_t(0), std::int64_t(line), drawn.t, static_cast<double>(c.reference(drawn.t)[component])});
}

template <int n>
void add_method(scene::Table& data, std::int64_t number, const Record<n>& record, const Keeping& window,
                int component) {
  for (const auto& drawn : record.window) data.add({number, std::int64_t(line), drawn.t, drawn.x[component]});
  for (const auto& value : record.values) {
    if (!value.end || value.t < window.window_begin) continue;
    data.add({number, std::int64_t(step_end), value.t, value.x[component]});
  }
}

/// Greatest distance from the reference over the window, in amplitudes.
template <int n>
double distance(const Record<n>& record, const Case<n>& c, int component) {
  double greatest = 0;
  for (const auto& drawn : record.window) {
    const auto truth = static_cast<double>(c.reference(drawn.t)[component]);
    greatest = std::max(greatest, std::abs(drawn.x[component] - truth) / c.amplitude[component]);
  }
  return greatest;
}

template <int n>
scene::Showing show(const Example<n>& example, const Comparison& comparison, Workshop& w) {
  const Case<n>& c = example.made();
  scene::Table data({{"curve", 3, true}, {"kind"}, {"t_s"}, {"x"}});
  std::vector<std::string> legend;
  int off = 0;
  for (const std::string& method : comparison.methods) {
    const Record<n>& record = w.result(*example.row(method).nominal);
    if (legend.empty()) add_reference(data, record, c, comparison.component);
    legend.push_back(method);
    add_method(data, static_cast<std::int64_t>(legend.size()), record, example.keeping, comparison.component);
    off += distance(record, c, comparison.component) > visible ? 1 : 0;
  }
  scene::Showing showing;
  showing.figure = {std::move(data),
                    "rbf_ivp-comparison",
                    {{"heading", fmt::format("{}: {} of {} methods have left {}", example.title, off,
                                             comparison.methods.size(), comparison.symbol)},
                     {"legend", fmt::format("{}", fmt::join(legend, "|"))},
                     {"symbol", comparison.symbol},
                     {"begin", fmt::format("{:.17g}", example.keeping.window_begin)},
                     {"end", fmt::format("{:.17g}", example.keeping.window_end)}}};
  for (const std::string& method : comparison.methods) {
    const Row<n>& row = example.row(method);
    if (!row.reading.nominal) continue;
    const Expected& e = *row.reading.nominal;
    showing.quantities.push_back(
        {"RMS error of " + method, "1", row.nominal_error(w), e.low, e.high, e.reason});
  }
  return showing;
}

template <int n>
void add(scene::Chapter& chapter, const Example<n>& example, const Comparison& comparison) {
  std::vector<const scene::AnyRun*> needs;
  for (const std::string& method : comparison.methods) needs.push_back(example.row(method).nominal);
  chapter.add(
      {.name = fmt::format("fig-4.{}", comparison.figure),
       .title = fmt::format("{}: {} by all methods over the last {:.3g} s", example.title, comparison.symbol,
                            example.keeping.window_end - example.keeping.window_begin),
       .place = fmt::format("Figure 4.{}", comparison.figure),
       .needs = needs,
       .show = [example, comparison](Workshop& w) { return show(example, comparison, w); }});
}

}  // namespace

void add_comparison(scene::Chapter& chapter, const Example<2>& example, const Comparison& figure) {
  add(chapter, example, figure);
}

void add_comparison(scene::Chapter& chapter, const Example<6>& example, const Comparison& figure) {
  add(chapter, example, figure);
}

}  // namespace nlmech::chapters::rbf_ivp
