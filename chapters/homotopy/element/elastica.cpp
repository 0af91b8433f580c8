#include "nlmech/frames/elastica.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "nlmech/algebraic/newton/energy_trust_region.hpp"
#include "nlmech/algebraic/paths/path.hpp"
#include "nlmech/frames/equilibrium.hpp"
#include "nlmech/frames/loaded_frame.hpp"
#include "nlmech/frames/toggle.hpp"
#include "nlmech/scene/scene.hpp"
#include "nlmech/support/doubles.hpp"

namespace nlmech::chapters::homotopy::elastica {
namespace {

constexpr double snap_load = 44;

/// What is compared for one height.
struct Loads {
  double maximum = nan, minimum = nan;  ///< limit loads
};

struct Row {
  int elements = 0;      ///< 0: exact
  Loads high, low;       ///< heights 0.44 and 0.38
  double snapped = nan;  ///< drop under 44 lb, height 0.44
};

struct Convergence {
  Row exact;
  std::vector<Row> frames;
};

Loads limits_of_frame(double height, int elements) {
  const frames::ToggleFrame toggle = make_frame(frames::Toggle{.height = height, .elements = elements});
  frames::LoadedFrame loaded(toggle.frame, toggle.load);
  algebraic::Path path({.first = 2}, loaded, Eigen::VectorXd::Zero(toggle.frame.size()), 0);
  Loads loads;
  std::vector<algebraic::PathPoint> here;
  Status status = path.start();
  for (int k = 0; k < 200 && status.ok() && std::isnan(loads.minimum); ++k) {
    status = path.advance();
    if (!status.ok() || path.folds(here) != Outcome::success) break;
    for (const algebraic::PathPoint& fold : here)
      (std::isnan(loads.maximum) ? loads.maximum : loads.minimum) = fold.load;
  }
  return loads;
}

Loads limits_of_elastica(const std::vector<frames::ElasticaPoint>& curve, const frames::Elastica& elastica) {
  Loads loads;
  for (std::size_t i = 1; i < curve.size(); ++i) {
    if ((curve[i].slope > 0) == (curve[i - 1].slope > 0)) continue;
    const frames::ElasticaPoint limit = elastica.limit(curve[i - 1], curve[i]);
    if (limit.outcome == Outcome::success)
      (std::isnan(loads.maximum) ? loads.maximum : loads.minimum) = limit.load;
  }
  return loads;
}

/// The drop under the snapping load, by Newton's iteration from the curve's end.
double drop_of_elastica(const std::vector<frames::ElasticaPoint>& curve, const frames::Elastica& elastica) {
  frames::ElasticaPoint at = curve.back();
  for (int k = 0; k < 8 && at.outcome == Outcome::success; ++k)
    at = elastica.at(at.drop - (at.load - snap_load) / at.slope, at);
  return at.outcome == Outcome::success ? at.drop : nan;
}

double drop_of_frame(int elements) {
  const frames::ToggleFrame toggle = make_frame(frames::Toggle{.height = 0.44, .elements = elements});
  frames::Equilibrium equations(toggle.frame, toggle.load, snap_load);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(toggle.frame.size());
  return find_root(algebraic::EnergyTrustRegion{}, equations, x).status.ok() ? -x[toggle.apex] : nan;
}

Convergence compute(bool quick) {
  Convergence c;
  const frames::Elastica high({.height = 0.44}), low({.height = 0.38});
  const auto curve = high.curve(0.65, 13);
  c.exact.high = limits_of_elastica(curve, high);
  c.exact.low = limits_of_elastica(low.curve(0.6, 12), low);
  c.exact.snapped = drop_of_elastica(curve, high);
  for (int elements = 1; elements <= (quick ? 32 : 128); elements *= 2)
    c.frames.push_back({elements, limits_of_frame(0.44, elements), limits_of_frame(0.38, elements),
                        drop_of_frame(elements)});
  return c;
}

/// Relative errors of a row, in the order of the figure's curves.
constexpr std::array names = {"0.44 in, maximum", "0.44 in, minimum", "0.38 in, maximum", "0.38 in, minimum",
                              "drop under 44 lb"};
std::array<double, 5> values(const Row& r) {
  return {r.high.maximum, r.high.minimum, r.low.maximum, r.low.minimum, r.snapped};
}
std::array<double, 5> errors(const Convergence& c, std::size_t row) {
  std::array<double, 5> e = values(c.frames[row]);
  const auto exact = values(c.exact);
  for (std::size_t i = 0; i < e.size(); ++i) e[i] = std::abs(e[i] / exact[i] - 1);
  return e;
}

void put_table(const Convergence& c, scene::Show& show) {
  std::vector<Row> rows = c.frames;
  rows.push_back(c.exact);
  show.table(rows, {{"elements a member",
                     [](const Row& r) { return r.elements == 0 ? "exact" : std::to_string(r.elements); }},
                    {"maximum, 0.44 in (lb)", [](const Row& r) { return r.high.maximum; }, 12},
                    {"minimum, 0.44 in (lb)", [](const Row& r) { return r.high.minimum; }, 12},
                    {"maximum, 0.38 in (lb)", [](const Row& r) { return r.low.maximum; }, 12},
                    {"minimum, 0.38 in (lb)", [](const Row& r) { return r.low.minimum; }, 12},
                    {"drop under 44 lb (in)", &Row::snapped, 12}});
}

void draw(const Convergence& c, scene::Show& show) {
  scene::Table data({{"curve", 3, true}, {"elements"}, {"error"}});
  for (std::size_t i = 0; i < names.size(); ++i) {
    for (std::size_t k = 0; k < c.frames.size(); ++k)
      data.add({names[i], c.frames[k].elements, errors(c, k)[i]});
  }
  scene::Panel& panel =
      show.plot("Elements converge to the elastica in second order", "elements a member", "relative error");
  panel.log_x(0.8, 160).log_y(1e-9, 3e-4).key("bottom left").set("mxtics 1").set("format x '%g'");
  panel.set("xtics (1, 2, 4, 8, 16, 32, 64, 128)").note("second order", 40, 4e-5);
  show.figure().data(std::move(data));
  for (std::size_t i = 0; i < names.size(); ++i)
    panel.columns(names[i], "elements:error", scene::linespoints(), static_cast<int>(i));
  panel.also("[16:128] 0.03/x**2 with lines linecolor rgb ink dashtype 2 linewidth 1 notitle");
}

void check(const Convergence& c, scene::Show& show) {
  // oracle: homotopy_elastica elastica 0.?? maximum, elastica 0.?? minimum
  // oracle: homotopy_frames toggle 0.44 of 1 maximum, toggle 0.44 of 1 minimum, toggle 0.?? of 32 *
  const char *shooting = "shooting by tools/oracles/homotopy_elastica.py, all its digits",
             *program = "tools/oracles/homotopy_frames.py, all its digits";
  const Row &one = c.frames.at(0), &two = c.frames.at(1), &many = c.frames.at(5);
  const auto near = [&](const char* name, double load, double known, double relative, const char* reason) {
    show.near(name, {load, "lb"}, known, relative, reason);
  };
  near("exact maximum, 0.44 in", c.exact.high.maximum, 42.4397755886, 4e-12, shooting);
  near("exact minimum, 0.44 in", c.exact.high.minimum, 32.1221640887, 4e-12, shooting);
  near("exact maximum, 0.38 in", c.exact.low.maximum, 33.1252040575, 4e-12, shooting);
  near("exact minimum, 0.38 in", c.exact.low.minimum, 31.1081968550, 4e-12, shooting);
  near("maximum by 1 element, 0.44 in", one.high.maximum, 42.435492120383, 1e-12, program);
  near("minimum by 1 element, 0.44 in", one.high.minimum, 32.124218754757, 1e-12, program);
  near("maximum by 32 elements, 0.44 in", many.high.maximum, 42.4397589244, 4e-12, program);
  near("minimum by 32 elements, 0.44 in", many.high.minimum, 32.1221656364, 4e-12, program);
  near("maximum by 32 elements, 0.38 in", many.low.maximum, 33.1251939340, 4e-12, program);
  near("minimum by 32 elements, 0.38 in", many.low.minimum, 31.1081922157, 4e-12, program);
  // An S is its own mirror image: the middle of a member carries no moment, and one element is exact there.
  near("maximum by 2 elements, 0.44 in", two.high.maximum, one.high.maximum, 1e-12,
       "by symmetry what one element gives");
  const auto coarse = errors(c, 4), fine = errors(c, 5);
  for (std::size_t i = 0; i < names.size(); ++i)
    show.between(fmt::format("order from 16 to 32 elements, {}", names[i]), std::log2(coarse[i] / fine[i]),
                 1.95, 2.05,
                 "the element's rotations are linear about its chord: an error of the square of its length");
}

}  // namespace

std::vector<scene::Scene> scenes() {
  const scene::Result result(
      "elastica-convergence",
      "limit loads for heights of 0.38 and 0.44 in, and the drop under 44 lb, by 1 to 128 elements a member "
      "and by shooting for the exact extensible elastica, 1000 steps",
      compute);
  return {{.name = "elastica",
           .title = "Convergence of elements to the exact elastica",
           .content = scene::Content(
               [](const Convergence& c, scene::Show& show) {
                 draw(c, show);
                 put_table(c, show);
                 check(c, show);
               },
               result)}};
}

}  // namespace nlmech::chapters::homotopy::elastica
