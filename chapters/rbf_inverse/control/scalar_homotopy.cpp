#include "nlmech/algebraic/homotopies/scalar_homotopy.hpp"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <ranges>
#include <string>
#include <tuple>
#include <vector>

#include "chapters/rbf_inverse/control/duffing_runs.hpp"

namespace nlmech::chapters::rbf_inverse::scalar_homotopy {
namespace {

using algebraic::ScalarHomotopy;
using bvp::DuffingCase;

/// The same equations, multiplied by a constant matrix from the left: the roots stay, the condition changes.
class Conditioned final : public algebraic::Equations {
 public:
  Conditioned(algebraic::Equations& of, Eigen::MatrixXd factor) : of_(of), factor_(std::move(factor)) {}
  [[nodiscard]] Eigen::Index size() const override { return of_.size(); }
  void residual(const Eigen::VectorXd& x, Eigen::VectorXd& f) override {
    of_.residual(x, own_);
    f.noalias() = factor_ * own_;
  }
  void linearise(const Eigen::VectorXd& x) override { of_.linearise(x); }
  void apply(const Eigen::VectorXd& v, Eigen::VectorXd& out) const override {
    Eigen::VectorXd inner(size());
    of_.apply(v, inner);
    out.noalias() = factor_ * inner;
  }
  void apply_transposed(const Eigen::VectorXd& v, Eigen::VectorXd& out) const override {
    const Eigen::VectorXd inner = factor_.transpose() * v;
    of_.apply_transposed(inner, out);
  }

