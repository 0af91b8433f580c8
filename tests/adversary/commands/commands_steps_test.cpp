/// Random runs of `integrate --step`. They are not judged by the command: their error is what the step makes
/// of it. But they are runs of that method with that step, so three things hold. Whatever the step, the
/// simplest methods print powers of a matrix on a linear problem. Runs that come nearer to each other with
/// every halving of the step come nearer to the solution. And rows between are as the method's ends are.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "nlmech/ivp/hermitian/hermitian_operators.hpp"
#include "nlmech/ivp/named/named_methods.hpp"
#include "tests/adversary/commands/ivp_oracle.hpp"

namespace nlmech::adversary::commands_steps_test {
namespace {

using Wide = long double;
constexpr double eps = std::numeric_limits<double>::epsilon();

/// Rows at these times, of which the first is the begin.
std::optional<Eigen::MatrixXd> states_of(const Ran& r, std::size_t count) {
  if (r.rows.size() != count) return {};
  Eigen::MatrixXd x(static_cast<Eigen::Index>(r.header.size()) - 1, static_cast<Eigen::Index>(count));
  for (std::size_t k = 0; k < count; ++k) {
    if (r.rows[k].size() != r.header.size()) return {};
    for (std::size_t i = 1; i < r.header.size(); ++i)
      x(static_cast<Eigen::Index>(i) - 1, static_cast<Eigen::Index>(k)) = number(r.rows[k][i]);
  }
  return x;
}

/// The words of a method that takes a step, and of what it takes besides.
std::string any_stepped(Draw& draw, const Question& question) {
  const auto m = comparison::any_method(any_method(draw, question, true));
  std::string words = fmt::format(" --method {}", m.name);
  if (m.has(ivp::nodes_setting) && draw.chance(0.3)) words += fmt::format(" --nodes {}", draw.whole(3, 16));
  // With a shape that follows the step radial functions do not converge (named_integrator()).
  if (m.has(ivp::shape_setting)) words += fmt::format(" --shape {:.17g}", draw.log_uniform(0.3, 30));
  if (m.has(ivp::order_setting) && draw.chance(0.5)) words += fmt::format(" --order {}", draw.whole(3, 24));
  if (m.has(ivp::points_setting) && draw.chance(0.3)) words += fmt::format(" --points {}", draw.whole(1, 6));
  return words;
}

/// Three runs by h, h/2 and h/4 and what they should come to.
struct Halved {
  std::vector<Eigen::MatrixXd> x;  // without the first row
  std::vector<double> times;
  Ran last;
};

/// Greatest difference, in units of each component's size.
double apart(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, const Eigen::VectorXd& size) {
  return ((a - b).array().abs().colwise() / size.array()).maxCoeff();
}

/// If the differences shrink as those of an order one or more do (by a half, with room for the higher
/// terms), the rest of the series of halvings is no longer than four times the last difference.
Case judge(const Halved& h, const Known& known, const std::string& words) {
  const double most = known.size.maxCoeff();
  const Eigen::VectorXd size = known.size.cwiseMax(1e-3 * most).cwiseMax(1e-300);
  const double first = apart(h.x[0], h.x[1], size), second = apart(h.x[1], h.x[2], size);
  const double doubt = (known.doubt.array().colwise() / size.array()).maxCoeff();
  if (!(first < 0.05 && second < first / 1.8)) return Case::undecided(words);
  // Rounding of up to 4000 steps, and of radial bases.
  const double bound = 4 * second + 1e-9;
  if (doubt > 0.1 * bound) return Case::undecided(words);
  return Case::judged(apart(h.x[2], known.x, size), bound,
                      fmt::format("{}: differences {:.3g} and {:.3g}", words, first, second));
}

/// Within a step the velocities of Hermitian operators are derivatives of an interpolated position, off by
/// the step's error of that per length, 30 s^2 (1 - s)^2 times. Near an end this is as the square of the
/// row's distance from it, whatever the step, so that no halving shows it: such a run is judged at its end.
bool is_judged_at_its_end(const std::string& stepped, double steps_a_row) {
  const bool is_hermitian =
      std::any_of(ivp::hermitian_table.begin(), ivp::hermitian_table.end(), [&](const auto& pair) {
        return (stepped + " ").find(fmt::format(" {} ", pair.name)) != std::string::npos;
      });
  return is_hermitian && std::abs(steps_a_row - std::round(steps_a_row)) > 1e-9 * steps_a_row;
}

Case halvings(Draw& draw) {
  const Question q = any_question(draw);
  const double way = draw.log_uniform(1e-4, 0.3) * q.longest * (draw.chance(0.3) ? -1 : 1);
  const double t0 = draw.chance(0.3) ? draw.uniform(-10, 10) : 0, t1 = t0 + way;
  // A whole number of steps more often than its share, and with it of steps a row.
  const double steps = draw.chance(0.5) ? draw.whole(4, 200) : draw.uniform(4, 1000);
  const int rows = draw.whole(1, 12);
  const std::string stepped = any_stepped(draw, q);
  const std::string words =
      fmt::format("integrators integrate {} --from {:.17g} --until {:.17g} --every {:.17g}{}", q.words, t0,
                  t1, std::abs(way) / rows, stepped);
  const int judged = is_judged_at_its_end(stepped, steps / rows) ? 1 : rows;
  Halved h;
  for (const int part : {1, 2, 4}) {
    h.last = ran(words + fmt::format(" --step {:.17g}", std::abs(way) / steps / part));
    if (const auto failure = failed(h.last)) return *failure;
    auto x = states_of(h.last, static_cast<std::size_t>(rows) + 1);
    if (!x) return Case::wrong(h.last.words + fmt::format(": {} rows", h.last.rows.size()));
    if (!x->allFinite()) return Case::wrong(h.last.words + ": no number");
    h.x.push_back(x->rightCols(judged));
  }
  for (int k = rows - judged + 1; k <= rows; ++k)
    h.times.push_back(number(h.last.rows[static_cast<std::size_t>(k)][0]));
  const auto known = q.known({t0, h.times});
  return known ? judge(h, *known, h.last.words) : Case::undecided(words);
}

TEST(AdversaryCommands, HalvedStepsLeadToTheSolution) {
  if (const std::string what = missing_oracles(); !what.empty()) GTEST_SKIP() << what;
  hunt({.quick = 20, .full = 3'000}, halvings);
}

using Matrix = Eigen::Matrix<Wide, 2, 2>;

/// What a step of the length h does to the state of x'' + 2 z w x' + w^2 x = 0.
Matrix step_of(const std::string& method, const Matrix& a, Wide h) {
  const Matrix one = Matrix::Identity(), z = a * h;
  if (method == "euler") return one + z;
  if (method == "backward-euler") return (one - z).inverse();
  // Constant average acceleration is the trapezoidal rule.
  if (method == "newmark") return Matrix((one - z / 2).inverse()) * (one + z / 2);
  return one + z + z * z / 2 + z * z * z / 6 + z * z * z * z / 24;  // rk4
}

Case powers(Draw& draw) {
  const double w = draw.log_uniform(1e-2, 1e2), x = draw.signed_log(1e-3, 10), v = draw.signed_log(1e-3, 10);
  const std::string method = draw.one_of({"euler", "backward-euler", "newmark", "rk4"});
  // Any step, of those that leave the numbers finite.
  const double h = draw.log_uniform(1e-3, 3) / w;
  const int count = draw.whole(1, 200), stride = draw.whole(1, 5), whole = count / stride;
  const double sign = draw.chance(0.3) ? -1 : 1, rest = draw.chance(0.5) ? draw.uniform(0.1, 0.9) : 0;
  const double t1 = sign * (count + rest) * h;
  const Ran r =
      ran(fmt::format("integrators integrate --problem duffing --set hardening=0 --set "
                      "natural_frequency={:.17g} --initial {:.17g},{:.17g} --until {:.17g} "
                      "--step {:.17g} --every {:.17g} --method {}",
                      w, x, v, t1, h, stride * h, method));
  if (const auto failure = failed(r)) return *failure;
  const std::size_t rows = static_cast<std::size_t>(whole) + 1 + (count % stride != 0 || rest > 0 ? 1 : 0);
  const auto found = states_of(r, rows);
  if (!found)
    return Case::wrong(r.words + fmt::format(": {} rows where there should be {}", r.rows.size(), rows));
  Matrix a;
  a << 0, 1, -Wide(w) * w, 0;
  const Matrix step = step_of(method, a, sign * Wide(h));
  Eigen::Matrix<Wide, 2, 1> s(x, v);
  const Matrix scaled = (Matrix() << step(0, 0), step(0, 1) * w, step(1, 0) / w, step(1, 1)).finished();
  // In units of the amplitude; each step rounds by some eps of what it adds up, and so does its length.
  const double growth = std::max(1.0, static_cast<double>(scaled.norm()));
  double worst = 0, amplitude = std::hypot(x, v / w);
  for (int k = 0, row = 0; k <= count; ++k) {
    if (k > 0) s = (step * s).eval(), amplitude *= growth;
    if (k % stride != 0) continue;
    const double allowed = 4 * eps * (k + 1) * amplitude;
    worst = std::max(worst, static_cast<double>(std::abs((*found)(0, row) - s[0])) / allowed);
    worst = std::max(worst, static_cast<double>(std::abs((*found)(1, row) - s[1])) / (allowed * w));
    ++row;
  }
  if (rest > 0) s = (step_of(method, a, Wide(t1) - sign * count * Wide(h)) * s).eval();
  const double allowed = 4 * eps * (count + 2) * amplitude * growth;
  const auto last = static_cast<Eigen::Index>(rows) - 1;
  worst = std::max(worst, static_cast<double>(std::abs((*found)(0, last) - s[0])) / allowed);
  worst = std::max(worst, static_cast<double>(std::abs((*found)(1, last) - s[1])) / (allowed * w));
  return Case::judged(worst, 1, r.words);
}

TEST(AdversaryCommands, StepsArePowersOfAMatrix) {
  if (const std::string what = missing_oracles(); !what.empty()) GTEST_SKIP() << what;
  hunt({.quick = 20, .full = 3'000}, powers);
}

}  // namespace
}  // namespace nlmech::adversary::commands_steps_test
