#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "chapters/rbf_inverse/control/duffing_runs.hpp"

namespace nlmech::chapters::rbf_inverse::tables_control {
namespace {

using bvp::DuffingCase;

/// Printed conditions of a case in Table 5.1.
struct Conditions {
  DuffingCase which;
  const char *prescribed, *complementary, *remark = "";

  [[nodiscard]] std::string_view name() const { return to_string(which); }
  [[nodiscard]] bvp::ExtremalProblem problem() const { return duffing_problem(printed_settings(which)); }
  [[nodiscard]] std::string in_words() const;
  [[nodiscard]] double contradiction() const;
};

const std::vector<Conditions>& printed_conditions() {
  static const std::vector<Conditions> all = {
      {DuffingCase::final_only, "x(T)", "λ(0) = 0",
       "for a free start and a cost that does not depend on it; never solved in the text"},
      {DuffingCase::x1x1, "x₁(0), x₁(T)", "−λ₂(0) = φ_x₂, λ₂(T) = φ_x₂"},
      {DuffingCase::x1x2, "x₁(0), x₂(T)", "−λ₂(0) = φ_x₂, λ₁(T) = φ_x₁"},
      {DuffingCase::x2x1, "x₂(0), x₁(T)", "−λ₁(0) = φ_x₁, λ₂(T) = φ_x₂"},
      {DuffingCase::x2x2, "x₂(0), x₂(T)", "−λ₁(0) = φ_x₁, λ₁(T) = φ_x₁", "never solved in the text"},
      {DuffingCase::free, "x(0)", "not in the table", "λ(T) = φ_x: Eq. 5.23"},
      {DuffingCase::fixed, "x(0), x(T)", "not in the table", "none: Eq. 5.26"}};
  return all;
}

/// Condition of each component at both ends, as text.
std::string Conditions::in_words() const {
  const bvp::ControlTask task = problem().task();
  std::string text;
  const auto add = [&](const auto& states, const char* time, const char* sign) {
    for (std::size_t i = 0; i < 2; ++i) {
      if (!text.empty()) text += ", ";
      const char* index = i == 0 ? "₁" : "₂";
      text += states[i] ? fmt::format("x{}({})", index, time)
                        : fmt::format("{}λ{}({}) = φ_x{}", sign, index, time, index);
    }
  };
  add(task.begin, "0", "−");
  add(task.end, "T", "");
  return text;
}

/// Largest residual of the library's conditions at ends that satisfy the conditions from the variation of J,
/// (phi_x - lambda) dx(tF) + (phi_x + lambda) dx(t0) = 0, evaluated here for the cost of Eq. 5.20.
double Conditions::contradiction() const {
  const bvp::DuffingSettings s;  // weights and target as used
  const bvp::ExtremalProblem problem = this->problem();
  const auto& task = problem.task();
  double worst = 0;
  for (int trial = 1; trial <= 5; ++trial) {
    Eigen::MatrixXd ends(4, 2);
    for (Eigen::Index k = 0; k < 8; ++k) ends.reshaped()[k] = std::sin(3.7 * trial + 1.9 * double(k)) * 3;
    for (std::size_t i = 0; i < 2; ++i) {
      const auto row = static_cast<Eigen::Index>(i);
      ends(row, 0) = task.begin[i].value_or(ends(row, 0));
      ends(row, 1) = task.end[i].value_or(ends(row, 1));
      // Eq. 5.6 with phi = (x(tF) - x_F)^T (x(tF) - x_F)/2.
      if (!task.begin[i]) ends(2 + row, 0) = 0;
      if (!task.end[i]) ends(2 + row, 1) = s.weights[row] * (ends(row, 1) - s.target[row]);
    }
    Eigen::VectorXd r(4);
    problem.conditions(ends, Eigen::VectorXd(), r);
    worst = std::max(worst, r.cwiseAbs().maxCoeff());
  }
  return worst;
}

void put_conditions(scene::Show& show) {
  show.table(printed_conditions(), {{"prescribed", &Conditions::prescribed},
                                    {"complementary, as printed", &Conditions::complementary},
                                    {"all four conditions as solved", &Conditions::in_words},
                                    {"name", &Conditions::name},
                                    {"remark", &Conditions::remark}});
  for (const Conditions& c : printed_conditions())
    show.at_most(fmt::format("residual of the conditions by Eq. 5.6, {}", c.name()), c.contradiction(), 1e-14,
                 "rounding of numbers up to 10: the variation worked out by hand");
}

void put_parameters(scene::Show& show) {
  struct Parameter {
    std::string name, printed, used, remark = {};
  };
  const std::vector<Parameter> all = {
      {"natural frequency", "1 rad/s", fmt::format("{:g} rad/s", bvp::DuffingSettings().frequency)},
      {"nonlinearity beta", ">= 0.9", "0.9; 0.94 for x1x1 and x1x2; 0.97 for x2x1", "stated in the text"},
      {"initial conditions", "[0 0]", "0, 0 where prescribed"},
      {"final conditions", "[5 2]", "5, 2 where prescribed, and in the cost elsewhere"},
      {"harmonic amplitudes", "1.5, 2, 3", "1.5, 2, 3"},
      {"harmonic frequency", "3 rad/s", "3 rad/s"},
      {"final time T", "", "2; also 1 and 5",
       "not stated; inferred, from a range that the failure of shooting leaves"},
      {"weights S", "", "I", "not stated; consistent with Table 5.3"},
      {"nodes, shape", "N = 40, c = (N - 1)/(4 T)", "the same: c T = 9.75"},
      {"initial guess, stopping rule, extremal", "", "zeros, and ten random guesses", "not stated"}};
  show.table(all, {{"parameter", &Parameter::name},
                   {"printed", &Parameter::printed},
                   {"used", &Parameter::used},
                   {"remark", &Parameter::remark}});
  // Eq. 5.34 evaluated directly: cos 6, cos 18, cos 2 and the sines.
  const Eigen::Vector2d target = duffing_target(printed_settings(DuffingCase::harmonic));
  const double x1 = 1.5 * std::cos(6.0) + 2 * std::cos(18.0) + 3 * std::cos(2.0);
  const double x2 = -(4.5 * std::sin(6.0) + 18 * std::sin(18.0) + 3 * std::sin(2.0));
  show.near("x1F of the harmonic case, T = 2", target[0], x1, 1e-14, "Eq. 5.34 by hand");
  show.near("x2F of the harmonic case, T = 2", {target[1], "1/s"}, x2, 1e-14, "Eq. 5.34 by hand");
}

}  // namespace

std::vector<scene::Scene> scenes() {
  return {{.name = "table-5.1",
           .title = "End conditions of the co-states for each set of prescribed states",
           .place = "Table 5.1",
           .content = scene::Content(put_conditions)},
          {.name = "table-5.2",
           .title = "Constants of the Duffing control problem, and those that the text omits",
           .place = "Table 5.2",
           .content = scene::Content(put_parameters)}};
}

}  // namespace nlmech::chapters::rbf_inverse::tables_control
