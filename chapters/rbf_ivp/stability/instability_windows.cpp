#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "chapters/rbf_ivp/scenes.hpp"
#include "chapters/rbf_ivp/stability/extended.hpp"
#include "nlmech/ivp/collocation.hpp"
#include "nlmech/problems/three_mass_chain.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::chapters::rbf_ivp {
namespace {

using collocation::NodeFamily;
using scene::Workshop;

constexpr double threshold = 1.001;  // of |R|: below lies the truncation of radial functions themselves

/// A set of nodes, and the shape c h; 0 for polynomials.
struct Scheme {
  std::string name;  // no commas, which the figure's data could not hold
  int nodes;
  double shape;
  NodeFamily family;
};
const std::array<Scheme, 6> schemes = {
    Scheme{"LGL N = 7", 7, 0, NodeFamily::legendre_gauss_lobatto},
    Scheme{"RBF N = 7 c h = 0.367", 7, 0.367, NodeFamily::legendre_gauss_lobatto},
    Scheme{"LGL N = 35", 35, 0, NodeFamily::legendre_gauss_lobatto},
    Scheme{"RBF N = 35 c h = 8.5", 35, 8.5, NodeFamily::legendre_gauss_lobatto},
    Scheme{"Radau N = 7", 7, 0, NodeFamily::left_end_and_radau},
    Scheme{"Radau N = 35", 35, 0, NodeFamily::left_end_and_radau}};

Eigen::MatrixXd derivative(const Scheme& s) {
  return (s.shape == 0 ? polynomial_derivative(s.family, s.nodes)
                       : radial_derivative(s.family, s.nodes, s.shape))
      .cast<double>();
}

problems::ThreeMassChain stiff_chain() {
  problems::ThreeMassChain chain;
  chain.k1 = 1e8;
  return chain;
}

/// Angular frequency of the first mass between its stiff spring and its neighbour.
double frequency() {
  const problems::ThreeMassChain chain = stiff_chain();
  return std::sqrt((chain.k1 + chain.k2) / chain.m1);
}

/// The first mass, displaced by 1e-9, step by step.
struct Growth {
  std::size_t scheme;
  double step;
  double expected;                ///< |R(i omega h)| of the matrix in double
  std::vector<double> amplitude;  ///< at the ends of steps; fewer than asked for if one was not solved

