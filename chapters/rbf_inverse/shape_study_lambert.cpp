#include <algorithm>
#include <cmath>
#include <vector>

#include "chapters/rbf_inverse/curves.hpp"
#include "chapters/rbf_inverse/scenes.hpp"
#include "chapters/rbf_inverse/transfer_runs.hpp"

namespace nlmech::chapters {
namespace {

using orbit::TransferBasis;
using scene::Workshop;

/// Misses over the shape, and of polynomials over the number of nodes.
struct Study {
  std::vector<double> shapes, solved, stable;  // c T; m
  std::vector<int> nodes;
  std::vector<double> polynomial;  // m
};

double miss(TransferBasis basis, int nodes, double shape) {
  const auto t = orbit::collocate(printed_transfer(),
                                  {.nodes = nodes, .basis = basis, .shape = shape, .largest_miss = 0.01});
  return t.status.ok() ? t.miss : NAN;
}

Study study(Workshop& w) {
  Study s;
  const int count = w.quick() ? 9 : 25;
  for (int i = 0; i < count; ++i) {
    const double shape = 2 * std::pow(20.0, i / (count - 1.0));
    s.shapes.push_back(shape);
    s.solved.push_back(miss(TransferBasis::gaussian, 47, shape));
    s.stable.push_back(miss(TransferBasis::stable_gaussian, 47, shape));
  }
  for (const int n : {15, 21, 27, 31, 35, 41, 47, 53, 61, 71, 81}) {
    s.nodes.push_back(n);
    s.polynomial.push_back(miss(TransferBasis::polynomial, n, 0));
  }
  return s;
}

scene::Showing show(const scene::Run<Study>& run, Workshop& w) {
  const Study& s = w.result(run);
  ControlCurves curves("Only the stable basis reaches a millimetre", "abscissa");
  const auto add = [&](double x, double y) {
    if (y > 0) curves.add(x, y);
  };
  curves.panel("shape c T", "miss (m)", "47 nodes");
  curves.begin("by solving", "b1");
  for (std::size_t i = 0; i < s.shapes.size(); ++i) add(s.shapes[i], s.solved[i]);
  curves.begin("stable", "b2");
  for (std::size_t i = 0; i < s.shapes.size(); ++i) add(s.shapes[i], s.stable[i]);
  curves.with("logy", "1").with("yrange", "[1e-7:1e5]").with("key", "bottom right");
  curves.panel("nodes N", "miss (m)", "polynomials");
  curves.begin("", "b3");
  for (std::size_t i = 0; i < s.nodes.size(); ++i) add(s.nodes[i], s.polynomial[i]);
  curves.with("logy", "1").with("key", "off");
  const auto least = [](const std::vector<double>& all) {
    double best = HUGE_VAL;
    for (const double m : all) best = m < best ? m : best;
    return best;
  };
  const auto at = [&](int n) {
    return s
        .polynomial[static_cast<std::size_t>(std::find(s.nodes.begin(), s.nodes.end(), n) - s.nodes.begin())];
  };
  const char* const program = "recorded";
  scene::Showing showing;
  showing.figure = curves.take();
  showing.quantities = {
      {"least miss with D by solving", "m", least(s.solved), 0.05, 50, "3.6 m at best; recorded; rounding"},
      scene::at_most("least miss with D without loss of digits", "m", least(s.stable), 1e-3,
                     "the section's millimetre"),
      scene::near("miss of polynomials with 31 nodes", "m", at(31), 0.17, 0.5, program),
      scene::near("miss of polynomials with 41 nodes", "m", at(41), 1.9e-4, 0.5, program),
      scene::at_most("miss of polynomials with 61 nodes", "m", at(61), 1e-4, "6e-7 m; recorded; rounding")};
  return showing;
}

}  // namespace

void add_shape_study_lambert(scene::Chapter& chapter) {
  const auto& run = chapter.add_run<Study>(
      "lambert-shapes", "equations for positions alone, Newton's iteration from an arc about the centre", {},
      study);
  chapter.add({.name = "shape-study-lambert",
               .title = "Miss of the transfer over shape and number of nodes",
               .place = "our own",
               .needs = {&run},
               .show = [&run](Workshop& w) { return show(run, w); }});
}

}  // namespace nlmech::chapters
