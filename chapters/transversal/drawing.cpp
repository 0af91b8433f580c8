#include <cmath>
#include <functional>
#include <vector>

#include "chapters/transversal/oscillators.hpp"
#include "nlmech/ivp/transversal/mtl.hpp"
#include "nlmech/scene/scene.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::chapters::transversal::drawing {
namespace {

constexpr int p = 4;
constexpr double h = 0.4;

/// Samples of one block of x'' + x + x^3 = cos t from (1, 0), p = 4, h = 0.4.
struct Block {
  std::vector<double> t, path, defect;  ///< time; linearised path and its residual in the equation
  std::vector<Point> points;            ///< the p + 1 points
};

/// Lagrange interpolant at t of the cubes of the points' positions, which replaces x^3 in the linearised
/// equation.
double interpolated_cube(const std::vector<Point>& points, double t) {
  double sum = 0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    double term = std::pow(points[k].x[0], 3);
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (i != k) term *= (t - points[i].t) / (points[k].t - points[i].t);
    }
    sum += term;
  }
  return sum;
}

Block block() {
  const problems::TextProblem problem("driven-duffing");
  const ivp::State x0{1, 0};
  Block b;
  b.points.push_back({0, x0});
  const auto observe = [&b](const ivp::Step& step) {
    for (std::size_t i = 0; i < step.times.size(); ++i)
      b.points.push_back({step.times[i], step.states.col(static_cast<Eigen::Index>(i))});
    for (int i = 0; i <= 200; ++i) {
      ivp::State x(2);
      // Every fiftieth sample is at a point.
      const double t = i % 50 == 0 ? b.points[static_cast<std::size_t>(i / 50)].t : p * h * i / 200;
      step.dense.at(t, x);
      b.t.push_back(t);
      b.path.push_back(x[0]);
      // y'' + y + y^3 - cos t with y'' + y = cos t - (interpolated cube).
      b.defect.push_back(std::pow(x[0], 3) - interpolated_cube(b.points, t));
    }
    return true;
  };
  const ivp::Mtl method{.step = h, .points = p, .error_tolerance = 0};  // as in the source
  const auto s = ivp::integrate(ivp::System(problem), x0, 0, p * h, method, observe);
  if (!s.status.ok()) throw Failure(s.status);
  return b;
}

/// Curves of the sketch: a smooth true path. The linearised path differs from it by a multiple of
/// product (t - t_k), like the interpolation error, and meets it at the points.
double drawn_path(double s) { return 1.1 + 0.35 * s - 0.55 * std::sin(0.9 * s + 0.2); }
double drawn_gap(double s) {
  double product = 0.07;
  for (int k = 0; k <= p; ++k) product *= s - k;
  return product;
}

/// Number of sign changes of the drawn gap, which vanishes at the points.
int drawn_crossings(const std::vector<double>& s) {
  int crossings = 0;
  double before = drawn_gap(-0.2);
  for (const double at : s) {
    const double gap = drawn_gap(at);
    if (gap * before < 0) ++crossings;
    if (gap != 0) before = gap;
  }
  return crossings;
}

void draw(const Block& b, const std::vector<double>& s, scene::Show& show) {
  scene::Plot& plot = show.plots("The linearised path crosses the true path at the grid points");
  plot.stacked({2, 1}).columns({"series", "t", "y"});
  scene::Panel& sketch = plot.panel("", "{/:Italic x}, sketched");
  sketch.x_range(-0.25, 4.25).y_range(0.2, 3.2).set("ytics format ''").set("xtics 1").key("top left");
  std::vector<double> points;
  for (int k = 0; k <= p; ++k) points.push_back(k);
  sketch.curve("true path", s, std::identity(), drawn_path);
  sketch.curve("linearised path, its distance enlarged", s, std::identity(),
               [](double at) { return drawn_path(at) + drawn_gap(at); });
  sketch.curve("points {/:Italic X}_{/:Italic k}", points, std::identity(), drawn_path, scene::points(3));
  scene::Panel& defect = plot.panel("time, {/:Italic h} = 0.4", "defect × 10^3");
  defect.x_range(-0.25, 4.25).key("off").set("ytics 2");
  defect.set(
      "xtics ('{/:Italic t}_0' 0, '{/:Italic t}_1' 1, '{/:Italic t}_2' 2, '{/:Italic t}_3' 3, '{/:Italic "
      "t}_4' 4)");
  std::vector<double> steps, thousandths;
  for (std::size_t i = 0; i < b.t.size(); ++i) {
    steps.push_back(b.t[i] / h);
    thousandths.push_back(1e3 * b.defect[i]);
  }
  defect.curve("", steps, thousandths, scene::lines(5)).also("0 with lines linestyle 13");
}

void put(const Block& b, scene::Show& show) {
  std::vector<double> s;
  for (int i = -10; i <= 210; ++i) s.push_back(i / 50.);
  draw(b, s, show);
  double at_points = 0, between = 0;
  for (std::size_t i = 0; i < b.t.size(); ++i) {
    double& where = i % 50 == 0 ? at_points : between;
    where = std::max(where, std::abs(b.defect[i]));
  }
  show.equals("crossings drawn", drawn_crossings(s), p + 1, "one at each of the p + 1 points");
  show.at_most("greatest defect at the points", at_points, 1e-12,
               "vector fields agree there (Eq. 3): roundings of a cube of size 1, and Newton's tolerance");
  show.between("greatest defect between the points", between, 1e-4, 1e-1,
               "the interpolation error of x^3 is about h^5 = 0.01 times a fifth derivative of some units, "
               "over 5! and "
               "times the greatest |s (s - 1)...(s - 4)|, 3.6");
}

}  // namespace

std::vector<scene::Scene> scenes() {
  const scene::Result result(
      "block",
      "the drawing is a sketch; the defect below it is that of x'' + x + x^3 = cos t, p = 4, h = 0.4", block);
  return {{.name = "fig-1",
           .title = "True and linearised paths cross at the grid points, p = 4",
           .place = "Figure 1",
           .content = scene::Content(put, result)}};
}

}  // namespace nlmech::chapters::transversal::drawing
