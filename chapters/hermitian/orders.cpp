#include <fmt/format.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "chapters/hermitian/peaks.hpp"
#include "chapters/hermitian/scenes.hpp"
#include "nlmech/problems/reference_trajectory.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::chapters {
namespace {

using scene::Workshop;

constexpr double end = 10;
constexpr std::array<double, 8> steps = {0.4, 0.2, 0.1, 0.05, 0.025, 0.0125, 0.00625, 0.003125};

/// Errors of one row of Table 1 on one problem.
struct Errors {
  std::string problem, row;
  std::array<double, steps.size()> error;  ///< greatest of position and velocity at t = 10

  /// Between two neighbouring steps, from number i on.
  [[nodiscard]] double order(std::size_t i) const { return std::log2(error.at(i) / error.at(i + 1)); }
};

template <class Problem>
void measure(std::vector<Errors>& all, const Problem& problem, const ivp::State<2>& x0) {
  const problems::ReferenceTrajectory<long double, Problem> reference(problem, x0.cast<long double>().eval(),
                                                                      0, end);
  if (!reference.status().ok()) throw Failure(reference.status());
  const ivp::State<2> truth = reference(end).template cast<double>();
  const ivp::System<2> system(problem);
  for (const ivp::HermitianPair& pair : ivp::hermitian_table) {
    Errors e{std::string(Problem::name), std::string(pair.name), {}};
    for (std::size_t i = 0; i < steps.size(); ++i) {
      const auto run =
          ivp::integrate(system, x0, 0, end, ivp::Hermitian{.operators = pair, .step = steps.at(i)});
      if (!run.status.ok()) throw Failure(run.status);
      e.error.at(i) = (run.x - truth).cwiseAbs().maxCoeff();
    }
    all.push_back(e);
  }
}

std::vector<Errors> all_errors() {
  std::vector<Errors> all;
  measure(all, laier_duffing(), {0, 0});
  measure(all, laier_van_der_pol(), {2, 0});
  return all;
}

const Errors& of(const std::vector<Errors>& all, const std::string& problem, const std::string& row) {
  for (const Errors& e : all) {
    if (e.problem == problem && e.row == row) return e;
  }
  throw std::out_of_range("no errors of " + row + " on " + problem);
}

scene::Showing show(const std::vector<Errors>& all) {
  scene::Table data({{"problem"}, {"operators"}, {"step"}, {"error"}});
  scene::Table table({{"problem"}, {"operators"}, {"step", 4}, {"error", 3}, {"order", 3}});
  for (const Errors& e : all) {
    for (std::size_t i = 0; i < steps.size(); ++i) {
      data.add({e.problem, e.row, steps.at(i), e.error.at(i)});
      table.add({e.problem, e.row, steps.at(i), e.error.at(i),
                 i + 1 < steps.size() ? scene::Cell(e.order(i)) : scene::Cell()});
    }
  }
  scene::Showing showing;
  showing.figure = {
      std::move(data), "hermitian-orders", {{"heading", "Orders 4, 4 and 2"}, {"width", "900"}}};
  showing.table = std::move(table);
  for (const std::string problem : {"driven-duffing", "van-der-pol"}) {
    for (const std::string row : {"laier", "argyris", "newmark"}) {
      showing.quantities.push_back(scene::near(fmt::format("order of {}, {}", row, problem), "1",
                                               of(all, problem, row).order(3), row == "newmark" ? 2 : 4, 0.03,
                                               "Taylor's expansion; step 0.05 against 0.025"));
    }
    const Errors& newmark = of(all, problem, "newmark");
    double different = 0;
    for (const std::string row : {"hoff", "bazzi"}) {
      for (std::size_t i = 0; i < steps.size(); ++i)
        different = std::max(different, std::abs(of(all, problem, row).error.at(i) - newmark.error.at(i)));
    }
    showing.quantities.push_back(scene::at_most("difference of Newmark, Hoff and Bazzi, " + problem, "1",
                                                different, 0, "one method, to the last digit"));
    showing.quantities.push_back(
        {"error of Argyris over that of Laier, " + problem, "1",
         of(all, problem, "argyris").error.at(4) / of(all, problem, "laier").error.at(4), 0.3, 2.5,
         "recorded: 0.48 for a Duffing oscillator, 1.2 for one of van der Pol; it varies with "
         "the end"});
  }
  return showing;
}

}  // namespace

void add_orders(scene::Chapter& chapter) {
  const auto& run = chapter.add_run<std::vector<Errors>>(
      "errors", "Duffing (11) from rest, van der Pol with 1.5 from (2, 0); error at t = 10", {},
      [](Workshop&) { return all_errors(); });
  chapter.add({.name = "orders",
               .title = "Error against the step for the five pairs of operators",
               .place = "our own",
               .needs = {&run},
               .show = [&run](Workshop& w) { return show(w.result(run)); }});
}

}  // namespace nlmech::chapters
