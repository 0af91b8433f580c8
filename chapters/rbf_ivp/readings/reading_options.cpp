#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <stdexcept>

#include "chapters/rbf_ivp/readings/explicit_variants.hpp"
#include "chapters/rbf_ivp/readings/readings.hpp"
#include "nlmech/comparison/commands/example_of.hpp"
#include "nlmech/problems/texts.hpp"
#include "nlmech/scene/evidence/published.hpp"
#include "nlmech/scene/program/files.hpp"

namespace nlmech::chapters::rbf_ivp {
namespace {

using ivp::CentralDifference;
using ivp::Hht;
using ivp::Mcpi;
using ivp::Newmark;
using ivp::Ode45;
using ivp::RbfCollocation;
using ivp::Rk4;
using ivp::VelocityTime;

/// Printed errors, indexed by names such as "table-4.2/RK4-1 (P/10)".
using Printed = std::map<std::string, std::string>;

Printed read_printed() {
  Printed printed;
  for (const scene::PublishedValue& v : scene::read_published(scene::data_folder())) {
    if (v.source == "elgohary" && (v.kind == "error" || v.kind == "rounding"))
      printed[v.place + "/" + v.row] = v.printed;
  }
  return printed;
}

/// Step sizes of rows of a table.
struct Setting {
  std::string table;  ///< such as "table-4.2"
  std::string steps;  ///< text in the name of the row, such as "(P/10)"
  double first;       ///< step size
  double second = 0;  ///< step size after the impact; 0: none
};

/// First and second settings of Newmark and HHT, with steps as fractions of the period @p P.
std::vector<Setting> implicit_settings(double P) {
  return {{"table-4.2", "(P/10)", P / 10},       {"table-4.2", "(P/500)", P / 500},
          {"table-4.4", "(0.1; 0.5)", 0.1, 0.5}, {"table-4.4", "(0.05; 0.03)", 0.05, 0.03},
          {"table-4.6", "(0.625)", 0.625},       {"table-4.6", "(0.0625)", 0.0625}};
}

/// The example of a table. The reference of the free oscillator is a Taylor series, fifteen times as fast as
/// the elliptic functions.
const Case& case_of(const std::string& table) {
  if (table == "table-4.4") return impact_case();
  if (table == "table-4.6") return three_mass_case();
  static const Case by_series = [] {
    Case c = free_duffing_case();
    c.reference =
        comparison::example_of(problems::TextProblem("duffing"), c.name, c.x0, c.t0, c.t1, 5).reference;
    return c;
  }();
  return by_series;
}
Record run_on(const std::string& table, const Procedure& procedure) {
  return record(case_of(table), case_of(table).t1, procedure);
}

/// A printed row and its run.
struct Answer {
  std::string table, row;
  Record record;
  [[nodiscard]] const std::string& printed(const Printed& all) const { return all.at(table + "/" + row); }
  /// Inferred end time of the printed errors of the table.
  [[nodiscard]] double inferred_end() const { return case_of(table).inferred_end; }
  /// RMS error of a component up to a time; @p start counts the start with Points::ends.
  [[nodiscard]] double rms(double until, Points points = Points::ends, int component = 0,
                           bool start = true) const {
    return rms_error(record, component, points, until, start);
  }
};

/// Runs a method with the step sizes of a setting on the example of its table.
template <class Method>
Answer answer(const Setting& s, const std::string& row, Method method) {
  Method after = method;
  method.step = s.first;
  after.step = s.second;
  return {s.table, row + " " + s.steps,
          run_on(s.table, s.second > 0 ? in_two_phases(method, after) : throughout(method))};
}

/// Numbered method: "-1" for the long steps, "-2" for the short ones.
std::string numbered(const std::string& method, const Setting& s) {
  return method + (s.first >= 0.1 ? "-1" : "-2");
}

/// RK4, Newmark and HHT in all three tables.
std::vector<Answer> step_methods(double P, bool free_only = false) {
  std::vector<Answer> all;
  for (const Setting& s : implicit_settings(P)) {
    if (free_only && s.table != "table-4.2") continue;
    Setting shorter = s;
    if (s.steps == "(P/500)") shorter = {s.table, "(P/250)", P / 250};
    all.push_back(answer(shorter, numbered("RK4", s), Rk4{}));
    all.push_back(answer(s, numbered("Newmark", s), Newmark{}));
    all.push_back(answer(s, numbered("HHT", s), Hht{}));
  }
  return all;
}

/// The two MCPI rows of each table, with degree n + @p degree and n + @p intervals intervals for the printed
/// order n.
std::vector<Answer> picard(double P, int degree, int intervals, double tolerance) {
  const auto method = [&](int n) {
    return Mcpi{.order = n + degree, .intervals = n + intervals, .tolerance = tolerance};
  };
  return {answer({"table-4.2", "(P/10)", P / 10}, "MCPI-1", method(8)),
          answer({"table-4.2", "(P/2)", P / 2}, "MCPI-2", method(16)),
          answer({"table-4.4", "(0.1; 0.5)", 0.1, 0.5}, "MCPI-1", method(6)),
          answer({"table-4.4", "(0.5; 2)", 0.5, 2}, "MCPI-2", method(10)),
          answer({"table-4.6", "(0.625)", 0.625}, "MCPI-1", method(6)),
          answer({"table-4.6", "(4)", 4}, "MCPI-2", method(12))};
}

/// Score of answers; @p number returns the computed value of an answer.
template <class Number>
Score score(const std::vector<Answer>& answers, const Printed& printed, Number number) {
  Score s;
  for (const Answer& a : answers) s.count(a.printed(printed), number(a));
  return s;
}

double at_step_ends(const Answer& a) { return a.rms(a.inferred_end()); }

ReadingChoice end_and_period(const Printed& printed) {
  ReadingChoice q{"end time and period", "4.2", "P = 4.77, to 500 s", "P exact, to 100 P", {}};
  for (const auto& [name, P] : {std::pair("exact", duffing_period()), {"= 4.768", 4.768}, {"= 4.77", 4.77}}) {
    std::vector<Answer> answers = step_methods(P, true);
    answers.push_back(answer({"table-4.2", "(P/500)", P / 500}, "Explicit-2", CentralDifference{}));
    answers.push_back({"table-4.2", "ODE45-1", run_on("table-4.2", throughout(Ode45{1e-6, 1e-6}))});
    answers.push_back({"table-4.2", "ODE45-2", run_on("table-4.2", throughout(Ode45{1e-9, 1e-9}))});
    const auto to = [&](double end) {
      return score(answers, printed, [end](const Answer& a) {
        return a.rms(end, a.row.starts_with("ODE45") ? Points::all : Points::ends);
      });
    };
    q.options.push_back({fmt::format("P {}, to 100 P", name), to(100 * P)});
    q.options.push_back({fmt::format("P {}, to 101 P", name), to(101 * P)});
    q.options.push_back({fmt::format("P {}, to 500 s", name), to(500)});
  }
  return q;
}

ReadingChoice hht_alpha(const Printed& printed, bool quick) {
  ReadingChoice q{"alpha of HHT and its form", "4.2 4.4 4.6", "", "alpha = -0.1, form of 1977", {}};
  const std::vector<double> few = {0.0, -0.1, -1. / 3},
                            all = {0.0, -0.01, -0.02, -0.05, -0.08, -0.1, -0.15, -0.2, -0.3, -1. / 3};
  for (const double alpha : quick ? few : all) {
    for (const Hht::Form form : {Hht::Form::corrected, Hht::Form::as_printed}) {
      std::vector<Answer> answers;
      for (const Setting& s : implicit_settings(duffing_period()))
        answers.push_back(answer(s, numbered("HHT", s), Hht{.alpha = alpha, .form = form}));
      q.options.push_back({fmt::format("alpha = {:.3g}, {}", alpha,
                                       form == Hht::Form::corrected ? "form of 1977" : "Eq. 4.7 as printed"),
                           score(answers, printed, at_step_ends)});
    }
  }
  return q;
}

ReadingChoice newton_tolerance(const Printed& printed, bool quick) {
  ReadingChoice q{"tolerance of Newton's iteration", "4.2 4.4 4.6", "", "1e-12", {}};
  const std::vector<double> few = {1e-12, 1e-2}, all = {1e-12, 1e-8, 1e-6, 1e-4, 1e-3, 1e-2};
  for (const double tolerance : quick ? few : all) {
    std::vector<Answer> answers;
    for (const Setting& s : implicit_settings(duffing_period())) {
      answers.push_back(answer(s, numbered("Newmark", s), Newmark{.newton = {.tolerance = tolerance}}));
      answers.push_back(answer(s, numbered("HHT", s), Hht{.newton = {.tolerance = tolerance}}));
    }
    q.options.push_back({scene::format_number(tolerance, 1), score(answers, printed, at_step_ends)});
  }
  return q;
}

ReadingChoice end_of_impact_runs(const Printed& printed, const std::vector<Answer>& steps) {
  ReadingChoice q{"end time", "4.4", "500 s", "499 s", {}};
  std::vector<Answer> answers;
  std::copy_if(steps.begin(), steps.end(), std::back_inserter(answers),
               [](const Answer& a) { return a.table == "table-4.4"; });
  for (const double end : {496.0, 497.0, 498.0, 498.5, 499.0, 499.5, 500.0}) {
    q.options.push_back(
        {fmt::format("{:g} s", end), score(answers, printed, [end](const Answer& a) { return a.rms(end); })});
  }
  return q;
}

ReadingChoice explicit_restart(const Printed& printed) {
  ReadingChoice q{"restart of the explicit rows",
                  "4.4",
                  "v(t_1), read as v(t_1), to 500 s",
                  "v(t_1 - h/2), read as v(t_1 - h/2), to 499 s",
                  {}};
  const auto name = [](VelocityTime v) { return v == VelocityTime::of_state ? "v(t_1)" : "v(t_1 - h/2)"; };
  for (const VelocityTime given : {VelocityTime::of_state, VelocityTime::half_step_before}) {
    for (const VelocityTime read : {VelocityTime::of_state, VelocityTime::half_step_before}) {
      const auto run = [&](double during, double after, const std::string& row) {
        return Answer{"table-4.4", row,
                      run_on("table-4.4", in_two_phases(CentralDifference{.step = during, .reported = given},
                                                        CentralDifference{.step = after, .initial = read}))};
      };
      const std::vector<Answer> answers = {run(0.1, 0.5, "Explicit-1 (0.1; 0.5)"),
                                           run(0.005, 0.006, "Explicit-2 (0.005; 0.006)")};
      for (const double end : {496.0, 497.0, 498.0, 498.5, 499.0, 499.5, 500.0}) {
        q.options.push_back({fmt::format("{}, read as {}, to {:g} s", name(given), name(read), end),
                             score(answers, printed, [end](const Answer& a) { return a.rms(end); })});
      }
    }
  }
  return q;
}

ReadingChoice explicit_column(const Printed& printed) {
  ReadingChoice q{"component in the explicit rows",
                  "4.6",
                  "x1, v0 - h/2 a0, v0 first",
                  "x3, v0 - h/2 a0, v(-h/2) first",
                  {}};
  for (const ExplicitStart start : explicit_starts) {
    for (const ExplicitDamping damping : explicit_dampings) {
      const Answer coarse{"table-4.6", "Explicit-1 (0.625)", explicit_chain(0.625, start, damping)};
      const Answer fine{"table-4.6", "Explicit-2 (0.00625)", explicit_chain(0.00625, start, damping)};
      for (int i = 0; i < 3; ++i) {
        Score s;
        for (const Answer* a : {&coarse, &fine}) s.count(a->printed(printed), a->rms(200, Points::ends, i));
        q.options.push_back({fmt::format("x{}, {}, {}", i + 1, to_string(start), to_string(damping)), s});
      }
    }
  }
  return q;
}

ReadingChoice normalisation(const Printed& printed, const std::vector<Answer>& steps) {
  std::vector<Answer> answers;
  std::copy_if(steps.begin(), steps.end(), std::back_inserter(answers),
               [](const Answer& a) { return a.table != "table-4.2"; });
  ReadingChoice q{"what is averaged", "4.4 4.6", "error of x", "error of x", {}};
  q.options.push_back({"error of x", score(answers, printed, at_step_ends)});
  q.options.push_back({"error of x over its amplitude", score(answers, printed, [](const Answer& a) {
                         return at_step_ends(a) / case_of(a.table).amplitude[0];
                       })});
  q.options.push_back({"norm of the state's error", score(answers, printed, [](const Answer& a) {
                         double sum = 0;
                         for (int i = 0; i < static_cast<int>(case_of(a.table).x0.size()); ++i)
                           sum += std::pow(a.rms(a.inferred_end(), Points::ends, i), 2);
                         return std::sqrt(sum);
                       })});
  return q;
}

ReadingChoice begin_counted(const Printed& printed, const std::vector<Answer>& steps) {
  ReadingChoice q{"start included in the mean", "4.2 4.4 4.6", "", "yes", {}};
  q.options.push_back({"yes", score(steps, printed, at_step_ends)});
  q.options.push_back({"no", score(steps, printed, [](const Answer& a) {
                         return a.rms(a.inferred_end(), Points::ends, 0, false);
                       })});
  return q;
}

/// In Table 4.2 the errors of MCPI are to 500 s, those of the other rows to 100 P.
ReadingChoice picard_points(const Printed& printed) {
  const std::vector<Answer> answers = picard(duffing_period(), 0, 0, 1e-13);
  ReadingChoice q{
      "points and end time of MCPI", "4.2 4.4 4.6", "step ends, to 500 s", "all nodes, to 500 s", {}};
  for (const Points points : {Points::ends, Points::all}) {
    for (const bool whole : {true, false}) {
      q.options.push_back({fmt::format("{}, to {}", points == Points::ends ? "step ends" : "all nodes",
                                       whole ? "500 s" : "100 P"),
                           score(answers, printed, [&](const Answer& a) {
                             const bool to_500 = whole && a.table == "table-4.2";
                             return a.rms(to_500 ? 500 : a.inferred_end(), points);
                           })});
    }
  }
  return q;
}

ReadingChoice picard_scheme(const Printed& printed, bool quick) {
  ReadingChoice q{"degree and nodes of MCPI", "4.2 4.4 4.6", "", "degree n, n + 1 nodes, 1e-13", {}};
  for (const auto& [degree, intervals] : {std::pair(0, 0), {-1, -1}, {-1, 0}, {0, 1}}) {
    for (const double tolerance : {1e-13, 1e-10, 1e-8, 1e-6}) {
      if (quick && tolerance != 1e-13) continue;
      const auto answers = picard(duffing_period(), degree, intervals, tolerance);
      q.options.push_back({fmt::format("degree {}, {} nodes, {}", degree == 0 ? "n" : "n - 1",
                                       intervals == -1  ? "n"
                                       : intervals == 0 ? "n + 1"
                                                        : "n + 2",
                                       scene::format_number(tolerance, 1)),
                           score(answers, printed, [](const Answer& a) {
                             return a.rms(a.table == "table-4.2" ? 500 : a.inferred_end(), Points::all);
                           })});
    }
  }
  return q;
}

ReadingChoice ode45_points(const Printed& printed) {
  ReadingChoice q{"points of ODE45", "4.2", "", "four values a step", {}};
  for (const Points points : {Points::all, Points::ends}) {
    Score s;
    for (const auto& [row, tolerance] : {std::pair("ODE45-1", 1e-6), {"ODE45-2", 1e-9}}) {
      const Answer a{"table-4.2", row, run_on("table-4.2", throughout(Ode45{tolerance, tolerance}))};
      s.count(a.printed(printed), a.rms(a.inferred_end(), points));
    }
    q.options.push_back({points == Points::all ? q.chosen : "step ends", s});
  }
  return q;
}

/// A printed row of RBF-Coll with its run.
struct RadialRun {
  std::string table;
  double printed;                ///< printed error
  Points chosen;                 ///< points of the inferred reading
  std::optional<Record> record;  ///< nothing if a step is not solved
};

std::vector<RadialRun> radial_runs(const Printed& printed, collocation::Inversion inversion) {
  const double P = duffing_period();
  std::vector<RadialRun> all;
  const auto add = [&](const Setting& setting, const std::string& row, Points points, RbfCollocation method,
                       double later_shape = 0) {
    method.inversion = inversion;
    RadialRun& run = all.emplace_back(RadialRun{
        setting.table, std::stod(printed.at(setting.table + "/" + row + " " + setting.steps)), points, {}});
    RbfCollocation during = method, after = method;
    during.step = setting.first;
    after.step = setting.second;
    if (later_shape > 0) after.shape = later_shape;
    try {
      run.record =
          run_on(setting.table, setting.second > 0 ? in_two_phases(during, after) : throughout(during));
    } catch (const Failure&) {
      run.record.reset();
    }
  };
  add({"table-4.2", "(P/10)", P / 10}, "RBF-Coll-1", Points::ends, {.nodes = 7, .shape = 0.77});
  add({"table-4.2", "(P)", P}, "RBF-Coll-2", Points::all, {.nodes = 35});
  add({"table-4.4", "(0.1; 0.5)", 0.1, 0.5}, "RBF-Coll-1", Points::ends, {.nodes = 7, .shape = 2.5}, 0.66);
  add({"table-4.4", "(0.5; 6)", 0.5, 6}, "RBF-Coll-2", Points::ends, {.nodes = 35});
  add({"table-4.6", "(0.625)", 0.625}, "RBF-Coll-1", Points::ends, {.nodes = 7, .shape = 0.35});
  add({"table-4.6", "(20)", 20}, "RBF-Coll-2", Points::ends, {.nodes = 35, .shape = 0.39});
  return all;
}

/// Score of rounding noise. @param points of all rows; nothing: those of the inferred reading
Score score_noise(const std::vector<RadialRun>& runs, std::optional<Points> points = {}) {
  Score s;
  for (const RadialRun& run : runs)
    s.count_noise(run.printed, run.record ? rms_error(*run.record, 0, points.value_or(run.chosen),
                                                      case_of(run.table).inferred_end)
                                          : HUGE_VAL);
  return s;
}

ReadingChoice radial_points(const std::vector<RadialRun>& runs) {
  ReadingChoice q{
      "points of RBF-Coll", "4.2 4.4 4.6", "", "all nodes for RBF-Coll-2 of Table 4.2, else step ends", {}};
  q.options = {{q.chosen, score_noise(runs)},
               {"step ends", score_noise(runs, Points::ends)},
               {"all nodes", score_noise(runs, Points::all)}};
  return q;
}

ReadingChoice derivative_matrix(const Printed& printed, const std::vector<RadialRun>& solved) {
  ReadingChoice q{"derivative matrix of RBF-Coll", "4.2 4.4 4.6", "", "linear systems", {}};
  q.options = {
      {q.chosen, score_noise(solved)},
      {"product with the inverse", score_noise(radial_runs(printed, collocation::Inversion::inverse))}};
  return q;
}

}  // namespace

double last_digit(const std::string& printed) {
  const auto e = printed.find('e'), point = printed.find('.');
  const int exponent = e == std::string::npos ? 0 : std::stoi(printed.substr(e + 1));
  const auto mantissa_end = std::min(e, printed.size());
  const int decimals = point == std::string::npos ? 0 : static_cast<int>(mantissa_end - point) - 1;
  return std::pow(10.0, exponent - decimals);
}

void Score::count(const std::string& printed, double computed) {
  const double distance = std::abs(computed - std::stod(printed)) / last_digit(printed);
  ++rows;
  exact += distance <= 0.5 + 1e-9 ? 1 : 0;  // a tie can be rounded either way
  close += scene::Tolerance("digits", printed).allows(computed, std::stod(printed)) ? 1 : 0;
}

void Score::count_noise(double printed, double computed) {
  const bool explained = computed <= 5 * printed && computed >= printed / 5;
  ++rows;
  exact += explained ? 1 : 0;
  close += explained ? 1 : 0;
}

const Option& ReadingChoice::option(const std::string& wanted) const {
  for (const Option& o : options) {
    if (o.text == wanted) return o;
  }
  throw std::logic_error(fmt::format("{}: no option '{}'", text, wanted));
}

std::vector<ReadingChoice> try_readings(bool quick) {
  const Printed printed = read_printed();
  const std::vector<Answer> steps = step_methods(duffing_period());
  const std::vector<RadialRun> solved = radial_runs(printed, collocation::Inversion::solve);
  return {end_and_period(printed),
          end_of_impact_runs(printed, steps),
          normalisation(printed, steps),
          begin_counted(printed, steps),
          hht_alpha(printed, quick),
          newton_tolerance(printed, quick),
          explicit_restart(printed),
          explicit_column(printed),
          picard_points(printed),
          picard_scheme(printed, quick),
          ode45_points(printed),
          radial_points(solved),
          derivative_matrix(printed, solved)};
}

}  // namespace nlmech::chapters::rbf_ivp
