#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "chapters/rbf_inverse/scenes.hpp"

namespace nlmech::chapters {
namespace {

using bvp::DuffingCase;
using scene::Workshop;

/// What the text prints for a case in Table 5.1.
struct PrintedConditions {
  DuffingCase which;
  const char *prescribed, *complementary, *remark;
};

const std::vector<PrintedConditions>& printed_conditions() {
  static const std::vector<PrintedConditions> all = {
      {DuffingCase::final_only, "x(tF)", "lambda(t0) = 0",
       "for a free start and a cost that does not depend on it; never solved in the text"},
      {DuffingCase::x1x1, "x1(t0), x1(tF)", "-lambda2(t0) = phi_x2, lambda2(tF) = phi_x2", ""},
      {DuffingCase::x1x2, "x1(t0), x2(tF)", "-lambda2(t0) = phi_x2, lambda1(tF) = phi_x1", ""},
      {DuffingCase::x2x1, "x2(t0), x1(tF)", "-lambda1(t0) = phi_x1, lambda2(tF) = phi_x2", ""},
      {DuffingCase::x2x2, "x2(t0), x2(tF)", "-lambda1(t0) = phi_x1, lambda1(tF) = phi_x1",
       "never solved in the text"},
      {DuffingCase::free, "x(t0)", "not in the table", "lambda(tF) = phi_x: Eq. 5.23"},
      {DuffingCase::fixed, "x(t0), x(tF)", "not in the table", "none: Eq. 5.26"}};
  return all;
}

/// Which condition holds for each component at both ends.
std::string conditions_in_words(const bvp::ExtremalProblem& problem) {
  const auto& task = problem.task();
  std::string text;
  for (const bool end : {false, true}) {
    const auto& prescribed = end ? task.end : task.begin;
    for (std::size_t i = 0; i < 2; ++i) {
      if (!text.empty()) text += ", ";
      const char* const time = end ? "tF" : "t0";
      if (prescribed[i]) {
        text += fmt::format("x{}({})", i + 1, time);
      } else {
        text += fmt::format("{}lambda{}({}) = phi_x{}", end ? "" : "-", i + 1, time, i + 1);
      }
    }
  }
  return text;
}

/// Are the library's conditions those that the variation of J gives? Their largest residual at ends that
/// satisfy (phi_x - lambda) dx(tF) + (phi_x + lambda) dx(t0) = 0, worked out here for the cost of Eq. 5.20.
double contradiction(const bvp::ExtremalProblem& problem) {
  const bvp::DuffingSettings s;  // weights and target as used
  double worst = 0;
  for (int trial = 1; trial <= 5; ++trial) {
    Eigen::MatrixXd ends(4, 2);
    for (Eigen::Index k = 0; k < 8; ++k) ends.reshaped()[k] = std::sin(3.7 * trial + 1.9 * double(k)) * 3;
    const auto& task = problem.task();
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

scene::Showing show_conditions(Workshop&) {
  scene::Table table({{"prescribed"},
                      {"complementary, as printed"},
                      {"all four conditions as solved"},
                      {"name"},
                      {"remark"}});
  std::vector<scene::Quantity> quantities;
  for (const PrintedConditions& p : printed_conditions()) {
    const bvp::ExtremalProblem problem = duffing_problem(printed_settings(p.which, 2));
    table.add({std::string(p.prescribed), std::string(p.complementary), conditions_in_words(problem),
               std::string(to_string(p.which)), std::string(p.remark)});
    quantities.push_back(scene::at_most(
        fmt::format("residual of the conditions by Eq. 5.6, {}", to_string(p.which)), "1",
        contradiction(problem), 1e-14, "rounding of numbers up to 10: the variation worked out by hand"));
  }
  return {{}, std::move(table), std::move(quantities)};
}

scene::Showing show_parameters(Workshop&) {
  scene::Table table({{"parameter"}, {"printed"}, {"used"}, {"remark"}});
  const bvp::DuffingSettings s;
  table.add({"natural frequency", "1 rad/s", fmt::format("{:g} rad/s", s.frequency), ""});
  table.add(
      {"nonlinearity beta", ">= 0.9", "0.9; 0.94 for x1x1 and x1x2; 0.97 for x2x1", "stated in the text"});
  table.add({"initial conditions", "[0 0]", "0, 0 where prescribed", ""});
  table.add({"final conditions", "[5 2]", "5, 2 where prescribed, and in the cost elsewhere", ""});
  table.add({"harmonic amplitudes", "1.5, 2, 3", "1.5, 2, 3", ""});
  table.add({"harmonic frequency", "3 rad/s", "3 rad/s", ""});
  table.add({"final time T", "", "2, with 1 and 5 beside",
             "not stated; inferred, from a range that the failure of shooting leaves"});
  table.add({"weights S", "", "I", "not stated; Table 5.3 speaks for it"});
  table.add({"nodes, shape", "N = 40, c = (N - 1)/(4 T)", "the same: c T = 9.75", ""});
  table.add({"initial guess, stopping rule, extremal", "", "zeros, and ten random guesses", "not stated"});
  // Eq. 5.34 by hand: cos 6, cos 18, cos 2 and the sines.
  const Eigen::Vector2d target = duffing_target(printed_settings(DuffingCase::harmonic, 2));
  const double x1 = 1.5 * std::cos(6.0) + 2 * std::cos(18.0) + 3 * std::cos(2.0);
  const double x2 = -(4.5 * std::sin(6.0) + 18 * std::sin(18.0) + 3 * std::sin(2.0));
  return {{},
          std::move(table),
          {scene::near("x1F of the harmonic case, T = 2", "1", target[0], x1, 1e-14, "Eq. 5.34 by hand"),
           scene::near("x2F of the harmonic case, T = 2", "1/s", target[1], x2, 1e-14, "Eq. 5.34 by hand")}};
}

/// A printed number of Table 5.3.
struct PrintedError {
  int condition;  ///< 0, 1: at t0; 2, 3: at tF
  double value;
};
std::vector<PrintedError> printed_errors(DuffingCase which) {
  switch (which) {
    case DuffingCase::free: return {{0, 1e-22}, {1, 1.2e-22}, {2, 0}, {3, 2.2e-16}};
    case DuffingCase::fixed: return {{0, 9.9e-18}, {2, 1.9e-17}};
    case DuffingCase::x1x1: return {{0, 3.8e-17}, {1, 6.8e-19}, {2, 0}, {3, 1.1e-16}};
    case DuffingCase::x1x2: return {{0, 6e-19}, {1, 1.4e-19}, {2, 0}, {3, 0}};
    case DuffingCase::x2x1: return {{0, 3.2e-17}, {1, 3e-17}, {2, 0}, {3, 2.2e-16}};
    default: return {{0, 4.3e-19}, {1, 1.4e-18}, {2, 0}, {3, 0}};
  }
}

std::string name_of(const DuffingSubject& subject, int condition) {
  return fmt::format("elgohary/table-5.3/{}/error at {} (x{})", subject.row, condition < 2 ? "t0" : "tF",
                     condition % 2 + 1);
}

/// |residual|, NaN if Newton's iteration had none.
double residual_of(const bvp::GlobalResult& r, int condition) {
  return r.conditions.size() == 4 ? std::abs(r.conditions[condition])
                                  : std::numeric_limits<double>::quiet_NaN();
}

/// The condition as it is solved, from the case alone: "x1" or "lambda1".
std::string condition_name(const DuffingSubject& subject, int condition) {
  const bvp::ExtremalProblem problem = duffing_problem(printed_settings(subject.which, 2));
  const auto i = static_cast<std::size_t>(condition % 2);
  const bool prescribed = (condition < 2 ? problem.task().begin : problem.task().end)[i].has_value();
  return fmt::format("{}{}({})", prescribed ? "x" : "lambda", i + 1, condition < 2 ? "t0" : "tF");
}

/// The largest residual at the prescribed conditions, of all extremals at all final times: what Table 5.3
/// shows of one root depends neither on T nor on the guess.
double largest_residual(const DuffingRuns& runs, Workshop& w) {
  double worst = 0;
  for (const DuffingSubject& subject : duffing_subjects())
    for (std::size_t time = 0; time < final_times.size(); ++time)
      for (const bvp::GlobalResult& r : w.result(run_of(runs.printed, subject.which, time)))
        for (const PrintedError& p : printed_errors(subject.which))
          if (r.extremal.solution.status.ok()) worst = std::max(worst, residual_of(r, p.condition));
  return worst;
}

/// The root that is drawn, of one final time; null if no guess leads to an extremal.
const bvp::GlobalResult* drawn_or_null(const DuffingRuns& runs, Workshop& w, DuffingCase which,
                                       std::size_t time) {
  for (const bvp::GlobalResult& r : w.result(run_of(runs.printed, which, time)))
    if (r.extremal.solution.status.ok()) return &r;
  return nullptr;
}

scene::Showing show_errors(const DuffingRuns& runs, Workshop& w) {
  scene::Table table({{"case"},
                      {"condition"},
                      {"printed", 2},
                      {"T = 2", 2},
                      {"T = 1", 2},
                      {"T = 5", 2},
                      {"largest co-state error, T = 2", 2}});
  double worst_begin = 0, worst_end = 0, least_error = HUGE_VAL;
  for (std::size_t i = 0; i < duffing_subjects().size(); ++i) {
    const DuffingSubject& subject = duffing_subjects()[i];
    const auto result = [&](std::size_t time) { return drawn_or_null(runs, w, subject.which, time); };
    const bvp::GlobalResult* const drawn = result(inferred);
    const double error = drawn == nullptr ? std::nan("") : node_errors(*drawn).costates;
    least_error = std::min(least_error, error);
    const auto cell = [&](std::size_t time, int condition) {
      return result(time) == nullptr ? scene::Cell() : scene::Cell(residual_of(*result(time), condition));
    };
    for (const PrintedError& p : printed_errors(subject.which)) {
      table.add({subject.row, condition_name(subject, p.condition), p.value, cell(inferred, p.condition),
                 cell(0, p.condition), cell(2, p.condition), error});
      double& worst = p.condition < 2 ? worst_begin : worst_end;
      if (drawn != nullptr) worst = std::max(worst, residual_of(*drawn, p.condition));
    }
  }
  return {{},
          std::move(table),
          {scene::at_most("largest residual at t0, T = 2", "1", worst_begin, 1e-15,
                          "rounding of linear conditions solved as rows of a linear system"),
           scene::at_most("largest residual at tF, T = 2", "1", worst_end, 2e-15,
                          "one rounding of a target below 16"),
           scene::at_most("largest residual at either end, any T and guess", "1", largest_residual(runs, w),
                          1e-14, "some roundings of targets and co-states below 16"),
           {"least co-state error of the same solutions, T = 2", "1", least_error, 1e-7, 1,
            "recorded: 2e-6 and more"}}};
}

/// The text has one number for all; the best of ours, over cases, final times and guesses, is the kindest
/// comparison. A wider shape beside it.
scene::Measured least_differences(const DuffingRuns& runs, Workshop& w) {
  double least = HUGE_VAL, wider = HUGE_VAL;
  const auto worst_of = [](const bvp::GlobalResult& r) {
    const NodeErrors e = node_errors(r);
    return r.extremal.solution.status.ok() ? std::max(e.states, e.costates) : HUGE_VAL;
  };
  for (const DuffingSubject& subject : duffing_subjects()) {
    for (std::size_t time = 0; time < final_times.size(); ++time)
      for (const bvp::GlobalResult& r : w.result(run_of(runs.printed, subject.which, time)))
        least = std::min(least, worst_of(r));
    wider = std::min(wider, worst_of(w.result(*runs.variants[static_cast<std::size_t>(subject.which)])[1]));
  }
  return {least, wider};
}

}  // namespace

void add_end_conditions(scene::Chapter& chapter) {
  chapter.add({.name = "table-5.1",
               .title = "End conditions of the co-states for each set of prescribed states",
               .place = "Table 5.1",
               .needs = {},
               .show = show_conditions});
}

void add_duffing_parameters(scene::Chapter& chapter) {
  chapter.add({.name = "table-5.2",
               .title = "Constants of the Duffing control problem, and what the text leaves out",
               .place = "Table 5.2",
               .needs = {},
               .show = show_parameters});
}

void add_boundary_errors(scene::Chapter& chapter, const DuffingRuns& runs) {
  for (std::size_t i = 0; i < duffing_subjects().size(); ++i) {
    const DuffingSubject& subject = duffing_subjects()[i];
    for (const PrintedError& p : printed_errors(subject.which)) {
      const int condition = p.condition;
      const auto& run = run_of(runs.printed, subject.which);
      // T is not stated. That x1(T) - 5 is a multiple of a unit in the last place of 5 needs no T.
      const bool any_time = subject.which == DuffingCase::fixed && condition == 2;
      const auto measure = [&run, condition, any_time](Workshop& w) {
        const FromGuesses& all = w.result(run);
        const double residual = residual_of(all[drawn_of(all)], condition);
        return any_time ? scene::Measured{residual, {}} : scene::Measured{{}, residual};
      };
      chapter.add(scene::Measurement{name_of(subject, condition), {&run}, measure});
    }
  }
  std::vector<const scene::AnyRun*> needs;
  for (const auto& at_time : runs.printed)
    for (const DuffingSubject& subject : duffing_subjects())
      needs.push_back(at_time[static_cast<std::size_t>(subject.which)]);
  std::vector<const scene::AnyRun*> all = needs;
  for (const DuffingSubject& subject : duffing_subjects())
    all.push_back(runs.variants[static_cast<std::size_t>(subject.which)]);
  chapter.add(scene::Measurement{"elgohary/claim-5.3.5/all cases/difference to ODE45 at the nodes", all,
                                 [runs](Workshop& w) { return least_differences(runs, w); }});
  chapter.add({.name = "table-5.3",
               .title = "Residuals of the end conditions: what they measure is the linear solve",
               .place = "Table 5.3",
               .needs = needs,
               .show = [runs](Workshop& w) { return show_errors(runs, w); }});
}

}  // namespace nlmech::chapters
