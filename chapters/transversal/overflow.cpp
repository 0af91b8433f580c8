#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "chapters/transversal/oscillators.hpp"
#include "nlmech/scene/scene.hpp"

namespace nlmech::chapters::transversal::overflow {
namespace {

constexpr double end = 40;

/// A run of one method with one step size.
struct Run {
  std::string method;  ///< method name, such as "rk6" or "mtl 3"
  double step;         ///< step size h
  std::string status;  ///< outcome
  double error;        ///< largest error of x; infinite if the run failed

  /// The error; nothing if the run failed.
  [[nodiscard]] std::optional<double> finite_error() const {
    return std::isfinite(error) ? std::optional(error) : std::nullopt;
  }
};

/// All runs on one oscillator.
struct Outcomes {
  std::vector<Run> runs;  ///< ordered by method, then by step size
  double amplitude = 0;   ///< largest |x| of the solution

  /// The smallest step size with which a method overflows; NaN if there is none.
  [[nodiscard]] double overflow_from(const std::string& name) const {
    const auto found = std::ranges::find_if(
        runs, [&](const Run& f) { return f.method == name && f.status == "non_finite"; });
    return found == runs.end() ? NAN : found->step;
  }
  /// @throws std::out_of_range if there is no such run
  [[nodiscard]] const Run& at(const std::string& name, double step) const {
    const auto found = std::ranges::find_if(
        runs, [&](const Run& f) { return f.method == name && std::abs(f.step - step) < 1e-9; });
    if (found == runs.end())
      throw std::out_of_range(fmt::format("no run of {} with the step {}", name, step));
    return *found;
  }
};

/// Step sizes 0.01, 0.02, ..., 0.5; fewer if @p quick.
std::vector<double> steps(bool quick) {
  std::vector<double> all;
  for (int k = 1; k <= 50; ++k) {
    if (!quick || k % 5 == 0 || (k > 17 && k < 24) || (k > 29 && k < 38)) all.push_back(k / 100.);
  }
  return all;
}

ivp::NamedIntegrator method(const std::string& name, double step) {
  return name.starts_with("mtl") ? mtl(step, name.back() - '0') : classical(name, step);
}

Outcomes runs(double e2, bool quick) {
  const problems::TextProblem problem = stand_in(e2);
  const Reference reference(problem, {0, 0}, 0, end);
  Outcomes all;
  for (int i = 0; i <= 4000; ++i)
    all.amplitude = std::max(all.amplitude, std::abs(static_cast<double>(reference(end * i / 4000.0L)[0])));
  for (const std::string name : {"rk4", "rk6", "mtl 3", "mtl 4", "mtl 5"}) {
    for (const double h : steps(quick)) {
      const Course c = course(problem, {0, 0}, end, method(name, h), &reference);
      all.runs.push_back({name, h, std::string(to_string(c.status.outcome())), c.error});
    }
  }
  return all;
}

void check(const std::string& label, const Outcomes& all, double rk6, double rk4, scene::Show& show) {
  const char* recorded = "regression value; steps in hundredths are the resolution";
  show.near("RK6 overflows from h, " + label, all.overflow_from("rk6"), rk6, 0.0101 / rk6, recorded);
  show.near("RK4 overflows from h, " + label, all.overflow_from("rk4"), rk4, 0.0101 / rk4, recorded);
  show.between("error of p = 3 at h = 0.21 over the amplitude, " + label,
               all.at("mtl 3", 0.21).error / all.amplitude, 0.5, 3,
               "no digit is right, and two bounded motions differ by little more than twice the amplitude");
  const auto wild = std::ranges::find_if(all.runs, [&](const Run& f) {
    return f.method == "mtl 3" && f.status == "success" && f.error > 10 * all.amplitude;
  });
  show.between("p = 3 errs by ten amplitudes from h, " + label, wild == all.runs.end() ? NAN : wild->step,
               0.22, 0.5,
               "beyond the 0.21 of the paper; nothing bounds the roots that a block's equations may have");
  show.between("error of RK6 over that of p = 3 at h = 0.1, " + label,
               all.at("rk6", 0.1).error / all.at("mtl 3", 0.1).error, 0, 0.5,
               "order 6 against 4; a seventh and a quarter are regression values");
}

/// Method name for the legend: "RK6", or "MTL p = 3" with an italic p.
std::string in_legend(const std::string& name) {
  return name.starts_with("mtl") ? "MTL {/:Italic p} = " + name.substr(4) : "RK" + name.substr(2);
}

/// Draws one error curve per method. Crosses mark step sizes that fail, one row per method.
void draw(const Outcomes& all, scene::Show& show) {
  scene::Panel& panel = show.plot("Error against step: at {/:Italic h} = 0.21 no method has a correct digit",
                                  "step {/:Italic h} (periods of the force)",
                                  "greatest error of {/:Italic x} to {/:Italic t} = 40");
  panel.log_x(8e-3, 0.6).log_y(1e-9, 300).key("outside right center");
  panel.level(all.amplitude, "amplitude of the motion").mark(0.21, "{/:Italic h} = 0.21");
  panel.note("× overflow or no root", 9e-3, 90);
  scene::Table data({{"series", 3, true}, {"step"}, {"error"}, {"overflow"}});
  std::vector<std::string> methods;
  std::set<int> failing;
  for (const Run& f : all.runs) {
    if (methods.empty() || methods.back() != f.method) methods.push_back(f.method);
    const int number = static_cast<int>(methods.size());
    std::optional<double> cross;
    if (!f.finite_error()) cross = 20 * std::pow(1.5, number - 1);
    if (cross) failing.insert(number);
    data.add({number, f.step, f.finite_error(), cross});
  }
  for (int i = 0; i < static_cast<int>(methods.size()); ++i)
    panel.columns(in_legend(methods[static_cast<std::size_t>(i)]), "step:error", scene::linespoints(), i);
  for (const int i : failing)
    panel.columns("", "step:overflow", {"points pointtype 2 pointsize 0.6", i}, i - 1);
  show.figure().data(std::move(data));
}

void put(const Outcomes& soft, const Outcomes& stiff, scene::Show& show) {
  draw(soft, show);
  struct Row {
    const Run &soft, &stiff;
  };
  std::vector<Row> rows;
  for (std::size_t i = 0; i < soft.runs.size(); ++i) {
    const auto hundredths = std::lround(soft.runs[i].step * 100);
    if (hundredths % 5 == 0 ? hundredths <= 20 || hundredths == 30 : hundredths == 21)
      rows.push_back({soft.runs[i], stiff.runs[i]});
  }
  show.table(rows, {{"method", [](const Row& r) { return r.soft.method; }},
                    {"h", [](const Row& r) { return r.soft.step; }},
                    {"error, e2 = 0.5", [](const Row& r) { return r.soft.finite_error(); }, 2},
                    {"ends, e2 = 0.5", [](const Row& r) { return r.soft.status; }},
                    {"error, e2 = 1", [](const Row& r) { return r.stiff.finite_error(); }, 2},
                    {"ends, e2 = 1", [](const Row& r) { return r.stiff.status; }}});
  check("e2 = 0.5", soft, 0.19, 0.31, show);
  check("e2 = 1", stiff, 0.20, 0.36, show);
  show.measured("roy/fig-2/sixth-order Runge-Kutta/overflows at step", {}, soft.overflow_from("rk6"));
}

scene::Result<Outcomes> fates_of(double e2) {
  return {fmt::format("outcomes-e2-{}", e2),
          fmt::format(
              "stand-in parameters e1 = 0.25, e2 = {}, e3 = 0.5, from rest to t = 40; RK6 is Butcher's of 7 "
              "stages",
              e2),
          [e2](bool quick) { return runs(e2, quick); }};
}

}  // namespace

std::vector<scene::Scene> scenes() {
  return {{.name = "overflow",
           .title = "Error and overflow of RK4, RK6 and MTL against the step",
           .place = "our own, for Figure 2",
           .content = scene::Content(put, fates_of(0.5), fates_of(1))}};
}

}  // namespace nlmech::chapters::transversal::overflow
