#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "chapters/hermitian/peaks.hpp"
#include "nlmech/problems/reference_trajectory.hpp"
#include "nlmech/problems/texts.hpp"
#include "nlmech/scene/scene.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::chapters::hermitian::orders {
namespace {

constexpr double end = 10;
constexpr std::array<double, 8> steps = {0.4, 0.2, 0.1, 0.05, 0.025, 0.0125, 0.00625, 0.003125};

/// The error of a row of Table 1 on a problem.
struct Error {
  std::string problem, row;
  double step, error;           ///< greatest of position and velocity at t = 10
  std::optional<double> order;  ///< between this step and its half
};

void measure(std::vector<Error>& all, const std::string& name, const problems::TextProblem& problem,
             const ivp::State& x0) {
  const problems::ReferenceTrajectory<long double, problems::TextProblem> reference(
      problem, x0.cast<long double>().eval(), 0, end);
  if (!reference.status().ok()) throw Failure(reference.status());
  const ivp::State truth = reference(end).cast<double>();
  const ivp::System system(problem);
  for (const ivp::HermitianPair& pair : ivp::hermitian_table) {
    for (const double step : steps) {
      const auto run = ivp::integrate(system, x0, 0, end, ivp::Hermitian{.operators = pair, .step = step});
      if (!run.status.ok()) throw Failure(run.status);
      const double error = (run.x - truth).cwiseAbs().maxCoeff();
      if (step < steps[0]) all.back().order = std::log2(all.back().error / error);
      all.push_back({name, std::string(pair.name), step, error, {}});
    }
  }
}

std::vector<Error> all_errors() {
  std::vector<Error> all;
  measure(all, "driven-duffing", problems::TextProblem("laier-duffing"), {0, 0});
  measure(all, "van-der-pol", problems::TextProblem("laier-van-der-pol"), {2, 0});
  return all;
}

const Error& of(const std::vector<Error>& all, const std::string& problem, const std::string& row,
                double step) {
  for (const Error& e : all) {
    if (e.problem == problem && e.row == row && e.step == step) return e;
  }
  throw std::out_of_range("no error of " + row + " on " + problem);
}

/// How a pair of operators is drawn.
struct Curve {
  const char *row, *name;
  int style;
  double size;  ///< of its points
};
constexpr std::array curves = {Curve{"laier", "Laier", 1, 0.8}, Curve{"newmark", "Newmark", 3, 1.3},
                               Curve{"hoff", "Hoff", 4, 0.9}, Curve{"bazzi", "Bazzi", 6, 0.5},
                               Curve{"argyris", "Argyris", 5, 0.8}};

void draw(const std::vector<Error>& all, scene::Show& show) {
  scene::Plot& plot = show.plots("Laier and Argyris are of order 4, the others of order 2").size(900, 520);
  plot.data(scene::table_of(all, {{"problem", &Error::problem},
                                  {"operators", &Error::row},
                                  {"step", &Error::step},
                                  {"error", &Error::error}}));
  for (const auto& [problem, caption] : {std::pair{"driven-duffing", "Duffing (11) from rest"},
                                         std::pair{"van-der-pol", "van der Pol, 1.5, from (2, 0)"}}) {
    scene::Panel& panel = plot.panel("step (s)", "error at t = 10").caption(caption);
    panel.log_x(0.0025, 0.5).set("xtics (0.003, 0.01, 0.03, 0.1, 0.3)").set("format x '%g'");
    panel.log_y(1e-14, 1).key("at graph 0.97, graph 0.04 right bottom Left reverse");
    for (const Curve& c : curves)
      panel.columns(c.name,
                    fmt::format("step:(strcol('problem') eq '{}' && strcol('operators') eq '{}' ? "
                                "column('error') : NaN)",
                                problem, c.row),
                    {fmt::format("linespoints pointsize {}", c.size), c.style});
  }
}

void put(const std::vector<Error>& all, scene::Show& show) {
  draw(all, show);
  show.table(all, {{"problem", &Error::problem},
                   {"operators", &Error::row},
                   {"step", &Error::step, 4},
                   {"error", &Error::error},
                   {"order", &Error::order}});
  for (const std::string problem : {"driven-duffing", "van-der-pol"}) {
    for (const std::string row : {"laier", "argyris", "newmark"})
      show.near(fmt::format("order of {}, {}", row, problem), *of(all, problem, row, 0.05).order,
                row == "newmark" ? 2 : 4, 0.03, "Taylor's expansion; step 0.05 against 0.025");
    double different = 0;
    for (const double step : steps) {
      const double newmark = of(all, problem, "newmark", step).error;
      for (const std::string row : {"hoff", "bazzi"})
        different = std::max(different, std::abs(of(all, problem, row, step).error - newmark));
    }
    show.at_most("difference of Newmark, Hoff and Bazzi, " + problem, different, 0,
                 "one method, to the last digit");
    show.between("error of Argyris over that of Laier, " + problem,
                 of(all, problem, "argyris", 0.025).error / of(all, problem, "laier", 0.025).error, 0.3, 2.5,
                 "recorded: 0.48 for a Duffing oscillator, 1.2 for one of van der Pol; it varies with "
                 "the end");
  }
}

}  // namespace

std::vector<scene::Scene> scenes() {
  const scene::Result result(
      "errors", "Duffing (11) from rest, van der Pol with 1.5 from (2, 0); error at t = 10", all_errors);
  return {{.name = "orders",
           .title = "Error against the step for the five pairs of operators",
           .content = scene::Content(put, result)}};
}

}  // namespace nlmech::chapters::hermitian::orders
