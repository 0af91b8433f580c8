#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "nlmech/collocation/barycentric.hpp"
#include "nlmech/collocation/differentiation.hpp"
#include "nlmech/collocation/nodes.hpp"
#include "nlmech/collocation/radial/stable_gaussian.hpp"
#include "nlmech/scene/scene.hpp"

namespace nlmech::chapters::rbf_ivp::contour {
namespace {

/// Largest |D - D of polynomials| relative to the largest entry of the latter, for n nodes on the unit
/// interval.
struct Point {
  int nodes;
  double shape, stable;
  std::optional<double> solved;
  double condition;
};

Point point(int n, double shape) {
  const Eigen::VectorXd nodes = collocation::legendre_gauss_lobatto(n), times = (nodes.array() + 1) / 2;
  // From nodes on [-1, 1], where differences of those near both ends keep their digits.
  const Eigen::MatrixXd P = 2 * collocation::polynomial_differentiation_matrix(nodes);
  const auto difference = [&](const Eigen::MatrixXd& D) {
    return (D - P).cwiseAbs().maxCoeff() / P.cwiseAbs().maxCoeff();
  };
  const collocation::StableGaussian stable(times, shape);
  const auto direct = collocation::radial_differentiation(times, collocation::Kernel::gaussian, shape);
  return {n, shape, difference(stable.differentiation_matrix()),
          direct.matrix.size() > 0 ? std::optional(difference(direct.matrix)) : std::nullopt,
          direct.condition};
}

std::vector<Point> points(bool quick) {
  std::vector<Point> all;
  const int step = quick ? 6 : 2, count = quick ? 16 : 64;
  for (int n = 3; n <= 45; n += step) {
    for (int i = 0; i <= count; ++i) all.push_back(point(n, std::pow(10, -6 + 7.0 * i / count)));
  }
  return all;
}

void put(const std::vector<Point>& all, scene::Show& show) {
  scene::Table data({{"nodes", 3, true}, {"shape"}, {"stable"}, {"solve"}, {"condition"}});
  for (const Point& p : all) data.add({p.nodes, p.shape, p.stable, p.solved.value_or(NAN), p.condition});
  show.draw(std::move(data), "rbf_ivp-contour",
            {{"heading", "Wide Gaussians differentiate as polynomials do"}});
  for (const int n : {7, 35, 100}) {
    const double power = std::log10(point(n, 1e-2).stable / point(n, 1e-3).stable);
    show.near(fmt::format("power of c h by which D tends to polynomials, N = {}", n), power, 2, 0.005,
              "Gaussians are even functions of c, so that D is one");
    show.at_most(fmt::format("difference to polynomials at c h = 1e-6, N = {}", n), point(n, 1e-6).stable,
                 1e-11, "(c h)^2 = 1e-12, and the rounding of both matrices");
  }
  show.between("difference to polynomials at c h = 0.1, N = 15, solved by LU",
               std::min(point(15, 0.1).solved.value_or(HUGE_VAL), 1e9), 0.1, 1e9,
               "nothing is left of D once the condition exceeds 1e16; recorded");
}

}  // namespace

std::vector<scene::Scene> scenes() {
  const scene::Result runs(
      "flat-limit",
      "differentiation matrices of Gaussians at Legendre-Gauss-Lobatto nodes by the stable basis and by LU "
      "factors, against that of polynomials",
      points);
  return {{.name = "contour",
           .title = "The flat limit of Gaussians is the polynomial, over shape and number of nodes",
           .content = scene::Content(put, runs)}};
}

}  // namespace nlmech::chapters::rbf_ivp::contour
