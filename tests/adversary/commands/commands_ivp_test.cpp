/// Random runs of `integrate` for all problems that are not stiff, by all methods, tolerances, begins, ends
/// and rows: what is printed with exit code 0 is held to two methods that have no part in its verification,
/// at tolerances of 1e-13.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "nlmech/comparison/any_method.hpp"
#include "tests/adversary/commands/ivp_oracle.hpp"

namespace nlmech::adversary::commands_ivp_test {
namespace {

/// The condition is known by finite differences, here and in the command. Of more than 48 rows the command
/// looks at some: the others may be off by as much again.
constexpr double slack = 1.1, slack_between = 2;
constexpr std::size_t most_verified = 48;

/// A run by a tolerance, and the rows that it should print.
struct Asked {
  Question question;
  std::string words;
  Journey rows;  // without the first
  Tolerances tolerances;
};

/// The words of a method that chooses its steps, and of what it takes.
std::string any_chosen(Draw& draw, const Question& question) {
  const auto method = comparison::any_method(any_method(draw, question, false));
  std::string words = fmt::format(" --method {}", method.name);
  if (method.has(ivp::nodes_setting) && draw.chance(0.3))
    words += fmt::format(" --nodes {}", draw.whole(3, 24));
  if (method.has(ivp::shape_setting) && draw.chance(0.3))
    words += fmt::format(" --shape {:.17g}", draw.log_uniform(0.1, 10));
  if (method.has(ivp::order_setting) && draw.chance(0.3))
    words += fmt::format(" --order {}", draw.whole(6, 40));
  return words;
}

/// t0, t0 + DT, ...: the times between begin and end.
std::vector<double> inner_times(double t0, double t1, double every) {
  std::vector<double> times;
  const double sign = t1 > t0 ? 1 : -1;
  for (int k = 1; std::abs(t1 - t0) - k * every > 1e-9 * every; ++k) times.push_back(t0 + sign * k * every);
  return times;
}

/// @param rows more than the first and the last
Asked ask(Draw& draw, bool rows) {
  Asked a{any_question(draw), {}, {}, {}};
  a.tolerances.relative = a.tolerances.absolute = draw.log_uniform(1e-10, 1e-3);
  const double way = draw.log_uniform(1e-4, 1) * a.question.longest * (rows && draw.chance(0.3) ? -1 : 1);
  if (rows && draw.chance(0.3)) a.rows.t0 = draw.uniform(-10, 10);
  const double t1 = a.rows.t0 + way;
  a.words = fmt::format("integrators integrate {} --from {:.17g} --until {:.17g} --tolerance {:.17g}{}",
                        a.question.words, a.rows.t0, t1, a.tolerances.relative, any_chosen(draw, a.question));
  if (rows && draw.chance(0.2)) {
    a.tolerances.absolute *= draw.log_uniform(1e-3, 1);
    a.words += fmt::format(" --absolute-tolerance {:.17g}", a.tolerances.absolute);
  }
  if (rows) {
    // More than 48, of which not all are verified, in one case of five.
    const double every = std::abs(way) / (draw.chance(0.2) ? draw.uniform(48, 200) : draw.uniform(0.5, 48));
    a.words += fmt::format(" --every {:.17g}", every);
    a.rows.times = inner_times(a.rows.t0, t1, every);
  }
  a.rows.times.push_back(t1);
  return a;
}

/// What is wrong with the times of the rows.
std::string untimely(const Ran& r, const Journey& way) {
  if (r.rows.size() != way.times.size() + 1) return fmt::format("{} rows", r.rows.size());
  for (std::size_t k = 0; k < way.times.size(); ++k) {
    // Rounding of k DT and of the sum.
    const double near =
        4 * std::numeric_limits<double>::epsilon() * (std::abs(way.t0) + std::abs(way.times[k]));
    if (!(std::abs(number(r.rows[k + 1][0]) - way.times[k]) <= near)) return "a row at " + r.rows[k + 1][0];
  }
  return "";
}

Eigen::MatrixXd printed_states(const Ran& r) {
  Eigen::MatrixXd x(static_cast<Eigen::Index>(r.header.size()) - 1,
                    static_cast<Eigen::Index>(r.rows.size()) - 1);
  for (Eigen::Index k = 0; k < x.cols(); ++k) {
    for (Eigen::Index i = 0; i < x.rows(); ++i)
      x(i, k) = number(r.rows[static_cast<std::size_t>(k) + 1].at(static_cast<std::size_t>(i) + 1));
  }
  return x;
}

/// The same with 32 equal parts of the way, at which the condition is sampled: the command has half of them.
Journey with_parts(const Journey& way, std::vector<Eigen::Index>& columns) {
  Journey all = way;
  const double t1 = way.times.back(), part = (t1 - way.t0) / 32;
  for (int k = 1; k < 32; ++k) all.times.push_back(way.t0 + k * part);
  const double sign = t1 > way.t0 ? 1 : -1;
  std::sort(all.times.begin(), all.times.end(), [sign](double a, double b) { return sign * a < sign * b; });
  all.times.erase(std::unique(all.times.begin(), all.times.end()), all.times.end());
  for (const double t : way.times)
    columns.push_back(std::find(all.times.begin(), all.times.end(), t) - all.times.begin());
  return all;
}

Case judge(const Asked& a, const Ran& r) {
  std::vector<Eigen::Index> columns;
  const Journey all = with_parts(a.rows, columns);
  const std::optional<Known> known = a.question.known(all);
  if (!known) return Case::undecided(r.words);
  const Eigen::MatrixXd x = printed_states(r);
  Eigen::MatrixXd error(x.rows(), x.cols()), allowed = error, doubt = error;
  for (Eigen::Index k = 0; k < x.cols(); ++k) {
    const Eigen::VectorXd truth = known->x.col(columns[static_cast<std::size_t>(k)]);
    error.col(k) = (x.col(k) - truth).cwiseAbs();
    doubt.col(k) = known->doubt.col(columns[static_cast<std::size_t>(k)]);
    allowed.col(k) = most_tolerances * one_tolerance(truth, known->size, a.tolerances);
  }
  if (!(error.array() <= allowed.array()).all()) {
    const auto moved = a.question.moved(all, *known, a.tolerances);
    if (!moved) return Case::undecided(r.words);
    for (Eigen::Index k = 0; k < x.cols(); ++k)
      allowed.col(k) =
          allowed.col(k).cwiseMax(most_amplified * moved->col(columns[static_cast<std::size_t>(k)]));
  }
  if ((doubt.array() > 0.1 * allowed.array()).any()) return Case::undecided(r.words);
  Eigen::Index i = 0, k = 0;
  const double ratio = (error.array() / allowed.array()).maxCoeff(&i, &k);
  return Case::judged(ratio, a.rows.times.size() > most_verified ? slack_between : slack,
                      fmt::format("{}: component {} at t = {:.9g} is {:.9g}, right {:.9g}", r.words, i + 1,
                                  a.rows.times[static_cast<std::size_t>(k)], x(i, k),
                                  known->x(i, columns[static_cast<std::size_t>(k)])));
}

Case trial(Draw& draw, bool rows) {
  const Asked a = ask(draw, rows);
  const Ran r = ran(a.words);
  if (const auto failure = failed(r)) return *failure;
  if (const std::string what = untimely(r, a.rows); !what.empty()) return Case::wrong(r.words + ": " + what);
  if (!printed_states(r).allFinite()) return Case::wrong(r.words + ": no number");
  if (r.errors.find("not verified") != std::string::npos) return Case::undecided(r.words);
  return judge(a, r);
}

TEST(AdversaryCommands, IntegratePrintsWhatIsRight) {
  if (const std::string what = missing_oracles(); !what.empty()) GTEST_SKIP() << what;
  hunt({.quick = 8, .full = 3'000}, [](Draw& draw) { return trial(draw, false); });
}

TEST(AdversaryCommands, EveryRowIsRight) {
  if (const std::string what = missing_oracles(); !what.empty()) GTEST_SKIP() << what;
  hunt({.quick = 12, .full = 3'000}, [](Draw& draw) { return trial(draw, true); });
}

}  // namespace
}  // namespace nlmech::adversary::commands_ivp_test