 private:
  algebraic::Equations& of_;
  Eigen::MatrixXd factor_;
  Eigen::VectorXd own_;
};

/// What stands before F.
enum class Factor : std::uint8_t { none, rows, inverse };
const char* name_of(Factor f) {
  switch (f) {
    case Factor::none: return "equations as they are";
    case Factor::rows: return "rows scaled to 1";
    case Factor::inverse: return "times the inverse at beta = 0";
  }
  return "";
}

/// |F|/|F(0)| after so many iterations.
struct Residual {
  double iteration, relative;
};

struct Flow {
  DuffingCase which;
  double final_time;
  Factor factor;
  ScalarHomotopy::Function function;
  std::vector<Residual> trace = {};
  std::string status = {};
  std::int64_t iterations = 0;
  double residual = 0, error = 0;  ///< |F|/|F(0)|; of the unknowns against Newton's root, largest
  double nearer = 0;               ///< Euclidean distance from Newton's root over that of the start
  double condition = 0;            ///< of the factor times the Jacobian at Newton's root
  std::int64_t newton = 0;         ///< iterations of Newton's from the same start; 0 if it fails
};

/// The wider shape, which is kinder to every solver.
constexpr double shape = 7.5;

Eigen::MatrixXd factor_of(Factor which, const bvp::ExtremalProblem& problem,
                          bvp::GlobalCollocation& equations, const bvp::DuffingSettings& settings,
                          const Eigen::VectorXd& x) {
  const Eigen::Index n = equations.size();
  if (which == Factor::none) return Eigen::MatrixXd::Identity(n, n);
  Eigen::MatrixXd b;
  if (which == Factor::rows) {
    equations.linearise(x);
    equations.matrix(b);
    return b.rowwise().norm().cwiseInverse().asDiagonal();
  }
  bvp::DuffingSettings linear = settings;
  linear.beta = 0;
  const bvp::ExtremalProblem other = duffing_problem(linear);
  bvp::GlobalCollocation of_linear(other, {.relative_shape = shape, .rows = printed_rows(problem)});
  of_linear.linearise(x);
  of_linear.matrix(b);
  return b.partialPivLu().inverse();
}

/// Condition of the factor times the Jacobian at @p x.
double condition_at(const Eigen::VectorXd& x, const Eigen::MatrixXd& factor,
                    bvp::GlobalCollocation& equations) {
  Eigen::MatrixXd b;
  equations.linearise(x);
  equations.matrix(b);
  const Eigen::VectorXd singular = (factor * b).jacobiSvd().singularValues();
  return singular[0] / singular[singular.size() - 1];
}

void run(Flow& flow, std::int64_t limit) {
  const bvp::DuffingSettings settings = printed_settings(flow.which, flow.final_time);
  const bvp::ExtremalProblem problem = duffing_problem(settings);
  bvp::GlobalCollocation equations(problem, {.relative_shape = shape, .rows = printed_rows(problem)});
  Eigen::VectorXd x = equations.unknowns(bvp::constant_start(Eigen::VectorXd::Zero(4)));
  Eigen::VectorXd newton = x;
  const algebraic::Report direct =
      find_root(algebraic::Newton{.tolerance = 1e-8, .noise = 1e-7, .iterations = 60}, equations, newton);
  const Eigen::MatrixXd factor = factor_of(flow.factor, problem, equations, settings, x);
  Conditioned conditioned(equations, factor);
  double first = 0;
  std::int64_t next = 0;
  const auto observe = [&](const algebraic::Iterate& at) {
    if (at.index == 0) first = at.norm;
    if (at.index < next) return true;
    flow.trace.push_back({static_cast<double>(std::max<std::int64_t>(at.index, 1)), at.norm / first});
    next = at.index + std::max<std::int64_t>(1, at.index / 12);
    return true;
  };
  Eigen::VectorXd f(x.size());
  conditioned.residual(x, f);
  const double away = (x - newton).norm();
  const ScalarHomotopy method{
      .function = flow.function, .step = 1, .tolerance = 1e-8 * f.norm(), .steps = limit};
  const algebraic::Report report = find_root(method, conditioned, x, observe);
  flow.status = to_string(report.status.outcome());
  flow.iterations = report.statistics.steps;
  flow.residual = report.last / report.first;
  flow.newton = direct.status.ok() ? direct.statistics.newton_iterations : 0;
  flow.error = (x - newton).cwiseAbs().maxCoeff();
  flow.nearer = (x - newton).norm() / away;
  flow.condition = direct.status.ok() ? condition_at(newton, factor, equations) : std::nan("");
}

std::vector<Flow> compute(bool quick) {
  std::vector<Flow> all;
  for (const auto& [which, final_time, factor] : {std::tuple{DuffingCase::free, 1.0, Factor::none},
                                                  {DuffingCase::free, 1.0, Factor::rows},
                                                  {DuffingCase::free, 1.0, Factor::inverse},
                                                  {DuffingCase::free, 2.0, Factor::inverse},
                                                  {DuffingCase::fixed, 1.0, Factor::rows},
                                                  {DuffingCase::fixed, 1.0, Factor::inverse}}) {
    for (const auto function : {ScalarHomotopy::Function::newton, ScalarHomotopy::Function::fixed_point})
      run(all.emplace_back(Flow{which, final_time, factor, function}), quick ? 500 : 6000);
  }
  return all;
}

void draw(const std::vector<Flow>& all, scene::Show& show) {
  scene::Plot& plot = show.plots("Flows that avoid the inverse need it to arrive");
  plot.size(900, 480).columns({"panel", "curve", "x", "y"});
  for (const DuffingCase which : {DuffingCase::free, DuffingCase::fixed}) {
    const bool is_free = which == DuffingCase::free;
    scene::Panel& panel = plot.panel("iteration", is_free ? "|{/:Italic F}|/|{/:Italic F}(0)|" : "");
    panel.caption(is_free ? "free final state, {/:Italic T} = 1" : "final state given, {/:Italic T} = 1");
    panel.log_x(1, 1e4).log_y(1e-9, 1e8).key("top left");
    int style = 1;
    for (const Flow& flow : all) {
      if (flow.which != which || flow.final_time != 1 || flow.function != ScalarHomotopy::Function::newton)
        continue;
      const auto finite = [](const Residual& r) { return r.relative > 0 && r.relative < 1e20; };
      panel.curve(name_of(flow.factor), flow.trace | std::views::filter(finite), &Residual::iteration,
                  &Residual::relative, scene::lines(style));
      style += 2;
    }
  }
}

/// Eq. 2.16 with a step of 1 is x - (|F|^2/2) w/|w|^2, w = B^T F. For a linear F it has w.(x - root) = |F|^2,
/// so that the square of the distance from the root loses 3/4 |F|^4/|w|^2, which is 3/(4 cond(B)^2) of it at
/// least.
void check_rate(const std::vector<Flow>& all, scene::Show& show) {
  const auto easiest = std::ranges::find_if(all, [](const Flow& f) {
    return f.which == DuffingCase::free && f.final_time == 1 && f.factor == Factor::inverse &&
           f.function == ScalarHomotopy::Function::newton;
  });
  const double kept = 1 - 0.75 / (easiest->condition * easiest->condition);
  show.at_most("distance from the root over that at the start, free, T = 1, times the inverse at beta = 0",
               easiest->nearer, std::pow(kept, static_cast<double>(easiest->iterations) / 2),
               "gradient descent with Polyak's steps: each leaves 1 - 3/(4 cond^2) of the square at most");
}

void put(const std::vector<Flow>& all, scene::Show& show) {
  draw(all, show);
  show.table(
      all, {{"case", [](const Flow& f) { return to_string(f.which); }},
            {"T", &Flow::final_time},
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
  double raw = HUGE_VAL, condition = HUGE_VAL, fixed = HUGE_VAL, newton = 0;
  for (const Flow& f : all) {
    const bool easy = f.which == DuffingCase::free && f.final_time == 1;
    if (f.factor != Factor::inverse) raw = std::min(raw, f.residual);
    if (f.factor != Factor::inverse) condition = std::min(condition, f.condition);
    if (f.which == DuffingCase::fixed) fixed = std::min(fixed, f.residual);
    if (easy) newton = std::max(newton, static_cast<double>(f.newton));
  }
  show.between("least relative residual, equations as they are or rows scaled", raw, 1e-5, 1e300,
               "recorded: no decrease, or a plateau at 1e-3 to 1e-2 after 20 000 iterations");
  show.between("the same of the fixed case, any factor", fixed, 1e-8, 1e300,
               "recorded: no convergence in 20 000 iterations");
  show.between("least condition at the root, equations as they are or rows scaled", condition, 1e3, HUGE_VAL,
               "its square, which gradient descent takes in order, is a hundred times 6000 or more");
  check_rate(all, show);
  show.between("Newton's iterations, free, T = 1", newton, 2, 12, "recorded: 2 to 7, the last to confirm");
}

}  // namespace

std::vector<scene::Scene> scenes() {
  const scene::Result flows(
      "scalar-flows",
      "40 nodes, c T = 7.5, from zero; Euler's rule, step 1; the tolerance is 1e-8 of |F| at the start",
      compute);
  return {{.name = "scalar-homotopy",
           .title = "Eqs 2.15 and 2.16 as solvers of the collocation equations: how slowly they go",
           .content = scene::Content(put, flows)}};
}

}  // namespace nlmech::chapters::rbf_inverse::scalar_homotopy
