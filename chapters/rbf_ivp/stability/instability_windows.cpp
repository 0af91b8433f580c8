#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "chapters/rbf_ivp/stability/extended.hpp"
#include "nlmech/ivp/collocation/collocation.hpp"
#include "nlmech/problems/texts.hpp"
#include "nlmech/scene/scene.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::chapters::rbf_ivp::instability_windows {
namespace {

using collocation::NodeFamily;

constexpr double threshold = 1.001;  // of |R|: below lies the truncation of radial functions themselves

/// A set of nodes, and the shape c h; 0 for polynomials.
struct Scheme {
  std::string name;  // no commas, which the figure's data could not hold
  int nodes;
  double shape;
  NodeFamily family;

  /// On the unit interval.
  [[nodiscard]] Eigen::MatrixXd derivative() const {
    return (shape == 0 ? polynomial_derivative(family, nodes) : radial_derivative(family, nodes, shape))
        .cast<double>();
  }
};
const std::array schemes = {Scheme{"LGL N = 7", 7, 0, NodeFamily::legendre_gauss_lobatto},
                            Scheme{"RBF N = 7 c h = 0.367", 7, 0.367, NodeFamily::legendre_gauss_lobatto},
                            Scheme{"LGL N = 35", 35, 0, NodeFamily::legendre_gauss_lobatto},
                            Scheme{"RBF N = 35 c h = 8.5", 35, 8.5, NodeFamily::legendre_gauss_lobatto},
                            Scheme{"Radau N = 7", 7, 0, NodeFamily::left_end_and_radau},
                            Scheme{"Radau N = 35", 35, 0, NodeFamily::left_end_and_radau}};

problems::TextProblem stiff_chain() { return problems::TextProblem("three-dof", {{"k1", 1e8}}); }

/// Angular frequency of the first mass between its stiff spring and its neighbour.
double frequency() {
  const problems::TextProblem chain = stiff_chain();
  return std::sqrt((chain.parameter("k1") + chain.parameter("k2")) / chain.parameter("m1"));
}

/// The first mass, displaced by 1e-9, step by step.
struct Growth {
  std::size_t scheme;
  double step;
  double expected;                ///< |R(i omega h)| of the matrix in double
  std::vector<double> amplitude;  ///< at the ends of steps; fewer than asked for if one was not solved

  [[nodiscard]] std::string name() const { return fmt::format("{} h = {:g}", schemes[scheme].name, step); }
  /// Mean growth a step, from step 20 to step 25: the start is over, and the cubic spring does not matter
  /// yet.
  [[nodiscard]] double rate() const { return std::pow(amplitude.at(24) / amplitude.at(19), 1.0 / 5); }
};

template <class Method>
Growth grow(std::size_t scheme, const Method& method, int steps) {
  const Eigen::MatrixXd in_double = ivp::basis_of(method).derivative();
  Growth growth{
      scheme, method.step, std::abs(stability_function(in_double, {0, frequency() * method.step})), {}};
  const ivp::System system(stiff_chain());
  ivp::State x0 = ivp::State::Zero(6);
  x0[0] = 1e-9;
  const ivp::Observer watch = [&](const ivp::Step& step) {
    growth.amplitude.push_back(std::hypot(step.x1[0], step.x1[3] / frequency()));
    return true;
  };
  const auto solution = ivp::integrate(system, x0, 0, steps * method.step, method, watch);
  if (!solution.status.ok() && growth.amplitude.empty()) throw Failure(solution.status);
  return growth;
}

Growth grow(std::size_t scheme, double step, int steps) {
  const Scheme& s = schemes[scheme];
  if (s.shape > 0)
    return grow(scheme, ivp::RbfCollocation{.step = step, .nodes = s.nodes, .shape = s.shape / step}, steps);
  return grow(scheme, ivp::PolynomialCollocation{.step = step, .nodes = s.nodes, .points = s.family}, steps);
}

std::vector<Growth> all_growths(bool quick) {
  constexpr std::array<std::pair<std::size_t, double>, 8> cases = {{{0, 1.2e-3},
                                                                    {0, 9.9e-4},
                                                                    {1, 1.2e-3},
                                                                    {2, 2.7e-2},
                                                                    {3, 1.04e-2},
                                                                    {4, 1.2e-3},
                                                                    {4, 9.9e-4},
                                                                    {5, 2.7e-2}}};
  std::vector<Growth> growths;
  for (const auto& [scheme, step] : cases) growths.push_back(grow(scheme, step, quick ? 30 : 150));
  return growths;
}

/// All windows of a scheme together.
struct Extent {
  Scheme scheme;
  Eigen::MatrixXd derivative;
  std::vector<Window> windows;

