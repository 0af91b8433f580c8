#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "chapters/rbf_ivp/examples/runs.hpp"
#include "nlmech/support/stopwatch.hpp"

namespace nlmech::chapters::rbf_ivp::fixed_step_more_nodes {
namespace {

/// Errors of the three methods for a number of nodes; nothing if a step was not solved.
struct Row {
  std::string problem;
  int nodes;
  std::optional<double> rbf, lgl, radau;
};

/// RMS error of the first position over all nodes of all steps from t0 to @p end; nothing after a failure.
template <class Method>
std::optional<double> error_of(const Case& c, double end, const Method& method) {
  try {
    return rms_error(record(c, end, throughout(method)), 0, Points::all);
  } catch (const Failure&) {
    return std::nullopt;
  }
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

void put(const std::vector<Row>& rows, scene::Show& show) {
  show.table(rows, {{"problem", &Row::problem},
                    {"N", &Row::nodes},
                    {"RBF-Coll, c = (N - 1)/(4 h)", &Row::rbf},
                    {"LGL", &Row::lgl},
                    {"Radau", &Row::radau}});
  /// Error for a number of nodes.
  const auto error_with = [&](const char* problem, int nodes, std::optional<double> Row::*of) {
    const auto row =
        std::ranges::find_if(rows, [&](const Row& r) { return r.problem == problem && r.nodes == nodes; });
    return row == rows.end() ? NAN : ((*row).*of).value_or(HUGE_VAL);
  };
  const double at_10 = error_with("duffing", 10, &Row::rbf), at_35 = error_with("duffing", 35, &Row::rbf);
  show.between("error of RBF-Coll with 35 nodes over that with 10, free Duffing", at_35 / at_10, 1e-6, 1e-3,
               "regression value: 2e-5; rounding moves the error with 35 nodes by a factor of ten");
  /// Least error for 60 or more nodes.
  const auto least = [&](const char* problem, std::optional<double> Row::*error) {
    double smallest = HUGE_VAL;
    for (const Row& r : rows) {
      if (r.problem == problem && r.nodes >= 60) smallest = std::min(smallest, (r.*error).value_or(HUGE_VAL));
    }
    return smallest;
  };
  std::vector<double> beyond;
  for (const Row& r : rows)
    if (r.problem == "duffing" && r.nodes > 40) beyond.push_back(r.rbf.value_or(HUGE_VAL));
  show.between(
      "median error of RBF-Coll with more than 40 nodes over that with 35, free Duffing",
      median(beyond) / at_35, 2, 1e4,
      "regression value: 63; rounding moves the error with 35 nodes by a factor of ten to either side");
  show.between("least error of RBF-Coll with 60 and more nodes, free Duffing", least("duffing", &Row::rbf),
               1e-7, 1e-3,
               "no convergence: its matrix differentiates this motion with errors of 1e-5 to 1e-4 whatever "
               "the number of nodes; regression value");
  show.at_most("least error of LGL with 60 and more nodes, free Duffing", least("duffing", &Row::lgl), 1e-12,
               "regression value: 1.3e-13 a step at 60 nodes; ten steps");
  show.between("least error of RBF-Coll with 60 nodes, three masses", least("three-masses", &Row::rbf), 1e-7,
               1e-3, "no convergence, as above");
  show.near("error of LGL with 60 nodes, three masses", least("three-masses", &Row::lgl), 3.3e-10, 0.05,
            "regression value with two digits");
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
           .place = "our own, for the claim of section 4.4",
           .content = scene::Content(put, rows)}};
}

}  // namespace nlmech::chapters::rbf_ivp::fixed_step_more_nodes
