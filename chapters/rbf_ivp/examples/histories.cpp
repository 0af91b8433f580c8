#include "chapters/rbf_ivp/examples/histories.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace nlmech::chapters::rbf_ivp {
namespace {

/// Thinning of a record for drawing.
struct Thinning {
  bool by_step;      ///< keep the largest error within each step
  int bins;          ///< otherwise the largest in each of so many equal intervals; 0: keep all
  std::string text;  ///< description for the axis
};

/// Thinning by the number of steps: none for a few steps, by step for steps longer than half a period, else
/// by bins.
Thinning thinning_of(const Record& record, const Case& c) {
  constexpr std::int64_t few = 20;
  const int bins = static_cast<int>(std::round((c.t1 - c.t0) / c.half_period));
  if (record.statistics.steps <= few) return {false, 0, "all nodes"};
  if (record.statistics.steps <= bins) return {true, 0, "largest in each step"};
  return {false, bins, fmt::format("largest in each {:.1f} s", (c.t1 - c.t0) / bins)};
}

/// Points of one line, or of one series of dots.
struct Curve {
  std::string label;
  std::vector<TimeError> points;
};

/// The curves of a run: lines, and dots at the ends of steps.
struct Curves {
  std::vector<Curve> lines, dots;
};

/// Errors of a record by a measure, thinned for drawing.
template <class Measure>
std::vector<TimeError> errors_of(const Record& record, const Case& c, Points points, Measure measure) {
  const Thinning thinning = thinning_of(record, c);
  std::vector<TimeError> all;
  bool step_begins = true;
  for (const auto& value : record.values) {
    if (points == Points::ends && !value.end) continue;
    const TimeError here{value.t, std::max(measure(value.error), 1e-18)};  // zero has no logarithm
    if (!thinning.by_step || step_begins || points == Points::ends) {
      all.push_back(here);
    } else if (here.error > all.back().error) {
      all.back() = here;
    }
    step_begins = value.end;
  }
  const bool sparse = all.size() <= 2 * static_cast<std::size_t>(thinning.bins);
  return sparse || thinning.bins == 0 ? all : greatest_by_bin(all, c.t0, c.t1, thinning.bins);
}

double greatest(const std::vector<TimeError>& errors) {
  double largest = 0;
  for (const TimeError& p : errors) largest = std::max(largest, p.error);
  return largest;
}

/// Removes the dots if they are on the lines.
void drop_needless_dots(Curves& curves) {
  for (std::size_t i = 0; i < curves.lines.size(); ++i) {
    if (greatest(curves.lines[i].points) > 1.5 * greatest(curves.dots[i].points)) return;
  }
  curves.dots.clear();
}

/// One curve per component, or one for the state.
Curves curves_of(const Record& record, const Case& c, Shown shown, const std::string& label) {
  Curves all;
  const auto add = [&](const std::string& name, auto measure) {
    all.lines.push_back({name, errors_of(record, c, Points::all, measure)});
    all.dots.push_back({"step ends", errors_of(record, c, Points::ends, measure)});
  };
  if (shown == Shown::state) {
    add(label, [&c](const ivp::State& e) { return normalised_state_error(c, e); });
    return all;
  }
  const int half = static_cast<int>(c.x0.size()) / 2, first = shown == Shown::positions ? 0 : half;
  for (int i = first; i < first + half; ++i) {
    const std::string component =
        half == 1 ? label : fmt::format("{}_{}", shown == Shown::positions ? "x" : "v", i - first + 1);
    add(component, [&c, i](const ivp::State& e) { return std::abs(e[i]) / c.amplitude[i]; });
  }
  return all;
}

/// Sets the decades of the axis to cover all errors; at most twelve, because a first step can be exact to
/// rounding.
void set_decades(const Curves& curves, scene::Panel& panel) {
  double least = HUGE_VAL, largest = 0;
  for (const std::vector<Curve>* group : {&curves.lines, &curves.dots}) {
    for (const Curve& curve : *group) {
      largest = std::max(largest, greatest(curve.points));
      least = std::min(least, std::ranges::min(curve.points, {}, &TimeError::error).error);
    }
  }
  const double high = std::ceil(std::log10(largest));
  const double low = std::clamp(std::floor(std::log10(least)), high - 12, high - 1);
  panel.log_y(std::pow(10, low), std::pow(10, high)).set("format y power_of_ten");
  panel.set(high - low > 8 ? "ytics 100" : "ytics 10");
}

/// Draws the curves. @param size of the dots
void draw(const Curves& curves, double end, const char* size, scene::Panel& panel) {
  const bool alone = curves.lines.size() + curves.dots.size() == 1;
  panel.place(0.12, 0.97, 0.13, alone ? 0.89 : 0.83).set(alone ? "title offset 0,0.2" : "title offset 0,1.4");
  panel.x_range(0, end).key(
      "at screen 0.545, screen 0.905 center top horizontal maxrows 1 samplen 2.5 width -1");
  set_decades(curves, panel);
  for (const Curve& curve : curves.lines)
    panel.curve(alone ? "" : curve.label, curve.points, &TimeError::t, &TimeError::error,
                {"lines linewidth 1.6"});
  for (int style = 1; const Curve& curve : curves.dots) {
    panel.curve(style == 1 ? curve.label : "", curve.points, &TimeError::t, &TimeError::error,
                {fmt::format("points pointtype 7 pointsize {}", size), style});
    ++style;
  }
}

const char* word_for(Shown shown) {
  return shown == Shown::state       ? "state error"
         : shown == Shown::positions ? "position error"
                                     : "velocity error";
}

/// Formats an error size, such as "5.6e-4" or "0.12".
std::string size_text(double size) {
  if (size >= 0.01) return scene::format_number(size, 2);
  std::string text = fmt::format("{:.1e}", size);
  const auto e = text.find('e');
  return text.substr(0, e + 2) + text.substr(text.find_first_not_of('0', e + 2));
}

/// Finding for the title: the time at which the phase is lost, or the largest error and its growth.
std::string finding(const std::vector<Curve>& lines, Shown shown) {
  const Curve& worst =
      *std::ranges::max_element(lines, {}, [](const Curve& c) { return greatest(c.points); });
  const double largest = greatest(worst.points);
  const auto lost = std::ranges::find_if(worst.points, [](const TimeError& p) { return p.error > 1; });
  if (lost != worst.points.end())
    return fmt::format("{} first above 1 at {:.0f} s", word_for(shown), lost->t);
  const std::string size = size_text(largest);
  const double exponent = growth_exponent(worst.points);
  // Slower growth is not visible.
  if (exponent < 0.75) return fmt::format("{} at most {}", word_for(shown), size);
  return fmt::format("{} grows to {} as t^{{{:.1f}}}", word_for(shown), size, exponent);
}

void put(const Case& c, const Row& row, const History& figure, const Record& nominal, const Record& inferred,
         scene::Show& show) {
  const bool two = &nominal != &inferred;
  Curves curves = curves_of(nominal, c, figure.shown, two ? row.as_printed : "all nodes");
  const std::string seen = finding(curves.lines, figure.shown);
  if (two) {
    Curves others = curves_of(inferred, c, figure.shown, row.as_inferred);
    std::ranges::move(others.lines, std::back_inserter(curves.lines));
    std::ranges::move(others.dots, std::back_inserter(curves.dots));
  }
  drop_needless_dots(curves);
  scene::Panel& panel =
      show.plot(fmt::format("{} ({}): {}", row.method, row.setting, seen), "{/:Italic t} (s)",
                fmt::format("normalised {}, {}", word_for(figure.shown), thinning_of(nominal, c).text));
  show.figure().columns({"curve", "t_s", "error"});
  const auto steps = nominal.statistics.steps;
  draw(curves, c.t1, steps <= 20 ? "0.9" : steps <= 60 ? "0.5" : "0.35", panel);
  if (row.nominal) row.nominal->check("RMS position error", row.nominal_error(nominal), show);
  if (two && row.inferred) {
    row.inferred->check("RMS position error, inferred reading", row.inferred_error(inferred, c.inferred_end),
                        show);
  }
  if (figure.velocity.high > 0)
    figure.velocity.check("RMS velocity error",
                          rms_error(nominal, static_cast<int>(c.x0.size()) / 2, row.points), show);
}

/// Largest position error in each interval of time.
std::vector<TimeError> position_errors(const Record& record, const Case& c) {
  return errors_of(record, c, Points::all, [&c](const ivp::State& e) {
    const Eigen::Index half = e.size() / 2;
    return (e.head(half).cwiseAbs().array() / c.amplitude.head(half).array()).maxCoeff();
  });
}

/// Draws one panel per run with common axes; the two settings of a method are side by side.
void put_all(const Example& example, const std::vector<std::string>& methods,
             const std::vector<const Record*>& records, scene::Show& show) {
  const Case& c = example.made();
  constexpr double small = 1e-6, least = 1e-11, greatest_shown = 100;
  std::vector<std::vector<TimeError>> errors;
  for (const Record* record : records) errors.push_back(position_errors(*record, c));
  const auto accurate = std::ranges::count_if(errors, [](const auto& run) { return greatest(run) < small; });
  scene::Plot& plot = show.plots(
      fmt::format("{}: {} of {} runs keep the error below 1e-6", example.title, accurate, records.size()));
  const int rows = static_cast<int>(records.size()) / 2, top = 56, foot = 70, height = 92, gap = 24;
  const int whole = top + rows * (height + gap) + foot - gap;
  plot.size(760, whole).columns({"panel", "curve", "t_s", "error"});
  for (int i = 0; const std::vector<TimeError>& run : errors) {
    const int row = i / 2, column = i % 2;
    const double above = 1 - double(top + row * (height + gap)) / whole;
    const bool last = row + 1 == rows;
    scene::Panel& panel = plot.panel(last ? "{/:Italic t} (s)" : "", column == 0 ? "error" : "");
    const Row& method = example.row(methods.at(static_cast<std::size_t>(i)));
    panel.place(0.115 + 0.455 * column, 0.525 + 0.455 * column, above - double(height) / whole, above)
        .caption(fmt::format("{} ({})", method.method, method.setting))
        .x_range(c.t0, c.t1)
        .log_y(least, greatest_shown)
        .set("ytics 1e-10, 1e5")
        .set(column == 0 ? "format y power_of_ten" : "format y ''");
    if (!last) panel.set("format x ''");
    panel.curve("", run, &TimeError::t, &TimeError::error, {"lines linewidth 1.4", 1});
    if (method.nominal)
      method.nominal->check("RMS error of " + method.method,
                            method.nominal_error(*records[static_cast<std::size_t>(i)]), show);
    ++i;
  }
}

}  // namespace

