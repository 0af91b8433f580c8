#include "nlmech/comparison/commands/run_figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "nlmech/comparison/cost/cost_curves.hpp"
#include "nlmech/scene/picture.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::comparison {
namespace {

using Values = std::vector<double>;

std::string italic(const std::string& name) {
  return fmt::format("{{/:Italic {}}}", scene::without_markup(name));
}

/// Do the values differ by more than rounding?
bool varies(const Values& values) {
  const auto [low, high] = std::ranges::minmax(values);
  return high - low > 1e-12 * std::max(std::abs(low), std::abs(high));
}

/// Sets the range of constant values, for which gnuplot chooses none.
void give_range(const Values& values, scene::Panel& panel) {
  if (varies(values)) return;
  const double margin = values.front() == 0 ? 1 : std::abs(values.front()) / 2;
  panel.y_range(values.front() - margin, values.front() + margin);
}

/// Start of a logarithmic time axis, if most of the steps lie near the start of the run.
std::optional<double> log_begin(const Values& times) {
  if (times.front() != 0 || !(times.back() > 0)) return {};
  if (times[times.size() / 2] > 1e-3 * times.back()) return {};
  return std::max(times[1 + times.size() / 100], 1e-16 * times.back());
}

/// Indices of the first most_panels unknowns.
std::vector<std::size_t> panels_of(const PlotSamples& run) {
  std::vector<std::size_t> shown;
  for (std::size_t i = 0; i < run.components.size(); ++i) {
    if (run.components[i].unknown && shown.size() < most_panels) shown.push_back(i);
  }
  return shown;
}

void put_events(const PlotSamples& run, std::size_t component, scene::Panel& panel) {
  if (run.events.empty()) return;
  Values t, x;
  for (const PlotSamples::Moment& m : run.events) {
    t.push_back(m.t);
    x.push_back(m.x[component]);
  }
  panel.curve("", t, x, {"points pointtype 7 pointsize 0.6", 5});
}

/// Grid of panels, filled row by row.
class Grid {
 public:
  Grid(std::size_t count, scene::Plot& plot)
      : columns_(count > 4 ? 2 : 1), rows_((count + columns_ - 1) / columns_), count_(count), plot_(plot) {
    plot.size(width(), height());
  }
  scene::Panel& panel(const std::string& x_label, const std::string& y_label) {
    const std::size_t row = next_ / columns_, column = next_ % columns_;
    ++next_;
    scene::Panel& panel = plot_.panel(lowest() ? x_label : "", y_label);
    panel.set("format y '%.10g'");
    if (count_ == 1) return panel;
    const double w = width(), h = height(), share = (w - 20) / static_cast<double>(columns_);
    const double left = share * static_cast<double>(column), high = static_cast<double>(row_height * row);
    return panel.place((left + 110) / w, (left + share - 5) / w, 1 - (high + top + row_height - 26) / h,
                       1 - (high + top) / h);
  }
  /// Is the last panel the lowest of its column?
  [[nodiscard]] bool lowest() const { return next_ + columns_ > count_; }

 private:
  static constexpr int top = 44, bottom = 64;
  [[nodiscard]] int width() const { return columns_ == 1 ? 760 : 1000; }
  [[nodiscard]] int height() const {
    return count_ == 1 ? 420 : top + bottom + static_cast<int>(rows_) * static_cast<int>(row_height);
  }
  std::size_t columns_, rows_, count_, next_ = 0;
  static constexpr std::size_t row_height = 170;
  scene::Plot& plot_;
};

/// Candidate pairs of components for a section, the abscissa first; unknowns with their derivatives lead.
std::vector<std::pair<std::size_t, std::size_t>> pairs_of(const PlotSamples& run) {
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  const auto& all = run.components;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i].unknown && all[i].rate) pairs.emplace_back(i, static_cast<std::size_t>(*all[i].rate));
  }
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t j = i + 1; j < all.size(); ++j) pairs.emplace_back(i, j);
  }
  return pairs;
}

}  // namespace

void SampledPath::add(double t, const Eigen::VectorXd& x) {
  bins_.resize(static_cast<std::size_t>(x.size()));
  const bool joins = inside_ > 0 && inside_ < stride_;
  for (std::size_t i = 0; i < bins_.size(); ++i) {
    const Point here{t, x[static_cast<Eigen::Index>(i)]};
    if (joins)
      bins_[i].back().include({here, here});
    else
      bins_[i].push_back({here, here});
  }
  inside_ = joins ? inside_ + 1 : 1;
  if (bins_.front().size() > most_bins) halve();
}

