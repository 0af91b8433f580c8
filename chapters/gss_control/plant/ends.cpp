#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "chapters/gss_control/craft.hpp"
#include "chapters/gss_control/grids.hpp"
#include "nlmech/scene/scene.hpp"
#include "nlmech/spacecraft/plant/discrete_model.hpp"
#include "nlmech/spacecraft/plant/poles.hpp"

namespace nlmech::chapters::gss_control::ends {
namespace {

using spacecraft::Parameters;
using spacecraft::TipSupport;

constexpr int modes = 4, elements = 40;
constexpr double clamped = std::numeric_limits<double>::infinity();
constexpr double softest = 1e-3, stiffest = 1e4;  ///< k L/EI

/// Table 3.1 with other ends. @param root k L/EI
Parameters with_ends(bool body, double root, TipSupport tip) {
  Parameters p = craft(body);
  p.root_stiffness = root * (p.bending_stiffness() / p.length);
  p.tip_support = tip;
  return p;
}

/// Ends, the first wave number of a beam that has them, and what is computed.
struct Row {
  const char *root, *tip;
  double stiffness;
  TipSupport support;
  double known;                    ///< |beta|^(1/4) L on a locked hub without tip bodies
  double wave_number = 0;          ///< the same, computed
  std::vector<double> poles = {};  ///< with tip bodies, rad/s
  double elements_error = 0;       ///< largest of finite elements, relative; 0: not computed
};

// Zeros of cos q cosh q + 1, tan q - tanh q, tan q + tanh q, cos q cosh q - 1, sin q and cos q.
const std::array<Row, 8> all_ends = {{{"clamped", "free", clamped, TipSupport::free, 1.875104068711961},
                                      {"pinned", "free", 0, TipSupport::free, 3.926602312047919},
                                      {"clamped", "pinned", clamped, TipSupport::pinned, 3.926602312047919},
                                      {"pinned", "pinned", 0, TipSupport::pinned, std::numbers::pi},
                                      {"clamped", "guided", clamped, TipSupport::guided, 2.365020372431352},
                                      {"pinned", "guided", 0, TipSupport::guided, std::numbers::pi / 2},
                                      {"clamped", "clamped", clamped, TipSupport::clamped, 4.730040744862704},
                                      {"pinned", "clamped", 0, TipSupport::clamped, 3.926602312047919}}};

Row computed(Row row) {
  const spacecraft::Plant bare(with_ends(false, row.stiffness, row.support));
  const Parameters p = with_ends(true, row.stiffness, row.support);
  row.wave_number = std::sqrt(hub_zeros(bare, 1).omega.at(0) * std::sqrt(bare.appendage().beta_unit()));
  row.poles = poles(spacecraft::Plant(p), modes).omega;
  if (p.swings()) return row;  // its stiffness matrix is singular
  const Eigen::VectorXd found = diagonalise(finite_elements(p, elements)).omega;
  for (std::size_t i = 0; i < row.poles.size(); ++i)
    row.elements_error =
        std::max(row.elements_error, std::abs(found[static_cast<Eigen::Index>(i)] / row.poles[i] - 1));
  return row;
}

/// The first pole of rigid appendages on springs: 2 k = omega^2 (2 m - 4 c^2/J), with the moment of inertia m
/// of an appendage about its root and its product c with the turn of the hub.
double rigid_on_springs(const Parameters& p) {
  const double l = p.length, r = p.hub_radius, beam = p.mass_per_length * l;
  const double about_root = beam * l * l / 3 + p.tip_mass * l * l + p.tip_inertia;
  const double product = beam * l * (r / 2 + l / 3) + p.tip_mass * (r + l) * l + p.tip_inertia;
  return std::sqrt(2 * p.root_stiffness / (2 * about_root - 4 * product * product / p.total_inertia()));
}

std::vector<double> poles_at(double root, TipSupport tip) {
  return poles(spacecraft::Plant(with_ends(true, root, tip)), modes).omega;
}

void draw(scene::Show& show) {
  scene::Plot& plot = show.plots("A soft root lowers the first frequency like the root of its stiffness");
  plot.size(1000, 460).columns({"curve", "panel", "x", "y"});
  const std::vector<double> roots = logarithmic(softest, stiffest, 57);
  for (const auto& [tip, caption] :
       {std::pair{TipSupport::free, "tips free"}, {TipSupport::pinned, "tips pinned to the hub's frame"}}) {
    scene::Panel& panel = plot.panel("stiffness of the roots, k L/EI", "open-loop poles (rad/s)");
    panel.caption(caption).log_x(softest, stiffest).log_y(0.05, 1000).key("bottom right");
    for (std::size_t mode = 0; mode < modes; ++mode) {
      std::vector<double> omega;
      for (const double root : roots) omega.push_back(poles_at(root, tip).at(mode));
      panel.curve(tip == TipSupport::free ? fmt::format("mode {}", mode + 1) : "", roots, omega,
                  scene::lines(static_cast<int>(mode) + 1));
    }
  }
}

void put(scene::Show& show) {
  draw(show);
  std::vector<Row> rows;
  double worst = 0, of_elements = 0;
  for (const Row& ends : all_ends) {
    rows.push_back(computed(ends));
    worst = std::max(worst, std::abs(rows.back().wave_number / ends.known - 1));
    of_elements = std::max(of_elements, rows.back().elements_error);
  }
  show.table(rows, {{"root", &Row::root},
                    {"tip", &Row::tip},
                    {"q_1 locked, no tip body", &Row::wave_number, 12},
                    {"pole 1 (rad/s)", [](const Row& r) { return r.poles.at(0); }, 10},
                    {"pole 2", [](const Row& r) { return r.poles.at(1); }, 10},
                    {"pole 3", [](const Row& r) { return r.poles.at(2); }, 10}});
  show.at_most("difference of q_1 from single beams", worst, 1e-12,
               "zeros of their characteristic equations");
  show.at_most("difference of finite elements", of_elements, 2e-5,
               "(q h)^4/1440 with elements of a fortieth, for q up to 14.2, within a factor 2");
  const Parameters soft = with_ends(true, softest, TipSupport::free);
  show.near("pole 1 at the softest root", {poles_at(softest, TipSupport::free).at(0), "rad/s"},
            rigid_on_springs(soft), softest, "rigid appendages on springs, to the first order in k L/EI");
  show.near("pole 1 at the stiffest root", {poles_at(stiffest, TipSupport::free).at(0), "rad/s"},
            poles_at(clamped, TipSupport::free).at(0), 5 / stiffest,
            "clamped, to the first order in EI/(k L)");
}

}  // namespace

std::vector<scene::Scene> scenes() {
  return {{.name = "ends",
           .title = "Springs at the roots and supports at the tips: open-loop poles",
           .place = "our own, for what section 3.1 leaves open",
           .content = scene::Content(put)}};
}

}  // namespace nlmech::chapters::gss_control::ends
