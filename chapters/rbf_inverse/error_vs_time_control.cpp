#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <ranges>
#include <string>
#include <vector>

#include "chapters/rbf_inverse/duffing_runs.hpp"
#include "chapters/rbf_inverse/shooting_methods.hpp"
#include "nlmech/peers/bvp/ipopt.hpp"
#include "nlmech/support/stopwatch.hpp"

namespace nlmech::chapters::rbf_inverse {
namespace {

using bvp::DerivativeMatrix;
using bvp::DuffingCase;

struct Method {
  const char* name;
  int style;  ///< of its curves
};
constexpr Method gaussian{"Gaussian, printed shape", 5}, stable{"stable Gaussian, c T = 5", 2},
    polynomial{"polynomial, one interval", 3}, refined{"polynomial, refined", 1},
    shooting{"multiple shooting, CVODE", 4}, direct{"direct, own start", 8}, ipopt{"direct, Ipopt", 7};

/// A setting of a method on a case.
struct Row {
  DuffingCase which;
  const Method* method;
  scene::Cell setting;
  std::string status;
  std::optional<double> error = {};  ///< of the initial co-states, relative; nothing if it failed
  std::optional<Timing> time = {};   ///< nothing if this build has not the method

  [[nodiscard]] double seconds() const { return time->median; }
  [[nodiscard]] double digits() const { return -std::log10(*error); }
  template <double Timing::*what>
  [[nodiscard]] std::optional<double> milliseconds() const {
    return time ? std::optional(1e3 * ((*time).*what)) : std::nullopt;
  }
};

/// How a solve ended, and with which x and lambda at 0.
struct Answer {
  Status status;
  Eigen::VectorXd first;
};
Answer answer_of(const bvp::Solution& s) { return {s.status, s.status.ok() ? s.first() : Eigen::VectorXd()}; }

/// One case. All begin at the same trajectory: a coarse direct method's.
struct Subject {
  const KnownExtremal& known;
  bool quick;
  std::vector<Row>& rows;
  bvp::ExtremalProblem problem = duffing_problem(printed_settings(known.which));
  bvp::ControlGuess guess = {Eigen::VectorXd::Zero(2), [](double, Eigen::VectorXd& u) { u[0] = 0; }};
  bvp::Start start = direct_start(problem, guess, {.pieces = 40}).start;

