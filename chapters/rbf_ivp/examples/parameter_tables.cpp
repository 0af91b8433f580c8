#include <cmath>
#include <string>
#include <vector>

#include "chapters/rbf_ivp/examples/cases.hpp"
#include "nlmech/problems/duffing.hpp"
#include "nlmech/problems/texts.hpp"
#include "nlmech/scene/scene.hpp"

namespace nlmech::chapters::rbf_ivp::parameter_tables {
namespace {

constexpr const char* digits60 = "tools/oracles/rbf_ivp_ends.py, 40 digits; two roundings";

/// A parameter as printed and as used, with the reason for a difference.
struct Parameter {
  std::string name, printed;
  double used;
  std::string remark = {};
};

void show_parameters(const std::vector<Parameter>& parameters, scene::Show& show) {
  show.table(parameters, {{"parameter", &Parameter::name},
                          {"printed", &Parameter::printed},
                          {"used", &Parameter::used, 10},
                          {"remark", &Parameter::remark}});
}

/// Checks a component of the reference against its value in 40 digits.
void check_reference(const std::string& name, Extended value, Extended known, scene::Show& show) {
  show.at_most("error of the reference, " + name, std::abs(value - known), 2e-16, digits60);
}

void free_duffing_parameters(scene::Show& show) {
  const problems::Duffing p;
  const Case& c = free_duffing_case();
  show_parameters(
      {{"t_0", "0", c.t0},
       {"t_F", "500", c.t1, "the errors of Table 4.2 belong to 100 P = 476.802"},
       {"x_1(0)", "1", c.x0[0]},
       {"x_2(0)", "0", c.x0[1]},
       {"omega_n", "1", p.natural_frequency},
       {"eta", "1", p.hardening},
       {"period P", "4.77", duffing_period(), "rounded in print; steps are fractions of the exact period"}},
      show);
  const Vector<Extended, 2> end = c.reference(500);
  show.near("period", {duffing_period(), "s"}, 4.7680220291024608063, 2.3e-16,
            "elliptic integral, tools/oracles/rbf_ivp_ends.py; one rounding");
  check_reference("x(500)", end[0], 0.6356014706573872618142369L, show);
  check_reference("v(500)", end[1], 1.0071778004510543827621357L, show);
  show.measured("elgohary/table-4.1/Period/period of the free oscillation", duffing_period());
}

void impact_parameters(scene::Show& show) {
  const problems::TextProblem p("impact");
  const Case& c = impact_case();
  show_parameters({{"t_0", "0", c.t0},
                   {"t_1", "1", p.parameter("duration"),
                    "Eq. 4.24 prints the falling force as a (1 - t): a (t_1 - t) is meant"},
                   {"t_F", "500", c.t1, "the errors of Table 4.4 belong to 499"},
                   {"x_1(0)", "0", c.x0[0]},
                   {"x_2(0)", "0", c.x0[1]},
                   {"omega_n", "1", p.parameter("natural_frequency")},
                   {"eta", "1", p.parameter("hardening")},
                   {"a", "2", p.parameter("slope"), "the force ends at t_1, which Eq. 4.24 does not say"}},
                  show);
  const Vector<Extended, 2> half = c.reference(0.5), one = c.reference(1), end = c.reference(500);
  check_reference("x(1/2)", half[0], 0.04114876293396327914860369L, show);
  check_reference("v(1/2)", half[1], 0.2448313772903179346460727L, show);
  check_reference("x(1)", one[0], 0.2345637237526737363950751L, show);
  check_reference("v(1)", one[1], 0.4279799258511257045665702L, show);
  check_reference("x(500)", end[0], -0.4043016339378515331621024L, show);
  check_reference("v(500)", end[1], -0.2507612394654356943494855L, show);
  show.near("amplitude after the impact", c.amplitude[0], 0.46508746209705230229, 5e-16, digits60);
  show.near("period after the impact", {2 * c.half_period, "s"}, 5.8305608540698689919, 5e-16, digits60);
}

void chain_parameters(scene::Show& show) {
  const problems::TextProblem p("three-dof");
  const Case& c = three_mass_case();
  const char* from_paper =
      "missing in the dissertation; from Table 5 of the paper, and the errors of Table 4.6 need it";
  show_parameters({{"t_0", "0", c.t0},
                   {"t_F", "200", c.t1},
                   {"x_0", "0", 0, "all three masses at rest"},
                   {"m_1", "2", p.parameter("m1")},
                   {"m_2", "1", p.parameter("m2")},
                   {"m_3", "0.5", p.parameter("m3")},
                   {"c_1", "0", p.parameter("c1")},
                   {"c_2", "0.05", p.parameter("c2")},
                   {"c_3", "0", p.parameter("c3")},
                   {"c_4", "0", p.parameter("c4")},
                   {"k_1", "2", p.parameter("k1")},
                   {"k_2", "1", p.parameter("k2")},
                   {"k_3", "0.5", p.parameter("k3")},
                   {"k_4", "0", p.parameter("k4")},
                   {"l_1", "0.2", p.parameter("l1")},
                   {"l_2", "0", p.parameter("l2")},
                   {"l_3", "0", p.parameter("l3")},
                   {"l_4", "0", p.parameter("l4")},
                   {"F", "missing", p.parameter("force"), from_paper},
                   {"Omega", "missing", p.parameter("frequency"), from_paper}},
                  show);
  // For the doubles nearest to the table's decimals; the exact 0.05, 0.2 and sqrt(1/2) change the end by up
  // to 5.4e-15.
  const Vector<Extended, 6> end = c.reference(200);
  check_reference("x1(200)", end[0], 0.1621748860002473897017669L, show);
  check_reference("x2(200)", end[1], 0.3465729515799769464131827L, show);
  check_reference("x3(200)", end[2], 0.7582358883258392394078843L, show);
  check_reference("v1(200)", end[3], -0.08899514991998155626594779L, show);
  check_reference("v2(200)", end[4], -0.1639274778294406028186595L, show);
  check_reference("v3(200)", end[5], -0.2083204784161271014782796L, show);
  const Eigen::Vector3d squares = chain_frequencies().cwiseAbs2();
  show.near("product of the squared natural frequencies", squares.prod(), 1, 1e-14,
            "determinant of stiffness over determinant of mass by hand: 1/1; rounding");
  show.near("sum of the squared natural frequencies", squares.sum(), 4, 1e-14,
            "trace of M^-1 K by hand: 3/2 + 3/2 + 1; rounding");
}

scene::Scene table(const std::string& number, const std::string& title, void (*show)(scene::Show&)) {
  return {
      .name = "table-" + number, .title = title, .place = "Table " + number, .content = scene::Content(show)};
}

}  // namespace

std::vector<scene::Scene> scenes() {
  return {
      table("4.1", "Free Duffing oscillator: parameters as printed and as used", free_duffing_parameters),
      table("4.3", "Duffing oscillator under an impact: parameters as printed and as used",
            impact_parameters),
      table("4.5", "Three masses: parameters as printed, and the two that are missing", chain_parameters)};
}

}  // namespace nlmech::chapters::rbf_ivp::parameter_tables
