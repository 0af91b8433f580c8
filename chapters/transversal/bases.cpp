#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "chapters/transversal/oscillators.hpp"
#include "nlmech/ivp/transversal/mtl.hpp"
#include "nlmech/scene/scene.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::chapters::transversal::bases {
namespace {

constexpr double end = 12;
constexpr double fixed_width = 1;     // sigma in units of time
constexpr double width_in_steps = 3;  // sigma/h

/// Error at the end for one step size.
struct BasisError {
  double step, error;
};

/// A basis for three points, with the errors of halved step sizes.
struct Basis {
  std::string name;
  int expected;                            ///< order by theory
  std::function<ivp::Mtl(double)> method;  ///< of a step size
  std::vector<BasisError> samples = {};

  /// Observed order from the last two step sizes.
  [[nodiscard]] double observed() const {
    return std::log2(samples[samples.size() - 2].error / samples.back().error);
  }
  [[nodiscard]] double least_error() const { return samples.back().error; }
  /// Largest difference of the sum of the basis functions from one, at the longest step.
  [[nodiscard]] double sum_defect() const {
    const ivp::Mtl longest = method(samples.front().step);
    double largest = 0;
    for (const Eigen::MatrixXd& piece : ivp::mtl_pieces(longest.basis, longest.points, longest.width)) {
      for (int i = 0; i <= 100; ++i) {
        double sum = 0;
        for (Eigen::Index m = piece.cols() - 1; m >= 0; --m) sum = sum * (i / 100.) + piece.col(m).sum();
        largest = std::max(largest, std::abs(sum - 1));
      }
    }
    return largest < 1e-12 ? 0 : largest;  // below is rounding
  }
};

std::vector<Basis> all_bases() {
  using ivp::MtlBasis;
  const auto of = [](MtlBasis basis) {
    return [basis](double h) { return ivp::Mtl{.step = h, .basis = basis, .error_tolerance = 0}; };
  };
  const auto daf = [](double h, double width) {
    return ivp::Mtl{.step = h, .basis = MtlBasis::daf, .width = width, .error_tolerance = 0};
  };
  std::vector<Basis> all = {{"Lagrange", ivp::mtl_order(MtlBasis::lagrange, 3), of(MtlBasis::lagrange)},
                            {"DAF, sigma = 1", ivp::mtl_order(MtlBasis::daf, 3),
                             [daf](double h) { return daf(h, fixed_width / h); }},
                            {"DAF, sigma = 3 h", 0, [daf](double h) { return daf(h, width_in_steps); }},
                            {"hats", ivp::mtl_order(MtlBasis::interpolet, 3), of(MtlBasis::interpolet)}};
  const problems::TextProblem problem("driven-duffing", {{"damping", 0.1}});
  const Reference reference(problem, {1, 0}, 0, end);
  for (Basis& basis : all) {
    for (int k = 0; k < 6; ++k) {  // more halvings would end in rounding, about 1e-12
      const double step = 0.2 / (1 << k);
      const auto s = ivp::integrate(ivp::System(problem), {1, 0}, 0, end, basis.method(step));
      if (!s.status.ok()) throw Failure(s.status);
      basis.samples.push_back({step, (s.x - reference(end).cast<double>()).cwiseAbs().maxCoeff()});
    }
  }
  return all;
}

void put(const std::vector<Basis>& all, scene::Show& show) {
  scene::Panel& panel = show.plot("Three bases: a Gaussian factor as wide as three steps leaves an error",
                                  "step {/:Italic h}", "largest error at {/:Italic t} = 12");
  panel.log_x(4e-3, 0.3).log_y(1e-11, 1).key("outside right center");
  show.figure().columns({"series", "step", "error"});
  for (const Basis& b : all)
    panel.curve(b.name, b.samples, &BasisError::step, &BasisError::error, scene::linespoints());
  show.table(all, {{"basis", &Basis::name},
                   {"sum differs from 1 by, h = 0.2", &Basis::sum_defect, 2},
                   {"order by theory", &Basis::expected},
                   {"observed order", &Basis::observed, 4},
                   {"least error", &Basis::least_error, 2}});
  for (const Basis& b : all)
    show.between("observed order of " + b.name, b.observed(), b.expected - 0.12, b.expected + 0.12,
                 "error of the interpolation; 0.12 for the next term of the error at these steps");
  // Error of the interpolation of the Gaussian at its centre by a cubic: the fourth derivative is at most
  // 3/sigma^4, the product of the distances from the nodes at most h^4.
  const double bound = 3 / 24. / std::pow(width_in_steps, 4);
  show.between(
      "difference of the sum from 1, sigma = 3 h", all[2].sum_defect(), 0.5 * bound, bound,
      "error of cubic interpolation of the Gaussian; half of the bound, as its fourth derivative falls");
}

}  // namespace

std::vector<scene::Scene> scenes() {
  const scene::Result bases(
      "bases",
      "p = 3, x'' + 0.1 x' + x + x^3 = cos t from (1, 0) to t = 12, K = 1, C = 0.1, the load "
      "exact; DAF: Lagrange polynomials times exp(-(t - t_k)^2/(2 sigma^2))",
      all_bases);
  return {{.name = "bases",
           .title = "Lagrange polynomials, distributed approximating functionals and hat functions as bases",
           .content = scene::Content(put, bases)}};
}

}  // namespace nlmech::chapters::transversal::bases
