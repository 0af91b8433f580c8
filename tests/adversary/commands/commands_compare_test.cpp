/// Random comparisons: the digits of each row of `compare` are those of the same run beside two methods that
/// have no part in its reference, and no more than the reference is said to know; a row without digits says
/// why, and one that is off by more than a hundred tolerances says so.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "nlmech/comparison/any_method.hpp"
#include "nlmech/comparison/reference/reference.hpp"
#include "nlmech/ivp/named/named_methods.hpp"
#include "tests/adversary/commands/ivp_oracle.hpp"

namespace nlmech::adversary::commands_compare_test {
namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();
constexpr double most_unsure = 4;  // the doubt of the two oracles is a difference, and not a bound

/// What was asked of all methods.
struct Asked {
  Question question;
  std::string words;
  std::map<std::string, ivp::Settings> methods;  // by name
  double t0 = 0, t1 = 1;
};

Asked ask(Draw& draw) {
  Asked a{any_question(draw), {}, {}};
  ivp::Settings s;
  const double way = draw.log_uniform(1e-4, 0.3) * a.question.longest;
  a.t0 = draw.chance(0.3) ? draw.uniform(-10, 10) : 0;
  a.t1 = a.t0 + way * (draw.chance(0.2) ? -1 : 1);
  std::string how;
  if (draw.chance(0.4)) {
    s.step = way / draw.log_uniform(4, 2000);
    how = fmt::format(" --step {:.17g}", *s.step);
  } else {
    s.tolerance = draw.log_uniform(1e-12, 1e-2);
    how = fmt::format(" --tolerance {:.17g}", *s.tolerance);
  }
  std::string names;
  for (int n = draw.whole(1, 4); n > 0; --n) {
    const std::string name = any_method(draw, a.question, s.step.has_value());
    if (a.methods.emplace(name, s).second) names += (names.empty() ? "" : ",") + name;
  }
  a.words = fmt::format("integrators compare {} --from {:.17g} --until {:.17g}{} --methods {}",
                        a.question.words, a.t0, a.t1, how, names);
  return a;
}

/// How many digits the reference has, by its own words: "... agree to 17.1 digits"; nothing if there is none.
std::optional<double> digits_known(const std::string& errors) {
  const std::string before = " agree to ";
  const std::size_t place = errors.find(before);
  if (place == std::string::npos) return {};
  return number(errors.substr(place + before.size(), errors.find(" digits") - place - before.size()));
}

/// Relative to the component or, below a thousandth of its size, to its size.
double relative(const Eigen::VectorXd& difference, const Eigen::VectorXd& x, const Eigen::VectorXd& size) {
  double worst = 0;
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    const double scale = std::abs(x[i]) >= 1e-3 * size[i] ? std::abs(x[i]) : size[i];
    worst = std::max(worst, std::abs(difference[i]) / (scale > 0 ? scale : 1));
  }
  return worst;
}

/// What is wrong with the form of a row.
std::string malformed(const std::vector<std::string>& row, bool some_digits) {
  if (row.size() != 7) return "cells";
  const bool success = row[2] == "success";
  if (!success && row[6].empty()) return "a failure without a reason";
  if (!success && !row[3].empty()) return "digits of a failure";
  if (success && row[3].empty() == some_digits) return "no digits";
  return "";
}

/// A success says in its note if it is off by more than a hundred of the tolerances that it was given.
bool notes_its_error(const Asked& a, const std::vector<std::string>& row, const Eigen::VectorXd& end,
                     const Known& known) {
  const ivp::Settings& s = a.methods.at(row[0]);
  if (s.step) return true;
  const Eigen::ArrayXd truth = known.x.rightCols(1).array(), one = *s.tolerance * (1 + truth.abs());
  const double most = ((end.array() - truth).abs() / one).maxCoeff();
  const double doubt = (known.doubt.rightCols(1).array() / one).maxCoeff();
  // A tenth for what neither side knows.
  if (most > 110 + doubt) return !row[6].empty();
  return most > 90 - doubt || row[6].empty();
}

