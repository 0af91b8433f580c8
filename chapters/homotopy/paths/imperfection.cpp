#include <fmt/format.h>

#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "chapters/homotopy/paths/walked.hpp"
#include "nlmech/scene/scene.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::chapters::homotopy::imperfection {
namespace {

using frames::FramePoint;
using Kind = FramePoint::Kind;

constexpr int levels = 7;
constexpr double ratio = 4;  ///< of two amplitudes

/// A frame with smaller and smaller imperfections.
struct Subject {
  std::string file, name;
  int elements;
  double power;       ///< of the amplitude in the loss of load, by Koiter's theory
  double greatest;    ///< amplitude, in the file's units
  double height = 0;  ///< of the toggle; 0: the file's
};
const std::vector<Subject> subjects = {{"inclined-brace", "inclined brace", 1, 1. / 2, 0.08},
                                       {"level-brace", "level brace", 1, 2. / 3, 0.08},
                                       {"toggle", "toggle 0.8 high, tilted", 4, 2. / 3, 0.02, 0.8},
                                       {"half-shallow-arch", "arch, lowered", 2, 1, 0.02}};

/// One imperfection.
struct Loss {
  double amplitude, limit, loss;
};

/// A frame and its losses.
struct Series {
  double critical = 0;
  std::vector<Loss> losses;
  /// The power between two neighbouring amplitudes, from the greatest ones on.
  [[nodiscard]] double power(std::size_t i) const {
    return std::log(losses[i].loss / losses[i + 1].loss) / std::log(ratio);
  }
  /// Its limit for small amplitudes. By theory the loss is a series in a^p (in a, for p = 1), so that errors
  /// of power() fall by ratio^p.
  [[nodiscard]] double power_at_zero(double p) const {
    const std::size_t last = losses.size() - 2;
    return power(last) + (power(last) - power(last - 1)) / (std::pow(ratio, p) - 1);
  }
  [[nodiscard]] double last_change() const {
    return std::abs(power(losses.size() - 2) - power(losses.size() - 3));
  }
};

/// The curves of the column with the inclined brace.
struct Family {
  double amplitude;
  std::vector<FramePoint> points;
};

struct Study {
  std::vector<Series> series;
  std::vector<Family> family;
  Eigen::Index foot = 0;
};

FramePoint first_limit(const frames::NamedFrame& frame) {
  const frames::FramePaths paths = equilibrium_paths(frame, {.critical = 1});
  if (!paths.status.ok()) throw Failure(paths.status);
  if (paths.points.back().kind != Kind::maximum) throw Failure("imperfection: no maximum on the path");
  return paths.points.back();
}

frames::Imperfect made(const frames::NamedFrame& perfect, double amplitude) {
  frames::Imperfect out = imperfect(perfect, {.mode = 1, .amplitude = amplitude});
  if (!out.status.ok()) throw Failure(out.status);
  return out;
}

Series series_of(const Subject& s) {
  Series out;
  frames::FrameModel model = shipped_model(s.file);
  if (s.height > 0) model.nodes[1].y = s.height;
  const frames::NamedFrame perfect = build(model, s.elements);
  // Of both directions of a shape the one that costs more: the limit point's may be the other way.
  double amplitude = s.greatest;
  if (s.power == 1 && first_limit(made(perfect, amplitude).frame).load > made(perfect, 0).buckled.load)
    amplitude = -amplitude;
  for (int i = 0; i < levels; ++i, amplitude /= ratio) {
    const frames::Imperfect f = made(perfect, amplitude);
    out.critical = f.buckled.load;
    const double limit = first_limit(f.frame).load;
    out.losses.push_back({std::abs(amplitude), limit, 1 - limit / out.critical});
  }
  return out;
}

Study study() {
  Study out;
  for (const Subject& s : subjects) out.series.push_back(series_of(s));
  const frames::NamedFrame perfect = build(shipped_model("inclined-brace"), 1);
  out.foot = unknown_of(perfect, "foot.x");
  for (const double amplitude : {0.001, 0.01, 0.05, -0.001, -0.01, -0.05}) {
    const frames::FramePaths paths =
        equilibrium_paths(made(perfect, amplitude).frame, {.steps = 60, .turn = 0.05});
    Family family{amplitude, {}};
    for (const FramePoint& p : paths.points) {
      if (std::abs(p.x[out.foot]) > 0.6 || p.load > 0.6) break;
      family.points.push_back(p);
    }
    out.family.push_back(std::move(family));
  }
  return out;
}

/// The limit load of the column with the inclined brace, as one degree of freedom: the foot at x.
double exact_inclined(double e) {
  const auto brace = [](double x) { return std::hypot(1 - x, 1.); };
  const double rest = brace(e), column = std::hypot(1., e);
  const auto load = [&](double x) {
    const double pull = (brace(x) - rest) / rest * -(1 - x) / brace(x);
    return pull * std::sqrt((column - x) * (column + x)) / x;
  };
  const auto found = boost::math::tools::brent_find_minima([&](double x) { return -load(x); }, e, 0.9, 53);
  return -found.second;
}

/// The same with the level brace.
double exact_level(double e) {
  const double column = std::hypot(1., e), sine = e / column;
  return column * 2 / (2 - e) * std::pow(1 - std::pow(sine, 2. / 3), 1.5);
}

void put(const Study& all, scene::Show& show) {
  scene::Plot& plot = show.plots(
      "An imperfection a costs load like a^{1/2} where buckling has a side, like a^{2/3} where it has none");
  plot.size(960, 480).columns({"panel", "curve", "x", "y"});
  scene::Panel& paths =
      plot.panel("displacement of the foot, towards the brace / height", "load / critical load");
  paths.key("off").x_range(-0.5, 0.6).y_range(0, 1.45);
  const double critical = all.series[0].critical;
  for (const Family& f : all.family) {
    const double e = f.amplitude;
    paths.curve(
        "", f.points, [&](const FramePoint& p) { return e + p.x[all.foot]; },
        [&](const FramePoint& p) { return p.load / critical; }, scene::lines(e > 0 ? 1 : 2));
  }
  paths.curve("", std::vector<double>{0, 0}, std::vector<double>{0, 1.4}, scene::thin_lines(8));
  paths.caption("inclined brace, imperfections of 0.001, 0.01 and 0.05");
  scene::Panel& losses = plot.panel("amplitude, in the file's units", "share of the critical load lost");
  losses.log_x(2e-6, 0.2).log_y(1e-10, 1).key("bottom right");
  for (std::size_t i = 0; i < subjects.size(); ++i)
    losses.curve(subjects[i].name, all.series[i].losses, &Loss::amplitude, &Loss::loss,
                 scene::points(static_cast<int>(i) + 1));
  const auto law = [&](const char* name, double power, double factor, int style) {
    losses.curve(name, std::vector<double>{4e-6, 0.15},
                 std::vector<double>{factor * std::pow(4e-6, power), factor * std::pow(0.15, power)},
                 scene::thin_lines(style));
  };
  law("2 (0.75 a)^{1/2}", 0.5, 2 * std::sqrt(0.75), 1);
  law("1.5 a^{2/3}", 2. / 3, 1.5, 2);

  double worst[2] = {};
  for (const Loss& l : all.series[0].losses)
    worst[0] = std::max(worst[0], std::abs(l.limit / exact_inclined(l.amplitude) - 1));
  for (const Loss& l : all.series[1].losses)
    worst[1] = std::max(worst[1], std::abs(l.limit / exact_level(l.amplitude) - 1));
  const char* shortened = "one degree of freedom; the column shortens by P/EA, at most 1e-6";
  show.at_most("limit loads with an inclined brace against the exact ones, relative", worst[0], 1e-6,
               shortened);
  show.at_most("limit loads with a level brace against the exact ones, relative", worst[1], 2e-6, shortened);
  for (std::size_t i = 0; i < subjects.size(); ++i) {
    const Subject& s = subjects[i];
    const double change = all.series[i].last_change();
    show.between(fmt::format("power of the amplitude, {}", s.name), all.series[i].power_at_zero(s.power),
                 s.power - change, s.power + change,
                 "Koiter; the next term of the series changes it by no more than between the last two pairs");
  }
  struct Line {
    std::string name;
    double critical;
    Loss loss;
    std::optional<double> power;
  };
  std::vector<Line> lines;
  for (std::size_t i = 0; i < subjects.size(); ++i) {
    const Series& s = all.series[i];
    for (std::size_t k = 0; k < s.losses.size(); ++k)
      lines.push_back(
          {subjects[i].name, s.critical, s.losses[k], k > 0 ? std::optional(s.power(k - 1)) : std::nullopt});
  }
  show.table(lines, {{"frame", &Line::name},
                     {"critical load", &Line::critical, 10},
                     {"amplitude", [](const Line& l) { return l.loss.amplitude; }, 4},
                     {"limit load", [](const Line& l) { return l.loss.limit; }, 10},
                     {"share lost", [](const Line& l) { return l.loss.loss; }, 4},
                     {"power since the last", &Line::power, 5}});
}

}  // namespace

std::vector<scene::Scene> scenes() {
  const scene::Result losses(
      "imperfect-limits",
      "chapters/homotopy/frames, imperfections along the shape of the first limit or "
      "branch point, amplitudes "
      "fallen by 4; half an arch of 8 elements, a toggle with its apex at 0.8 and 4 elements a member",
      study);
  return {{.name = "imperfection",
           .title = "Koiter's law: what an imperfection costs at a bifurcation, and at a limit point",
           .content = scene::Content(put, losses)}};
}

}  // namespace nlmech::chapters::homotopy::imperfection
