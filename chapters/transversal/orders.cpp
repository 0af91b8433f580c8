#include <fmt/format.h>

#include <cmath>
#include <string>
#include <vector>

#include "chapters/transversal/oscillators.hpp"
#include "nlmech/ivp/transversal/mtl.hpp"
#include "nlmech/scene/scene.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::chapters::transversal::orders {
namespace {

constexpr double end = 12;

/// Error at the end for one step size.
struct Sample {
  double step, error;
};

/// Convergence of a basis with p points.
struct Convergence {
  std::string name;
  int expected;
  std::vector<Sample> samples;  ///< step sizes halved from one to the next

  /// Observed order from the last two step sizes.
  [[nodiscard]] double observed() const {
    return std::log2(samples[samples.size() - 2].error / samples.back().error);
  }
  [[nodiscard]] double least_error() const { return samples.back().error; }
};

Convergence convergence_of(const Reference& reference, const problems::TextProblem& problem,
                           const ivp::State& x0, int p, ivp::MtlBasis basis, int halvings) {
  Convergence result{
      basis == ivp::MtlBasis::lagrange ? fmt::format("p = {}", p) : fmt::format("hats p = {}", p),
      ivp::mtl_order(basis, p),
      {}};
  // `halvings` keeps the errors of the higher orders above rounding, about 1e-12.
  for (int k = 0; k < halvings; ++k) {
    const ivp::Mtl method{.step = 0.2 / (1 << k), .points = p, .basis = basis, .error_tolerance = 0};
    const auto s = ivp::integrate(ivp::System(problem), x0, 0, end, method);
    if (!s.status.ok()) throw Failure(s.status);
    result.samples.push_back({method.step, (s.x - reference(end).cast<double>()).cwiseAbs().maxCoeff()});
  }
  return result;
}

std::vector<Convergence> all_convergences() {
  const problems::TextProblem problem("driven-duffing", {{"damping", 0.1}});
  const Reference reference(problem, {1, 0}, 0, end);
  std::vector<Convergence> all;
  const int halvings[] = {7, 6, 6, 5, 5, 4};
  for (int p = 1; p <= 6; ++p)
    all.push_back(convergence_of(reference, problem, {1, 0}, p, ivp::MtlBasis::lagrange, halvings[p - 1]));
  all.push_back(convergence_of(reference, problem, {1, 0}, 4, ivp::MtlBasis::interpolet, 7));
  const problems::TextProblem pair("two-dof");
  const ivp::State start = pair.initial_state();
  all.push_back(convergence_of(Reference(pair, start.cast<long double>(), 0, end), pair, start, 3,
                               ivp::MtlBasis::lagrange, 6));
  all.back().name = "two masses, p = 3";
  return all;
}

void put(const std::vector<Convergence>& all, scene::Show& show) {
  scene::Panel& panel = show.plot(
      "Error against step: order {/:Italic p} + 1 for odd {/:Italic p}, {/:Italic p} + 2 for even {/:Italic "
      "p}",
      "step {/:Italic h}", "largest error at {/:Italic t} = 12");
  panel.log_x(2e-3, 0.3).log_y(1e-13, 1).key("outside right center");
  show.figure().columns({"series", "step", "error"});
  for (const Convergence& f : all)
    panel.curve(f.name, f.samples, &Sample::step, &Sample::error, scene::linespoints());
  show.table(all, {{"basis", &Convergence::name},
                   {"order by theory", &Convergence::expected},
                   {"observed order", &Convergence::observed, 4},
                   {"least error", &Convergence::least_error, 2}});
  for (const Convergence& f : all)
    show.between("observed order of " + f.name, f.observed(), f.expected - 0.12, f.expected + 0.12,
                 "quadrature at equidistant points; 0.12 for the next term of the error at these steps");
}

}  // namespace

std::vector<scene::Scene> scenes() {
  const scene::Result convergence(
      "convergence",
      "x'' + 0.1 x' + x + x^3 = cos t from (1, 0) to t = 12, K = 1, C = 0.1, the load "
      "exact; two such oscillators "
      "tied by a spring of 0.5, the first one driven",
      all_convergences);
  return {{.name = "orders",
           .title = "Observed orders for p = 1 to 6, of hat functions, and with two degrees of freedom",
           .content = scene::Content(put, convergence)}};
}

}  // namespace nlmech::chapters::transversal::orders