/// A row beside the same run: how far its error is from what its digits say, in units of what is not known.
/// @param step relative error at the end that an oracle's error of one step becomes
double ratio_of(const Asked& a, const std::vector<std::string>& row, const Eigen::VectorXd& end,
                double known_digits, const Known& known, double step) {
  const Eigen::VectorXd truth = known.x.rightCols(1);
  const double error = relative(end - truth, truth, known.size);
  // Steps round the time: by the state's rate, from the last of 64 parts of the way.
  const Eigen::VectorXd rate = (truth - known.x.col(known.x.cols() - 2)) *
                               (64 * eps * (std::abs(a.t0) + std::abs(a.t1)) / (a.t1 - a.t0));
  const double doubt =
      relative(known.doubt.rightCols(1), truth, known.size) + 4 * relative(rate, truth, known.size);
  const double said = std::pow(10, -number(row[3]));
  const double least = std::max(error, std::max(std::pow(10, -known_digits), eps / 2));
  // Besides the doubt: a quarter of an error of a step, and the rounding of the printed digits (0.0005, and
  // 0.05 for the reference's).
  const double unsure =
      doubt + step / 4 + 0.002 * error + (std::pow(10, -known_digits) > error / 2 ? 0.15 * least : 0);
  return std::abs(said - least) / unsure;
}

/// The same, where need be with what the problem makes of an oracle's tolerance at any time: errors of both
/// may grow alike, so that their difference does not show them.
double amplified_ratio_of(const Asked& a, const Journey& way, const std::vector<std::string>& row,
                          const Eigen::VectorXd& end, double known_digits, const Known& known) {
  constexpr Tolerances of_oracles = {1e-13, 1e-15};
  const double ratio = ratio_of(a, row, end, known_digits, known, of_oracles.relative);
  if (ratio <= most_unsure) return ratio;
  const auto moved = a.question.moved(way, known, of_oracles);
  if (!moved) return ratio;
  const double step = relative(moved->rightCols(1), known.x.rightCols(1), known.size);
  return ratio_of(a, row, end, known_digits, known, std::max(step, of_oracles.relative));
}

Case trial(Draw& draw) {
  const Asked a = ask(draw);
  const Ran r = ran(a.words);
  if (const auto failure = failed(r)) return *failure;
  if (r.rows.size() != a.methods.size()) return Case::wrong(r.words + ": rows");
  const auto digits = digits_known(r.errors);
  for (const auto& row : r.rows) {
    if (const std::string what = malformed(row, digits.has_value()); !what.empty())
      return Case::wrong(fmt::format("{}: {}: {}", r.words, fmt::join(row, ","), what));
  }
  if (!digits) return Case::undecided(r.words);
  const Journey way{a.t0, comparison::look_at(a.t0, a.t1, 64)};
  const auto known = a.question.known(way);
  if (!known) return Case::undecided(r.words);
  double worst = -1;
  std::string where;
  for (const auto& row : r.rows) {
    if (row[2] != "success") continue;
    const auto end = a.question.end(comparison::any_method(row[0]), a.methods.at(row[0]), a.t0, a.t1);
    if (!end) continue;  // by its wall time
    if (!notes_its_error(a, row, *end, *known))
      return Case::wrong(fmt::format("{}: {}: the note", r.words, fmt::join(row, ",")));
    const double ratio = amplified_ratio_of(a, way, row, *end, *digits, *known);
    if (ratio > worst) worst = ratio, where = fmt::format("{}", fmt::join(row, ","));
  }
  if (worst < 0) return Case::refused(r.words);
  return Case::judged(worst, most_unsure,
                      fmt::format("{}: {}; reference {} digits", r.words, where, *digits));
}

TEST(AdversaryCommands, ComparedDigitsAreThere) {
  if (const std::string what = missing_oracles(); !what.empty()) GTEST_SKIP() << what;
  hunt({.quick = 8, .full = 2'000}, trial);
}

}  // namespace
}  // namespace nlmech::adversary::commands_compare_test
