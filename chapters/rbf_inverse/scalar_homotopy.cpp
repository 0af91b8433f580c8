#include "nlmech/algebraic/scalar_homotopy.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <array>
#include <cmath>

#include "chapters/rbf_inverse/curves.hpp"
#include "chapters/rbf_inverse/scenes.hpp"

namespace nlmech::chapters {
namespace {

using algebraic::ScalarHomotopy;
using bvp::DuffingCase;
using scene::Workshop;

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

struct Flow {
  DuffingCase which;
  double final_time;
  Factor factor;
  ScalarHomotopy::Function function;
  std::vector<std::pair<double, double>> trace;  ///< iteration, |F|/|F(0)|
  std::string status;
  std::int64_t iterations;
  double residual, error;  ///< |F|/|F(0)|; of the unknowns against Newton's root from there, largest
  std::int64_t newton;     ///< iterations of Newton's from the same start; 0 if it fails
};

constexpr std::array flows = {std::tuple{DuffingCase::free, 1.0, Factor::none},
                              std::tuple{DuffingCase::free, 1.0, Factor::rows},
                              std::tuple{DuffingCase::free, 1.0, Factor::inverse},
                              std::tuple{DuffingCase::free, 2.0, Factor::inverse},
                              std::tuple{DuffingCase::fixed, 1.0, Factor::rows},
                              std::tuple{DuffingCase::fixed, 1.0, Factor::inverse}};

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

Flow run_flow(DuffingCase which, double final_time, Factor factor, ScalarHomotopy::Function function,
              std::int64_t limit) {
  const bvp::DuffingSettings settings = printed_settings(which, final_time);
  const bvp::ExtremalProblem problem = duffing_problem(settings);
  bvp::GlobalCollocation equations(problem, {.relative_shape = shape, .rows = printed_rows(problem)});
  Eigen::VectorXd x = equations.unknowns(bvp::constant_start(Eigen::VectorXd::Zero(4)));
  Eigen::VectorXd newton = x;
  const algebraic::Report direct =
      find_root(algebraic::Newton{.tolerance = 1e-8, .noise = 1e-7, .iterations = 60}, equations, newton);
  Conditioned conditioned(equations, factor_of(factor, problem, equations, settings, x));
  Flow flow{which, final_time, factor, function, {}, {}, 0, 0, 0, 0};
  double first = 0;
  std::int64_t next = 0;
  const auto observe = [&](const algebraic::Iterate& at) {
    if (at.index == 0) first = at.norm;
    if (at.index < next) return true;
    flow.trace.emplace_back(static_cast<double>(std::max<std::int64_t>(at.index, 1)), at.norm / first);
    next = at.index + std::max<std::int64_t>(1, at.index / 12);
    return true;
  };
  Eigen::VectorXd f(x.size());
  conditioned.residual(x, f);
  const algebraic::Report report =
      find_root(ScalarHomotopy{.function = function, .step = 1, .tolerance = 1e-8 * f.norm(), .steps = limit},
                conditioned, x, observe);
  flow.status = to_string(report.status.outcome());
  flow.iterations = report.statistics.steps;
  flow.residual = report.last / report.first;
  flow.newton = direct.status.ok() ? direct.statistics.newton_iterations : 0;
  flow.error = (x - newton).cwiseAbs().maxCoeff();
  return flow;
}

std::vector<Flow> compute(bool quick) {
  std::vector<Flow> all;
  for (const auto& [which, final_time, factor] : flows)
    for (const auto function : {ScalarHomotopy::Function::newton, ScalarHomotopy::Function::fixed_point})
      all.push_back(run_flow(which, final_time, factor, function, quick ? 500 : 6000));
  return all;
}

const char* equation_of(ScalarHomotopy::Function f) {
  return f == ScalarHomotopy::Function::newton ? "2.16" : "2.15";
}

scene::Figure draw(const std::vector<Flow>& all) {
  ControlCurves figure("Flows that avoid the inverse need it to arrive");
  for (const DuffingCase which : {DuffingCase::free, DuffingCase::fixed}) {
    const bool is_free = which == DuffingCase::free;
    figure.panel("iteration", is_free ? "|{/:Italic F}|/|{/:Italic F}(0)|" : "",
                 is_free ? "free final state, {/:Italic T} = 1" : "final state given, {/:Italic T} = 1");
    int style = 1;
    for (const Flow& flow : all) {
      if (flow.which != which || flow.final_time != 1 || flow.function != ScalarHomotopy::Function::newton)
        continue;
      figure.begin(name_of(flow.factor), fmt::format("l{}", style));
      style += 2;
      for (const auto& [iteration, residual] : flow.trace)
        if (residual > 0 && residual < 1e20) figure.add(iteration, residual);
    }
    figure.with("logx", "1").with("logy", "1").with("yrange", "[1e-9:1e8]").with("xrange", "[1:1e4]");
    figure.with("key", "top left");
  }
  figure.overall("width", "900");
  return figure.take();
}

scene::Table tabulate(const std::vector<Flow>& all) {
  scene::Table table({{"case"},
                      {"T"},
                      {"equation"},
                      {"factor"},
                      {"status"},
                      {"iterations"},
                      {"|F|/|F(0)|", 2},
                      {"distance from Newton's root", 2},
                      {"Newton's iterations from there"}});
  for (const Flow& f : all)
    table.add({std::string(to_string(f.which)), f.final_time, std::string(equation_of(f.function)),
               std::string(name_of(f.factor)), f.status, f.iterations, f.residual, f.error, f.newton});
  return table;
}

std::vector<scene::Quantity> promises(const std::vector<Flow>& all, bool quick) {
  double raw = HUGE_VAL, inverse = HUGE_VAL, fixed = HUGE_VAL, newton = 0;
  for (const Flow& f : all) {
    if (f.factor == Factor::none || f.factor == Factor::rows) raw = std::min(raw, f.residual);
    if (f.which == DuffingCase::fixed) fixed = std::min(fixed, f.residual);
    if (f.factor == Factor::inverse && f.which == DuffingCase::free && f.final_time == 1)
      inverse = std::min(inverse, f.residual);
    if (f.which == DuffingCase::free && f.final_time == 1) newton = std::max(newton, double(f.newton));
  }
  return {{"least relative residual, equations as they are or rows scaled", "1", raw, 1e-5, 1e300,
           "recorded: no decrease, or a plateau at 1e-3 to 1e-2 after 20 000 iterations"},
          {"the same of the fixed case, any factor", "1", fixed, 1e-8, 1e300,
           "recorded: no convergence in 20 000 iterations"},
          scene::at_most("free, T = 1, times the inverse at beta = 0", "1", inverse, quick ? 1 : 1e-2,
                         "recorded: 1e-8 in 1500 to 15 000 iterations"),
          {"Newton's iterations, free, T = 1", "1", newton, 2, 12, "recorded: 2 to 7, the last to confirm"}};
}

}  // namespace

void add_scalar_homotopy(scene::Chapter& chapter) {
  const auto& run = chapter.add_run<std::vector<Flow>>(
      "scalar-flows",
      "40 nodes, c T = 7.5, from zero; Euler's rule, step 1; the tolerance is 1e-8 of |F| at the start", {},
      [](Workshop& w) { return compute(w.quick()); });
  chapter.add({.name = "scalar-homotopy",
               .title = "Eqs 2.15 and 2.16 as solvers of the collocation equations: how slowly they go",
               .place = "our own",
               .needs = {&run},
               .show = [&run](Workshop& w) {
                 const auto& all = w.result(run);
                 return scene::Showing{draw(all), tabulate(all), promises(all, w.quick())};
               }});
}

}  // namespace nlmech::chapters
