#include <fmt/format.h>

#include <array>
#include <vector>

#include "chapters/gss_control/craft.hpp"
#include "nlmech/scene/scene.hpp"

namespace nlmech::chapters::gss_control::parameters {
namespace {

using spacecraft::Parameters;

/// Parameter with its printed text, if it is printed; then the printed value is used.
struct Row {
  const char *symbol, *name, *unit, *text;
  double used;
};

std::vector<Row> printed(const Parameters& p) {
  return {{"I_hub", "hub inertia", "slug ft^2", "8", p.hub_inertia},
          {"rho", "mass per length", "slug/ft", "0.0271875", p.mass_per_length},
          {"E", "Young's modulus", "lb/ft^2", "0.1584e10", p.youngs_modulus},
          {"L", "appendage length", "ft", "4", p.length},
          {"r", "hub radius", "ft", "1", p.hub_radius},
          {"I", "second moment of area", "ft^4", "0.47095e-7", p.second_moment},
          {"m_tip", "tip mass", "slug", "0.1569", p.tip_mass},
          {"I_tip", "tip inertia", "slug ft^2", "0.0018", p.tip_inertia}};
}

void measure_gains(const std::string& set, const spacecraft::Gains& gains, scene::Show& show) {
  const std::string name = "elgohary/claim-3.1.4/" + set + "/";
  show.measured(name + "k1", gains.k1);
  show.measured(name + "k2", gains.k2);
  show.measured(name + "k3", gains.k3);
}

void put(scene::Show& show) {
  const Parameters p = craft(true), bare = craft(false);
  std::vector<Row> rows = printed(p);
  for (const Row& row : rows)
    show.measured(fmt::format("elgohary/table-3.1/{}/{}", row.symbol, row.name), row.used);
  measure_gains("unit gains", unit_gains, show);
  measure_gains("designed gains", designed_gains, show);
  rows.push_back({"EI", "bending stiffness", "lb ft^2", "", p.bending_stiffness()});
  rows.push_back({"J1", "rigid inertia without tips", "slug ft^2", "", bare.total_inertia()});
  rows.push_back({"J2", "rigid inertia", "slug ft^2", "", p.total_inertia()});
  show.table(rows, {{"parameter", &Row::name},
                    {"symbol", &Row::symbol},
                    {"printed", &Row::text},
                    {"used", &Row::used, 8},
                    {"unit", &Row::unit}});
  show.near("bending stiffness", {p.bending_stiffness(), "lb ft^2"}, 74.59848, 1e-13,
            "0.1584e10 x 0.47095e-7 by hand");
  show.near("J1", {bare.total_inertia(), "slug ft^2"}, 10.2475, 1e-13, "8 + 2 x 0.0271875 x 124/3 by hand");
  show.near("J2", {p.total_inertia(), "slug ft^2"}, 18.0961, 1e-13,
            "J1 + 2 x 0.1569 x 25 + 2 x 0.0018 by hand");
}

}  // namespace

std::vector<scene::Scene> scenes() {
  return {{.name = "table-3.1",
           .title = "Parameters of the spacecraft",
           .place = "Table 3.1",
           .content = scene::Content(put)}};
}

}  // namespace nlmech::chapters::gss_control::parameters
