/// Claim of section 5.5, left to future studies: methods without the inverse of the Jacobian can replace
/// Newton's iteration.
#include "nlmech/algebraic/homotopies/scalar_homotopy.hpp"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "chapters/rbf_inverse/control/duffing_runs.hpp"

namespace nlmech::chapters::rbf_inverse::scalar_homotopy {
namespace {

using algebraic::ScalarHomotopy;
using bvp::DuffingCase;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Matrix that multiplies F from the left: it preserves the roots and changes the condition number.
enum class Factor : std::uint8_t { none, rows, inverse };
const char* name_of(Factor f) {
  switch (f) {
    case Factor::none: return "equations as they are";
    case Factor::rows: return "rows scaled to 1";
    case Factor::inverse: return "times the inverse at beta = 0";
  }
  return "";
}

/// Homotopy flow at T = 1 with its result.
struct Flow {
  DuffingCase which;
  Factor factor;
  ScalarHomotopy::Function function;
  std::string status = {};
  std::int64_t iterations = 0;
  double residual = 0, error = 0;  ///< |F|/|F(0)|; largest error of the unknowns relative to Newton's root
  double nearer = 0;               ///< Euclidean distance from Newton's root, relative to that of the start
  double condition = 0;            ///< condition number of the factor times the Jacobian at Newton's root
  std::int64_t newton = 0;         ///< Newton iterations from the same start
};

/// Collocation of the text with wider functions, for which every solver converges more easily.
bvp::GlobalCollocation collocation_of(const bvp::ExtremalProblem& problem) {
  return {problem, {.relative_shape = 7.5, .rows = printed_rows(problem)}};
}

MatrixXd jacobian_at(const VectorXd& x, algebraic::Equations& equations) {
  MatrixXd b;
  equations.linearise(x);
  equations.matrix(b);
  return b;
}

MatrixXd factor_of(Factor which, bvp::GlobalCollocation& equations, bvp::DuffingSettings settings,
                   const VectorXd& x) {
  if (which == Factor::none) return MatrixXd::Identity(x.size(), x.size());
  if (which == Factor::rows) return jacobian_at(x, equations).rowwise().norm().cwiseInverse().asDiagonal();
  settings.beta = 0;
  const bvp::ExtremalProblem linear = duffing_problem(settings);
  bvp::GlobalCollocation of_linear = collocation_of(linear);
  return jacobian_at(x, of_linear).partialPivLu().inverse();
}

void run(Flow& flow, std::int64_t limit) {
  const bvp::DuffingSettings settings = printed_settings(flow.which, 1);
  const bvp::ExtremalProblem problem = duffing_problem(settings);
  bvp::GlobalCollocation equations = collocation_of(problem);
  VectorXd x = equations.unknowns(bvp::constant_start(VectorXd::Zero(4))), newton = x, f(x.size());
  const algebraic::Report direct =
      find_root(algebraic::Newton{.tolerance = 1e-8, .noise = 1e-7, .iterations = 60}, equations, newton);
  const MatrixXd factor = factor_of(flow.factor, equations, settings, x);
  algebraic::DenseEquations conditioned(
      x.size(),
      [&](const VectorXd& at, VectorXd& out) {
        equations.residual(at, f);
        out = factor * f;
      },
      [&](const VectorXd& at, MatrixXd& b) { b = factor * jacobian_at(at, equations); });
  VectorXd first(x.size());
  conditioned.residual(x, first);
  const double away = (x - newton).norm();
  const ScalarHomotopy method{
      .function = flow.function, .step = 1, .tolerance = 1e-8 * first.norm(), .steps = limit};
  const algebraic::Report report = find_root(method, conditioned, x);
  flow.status = to_string(report.status.outcome());
  flow.iterations = report.statistics.steps;
  flow.residual = report.last / report.first;
  flow.error = (x - newton).cwiseAbs().maxCoeff();
  flow.nearer = (x - newton).norm() / away;
  if (!direct.status.ok()) return;
  flow.newton = direct.statistics.newton_iterations;
  const VectorXd singular = (factor * jacobian_at(newton, equations)).jacobiSvd().singularValues();
  flow.condition = singular[0] / singular[singular.size() - 1];
}

std::vector<Flow> compute(bool quick) {
  using enum ScalarHomotopy::Function;
  std::vector<Flow> all = {
      {DuffingCase::free, Factor::none, newton},    {DuffingCase::free, Factor::none, fixed_point},
      {DuffingCase::free, Factor::rows, newton},    {DuffingCase::free, Factor::rows, fixed_point},
      {DuffingCase::free, Factor::inverse, newton}, {DuffingCase::free, Factor::inverse, fixed_point},
      {DuffingCase::fixed, Factor::rows, newton},   {DuffingCase::fixed, Factor::inverse, newton}};
  for (Flow& flow : all) run(flow, quick ? 500 : 6000);
  return all;
}

void put(const std::vector<Flow>& all, scene::Show& show) {
  show.table(
      all, {{"case", [](const Flow& f) { return to_string(f.which); }},
            {"equation",
             [](const Flow& f) { return f.function == ScalarHomotopy::Function::newton ? "2.16" : "2.15"; }},
            {"factor", [](const Flow& f) { return name_of(f.factor); }},
            {"status", &Flow::status},
            {"iterations", &Flow::iterations},
            {"|F|/|F(0)|", &Flow::residual, 2},
            {"distance from Newton's root", &Flow::error, 2},
            {"over that of the start", &Flow::nearer, 2},
            {"condition at the root", &Flow::condition, 2},
            {"Newton's iterations from there", &Flow::newton}});
  double raw = HUGE_VAL, condition = HUGE_VAL, fixed = HUGE_VAL;
  for (const Flow& f : all) {
    if (f.factor != Factor::inverse) raw = std::min(raw, f.residual);
    if (f.factor != Factor::inverse) condition = std::min(condition, f.condition);
    if (f.which == DuffingCase::fixed) fixed = std::min(fixed, f.residual);
  }
  show.between(
      "least relative residual, equations as they are or rows scaled", raw, 5e-4, 1e300,
      "regression value: no decrease, or a plateau at 1e-3 to 1e-2 after 20 000 iterations; half of that");
  show.between("the same of the fixed case, any factor", fixed, 1e-8, 1e300,
               "regression value: no convergence in 20 000 iterations");
  show.between("least condition at the root, equations as they are or rows scaled", condition, 1e3, HUGE_VAL,
               "its square, which gradient descent takes in order, is a hundred times 6000 or more");
  // Eq. 2.16 with a step of 1 is x - (|F|^2/2) w/|w|^2, w = B^T F. For a linear F it has w.(x - root) =
  // |F|^2, so a step reduces the squared distance from the root by 3/4 |F|^4/|w|^2, at least the fraction
  // 3/(4 cond(B)^2) of it.
  const Flow& easiest = all[4];
  const double remains = 1 - 0.75 / (easiest.condition * easiest.condition);
  show.at_most("distance from the root over that at the start, free, times the inverse at beta = 0",
               easiest.nearer, std::pow(remains, static_cast<double>(easiest.iterations) / 2),
               "gradient descent with Polyak's steps: each leaves 1 - 3/(4 cond^2) of the square at most");
  show.between("Newton's iterations, free, T = 1", all.front().newton, 2, 12,
               "regression value: 2 to 7, the last to confirm");
}

}  // namespace

std::vector<scene::Scene> scenes() {
  const scene::Result flows("scalar-flows",
                            "T = 1, 40 nodes, c T = 7.5, from zero; Euler's rule, step 1; the tolerance is "
                            "1e-8 of |F| at the start",
                            compute);
  return {{.name = "scalar-homotopy",
           .title = "Slow convergence of Eqs 2.15 and 2.16 as solvers of the collocation equations",
           .place = "our own, for a claim of section 5.5",
           .content = scene::Content(put, flows)}};
}

}  // namespace nlmech::chapters::rbf_inverse::scalar_homotopy
