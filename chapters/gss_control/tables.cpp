#include <fmt/format.h>

#include <array>

#include "chapters/gss_control/craft.hpp"
#include "chapters/gss_control/scenes.hpp"

namespace nlmech::chapters {
namespace {

/// A printed parameter, used as printed.
struct Printed {
  const char *symbol, *name, *unit, *text;
  double spacecraft::Parameters::*field;
};

constexpr std::array printed = {
    Printed{"I_hub", "hub inertia", "slug ft^2", "8", &spacecraft::Parameters::hub_inertia},
    Printed{"rho", "mass per length", "slug/ft", "0.0271875", &spacecraft::Parameters::mass_per_length},
    Printed{"E", "Young's modulus", "lb/ft^2", "0.1584e10", &spacecraft::Parameters::youngs_modulus},
    Printed{"L", "appendage length", "ft", "4", &spacecraft::Parameters::length},
    Printed{"r", "hub radius", "ft", "1", &spacecraft::Parameters::hub_radius},
    Printed{"I", "second moment of area", "ft^4", "0.47095e-7", &spacecraft::Parameters::second_moment},
    Printed{"m_tip", "tip mass", "slug", "0.1569", &spacecraft::Parameters::tip_mass},
    Printed{"I_tip", "tip inertia", "slug ft^2", "0.0018", &spacecraft::Parameters::tip_inertia}};

void add_input(scene::Chapter& chapter, const std::string& name, double used) {
  chapter.add(scene::Measurement{name, {}, [used](scene::Workshop&) { return scene::Measured{used, {}}; }});
}

void add_gains(scene::Chapter& chapter, const std::string& set, const spacecraft::Gains& gains) {
  const std::string name = "elgohary/claim-3.1.4/" + set + "/";
  add_input(chapter, name + "k1", gains.k1);
  add_input(chapter, name + "k2", gains.k2);
  add_input(chapter, name + "k3", gains.k3);
}

scene::Showing show(scene::Workshop&) {
  const spacecraft::Parameters p = spacecraft::table_3_1(), bare = without_tip(p);
  scene::Table table({{"parameter"}, {"symbol"}, {"printed"}, {"used", 8}, {"unit"}});
  for (const Printed& q : printed) table.add({q.name, q.symbol, q.text, p.*(q.field), q.unit});
  table.add({"bending stiffness", "EI", "", p.bending_stiffness(), "lb ft^2"});
  table.add({"rigid inertia without tips", "J1", "", bare.total_inertia(), "slug ft^2"});
  table.add({"rigid inertia", "J2", "", p.total_inertia(), "slug ft^2"});
  return {{},
          table,
          {scene::near("bending stiffness", "lb ft^2", p.bending_stiffness(), 74.59848, 1e-13,
                       "0.1584e10 x 0.47095e-7 by hand"),
           scene::near("J1", "slug ft^2", bare.total_inertia(), 10.2475, 1e-13,
                       "8 + 2 x 0.0271875 x 124/3 by hand"),
           scene::near("J2", "slug ft^2", p.total_inertia(), 18.0961, 1e-13,
                       "J1 + 2 x 0.1569 x 25 + 2 x 0.0018 by hand")}};
}

}  // namespace

void add_parameters(scene::Chapter& chapter) {
  const spacecraft::Parameters used = spacecraft::table_3_1();
  for (const Printed& q : printed)
    add_input(chapter, fmt::format("elgohary/table-3.1/{}/{}", q.symbol, q.name), used.*(q.field));
  add_gains(chapter, "unit gains", unit_gains);
  add_gains(chapter, "designed gains", designed_gains);
  chapter.add({.name = "table-3.1",
               .title = "Parameters of the spacecraft",
               .place = "Table 3.1",
               .needs = {},
               .show = show});
}

}  // namespace nlmech::chapters
