#include <cmath>

#include "chapters/rbf_ivp/examples/cases.hpp"
#include "chapters/rbf_ivp/scenes.hpp"
#include "nlmech/problems/duffing.hpp"
#include "nlmech/problems/impact_duffing.hpp"
#include "nlmech/problems/three_mass_chain.hpp"
#include "nlmech/scene/published.hpp"

namespace nlmech::chapters::rbf_ivp {
namespace {

using scene::Workshop;

constexpr const char* digits60 = "tools/oracles/rbf_ivp_ends.py, 40 digits; two roundings";

/// A parameter as printed, the number we use, and why the two differ if they do.
void add_row(scene::Table& table, const std::string& name, const std::string& printed, double used,
             const std::string& remark = "") {
  table.add({name, printed, used, remark});
}

scene::Table parameter_table() {
  return scene::Table({{"parameter"}, {"printed"}, {"used", 10}, {"remark"}});
}

/// A component of the reference, beside its value in 40 digits.
scene::Quantity reference_value(const std::string& name, Extended value, Extended known) {
  const auto error = static_cast<double>(std::abs(value - known));
  return scene::at_most("error of the reference, " + name, "1", error, 2e-16, digits60);
}

scene::Showing free_duffing_parameters() {
  const problems::Duffing p;
  const Case<2>& c = free_duffing_case();
  scene::Table table = parameter_table();
  add_row(table, "t_0", "0", c.t0);
  add_row(table, "t_F", "500", c.t1, "the errors of Table 4.2 belong to 100 P = 476.802");
  add_row(table, "x_1(0)", "1", c.x0[0]);
  add_row(table, "x_2(0)", "0", c.x0[1]);
  add_row(table, "omega_n", "1", p.natural_frequency);
  add_row(table, "eta", "1", p.hardening);
  add_row(table, "period P", "4.77", duffing_period(),
          "rounded in print; steps are fractions of the exact period");
  const Vector<Extended, 2> end = c.reference(500);
  return {{},
          table,
          {scene::near("period", "s", duffing_period(), 4.7680220291024608063, 2.3e-16,
                       "elliptic integral, tools/oracles/rbf_ivp_ends.py; one rounding"),
           reference_value("x(500)", end[0], 0.6356014706573872618142369L),
           reference_value("v(500)", end[1], 1.0071778004510543827621357L)}};
}

scene::Showing impact_parameters() {
  const problems::ImpactDuffing p;
  const Case<2>& c = impact_case();
  scene::Table table = parameter_table();
  add_row(table, "t_0", "0", c.t0);
  add_row(table, "t_1", "1", p.duration,
          "Eq. 4.24 prints the falling force as a (1 - t): a (t_1 - t) is meant");
  add_row(table, "t_F", "500", c.t1, "the errors of Table 4.4 belong to 499");
  add_row(table, "x_1(0)", "0", c.x0[0]);
  add_row(table, "x_2(0)", "0", c.x0[1]);
  add_row(table, "omega_n", "1", p.natural_frequency);
  add_row(table, "eta", "1", p.hardening);
  add_row(table, "a", "2", p.slope, "the force ends at t_1, which Eq. 4.24 does not say");
  const Vector<Extended, 2> half = c.reference(0.5), one = c.reference(1), end = c.reference(500);
  return {{},
          table,
          {reference_value("x(1/2)", half[0], 0.04114876293396327914860369L),
           reference_value("v(1/2)", half[1], 0.2448313772903179346460727L),
           reference_value("x(1)", one[0], 0.2345637237526737363950751L),
           reference_value("v(1)", one[1], 0.4279799258511257045665702L),
           reference_value("x(500)", end[0], -0.4043016339378515331621024L),
           reference_value("v(500)", end[1], -0.2507612394654356943494855L),
           scene::near("amplitude after the impact", "1", c.amplitude[0], 0.46508746209705230229, 5e-16,
                       digits60),
           scene::near("period after the impact", "s", 2 * c.half_period, 5.8305608540698689919, 5e-16,
                       digits60)}};
}

scene::Showing chain_parameters() {
  const problems::ThreeMassChain p;
  const Case<6>& c = three_mass_case();
  scene::Table table = parameter_table();
  add_row(table, "t_0", "0", c.t0);
  add_row(table, "t_F", "200", c.t1);
  add_row(table, "x_0", "0", 0, "all three masses at rest");
  const auto add = [&](const char* name, const char* printed, double used) {
    add_row(table, name, printed, used);
  };
  add("m_1", "2", p.m1);
  add("m_2", "1", p.m2);
  add("m_3", "0.5", p.m3);
  add("c_1", "0", p.c1);
  add("c_2", "0.05", p.c2);
  add("c_3", "0", p.c3);
  add("c_4", "0", p.c4);
  add("k_1", "2", p.k1);
  add("k_2", "1", p.k2);
  add("k_3", "0.5", p.k3);
  add("k_4", "0", p.k4);
  add("l_1", "0.2", p.l1);
  add("l_2", "0", p.l2);
  add("l_3", "0", p.l3);
  add("l_4", "0", p.l4);
  const char* from_paper =
      "missing in the dissertation; from Table 5 of the paper, and the errors of Table 4.6 need it";
  add_row(table, "F", "missing", p.force, from_paper);
  add_row(table, "Omega", "missing", p.frequency, from_paper);

  const Vector<Extended, 6> end = c.reference(200);
  const Eigen::Vector3d squares = chain_frequencies().cwiseAbs2();
  return {{},
          table,
          {reference_value("x1(200)", end[0], 0.1621748860002476087274774L),
           reference_value("x2(200)", end[1], 0.3465729515799773248914656L),
           reference_value("x3(200)", end[2], 0.7582358883258399112466999L),
           reference_value("v1(200)", end[3], -0.08899514991998021237222876L),
           reference_value("v2(200)", end[4], -0.1639274778294379145512040L),
           reference_value("v3(200)", end[5], -0.2083204784161217199585619L),
           scene::near("product of the squared natural frequencies", "1", squares.prod(), 1, 1e-14,
                       "determinant of stiffness over determinant of mass by hand: 1/1; rounding"),
           scene::near("sum of the squared natural frequencies", "1", squares.sum(), 4, 1e-14,
                       "trace of M^-1 K by hand: 3/2 + 3/2 + 1; rounding")}};
}

void add(scene::Chapter& chapter, const std::string& number, const std::string& title,
         scene::Showing (*show)()) {
  chapter.add({.name = "table-" + number,
               .title = title,
               .place = "Table " + number,
               .needs = {},
               .show = [show](Workshop&) { return show(); }});
}

}  // namespace

void add_parameter_tables(scene::Chapter& chapter) {
  add(chapter, "4.1", "Free Duffing oscillator: parameters as printed and as used", free_duffing_parameters);
  add(chapter, "4.3", "Duffing oscillator under an impact: parameters as printed and as used",
      impact_parameters);
  add(chapter, "4.5", "Three masses: parameters as printed, and the two that are missing", chain_parameters);
  chapter.add(
      scene::Measurement{"elgohary/table-4.1/Period/period of the free oscillation", {}, [](Workshop&) {
                           return scene::Measured{duffing_period(), {}};
                         }});
}

}  // namespace nlmech::chapters::rbf_ivp
