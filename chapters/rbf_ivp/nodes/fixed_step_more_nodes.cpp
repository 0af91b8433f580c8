#include <array>
#include <cmath>
#include <optional>
#include <string>

#include "chapters/rbf_ivp/examples/cases.hpp"
#include "chapters/rbf_ivp/scenes.hpp"
#include "nlmech/ivp/collocation.hpp"

namespace nlmech::chapters::rbf_ivp {
namespace {

using collocation::NodeFamily;
using scene::Workshop;

/// Errors of one method on one problem by the number of nodes; nothing where a step was not solved.
struct Curve {
  std::string problem, method;
  std::vector<int> nodes;
  std::vector<std::optional<double>> error;
};

/// Root mean square of the first position's error over all nodes of all steps from t0 to @p end.
template <int n, class Method>
std::optional<double> error_of(const Case<n>& c, double end, const Method& method) {
  std::vector<double> errors;
  const auto watch = [&](const ivp::Step<n>& step) {
    for (std::size_t k = 0; k < step.times.size(); ++k) {
      const double found = step.states(0, static_cast<Eigen::Index>(k));
      errors.push_back(static_cast<double>(Extended(found) - c.reference(step.times[k])[0]));
    }
    return true;
  };
  if (!ivp::integrate(c.system, c.x0, c.t0, end, method, ivp::Observer<n>(watch)).status.ok())
    return std::nullopt;
  return root_mean_square(errors);
}

template <int n>
void add_curves(std::vector<Curve>& curves, const Case<n>& c, double step, double end, int last, int by) {
  std::array<Curve, 3> found = {Curve{c.name, "rbf-coll", {}, {}}, Curve{c.name, "lgl", {}, {}},
                                Curve{c.name, "radau", {}, {}}};
  for (int nodes = 10; nodes <= last; nodes += by) {
    for (Curve& curve : found) curve.nodes.push_back(nodes);
    found[0].error.push_back(error_of(c, end, ivp::RbfCollocation{.step = step, .nodes = nodes}));
    found[1].error.push_back(error_of(c, end, ivp::PolynomialCollocation{.step = step, .nodes = nodes}));
    const ivp::PolynomialCollocation radau = {
        .step = step, .nodes = nodes, .points = NodeFamily::left_end_and_radau};
    found[2].error.push_back(error_of(c, end, radau));
  }
  for (Curve& curve : found) curves.push_back(std::move(curve));
}

std::vector<Curve> all_curves(bool quick) {
  std::vector<Curve> curves;
  const int by = quick ? 25 : 5;
  add_curves(curves, free_duffing_case(), duffing_period(), 10 * duffing_period(), quick ? 60 : 80, by);
  add_curves(curves, three_mass_case(), 20, 200, 60, by);
  return curves;
}

const Curve& find(const std::vector<Curve>& curves, const std::string& problem, const std::string& method) {
  for (const Curve& curve : curves) {
    if (curve.problem == problem && curve.method == method) return curve;
  }
  throw std::logic_error("no curve of " + method + " on " + problem);
}

/// The least error from @p first nodes on.
double least(const Curve& curve, int first) {
  double smallest = HUGE_VAL;
  for (std::size_t i = 0; i < curve.nodes.size(); ++i) {
    if (curve.nodes[i] >= first) smallest = std::min(smallest, curve.error[i].value_or(HUGE_VAL));
  }
  return smallest;
}

scene::Showing show(const std::vector<Curve>& curves) {
  scene::Table data({{"problem", 3, true}, {"nodes"}, {"rbf"}, {"lgl"}, {"radau"}});
  scene::Table table({{"problem"}, {"N"}, {"RBF-Coll, c = (N - 1)/(4 h)"}, {"LGL"}, {"Radau"}});
  for (const char* problem : {"duffing", "three-masses"}) {
    const Curve &rbf = find(curves, problem, "rbf-coll"), &lgl = find(curves, problem, "lgl"),
                &radau = find(curves, problem, "radau");
    for (std::size_t i = 0; i < rbf.nodes.size(); ++i) {
      const std::vector<scene::Cell> row = {problem, std::int64_t(rbf.nodes[i]), scene::to_cell(rbf.error[i]),
                                            scene::to_cell(lgl.error[i]), scene::to_cell(radau.error[i])};
      data.add(row);
      table.add(row);
    }
  }
  scene::Showing showing;
  showing.table = std::move(table);
  showing.figure = {
      std::move(data),
      "rbf_ivp-fixed-step-more-nodes",
      {{"heading", "At a fixed step more nodes help polynomials; radial functions soon stop gaining"}}};
  showing.quantities = {
      {"least error of RBF-Coll with 60 and more nodes, free Duffing", "1",
       least(find(curves, "duffing", "rbf-coll"), 60), 1e-7, 1e-3,
       "no convergence: its matrix differentiates this motion with errors of 1e-5 to 1e-4 whatever the "
       "number of "
       "nodes; recorded"},
      scene::at_most("least error of LGL with 60 and more nodes, free Duffing", "1",
                     least(find(curves, "duffing", "lgl"), 60), 1e-12,
                     "recorded: 1.3e-13 a step at 60 nodes; ten steps"),
      {"least error of RBF-Coll with 60 nodes, three masses", "1",
       least(find(curves, "three-masses", "rbf-coll"), 60), 1e-7, 1e-3, "no convergence, as above"},
      scene::near("error of LGL with 60 nodes, three masses", "1",
                  least(find(curves, "three-masses", "lgl"), 60), 3.3e-10, 0.05, "recorded with two digits"),
  };
  return showing;
}

}  // namespace

void add_fixed_step_more_nodes(scene::Chapter& chapter) {
  const auto& curves = chapter.add_run<std::vector<Curve>>(
      "error-against-nodes",
      "free Duffing with h = P to 10 P, three masses with h = 20 s to 200 s; root mean square of x1's error "
      "over all nodes; RBF-Coll by Gaussians with c = (N - 1)/(4 h)",
      {}, [](Workshop& w) { return all_curves(w.quick()); });
  chapter.add({.name = "fixed-step-more-nodes",
               .title = "Error against the number of nodes at a fixed step",
               .place = "our own",
               .needs = {&curves},
               .show = [&curves](Workshop& w) { return show(w.result(curves)); }});
}

}  // namespace nlmech::chapters::rbf_ivp
