#include <fmt/format.h>

#include <array>
#include <cmath>

#include "chapters/gss_control/craft.hpp"
#include "chapters/gss_control/plots.hpp"
#include "chapters/gss_control/scenes.hpp"
#include "nlmech/spacecraft/poles.hpp"
#include "nlmech/spacecraft/timoshenko.hpp"

namespace nlmech::chapters {
namespace {

using scene::Workshop;

constexpr int modes = 10;
/// Aluminium in slug and ft: 2700 kg/m^3. Table 3.1 names no material; its E is that of aluminium, 11e6 psi.
constexpr double density = 5.239, poisson = 0.33, shear_coefficient = 5.0 / 6;

/// Rectangular section of the depth h with the bending stiffness and mass of Table 3.1.
spacecraft::ShearBeam beam_of_depth(const spacecraft::Parameters& p, double depth) {
  const double area = 12 * p.second_moment / (depth * depth);
  return spacecraft::solid_section(p, p.mass_per_length / area, poisson, shear_coefficient);
}

/// First-order estimate of a frequency's relative change: -(q^2/2) (I/A) (1 + E/(kappa G)).
double estimate(const spacecraft::Parameters& p, double omega, double depth) {
  const double q2 = omega * std::sqrt(p.mass_per_length / p.bending_stiffness());
  return -0.5 * q2 * depth * depth / 12 * (1 + 2 * (1 + poisson) / shear_coefficient);
}

scene::Showing show() {
  const spacecraft::Parameters p = craft(false);
  const auto euler = spacecraft::poles(spacecraft::Plant(p), modes);
  const double real_depth = std::sqrt(12 * p.second_moment * density / p.mass_per_length);
  struct Depth {
    const char *legend, *look, *thin;
    double depth;
  };
  const std::array depths = {Depth{"depth of solid aluminium", "p1", "t1", real_depth},
                             Depth{"depth L/100", "p2", "t2", p.length / 100},
                             Depth{"depth L/20", "p5", "t5", p.length / 20}};
  Plot plot("Shear and rotary inertia lower a thin plate's modes by 1e-3",
            "frequency of Euler's beam (rad/s)");
  plot.log_x(10, 4000);
  plot.panel("relative drop of the frequency");
  plot.log_y(1e-6, 1);
  scene::Table table({{"depth"},
                      {"depth (ft)"},
                      {"mode"},
                      {"Euler (rad/s)", 10},
                      {"Timoshenko (rad/s)", 10},
                      {"relative change", 3},
                      {"estimate", 3}});
  std::vector<scene::Quantity> quantities;
  for (const Depth& d : depths) {
    const spacecraft::TimoshenkoPlant plant(p, beam_of_depth(p, d.depth));
    const std::vector<double> found = plant.poles(modes, 1.01 * euler.omega.back());
    plot.begin(d.legend, d.look);
    for (std::size_t i = 0; i < found.size(); ++i) {
      const double change = found[i] / euler.omega.at(i) - 1;
      plot.add(euler.omega.at(i), -change / (1 + change));
      table.add({d.legend, d.depth, std::int64_t(i) + 1, euler.omega.at(i), found[i], change,
                 estimate(p, euler.omega.at(i), d.depth)});
    }
    plot.begin("", d.thin);
    for (const double w : logarithmic(10, 4000, 40)) plot.add(w, -estimate(p, w, d.depth));
    if (d.depth == real_depth) {
      const double tenth = found.size() == modes ? found.back() / euler.omega.back() - 1 : NAN;
      const double guess = estimate(p, euler.omega.back(), d.depth);
      quantities.push_back({"change of mode 10, solid aluminium", "1", tenth, 1.15 * guess, 0.85 * guess,
                            "-(q^2/2)(I/A)(1 + E/(kappa G)), first order for a long beam, within 15 %"});
    }
    quantities.push_back(scene::near(fmt::format("modes found, {}", d.legend), "1",
                                     static_cast<double>(found.size()), modes, 0,
                                     "one below each mode of Euler's beam"));
  }
  // Without shear and rotary inertia it is Euler's beam: a depth so small that both are below rounding.
  const spacecraft::TimoshenkoPlant thin(p, beam_of_depth(p, 1e-7));
  const spacecraft::Plant exact(p);
  double worst = 0;
  for (const double w : {1.0, 10.0, 100.0, 1000.0}) {
    const spacecraft::Complex s(0, w);
    const auto a = thin.response(s, 2), b = exact.response(s, 2);
    worst = std::max({worst, std::abs(a.theta / b.theta - 1.), std::abs(a.deflection / b.deflection - 1.)});
  }
  quantities.push_back(scene::at_most("difference from Euler's beam at a depth of 1e-7 ft", "1", worst, 1e-8,
                                      "the correction is below 1e-12; rounding of the thin beam's waves"));
  quantities.push_back(scene::near("depth of solid aluminium", "ft", real_depth,
                                   std::sqrt(12 * 0.47095e-7 / (0.0271875 / 5.239)), 1e-12,
                                   "sqrt(12 I/A) with A = rho/density"));
  return {plot.with("key1", "top left").take(), table, quantities};
}

}  // namespace

void add_timoshenko(scene::Chapter& chapter) {
  chapter.add({.name = "timoshenko",
               .title = "Timoshenko's beam for the appendages: how much the modes move",
               .place = "our own",
               .needs = {},
               .show = [](Workshop&) { return show(); }});
}

}  // namespace nlmech::chapters