void SampledPath::see(const ivp::Step& step, double end) {
  const double span = end - step.t0, share = std::abs(span / (t1_ - t0_));
  const int places = static_cast<int>(std::clamp(std::ceil(1000 * share), 8.0, 1000.0));
  for (int k = 1; k < places; ++k) {
    const double t = step.t0 + span * k / places;
    add(t, step.at(t));
  }
  add(end, step.at(end));
}

std::pair<std::vector<double>, std::vector<double>> SampledPath::component(std::size_t i) const {
  std::pair<std::vector<double>, std::vector<double>> all;
  const auto put = [&](const Point& p) {
    all.first.push_back(p.t);
    all.second.push_back(p.x);
  };
  for (const Bin& bin : bins_.at(i)) {
    const bool low_first = (bin.high.t - bin.low.t) * (t1_ - t0_) >= 0;
    put(low_first ? bin.low : bin.high);
    if (bin.low.t != bin.high.t) put(low_first ? bin.high : bin.low);
  }
  return all;
}

void SampledPath::halve() {
  for (std::vector<Bin>& bins : bins_) {
    for (std::size_t k = 0; 2 * k < bins.size(); ++k) {
      bins[k] = bins[2 * k];
      if (2 * k + 1 < bins.size()) bins[k].include(bins[2 * k + 1]);
    }
    bins.resize((bins.size() + 1) / 2);
  }
  stride_ *= 2;
}

scene::Figure run_figure(const PlotSamples& run, const std::string& heading) {
  const std::vector<std::size_t> shown = panels_of(run);
  if (run.path.empty()) throw Failure("start and end are at the same time; nothing can be drawn");
  scene::Show show(false);
  scene::Plot& plot = show.plots(scene::without_markup(heading));
  const std::optional<double> begin = log_begin(run.path.component(0).first);
  Grid grid(shown.size(), plot);
  for (const std::size_t i : shown) {
    const auto [t, x] = run.path.component(i);
    scene::Panel& panel = grid.panel("{/:Italic t}", italic(run.components[i].name));
    if (begin)
      panel.log_x(*begin, t.back());
    else
      panel.x_range(std::min(t.front(), t.back()), std::max(t.front(), t.back()));
    if (!grid.lowest()) panel.set("format x ''");
    give_range(x, panel);
    panel.curve("", t, x, scene::lines(1));
    put_events(run, i, panel);
  }
  return *show.take().figure;
}

scene::Figure section_figure(const PlotSamples& run, const std::string& heading) {
  if (run.events.empty()) throw Failure("the run does not meet the section");
  const auto values = [&](std::size_t component) {
    Values all;
    for (const PlotSamples::Moment& m : run.events) all.push_back(m.x[component]);
    return all;
  };
  scene::Show show(false);
  const scene::CurveStyle dots = {
      run.events.size() > 500 ? "points pointtype 7 pointsize 0.2" : "points pointtype 7 pointsize 0.5", 1};
  const auto put = [&](const std::string& x_label, const Values& x, const std::string& y_label,
                       const Values& y) {
    scene::Panel& panel = show.plot(scene::without_markup(heading), x_label, y_label);
    give_range(y, panel);
    panel.curve("", x, y, dots);
    show.figure().size(620, 480);
    return *show.take().figure;
  };
  for (const auto& [i, j] : pairs_of(run)) {
    const Values x = values(i), y = values(j);
    if (varies(x) && varies(y))
      return put(italic(run.components[i].name), x, italic(run.components[j].name), y);
  }
  // At most one component varies, or there is a single point.
  std::size_t moving = 0;
  while (moving + 1 < run.components.size() && !varies(values(moving))) ++moving;
  Values t;
  for (const PlotSamples::Moment& m : run.events) t.push_back(m.t);
  if (t.size() == 1) throw Failure("the run meets the section only once; nothing can be drawn");
  return put("{/:Italic t}", t, italic(run.components[moving].name), values(moving));
}

scene::Figure comparison_figure(const std::vector<scene::MethodLine>& lines, const std::string& heading) {
  if (std::ranges::none_of(lines, [](const scene::MethodLine& l) { return l.best() != nullptr; }))
    throw Failure("no method has any correct digits");
  scene::Show show(false);
  scene::show_work_precision({.heading = scene::without_markup(heading),
                              .work = work_columns(),
                              .work_label = "right-hand sides",
                              .groups = method_groups("adaptive collocation")},
                             {{"", lines}}, show);
  return *show.take().figure;
}

}  // namespace nlmech::comparison
