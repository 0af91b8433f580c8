#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "chapters/gss_control/craft.hpp"
#include "chapters/gss_control/grids.hpp"
#include "nlmech/scene/scene.hpp"
#include "nlmech/spacecraft/plant/poles.hpp"
#include "nlmech/spacecraft/plant/timoshenko.hpp"

namespace nlmech::chapters::gss_control::timoshenko {
namespace {

constexpr int modes = 10;
/// Aluminium in slug and ft: 2700 kg/m^3. Table 3.1 names no material; its E is that of aluminium, 11e6 psi.
constexpr double density = 5.239, poisson = 0.33, shear_coefficient = 5.0 / 6;

/// Beam of rectangular section of the given depth, with the bending stiffness and mass of Table 3.1.
spacecraft::ShearBeam beam_of_depth(const spacecraft::Parameters& p, double depth) {
  const double area = 12 * p.second_moment / (depth * depth);
  return spacecraft::solid_section(p, p.mass_per_length / area, poisson, shear_coefficient);
}

/// First-order estimate of the relative change of a frequency: -(q^2/2) (I/A) (1 + E/(kappa G)).
double estimate(const spacecraft::Parameters& p, double omega, double depth) {
  const double q2 = omega * std::sqrt(p.mass_per_length / p.bending_stiffness());
  return -0.5 * q2 * depth * depth / 12 * (1 + 2 * (1 + poisson) / shear_coefficient);
}

/// Depth of the beams, with the style of its curve.
struct Depth {
  const char* name;
  double depth;  ///< ft
  int style;
};

struct Mode {
  const char* name;
  double depth;
  int number;
  double euler, timoshenko;  ///< rad/s
  double guess;              ///< estimate of the relative change

  [[nodiscard]] double change() const { return timoshenko / euler - 1; }
  [[nodiscard]] double drop() const { return -change() / (1 + change()); }
};

std::vector<Mode> modes_of(const spacecraft::Parameters& p, const Depth& d) {
  const auto euler = spacecraft::poles(spacecraft::Plant(p), modes);
  std::vector<Mode> all;
  for (const double omega :
       timoshenko_frequencies(p, beam_of_depth(p, d.depth), modes, 1.01 * euler.omega.back())) {
    const double w = euler.omega.at(all.size());
    all.push_back({d.name, d.depth, static_cast<int>(all.size()) + 1, w, omega, estimate(p, w, d.depth)});
  }
  return all;
}

/// Largest relative difference from Euler-Bernoulli theory at a depth so small that shear and rotary inertia
/// are below rounding.
double distance_from_euler(const spacecraft::Parameters& p) {
  const std::vector<Mode> thin = modes_of(p, {"", 1e-7, 1});
  double worst = thin.size() == modes ? 0 : HUGE_VAL;
  for (const Mode& m : thin) worst = std::max(worst, std::abs(m.change()));
  return worst;
}

void put(scene::Show& show) {
  const spacecraft::Parameters p = craft(false);
  const double real_depth = std::sqrt(12 * p.second_moment * density / p.mass_per_length);
  scene::Panel& panel =
      show.plot("Shear and rotary inertia lower the frequencies of a thin plate by up to 1e-3",
                "frequency of Euler's beam (rad/s)", "relative drop of the frequency");
  panel.log_x(10, 4000).log_y(1e-6, 1).key("top left");
  show.figure().columns({"curve", "panel", "x", "y"});
  std::vector<Mode> rows;
  for (const Depth& d : {Depth{"depth of solid aluminium", real_depth, 1},
                         {"depth L/100", p.length / 100, 2},
                         {"depth L/20", p.length / 20, 5}}) {
    const std::vector<Mode> found = modes_of(p, d);
    rows.insert(rows.end(), found.begin(), found.end());
    panel.curve(d.name, found, &Mode::euler, &Mode::drop, scene::points(d.style));
    panel.curve(
        "", logarithmic(10, 4000, 40), std::identity(), [&](double w) { return -estimate(p, w, d.depth); },
        scene::thin_lines(d.style));
    if (d.depth == real_depth) {
      const double guess = found.back().guess;
      show.between("change of mode 10, solid aluminium", found.size() == modes ? found.back().change() : NAN,
                   1.15 * guess, 0.85 * guess,
                   "-(q^2/2)(I/A)(1 + E/(kappa G)), first order for a long beam, within 15 %");
    }
    show.equals(fmt::format("modes found, {}", d.name), found.size(), modes,
                "one below each mode of Euler's beam");
  }
  show.table(rows, {{"depth", &Mode::name},
                    {"depth (ft)", &Mode::depth},
                    {"mode", &Mode::number},
                    {"Euler (rad/s)", &Mode::euler, 10},
                    {"Timoshenko (rad/s)", &Mode::timoshenko, 10},
                    {"relative change", &Mode::change, 3},
                    {"estimate", &Mode::guess, 3}});
  show.at_most("difference from Euler's beam at a depth of 1e-7 ft", distance_from_euler(p), 1e-8,
               "the correction is below 1e-12; rounding of the thin beam's waves");
  show.near("depth of solid aluminium", {real_depth, "ft"}, std::sqrt(12 * 0.47095e-7 / (0.0271875 / 5.239)),
            1e-12, "sqrt(12 I/A) with A = rho/density");
}

}  // namespace

std::vector<scene::Scene> scenes() {
  return {{.name = "timoshenko",
           .title = "Timoshenko's beam for the appendages: change of the frequencies",
           .place = "our own, for what section 3.1 leaves open",
           .content = scene::Content(put)}};
}

}  // namespace nlmech::chapters::gss_control::timoshenko
