#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "chapters/rbf_ivp/scenes.hpp"
#include "nlmech/collocation/barycentric.hpp"
#include "nlmech/collocation/differentiation.hpp"
#include "nlmech/collocation/nodes.hpp"
#include "nlmech/collocation/stable_gaussian.hpp"

namespace nlmech::chapters::rbf_ivp {
namespace {

using collocation::Kernel;
using scene::Workshop;

/// Largest |D - D of polynomials| relative to the largest entry of the latter, for n nodes on the unit
/// interval.
struct Point {
  int nodes;
  double shape, stable;
  std::optional<double> solved;
  double condition;
};

Eigen::VectorXd times_of(int n) { return (collocation::legendre_gauss_lobatto(n).array() + 1) / 2; }

Point point(int n, double shape) {
  const Eigen::VectorXd times = times_of(n);
  // From nodes on [-1, 1], where differences of those near both ends keep their digits.
  const Eigen::MatrixXd P =
      2 * collocation::polynomial_differentiation_matrix(collocation::legendre_gauss_lobatto(n));
  const auto difference = [&](const Eigen::MatrixXd& D) {
    return (D - P).cwiseAbs().maxCoeff() / P.cwiseAbs().maxCoeff();
  };
  const collocation::StableGaussian stable(times, shape);
  const auto direct = collocation::radial_differentiation(times, Kernel::gaussian, shape);
  Point result{n, shape, difference(stable.differentiation_matrix()), std::nullopt, direct.condition};
  if (direct.matrix.size() > 0) result.solved = difference(direct.matrix);
  return result;
}

std::vector<Point> points(bool quick) {
  std::vector<Point> all;
  const int step = quick ? 6 : 2, count = quick ? 16 : 64;
  for (int n = 3; n <= 45; n += step) {
    for (int i = 0; i <= count; ++i) all.push_back(point(n, std::pow(10, -6 + 7.0 * i / count)));
  }
  return all;
}

scene::Table data_of(const std::vector<Point>& all) {
  scene::Table data({{"nodes", 3, true}, {"shape"}, {"stable"}, {"solve"}, {"condition"}});
  for (const Point& p : all)
    data.add({std::int64_t(p.nodes), p.shape, p.stable, p.solved.value_or(NAN), p.condition});
  return data;
}

std::vector<scene::Quantity> quantities() {
  std::vector<scene::Quantity> list;
  for (const int n : {7, 35, 100}) {
    const double power = std::log10(point(n, 1e-2).stable / point(n, 1e-3).stable);
    list.push_back(scene::near("power of c h by which D tends to polynomials, N = " + std::to_string(n), "1",
                               power, 2, 0.005, "Gaussians are even functions of c, so that D is one"));
    list.push_back(scene::at_most("difference to polynomials at c h = 1e-6, N = " + std::to_string(n), "1",
                                  point(n, 1e-6).stable, 1e-11,
                                  "(c h)^2 = 1e-12, and the rounding of both matrices"));
  }
  const double wild = point(15, 0.1).solved.value_or(HUGE_VAL);
  list.push_back({"difference to polynomials at c h = 0.1, N = 15, solved by LU", "1", std::min(wild, 1e9),
                  0.1, 1e9, "nothing is left of D once the condition exceeds 1e16; recorded"});
  return list;
}

scene::Showing show(const std::vector<Point>& all) {
  scene::Showing showing;
  showing.figure = {
      data_of(all), "rbf_ivp-contour", {{"heading", "Wide Gaussians differentiate as polynomials do"}}};
  showing.quantities = quantities();
  return showing;
}

}  // namespace

void add_contour(scene::Chapter& chapter) {
  const auto& runs = chapter.add_run<std::vector<Point>>(
      "flat-limit",
      "differentiation matrices of Gaussians at Legendre-Gauss-Lobatto nodes by the stable basis and by LU "
      "factors, against that of polynomials",
      {}, [](Workshop& w) { return points(w.quick()); });
  chapter.add({.name = "contour",
               .title = "The flat limit of Gaussians is the polynomial, over shape and number of nodes",
               .place = "our own",
               .needs = {&runs},
               .show = [&runs](Workshop& w) { return show(w.result(runs)); }});
}

}  // namespace nlmech::chapters::rbf_ivp