  /// Mean growth a step, from step 20 to step 25: the start is over, and the cubic spring does not matter
  /// yet.
  [[nodiscard]] double rate() const { return std::pow(amplitude.at(24) / amplitude.at(19), 1.0 / 5); }
};

template <class Method>
Growth grow(std::size_t scheme, const Method& method, int steps) {
  const Eigen::MatrixXd in_double = ivp::basis_of(method).derivative();
  Growth growth{
      scheme, method.step, std::abs(stability_function(in_double, {0, frequency() * method.step})), {}};
  const ivp::System<6> system(stiff_chain());
  ivp::State<6> x0 = ivp::State<6>::Zero();
  x0[0] = 1e-9;
  const ivp::Observer<6> watch = [&](const ivp::Step<6>& step) {
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
  struct Case {
    std::size_t scheme;
    double step;
  };
  constexpr Case cases[] = {{0, 1.2e-3},  {0, 9.9e-4}, {1, 1.2e-3}, {2, 2.7e-2},
                            {3, 1.04e-2}, {4, 1.2e-3}, {4, 9.9e-4}, {5, 2.7e-2}};
  std::vector<Growth> growths;
  for (const Case& c : cases) growths.push_back(grow(c.scheme, c.step, quick ? 30 : 150));
  return growths;
}

/// All windows of a scheme together.
struct Extent {
  std::size_t count = 0;
  double begin = 0, end = 0, largest = 1, place = 0;
};

Extent extent(const std::vector<Window>& windows) {
  Extent e{windows.size(), 0, 0, 1, 0};
  if (windows.empty()) return e;
  e.begin = windows.front().begin;
  e.end = windows.back().end;
  for (const Window& w : windows) {
    if (w.largest > e.largest) {
      e.largest = w.largest;
      e.place = w.place;
    }
  }
  return e;
}

scene::Table table_of(const std::vector<Extent>& extents) {
  scene::Table table({{"nodes"},
                      {"windows"},
                      {"from omega h", 4},
                      {"to", 4},
                      {"largest growth a step", 4},
                      {"at omega h", 4}});
  for (std::size_t i = 0; i < schemes.size(); ++i) {
    const Extent& e = extents[i];
    const auto if_any = [&](double value) { return e.count > 0 ? scene::Cell(value) : scene::Cell(); };
    table.add({schemes[i].name, static_cast<std::int64_t>(e.count), if_any(e.begin), if_any(e.end),
               if_any(e.largest), if_any(e.place)});
  }
  return table;
}

/// Equal ratios from 1 to 300, and the tops of the windows, which are narrow.
std::vector<double> frequencies(const std::vector<Window>& windows, int count) {
  std::vector<double> y;
  for (int k = 0; k <= count; ++k) y.push_back(std::pow(300, double(k) / count));
  for (const Window& w : windows) {
    for (const double beside : {-0.1, -0.02, 0.0, 0.02, 0.1}) y.push_back(w.place + beside);
  }
  std::sort(y.begin(), y.end());
  return y;
}

scene::Figure figure_of(const std::vector<Eigen::MatrixXd>& derivatives,
                        const std::vector<std::vector<Window>>& windows, const std::vector<Growth>& growths,
                        bool quick) {
  scene::Table data({{"panel"}, {"series", 3, true}, {"abscissa"}, {"ordinate"}});
  std::string names, runs;
  for (std::size_t i = 0; i < schemes.size(); ++i) {
    names += (i > 0 ? "|" : "") + schemes[i].name;
    for (const double y : frequencies(windows[i], quick ? 150 : 1200))
      data.add({"amplification", schemes[i].name, y, std::abs(stability_function(derivatives[i], {0, y}))});
  }
  for (const Growth& g : growths) {
    const std::string name = fmt::format("{} h = {:g}", schemes[g.scheme].name, g.step);
    runs += (runs.empty() ? "" : "|") + name;
    for (std::size_t k = 0; k < g.amplitude.size(); ++k)
      data.add({"growth", name, static_cast<double>(k + 1), g.amplitude[k]});
  }
  return {std::move(data),
          "rbf_ivp-instability-windows",
          {{"heading", "Lobatto nodes amplify some oscillations; Radau nodes amplify none"},
           {"schemes", names},
           {"runs", runs},
           {"height", "600"}}};
}

std::vector<scene::Quantity> quantities(const std::vector<Extent>& extents,
                                        const std::vector<Growth>& growths) {
  const char *recorded = "recorded with two or three digits",
             *formula = "|R| by the formula for the nodes (Hairer & Wanner II, Theorem IV.3.9), 50 digits",
             *dissipative = "L-stable: |R| < 1; rounding";
  const auto by_formula = [](std::size_t i, double y) {
    return polynomial_amplification(unit_nodes(schemes[i].family, schemes[i].nodes), y);
  };
  std::vector<scene::Quantity> list = {
      scene::near("LGL N = 7, begin of the window", "1", extents[0].begin, 5.4, 0.02, recorded),
      scene::near("LGL N = 7, end of the window", "1", extents[0].end, 9.5, 0.01, recorded),
      scene::near("LGL N = 7, largest growth", "1", extents[0].largest, 1.33, 0.005, recorded),
      scene::near("LGL N = 7, largest growth, again", "1", extents[0].largest,
                  by_formula(0, extents[0].place), 1e-9, formula),
      scene::near("LGL N = 35, end of the windows", "1", extents[2].end, 192, 0.005, recorded),
      scene::near("LGL N = 35, largest growth", "1", extents[2].largest, by_formula(2, extents[2].place),
                  1e-6, formula),
      scene::near("RBF N = 7, largest growth", "1", extents[1].largest, 1.29, 0.005, recorded),
      scene::near("RBF N = 35, end of the windows", "1", extents[3].end, 75, 0.01, recorded),
      scene::near("RBF N = 35, largest growth", "1", extents[3].largest, 2.35, 0.005, recorded),
      scene::at_most("Radau, windows", "1", static_cast<double>(extents[4].count + extents[5].count), 0,
                     dissipative)};
  for (const Growth& g : growths) {
    if (g.scheme > 3) continue;
    list.push_back(scene::near(
        fmt::format("growth of the first mass, {} h = {:g}", schemes[g.scheme].name, g.step), "1", g.rate(),
        g.expected, 1e-3, "|R(i omega h)| of the linear spring; the other masses and the start decay"));
  }
  return list;
}

scene::Showing show(const std::vector<Growth>& growths, bool quick) {
  std::vector<Eigen::MatrixXd> derivatives;
  std::vector<std::vector<Window>> windows;
  std::vector<Extent> extents;
  for (const Scheme& s : schemes) {
    derivatives.push_back(derivative(s));
    windows.push_back(instability_windows(derivatives.back(), 300, threshold, quick ? 10 : 20));
    extents.push_back(extent(windows.back()));
  }
  scene::Showing showing;
  showing.table = table_of(extents);
  showing.figure = figure_of(derivatives, windows, growths, quick);
  showing.quantities = quantities(extents, growths);
  return showing;
}

}  // namespace

void add_instability_windows(scene::Chapter& chapter) {
  const auto& growths = chapter.add_run<std::vector<Growth>>(
      "stiff-chain-growth",
      "three masses with k1 = 1e8, x1(0) = 1e-9, 150 steps; amplitude of the first mass, "
      "sqrt(x1^2 + (v1/omega)^2)",
      {}, [](Workshop& w) { return all_growths(w.quick()); });
  chapter.add({.name = "instability-windows",
               .title = "Growth of undamped oscillations under collocation: |R(i omega h)|, and three masses "
                        "with one stiff spring",
               .place = "our own",
               .needs = {&growths},
               .show = [&growths](Workshop& w) { return show(w.result(growths), w.quick()); }});
}

}  // namespace nlmech::chapters::rbf_ivp
