#include "chapters/rbf_ivp/examples/histories.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace nlmech::chapters::rbf_ivp {
namespace {

using scene::Workshop;

/// How a record is thinned out for drawing.
struct Thinning {
  bool by_step;      ///< the greatest error within each step
  int bins;          ///< else the greatest of each of so many equal parts; 0: all errors
  std::string text;  ///< the same in words
};

/// Nothing is left out of a few steps; steps longer than half a period count one by one.
template <int n>
Thinning thinning_of(const Record<n>& record, const Case<n>& c) {
  constexpr std::int64_t few = 20;
  const int bins = static_cast<int>(std::round((c.t1 - c.t0) / c.half_period));
  if (record.statistics.steps <= few) return {false, 0, "all nodes"};
  if (record.statistics.steps <= bins) return {true, 0, "greatest within each step"};
  return {false, bins, fmt::format("greatest of each {:.1f} s", (c.t1 - c.t0) / bins)};
}

/// One line or row of dots.
struct Curve {
  std::string label;
  std::vector<TimeError> points;
};

/// What is drawn of a run: its lines, and dots at the ends of steps.
struct Curves {
  std::vector<Curve> lines, dots;
};

/// Errors of a record by a measure, thinned out.
template <int n, class Measure>
std::vector<TimeError> errors_of(const Record<n>& record, const Case<n>& c, Points points, Measure measure) {
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

/// Dots are left out where they stand on the lines.
void drop_needless_dots(Curves& curves) {
  for (std::size_t i = 0; i < curves.lines.size(); ++i) {
    if (greatest(curves.lines[i].points) > 1.5 * greatest(curves.dots[i].points)) return;
  }
  curves.dots.clear();
}

/// One curve a component, or one for the state.
template <int n>
Curves curves_of(const Record<n>& record, const Case<n>& c, Shown shown, const std::string& label) {
  Curves all;
  const auto add = [&](const std::string& name, auto measure) {
    all.lines.push_back({name, errors_of(record, c, Points::all, measure)});
    all.dots.push_back({"step ends", errors_of(record, c, Points::ends, measure)});
  };
  if (shown == Shown::state) {
    add(label, [&c](const ivp::State<n>& e) { return normalised_state_error(c, e); });
    return all;
  }
  const int first = shown == Shown::positions ? 0 : n / 2;
  for (int i = first; i < first + n / 2; ++i) {
    const std::string component =
        n == 2 ? label : fmt::format("{}_{}", shown == Shown::positions ? "x" : "v", i - first + 1);
    add(component, [&c, i](const ivp::State<n>& e) { return std::abs(e[i]) / c.amplitude[i]; });
  }
  return all;
}

scene::Figure draw(const Curves& curves, std::map<std::string, std::string> variables) {
  scene::Table data({{"curve", 3, true}, {"t_s"}, {"error"}});
  std::int64_t number = 0;
  std::vector<std::string> lines, dots;
  for (const Curve& curve : curves.lines) {
    ++number;
    lines.push_back(curve.label);
    for (const TimeError& p : curve.points) data.add({number, p.t, p.error});
  }
  for (const Curve& curve : curves.dots) {
    ++number;
    dots.push_back(curve.label);
    for (const TimeError& p : curve.points) data.add({number, p.t, p.error});
  }
  variables["lines"] = fmt::format("{}", fmt::join(lines, "|"));
  if (!dots.empty()) variables["dots"] = fmt::format("{}", fmt::join(dots, "|"));
  return {std::move(data), "rbf_ivp-history", std::move(variables)};
}

const char* word_for(Shown shown) {
  return shown == Shown::state       ? "state error"
         : shown == Shown::positions ? "position error"
                                     : "velocity error";
}

/// "5.6e-4", "0.12"
std::string size_text(double size) {
  if (size >= 0.01) return scene::format_number(size, 2);
  std::string text = fmt::format("{:.1e}", size);
  const auto e = text.find('e');
  return text.substr(0, e + 2) + text.substr(text.find_first_not_of('0', e + 2));
}

/// What there is to see: the time at which the phase is lost, or how large the error gets and how it grows.
std::string finding(const std::vector<Curve>& lines, Shown shown) {
  const Curve& worst = *std::max_element(lines.begin(), lines.end(), [](const Curve& a, const Curve& b) {
    return greatest(a.points) < greatest(b.points);
  });
  const double largest = greatest(worst.points);
  const auto lost =
      std::find_if(worst.points.begin(), worst.points.end(), [](const TimeError& p) { return p.error > 1; });
  if (lost != worst.points.end()) return fmt::format("{} above 1 from {:.0f} s on", word_for(shown), lost->t);
  const std::string size = size_text(largest);
  const double exponent = growth_exponent(worst.points);
  // Less is not told from a level by the eye.
  if (exponent < 0.75) return fmt::format("{} at most {}", word_for(shown), size);
  return fmt::format("{} grows to {} as t^{{{:.1f}}}", word_for(shown), size, exponent);
}

template <int n>
scene::Showing show(const Example<n>& example, const Row<n>& row, const History& history, Workshop& w) {
  const Case<n>& c = example.made();
  const Record<n>& record = w.result(*row.nominal);
  const bool two = row.inferred != row.nominal;
  Curves curves = curves_of(record, c, history.shown, two ? row.reading.as_printed : "all nodes");
  const std::string seen = finding(curves.lines, history.shown);
  if (two) {
    Curves others = curves_of(w.result(*row.inferred), c, history.shown, row.reading.as_inferred);
    std::move(others.lines.begin(), others.lines.end(), std::back_inserter(curves.lines));
    std::move(others.dots.begin(), others.dots.end(), std::back_inserter(curves.dots));
  }
  drop_needless_dots(curves);
  scene::Showing showing;
  showing.figure = draw(
      curves,
      {{"heading", fmt::format("{} ({}): {}", row.reading.method, row.reading.setting, seen)},
       {"quantity", fmt::format("normalised {}, {}", word_for(history.shown), thinning_of(record, c).text)},
       {"end", fmt::format("{:g}", c.t1)},
       {"dot_size", record.statistics.steps <= 20   ? "0.9"
                    : record.statistics.steps <= 60 ? "0.5"
                                                    : "0.35"}});
  const auto promise = [&](const std::string& name, double value, const Expected& expected) {
    showing.quantities.push_back({name, "1", value, expected.low, expected.high, expected.reason});
  };
  if (row.reading.nominal) promise("RMS position error", row.nominal_error(w), *row.reading.nominal);
  if (two && row.reading.inferred) {
    promise("RMS position error, inferred reading", row.inferred_error(w, c.inferred_end),
            *row.reading.inferred);
  }
  if (history.velocity.high > 0) {
    promise("RMS velocity error", rms_error(w.result(*row.nominal), n / 2, row.reading.points),
            history.velocity);
  }
  return showing;
}

template <int n>
void add(scene::Chapter& chapter, const Example<n>& example, const std::vector<History>& figures) {
  for (const History& history : figures) {
    const Row<n>& row = example.row(history.method);
    chapter.add({.name = fmt::format("fig-4.{}", history.figure),
                 .title = fmt::format("{}: {} in time, {}, {}", example.title, word_for(history.shown),
                                      row.reading.method, row.reading.setting),
                 .place = fmt::format("Figure 4.{}", history.figure),
                 .needs = row.needs(),
                 .show = [example, row, history](Workshop& w) { return show(example, row, history, w); }});
  }
}

}  // namespace

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

void add_histories(scene::Chapter& chapter, const Example<2>& example, const std::vector<History>& figures) {
  add(chapter, example, figures);
}

void add_histories(scene::Chapter& chapter, const Example<6>& example, const std::vector<History>& figures) {
  add(chapter, example, figures);
}

}  // namespace nlmech::chapters::rbf_ivp