  /// Measures a setting.
  void add(const Method& method, const std::string& setting, const std::function<Answer()>& solve) const {
    const Stopwatch watch;
    const Answer answer = solve();
    const double first = watch.seconds();
    Row& row = rows.emplace_back(
        Row{known.which, &method, setting, std::string(to_string(answer.status.outcome()))});
    row.time = {first, first, first, 1};
    if (!answer.status.ok()) return;
    const Eigen::Vector2d right(known.first[2], known.first[3]), found = answer.first.tail<2>();
    row.error = std::max((found - right).cwiseAbs().maxCoeff() / right.cwiseAbs().maxCoeff(), 1e-16);
    if (!quick && first < 0.1)
      row.time = time_repeats([&] { static_cast<void>(solve()); }, first < 0.02 ? 7 : 3);
  }
  void not_built(const Method& method) const {
    rows.push_back({known.which, &method, {}, "not in this build"});
  }
};

/// @param shape c T; 0: that of the text, which grows with the nodes
void one_interval(const Subject& s, const Method& method, DerivativeMatrix derivative, double shape) {
  for (const int nodes : {10, 15, 20, 25, 30, 40, 50, 60, 80}) {
    if (s.quick && nodes % 20 != 0) continue;
    const bvp::GlobalMethod global{.nodes = nodes,
                                   .relative_shape = shape > 0 ? shape : (nodes - 1) / 4.,
                                   .derivative = derivative,
                                   .rows = printed_rows(s.problem)};
    s.add(method, fmt::format("{} nodes", nodes),
          [&] { return answer_of(solve_global(s.problem, global, s.start, 0.1, true).extremal.solution); });
  }
}

void refined_intervals(const Subject& s) {
  for (int power = 3; power <= 12; power += s.quick ? 3 : 1) {
    const bvp::Options options{
        .family = bvp::Family::lobatto, .nodes = 6, .intervals = 3, .tolerance = std::pow(10, -power)};
    s.add(refined, fmt::format("tolerance 1e-{}", power),
          [&] { return answer_of(solve_extremal(s.problem, s.start, options).solution); });
  }
}

void multiple_shooting(const Subject& s) {
  if (!multiple_shooting_available()) return s.not_built(shooting);
  for (int power = 4; power <= 12; power += s.quick ? 4 : 1)
    s.add(shooting, fmt::format("tolerance 1e-{}", power), [&] {
      const Shot shot = shoot(s.problem, s.start, {.tolerance = std::pow(10, -power)});
      return Answer{shot.status, shot.first};
    });
}

void direct_method(const Subject& s, const Method& method) {
  if (&method == &ipopt && !peers::ipopt_available()) return s.not_built(ipopt);
  for (const int pieces : {50, 100, 200, 400, 800}) {
    if (s.quick && pieces > 100) continue;
    s.add(method, fmt::format("{} pieces", pieces), [&] {
      const bvp::DirectResult r = &method == &ipopt
                                      ? peers::ipopt_start(s.problem, s.guess, {.pieces = pieces})
                                      : direct_start(s.problem, s.guess, {.pieces = pieces});
      Eigen::VectorXd z(4);
      if (r.status.ok()) r.start.states(0, z);
      return Answer{r.status, z};
    });
  }
}

std::vector<Row> measure(bool quick) {
  std::vector<Row> rows;
  for (const DuffingCase which : {DuffingCase::free, DuffingCase::fixed}) {
    const Subject s{known_extremal(which), quick, rows};
    one_interval(s, gaussian, DerivativeMatrix::gaussian, 0);
    one_interval(s, stable, DerivativeMatrix::stable_gaussian, 5);
    one_interval(s, polynomial, DerivativeMatrix::polynomial, 5);
    refined_intervals(s);
    multiple_shooting(s);
    direct_method(s, direct);
    direct_method(s, ipopt);
  }
  return rows;
}

/// The rows of a method on a case.
auto of(const std::vector<Row>& rows, DuffingCase which, const Method& method) {
  return rows |
         std::views::filter([=, &method](const Row& r) { return r.which == which && r.method == &method; });
}

void draw(const std::vector<Row>& rows, scene::Show& show) {
  scene::Plot& plot = show.plots("Digits of the initial co-states against time");
  plot.size(1000, 540).columns({"panel", "curve", "time_s", "y"});
  for (const DuffingCase which : {DuffingCase::free, DuffingCase::fixed}) {
    const bool is_free = which == DuffingCase::free;
    scene::Panel& panel = plot.panel("median run time (s)", is_free ? "digits of {/:Italic λ}(0)" : "");
    panel.caption(is_free ? "free final state, {/:Italic T} = 2" : "final state given, {/:Italic T} = 2");
    panel.log_x(1e-4, 10).y_range(0, 16).set("bmargin at screen 0.3");
    panel.set("xtics ('0.1 ms' 1e-4, '1 ms' 1e-3, '10 ms' 1e-2, '0.1 s' 0.1, '1 s' 1, '10 s' 10)");
    panel.key(is_free ? "off" : "at screen 0.5, screen 0.01 center bottom maxrows 3 samplen 3");
    for (const Method* method : {&gaussian, &stable, &polynomial, &refined, &shooting, &direct, &ipopt}) {
      const auto good = [](const Row& r) { return r.error && *r.error < 1; };
      auto drawn = of(rows, which, *method) | std::views::filter(good);
      if (!drawn.empty())
        panel.curve(method->name, drawn, &Row::seconds, &Row::digits, scene::linespoints(method->style));
    }
  }
}

void put(const std::vector<Row>& rows, scene::Show& show) {
  draw(rows, show);
  show.table(rows, {{"case", [](const Row& r) { return to_string(r.which); }},
                    {"method", [](const Row& r) { return r.method->name; }},
                    {"setting", &Row::setting},
                    {"status", &Row::status},
                    {"error of the initial co-states", &Row::error, 2},
                    {"time (ms)", &Row::milliseconds<&Timing::median>},
                    {"from", &Row::milliseconds<&Timing::smallest>},
                    {"to", &Row::milliseconds<&Timing::largest>}});
  for (const DuffingCase which : {DuffingCase::free, DuffingCase::fixed}) {
    const std::string name = fmt::format(", {}", to_string(which));
    const auto error = [](const Row& r) { return r.error.value_or(HUGE_VAL); };
    const auto least = [&](const Method& method) {
      return error(std::ranges::min(of(rows, which, method), {}, error));
    };
    show.at_most("least error, polynomial, refined" + name, least(refined), 1e-10,
                 "a tolerance of 1e-12 against tools/oracles/rbf_inverse_extremals.py");
    double worst = 0;
    for (const Row& r : of(rows, which, gaussian) | std::views::drop(show.quick() ? 0 : 2))
      worst = std::max(worst, error(r));
    show.between("largest error of 20 and more nodes, Gaussian, printed shape" + name, worst, 1e-7, 1e-1,
                 "recorded: no convergence with the nodes");
    if (multiple_shooting_available())
      show.at_most("least error, multiple shooting" + name, least(shooting), 1e-8,
                   "a tolerance of 1e-12 in each step");
    show.at_most("least error, direct, own start" + name, least(direct), show.quick() ? 0.1 : 1e-2,
                 "piecewise constant controls: of the second order in their length");
  }
}

}  // namespace

std::vector<scene::Scene> error_vs_time_control() {
  const scene::Result rows(
      "times-control",
      "T = 2, S = I; all begin at the trajectory of a direct method of 40 pieces, which is not timed; direct "
      "methods begin without force; error of lambda(0) against 36 digits; one thread, median of repeats",
      measure);
  return {{.name = "error-vs-time-ocp",
           .title = "Digits of the initial co-states against time",
           .content = scene::Content(put, rows)}};
}

}  // namespace nlmech::chapters::rbf_inverse
