/// @file
/// Computes the references of the problem set of chapter integrators: states at the times at which errors are
/// measured, in extended precision, each by two computations of different orders, and the condition numbers
/// of the problems.
///
///     problem_set_references tables/reference              all problems: some minutes
///     problem_set_references tables/reference lorenz       this one, in files of its own name, to look at

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <exception>
#include <fstream>
#include <set>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "chapters/integrators/problem_list.hpp"
#include "nlmech/ivp/system.hpp"
#include "nlmech/problems/reference_trajectory.hpp"
#include "nlmech/support/extended_real.hpp"
#include "tools/references/condition.hpp"
#include "tools/references/radau.hpp"

namespace {

using namespace nlmech;
using namespace nlmech::chapters::integrators;
using problems::TextProblem;
using references::Link;
using Real = ExtendedReal<60>;
using State = Vector<Real, Eigen::Dynamic>;
using TaylorStep = problems::TaylorStep<Real, Eigen::Dynamic>;

constexpr int fewest_digits = 18, most_digits = 34;

/// A problem, solved twice.
struct Solved {
  std::string how;                        ///< the two computations
  std::vector<std::vector<Real>> first;   ///< states at the judged times
  std::vector<std::vector<Real>> second;  ///< the same, by the more accurate one
  std::vector<Link> links;                ///< of one of them; none: no condition
};

std::vector<std::vector<Real>> lists(const std::vector<State>& states) {
  std::vector<std::vector<Real>> all;
  for (const State& x : states) all.emplace_back(x.data(), x.data() + x.size());
  return all;
}

/// Adds the derivatives of the ends of the parts of a Taylor step with respect to their starts. In a part the
/// fastest motion rotates or decays by at most four, for which eight Radau nodes have an error of 1e-6. The
/// condition number uses their products: a quotient of two fundamental matrices has no correct digit for a
/// stiff or chaotic problem.
void add_links(const TaylorStep& step, const TextProblem& problem, std::vector<Link>& links) {
  static const references::RadauRule<double> rule(8);
  const ivp::System system(problem);
  const auto start = static_cast<double>(step.start), length = static_cast<double>(step.length);
  const auto jacobian = [&](double from_start) {
    const ivp::State x = step.at(Real(from_start)).template cast<double>();
    ivp::Jacobian j(x.size(), x.size());
    system.jacobian(start + from_start, x, j);
    return Eigen::MatrixXd(j);
  };
  const double fastest = jacobian(length / 2).eigenvalues().cwiseAbs().maxCoeff();
  const int parts = std::max(1, static_cast<int>(std::ceil(length * fastest / 4)));
  const double h = length / parts;
  for (int part = 0; part < parts; ++part) {
    std::vector<Eigen::MatrixXd> jacobians;
    for (const double c : rule.c) jacobians.push_back(jacobian((part + c) * h));
    const double end =
        part + 1 == parts ? static_cast<double>(Real(step.start + step.length)) : start + (part + 1) * h;
    links.push_back({end, step.at(Real(part * h)).template cast<double>(),
                     references::step_derivative(rule.a, h, jacobians)});
  }
}

/// States at each of @p times; a step ends at each of them.
template <class Visit>
auto taylor_states(const TextProblem& problem, const std::vector<Real>& times, int order, double tolerance,
                   Visit&& visit) {
  State x = problem.initial_state().cast<Real>();
  Real t = problem.initial_time;
  std::vector<State> states;
  for (const Real& next : times) {
    const auto look = [&](const TaylorStep& step, const State& after) {
      visit(step);
      x = after;
    };
    const Status status = problems::integrate_reference(
        problem, State(x), t, next, {.order = order, .tolerance = tolerance, .most_steps = 100'000'000},
        look);
    if (!status.ok()) throw std::runtime_error(status.text());
    states.push_back(x);
    t = next;
  }
  return states;
}

Solved by_taylor(const TextProblem& problem, const std::vector<Real>& times) {
  Solved solved{"Taylor series of orders 40 and 50, errors of a step 1e-48 and 1e-52", {}, {}, {}};
  solved.first = lists(taylor_states(
      problem, times, 40, 1e-48, [&](const TaylorStep& step) { add_links(step, problem, solved.links); }));
  solved.second = lists(taylor_states(problem, times, 50, 1e-52, [](const auto&) {}));
  return solved;
}

Solved by_radau(const TextProblem& problem, const std::vector<Real>& times) {
  const Real t0 = problem.initial_time;
  const State x0 = problem.initial_state().cast<Real>();
  const double first_step = 1e-12 * static_cast<double>(Real(times.back() - t0));
  Solved solved{
      "Radau collocation of orders 21 and 29, last coefficients of a step 1e-19 and 1e-23", {}, {}, {}};
  solved.first = lists(references::radau_states<Real>(
      problem, t0, x0, times, 11, 1e-19, first_step, [&](const references::RadauStep<Real>& step) {
        solved.links.push_back({static_cast<double>(step.end), step.start, step.derivative});
      }));
  solved.second = lists(
      references::radau_states<Real>(problem, t0, x0, times, 15, 1e-23, first_step, [](const auto&) {}));
  return solved;
}

/// Closed form: each half swing starts at rest, on the other side than the one before and closer by twice the
/// force, about a centre that friction shifts.
template <class T>
std::vector<T> friction_at(const T& t) {
  const T pi = acos(T(-1));
  const int swing = static_cast<int>(static_cast<double>(T(t / pi)));
  const T amplitude = Friction::position - (2 * swing + 1) * Friction::force, angle = t - swing * pi;
  const int side = swing % 2 == 0 ? 1 : -1;
  return {side * (amplitude * cos(angle) + Friction::force), -side * amplitude * sin(angle)};
}

/// Quarters of half swings and the parts between the times of measurement. At a turning point the magnitude
/// of the acceleration decreases from x + f to x - f, and with it the effect on a velocity there.
std::vector<Link> friction_links(const std::vector<Real>& times) {
  constexpr double pi = 3.14159265358979323846;
  std::set<double> stops;
  for (const Real& t : times) stops.insert(static_cast<double>(t));
  for (int quarter = 1; quarter * pi / 4 < Friction::end; ++quarter) stops.insert(quarter * pi / 4);
  std::vector<Link> links;
  double start = 0;
  for (const double end : stops) {
    const std::vector<Real> x = friction_at(Real(start));
    const double angle = end - start;
    Eigen::MatrixXd turned(2, 2);
    turned << std::cos(angle), std::sin(angle), -std::sin(angle), std::cos(angle);
    const double swings = end / pi;
    if (std::abs(swings - std::round(swings)) < 1e-9) {
      const double far = Friction::position - 2 * std::round(swings) * Friction::force;
      turned.row(1) *= (far - Friction::force) / (far + Friction::force);
    }
    links.push_back({end, Eigen::Vector2d(static_cast<double>(x[0]), static_cast<double>(x[1])), turned});
    start = end;
  }
  return links;
}

Solved friction(const std::vector<Real>& times) {
  Solved solved{"closed form, in 60 and in 80 digits", {}, {}, friction_links(times)};
  for (const Real& t : times) {
    solved.first.push_back(friction_at(t));
    solved.second.emplace_back();
    for (const ExtendedReal<80>& x : friction_at(ExtendedReal<80>(t))) solved.second.back().emplace_back(x);
  }
  return solved;
}

/// Decimal digits on which two states agree, each component relative to its scale.
int agreed_digits(const Solved& solved, const references::Scales& scales) {
  double worst = 0;
  for (std::size_t k = 0; k < solved.first.size(); ++k) {
    for (std::size_t i = 0; i < solved.first[k].size(); ++i) {
      const Real difference = abs(solved.first[k][i] - solved.second[k][i]);
      const double scale = scales.of(static_cast<Eigen::Index>(i), static_cast<double>(solved.second[k][i]));
      worst = std::max(worst, static_cast<double>(difference) / scale);
    }
  }
  return worst > 0 ? std::min(most_digits, static_cast<int>(-std::log10(worst))) : most_digits;
}

/// The two tables.
struct Tables {
  std::ofstream states, conditions;
};

void write(Tables& tables, std::string_view name, const std::vector<double>& times, const Solved& solved,
           double absolute) {
  std::vector<Eigen::VectorXd> judged;
  for (const auto& x : solved.second) {
    judged.emplace_back(static_cast<Eigen::Index>(x.size()));
    for (std::size_t i = 0; i < x.size(); ++i)
      judged.back()[static_cast<Eigen::Index>(i)] = static_cast<double>(x[i]);
  }
  const references::Scales scales = references::scales_of(judged, absolute);
  const int digits = agreed_digits(solved, scales);
  if (digits < fewest_digits)
    throw std::runtime_error(fmt::format("{}: the computations agree on {} digits only", name, digits));
  for (std::size_t k = 0; k < times.size(); ++k) {
    for (std::size_t i = 0; i < solved.second[k].size(); ++i) {
      tables.states << fmt::format("{},{:.17g},{},{}\n", name, times[k], i + 1,
                                   solved.second[k][i].str(digits, std::ios_base::scientific));
    }
  }
  const auto of = [&](double a) {
    return fmt::format("{:.3g}", references::condition(solved.links, times, judged, scales, a));
  };
  std::string flagged;
  for (const double scale : scales.flagged)
    flagged += fmt::format("{}{:.3g}", flagged.empty() ? "" : " ", scale);
  tables.conditions << fmt::format("{},{},{},{},{},\"{}\",{}\n", name, digits, of(0), of(absolute), absolute,
                                   solved.how, flagged);
}

void make(const std::string& folder, const std::string& only) {
  const std::string stem = folder + "/problem_set" + (only.empty() ? "" : "_" + only);
  Tables tables{std::ofstream(stem + ".csv"), std::ofstream(stem + "_conditions.csv")};
  if (!tables.states || !tables.conditions) throw std::runtime_error("cannot write in " + folder);
  tables.states << "problem,t,component,value\n";
  tables.conditions << "problem,digits,condition,condition of tolerances,absolute over relative,how,scales\n";
  const auto solve = [&](std::string_view name, double t0, double end, double absolute,
                         const auto& solved_at) {
    if (!only.empty() && name != only) return;
    const auto start = std::chrono::steady_clock::now();
    std::vector<double> times;
    std::vector<Real> exact;
    for (int k = 0; k < judged_times; ++k) {
      times.push_back(judged_time(t0, end, k));
      exact.emplace_back(times.back());
    }
    write(tables, name, times, solved_at(exact), absolute);
    tables.states.flush();
    tables.conditions.flush();
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    (void)std::fprintf(stderr, "%s: %.1f s\n", std::string(name).c_str(), seconds.count());
  };
  for (const Case& c : all_cases()) {
    if (c.by == By::nothing) continue;
    solve(c.name, c.problem.initial_time, c.end, c.absolute, [&](const std::vector<Real>& times) {
      return c.by == By::taylor ? by_taylor(c.problem, times) : by_radau(c.problem, times);
    });
  }
  solve(Friction::name, 0, Friction::end, 1, friction);
}

}  // namespace

int main(int count, char** arguments) {
  if (count < 2 || count > 3) {
    (void)std::fprintf(stderr, "usage: problem_set_references FOLDER [PROBLEM]\n");
    return 2;
  }
  try {
    make(arguments[1], count == 3 ? arguments[2] : "");
  } catch (const std::exception& failed) {
    (void)std::fprintf(stderr, "problem_set_references: %s\n", failed.what());
    return 1;
  }
  return 0;
}
