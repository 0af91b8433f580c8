#include <algorithm>
#include <cmath>
#include <ranges>
#include <vector>

#include "chapters/rbf_inverse/lambert/printed_transfer.hpp"
#include "nlmech/scene/scene.hpp"

namespace nlmech::chapters::rbf_inverse::shape_study_lambert {
namespace {

using orbit::TransferBasis;

/// A miss, m, NaN without a solution, over the shape c T or the number of nodes.
struct Point {
  double x, miss;
};
struct Study {
  std::vector<Point> solved, stable;  ///< by shape
  std::vector<Point> polynomial;      ///< by nodes
};

double miss(TransferBasis basis, int nodes, double shape) {
  const auto t = orbit::collocate(printed_transfer(),
                                  {.nodes = nodes, .basis = basis, .shape = shape, .largest_miss = 0.01});
  return t.status.ok() ? t.miss : NAN;
}

Study study(bool quick) {
  Study s;
  const int count = quick ? 9 : 25;
  for (int i = 0; i < count; ++i) {
    const double shape = 2 * std::pow(20.0, i / (count - 1.0));
    s.solved.push_back({shape, miss(TransferBasis::gaussian, 47, shape)});
    s.stable.push_back({shape, miss(TransferBasis::stable_gaussian, 47, shape)});
  }
  for (const int n : {15, 21, 27, 31, 35, 41, 47, 53, 61, 71, 81})
    s.polynomial.push_back({double(n), miss(TransferBasis::polynomial, n, 0)});
  return s;
}

void put(const Study& s, scene::Show& show) {
  scene::Plot& plot = show.plots("Only the stable basis reaches a millimetre");
  plot.size(760, 480).columns({"panel", "curve", "abscissa", "y"});
  const auto curve = [](scene::Panel& panel, const char* name, const std::vector<Point>& points, int style) {
    const auto solved = [](const Point& p) { return p.miss > 0; };
    panel.curve(name, points | std::views::filter(solved), &Point::x, &Point::miss,
                scene::linespoints(style));
  };
  scene::Panel& by_shape = plot.panel("shape c T", "miss (m)").caption("47 nodes");
  by_shape.log_y(1e-7, 1e5).key("bottom right");
  curve(by_shape, "by solving", s.solved, 1);
  curve(by_shape, "stable", s.stable, 2);
  curve(plot.panel("nodes N", "miss (m)").caption("polynomials").log_y(), "", s.polynomial, 3);
  const auto least = [](const std::vector<Point>& all) {
    double best = HUGE_VAL;
    for (const Point& p : all) best = p.miss < best ? p.miss : best;
    return best;
  };
  const auto at = [&](int n) -> scene::Amount {
    return {std::ranges::find(s.polynomial, n, &Point::x)->miss, "m"};
  };
  show.between("least miss with D by solving", {least(s.solved), "m"}, 0.05, 50,
               "3.6 m at best; recorded; rounding");
  show.at_most("least miss with D without loss of digits", {least(s.stable), "m"}, 1e-3,
               "the section's millimetre");
  show.near("miss of polynomials with 31 nodes", at(31), 0.17, 0.5, "recorded");
  show.near("miss of polynomials with 41 nodes", at(41), 1.9e-4, 0.5, "recorded");
  show.at_most("miss of polynomials with 61 nodes", at(61), 1e-4, "6e-7 m; recorded; rounding");
}

}  // namespace

std::vector<scene::Scene> scenes() {
  const scene::Result misses("lambert-shapes",
                             "equations for positions alone, Newton's iteration from an arc about the centre",
                             study);
  return {{.name = "shape-study-lambert",
           .title = "Miss of the transfer over shape and number of nodes",
           .content = scene::Content(put, misses)}};
}

}  // namespace nlmech::chapters::rbf_inverse::shape_study_lambert
