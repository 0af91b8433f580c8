#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "chapters/rbf_ivp/examples/cases.hpp"
#include "nlmech/ivp/collocation/collocation.hpp"
#include "nlmech/scene/scene.hpp"

namespace nlmech::chapters::rbf_ivp::fixed_step_more_nodes {
namespace {

/// Errors of the three methods with a number of nodes; nothing where a step was not solved.
struct Row {
  std::string problem;
  int nodes;
  std::optional<double> rbf, lgl, radau;
};

/// Root mean square of the first position's error over all nodes of all steps from t0 to @p end.
template <class Method>
std::optional<double> error_of(const Case& c, double end, const Method& method) {
  std::vector<double> errors;
  const auto watch = [&](const ivp::Step& step) {
    for (std::size_t k = 0; k < step.times.size(); ++k) {
      const double found = step.states(0, static_cast<Eigen::Index>(k));
      errors.push_back(static_cast<double>(Extended(found) - c.reference(step.times[k])[0]));
    }
    return true;
  };
  if (!ivp::integrate(c.system, c.x0, c.t0, end, method, ivp::Observer(watch)).status.ok())
    return std::nullopt;
  return root_mean_square(errors);
}

void add_rows(std::vector<Row>& rows, const Case& c, double step, double end, int last, int by) {
  constexpr auto radau = collocation::NodeFamily::left_end_and_radau;
  for (int nodes = 10; nodes <= last; nodes += by) {
    rows.push_back(
        {c.name, nodes, error_of(c, end, ivp::RbfCollocation{.step = step, .nodes = nodes}),
         error_of(c, end, ivp::PolynomialCollocation{.step = step, .nodes = nodes}),
         error_of(c, end, ivp::PolynomialCollocation{.step = step, .nodes = nodes, .points = radau})});
  }
}

std::vector<Row> all_rows(bool quick) {
  std::vector<Row> rows;
  const int by = quick ? 25 : 5;
  add_rows(rows, free_duffing_case(), duffing_period(), 10 * duffing_period(), quick ? 60 : 80, by);
  add_rows(rows, three_mass_case(), 20, 200, 60, by);
  return rows;
}

void draw(const std::vector<Row>& rows, scene::Show& show) {
  scene::Plot& plot = show.plots("More nodes at a step: radial functions soon stop gaining");
  const auto add = [&](const char* caption, double last, const char* y_label, int block) -> scene::Panel& {
    scene::Panel& panel = plot.panel("nodes in a step", y_label).caption(caption);
    panel.x_range(5, last).set("xtics 20").log_y(1e-15, 1).set("ytics 1e3").key("off");
    return panel
        .columns("RBF, {/:Italic c = }({/:Italic N − }1)/(4{/:Italic h})", "nodes:rbf", {"linespoints", 5},
                 block)
        .columns("polynomials, LGL", "nodes:lgl", {"linespoints", 1}, block)
        .columns("polynomials, Radau", "nodes:radau", {"linespoints", 4}, block);
  };
  add("free Duffing, step P", 85, "RMS error of {/:Italic x}_1", 0)
      .place(0.135, 0.53, 0.13, 0.80)
      .key("at screen 0.53, screen 0.925 center top maxrows 1 samplen 3 width -5");
  add("three masses, step 20 s", 65, "", 1).place(0.575, 0.97, 0.13, 0.80).set("format y ''");
  scene::Table data({{"problem", 3, true}, {"nodes"}, {"rbf"}, {"lgl"}, {"radau"}});
  for (const Row& r : rows) data.add({r.problem, r.nodes, r.rbf, r.lgl, r.radau});
  plot.data(std::move(data));
}

void put(const std::vector<Row>& rows, scene::Show& show) {
  draw(rows, show);
  show.table(rows, {{"problem", &Row::problem},
                    {"N", &Row::nodes},
                    {"RBF-Coll, c = (N - 1)/(4 h)", &Row::rbf},
                    {"LGL", &Row::lgl},
                    {"Radau", &Row::radau}});
  /// With 60 and more nodes.
  const auto least = [&](const char* problem, std::optional<double> Row::*error) {
    double smallest = HUGE_VAL;
    for (const Row& r : rows) {
      if (r.problem == problem && r.nodes >= 60) smallest = std::min(smallest, (r.*error).value_or(HUGE_VAL));
    }
    return smallest;
  };
  show.between("least error of RBF-Coll with 60 and more nodes, free Duffing", least("duffing", &Row::rbf),
               1e-7, 1e-3,
               "no convergence: its matrix differentiates this motion with errors of 1e-5 to 1e-4 whatever "
               "the number of nodes; recorded");
  show.at_most("least error of LGL with 60 and more nodes, free Duffing", least("duffing", &Row::lgl), 1e-12,
               "recorded: 1.3e-13 a step at 60 nodes; ten steps");
  show.between("least error of RBF-Coll with 60 nodes, three masses", least("three-masses", &Row::rbf), 1e-7,
               1e-3, "no convergence, as above");
  show.near("error of LGL with 60 nodes, three masses", least("three-masses", &Row::lgl), 3.3e-10, 0.05,
            "recorded with two digits");
}

}  // namespace

std::vector<scene::Scene> scenes() {
  const scene::Result rows(
      "error-against-nodes",
      "free Duffing with h = P to 10 P, three masses with h = 20 s to 200 s; root mean square of x1's error "
      "over all nodes; RBF-Coll by Gaussians with c = (N - 1)/(4 h)",
      all_rows);
  return {{.name = "fixed-step-more-nodes",
           .title = "Error against the number of nodes at a fixed step",
           .content = scene::Content(put, rows)}};
}

}  // namespace nlmech::chapters::rbf_ivp::fixed_step_more_nodes