  [[nodiscard]] const std::string& name() const { return scheme.name; }
  [[nodiscard]] std::size_t count() const { return windows.size(); }
  /// A number of all windows, if there are any.
  template <class Get>
  [[nodiscard]] std::optional<double> of(Get get) const {
    return windows.empty() ? std::nullopt : std::optional<double>(get());
  }
  [[nodiscard]] const Window& greatest() const {
    return *std::ranges::max_element(windows, {}, &Window::largest);
  }
  [[nodiscard]] std::optional<double> begin() const {
    return of([&] { return windows.front().begin; });
  }
  [[nodiscard]] std::optional<double> end() const {
    return of([&] { return windows.back().end; });
  }
  [[nodiscard]] std::optional<double> largest() const {
    return of([&] { return greatest().largest; });
  }
  [[nodiscard]] std::optional<double> place() const {
    return of([&] { return greatest().place; });
  }
};

/// Equal ratios from 1 to 300, and the tops of the windows, which are narrow.
std::vector<double> frequencies(const std::vector<Window>& windows, int count) {
  std::vector<double> y;
  for (int k = 0; k <= count; ++k) y.push_back(std::pow(300, double(k) / count));
  for (const Window& w : windows) {
    for (const double beside : {-0.1, -0.02, 0.0, 0.02, 0.1}) y.push_back(w.place + beside);
  }
  std::ranges::sort(y);
  return y;
}

void draw(const std::vector<Extent>& extents, const std::vector<Growth>& growths, scene::Show& show) {
  scene::Plot& plot = show.plots("Lobatto nodes amplify some oscillations; Radau nodes none");
  scene::Panel& step = plot.panel("ω h", "").place(0.09, 0.49, 0.42, 0.86);
  step.caption("growth in a step: |R(iωh)|").log_x(1, 300).log_y(0.05, 100);
  step.set("xtics (1, 10, 100)").set("ytics (0.1, 1, 10, 100)").set("format '%g'");
  step.key("at screen 0.05, screen 0.29 left top maxrows 8 samplen 3 spacing 1.1 font 'sans-serif,12'");
  step.set("arrow 1 from 1, 1 to 300, 1 nohead linestyle 13");
  scene::Panel& mass = plot.panel("step", "amplitude").place(0.62, 0.98, 0.42, 0.86);
  mass.caption("three masses, k_1 = 10^8: first mass").x_range(0, 150).set("xtics 50");
  mass.log_y(1e-13, 1e6).set("ytics 1e3");
  mass.key("at screen 0.56, screen 0.29 left top maxrows 8 samplen 3 spacing 1.1 font 'sans-serif,12'");
  scene::Table data({{"panel"}, {"series", 3, true}, {"abscissa"}, {"ordinate"}});
  int block = 0;
  for (const Extent& e : extents) {
    for (const double y : frequencies(e.windows, show.quick() ? 150 : 1200))
      data.add({"amplification", e.name(), y, std::abs(stability_function(e.derivative, {0, y}))});
    step.columns(e.name(), "abscissa:ordinate", scene::lines(), block++);
  }
  for (const Growth& g : growths) {
    for (std::size_t k = 0; k < g.amplitude.size(); ++k)
      data.add({"growth", g.name(), k + 1, g.amplitude[k]});
    mass.columns(g.name(), "abscissa:ordinate", scene::lines(), block++);
  }
  plot.size(760, 600).data(std::move(data));
}

void check(const std::vector<Extent>& extents, const std::vector<Growth>& growths, scene::Show& show) {
  const char *recorded = "recorded with two or three digits",
             *formula = "|R| by the formula for the nodes (Hairer & Wanner II, Theorem IV.3.9), 50 digits";
  const auto number = [&](std::size_t i, auto get) { return std::invoke(get, extents[i]).value_or(NAN); };
  const auto by_formula = [&](std::size_t i) {
    const Scheme& s = schemes[i];
    return polynomial_amplification(unit_nodes(s.family, s.nodes), number(i, &Extent::place));
  };
  show.near("LGL N = 7, begin of the window", number(0, &Extent::begin), 5.4, 0.02, recorded);
  show.near("LGL N = 7, end of the window", number(0, &Extent::end), 9.5, 0.01, recorded);
  show.near("LGL N = 7, largest growth", number(0, &Extent::largest), 1.33, 0.005, recorded);
  show.near("LGL N = 7, largest growth, again", number(0, &Extent::largest), by_formula(0), 1e-9, formula);
  show.near("LGL N = 35, end of the windows", number(2, &Extent::end), 192, 0.005, recorded);
  show.near("LGL N = 35, largest growth", number(2, &Extent::largest), by_formula(2), 1e-6, formula);
  show.near("RBF N = 7, largest growth", number(1, &Extent::largest), 1.29, 0.005, recorded);
  show.near("RBF N = 35, end of the windows", number(3, &Extent::end), 75, 0.01, recorded);
  show.near("RBF N = 35, largest growth", number(3, &Extent::largest), 2.35, 0.005, recorded);
  show.at_most("Radau, windows", extents[4].count() + extents[5].count(), 0, "L-stable: |R| < 1; rounding");
  for (const Growth& g : growths) {
    if (g.scheme > 3) continue;
    show.near("growth of the first mass, " + g.name(), g.rate(), g.expected, 1e-3,
              "|R(i omega h)| of the linear spring; the other masses and the start decay");
  }
}

void put(const std::vector<Growth>& growths, scene::Show& show) {
  std::vector<Extent> extents;
  for (const Scheme& s : schemes) {
    const Eigen::MatrixXd derivative = s.derivative();
    extents.push_back({s, derivative, windows_above(derivative, 300, threshold, show.quick() ? 10 : 20)});
  }
  draw(extents, growths, show);
  show.table(extents, {{"nodes", &Extent::name},
                       {"windows", &Extent::count},
                       {"from omega h", &Extent::begin, 4},
                       {"to", &Extent::end, 4},
                       {"largest growth a step", &Extent::largest, 4},
                       {"at omega h", &Extent::place, 4}});
  check(extents, growths, show);
}

}  // namespace

std::vector<scene::Scene> scenes() {
  const scene::Result growths(
      "stiff-chain-growth",
      "three masses with k1 = 1e8, x1(0) = 1e-9, 150 steps; amplitude of the first mass, "
      "sqrt(x1^2 + (v1/omega)^2)",
      all_growths);
  return {{.name = "instability-windows",
           .title = "Growth of undamped oscillations under collocation: |R(i omega h)|, and three masses "
                    "with one stiff spring",
           .content = scene::Content(put, growths)}};
}

}  // namespace nlmech::chapters::rbf_ivp::instability_windows