scene::Scene history(const Example& example, const History& figure) {
  const Row& row = example.row(figure.method);
  const auto show = [made = example.made, row, figure](const Record& nominal, const Record& inferred,
                                                       scene::Show& to) {
    put(made(), row, figure, nominal, inferred, to);
  };
  return {.name = fmt::format("fig-4.{}", figure.figure),
          .title = fmt::format("{}: {} in time, {}, {}", example.title, word_for(figure.shown), row.method,
                               row.setting),
          .place = fmt::format("Figure 4.{}", figure.figure),
          .content = scene::Content(show, example.nominal(row), example.inferred(row))};
}

scene::Scene histories(const Example& example, const std::string& name,
                       const std::vector<std::string>& methods) {
  std::vector<scene::Result<Record>> results;
  for (const std::string& method : methods) results.push_back(example.nominal(example.row(method)));
  const auto show = [example, methods](const std::vector<const Record*>& records, scene::Show& to) {
    put_all(example, methods, records, to);
  };
  return {.name = name,
          .title = example.title + ": position errors in time by all methods, on common axes",
          .content = scene::Content(show, results)};
}

std::vector<TimeError> greatest_by_bin(const std::vector<TimeError>& errors, double begin, double end,
                                       int bins) {
  std::vector<TimeError> greatest;
  int last = -1;
  for (const TimeError& p : errors) {
    const int bin = std::clamp(static_cast<int>((p.t - begin) / (end - begin) * bins), 0, bins - 1);
    if (bin != last) greatest.push_back(p);
    if (p.error > greatest.back().error) greatest.back() = p;
    last = bin;
  }
  return greatest;
}

double growth_exponent(const std::vector<TimeError>& errors) {
  double count = 0, x = 0, y = 0, xx = 0, xy = 0;
  for (const TimeError& p : errors) {
    if (p.t < errors.back().t / 10 || p.error <= 0) continue;
    const double lt = std::log(p.t), le = std::log(p.error);
    count += 1;
    x += lt;
    y += le;
    xx += lt * lt;
    xy += lt * le;
  }
  return (count * xy - x * y) / (count * xx - x * x);
}

}  // namespace nlmech::chapters::rbf_ivp
