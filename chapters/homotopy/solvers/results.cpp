#include "chapters/homotopy/solvers/results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include "chapters/printed_values.hpp"
#include "nlmech/support/stopwatch.hpp"

namespace nlmech::chapters::homotopy {
namespace {

/// A printed row and its results with two Jacobians.
struct Row {
  PrintedRow printed;
  scene::Result<IterationRun> exact;  ///< Jacobian is the derivative of F
  scene::Result<IterationRun>
      misprinted;  ///< Jacobian with d_5 held constant (Williams) or A_nd as printed (element)
};

std::string short_name(Scheme scheme) {
  switch (scheme) {
    case Scheme::newton: return "newton";
    case Scheme::fixed_point: return "fixed-point";
    default: return "newton-homotopy";
  }
}

IterationRun run(const PrintedRow& row, Model model) {
  LoadedToggle toggle(model, row.height, row.load);
  IterationRun ran;
  ran.scale = toggle.scale();
  ran.count = iterate(toggle, row.iteration, &ran.trace);
  for (int k = 1; k <= 16; ++k) {
    LoadedToggle other(model, row.height, row.load * (1 + k * std::numeric_limits<double>::epsilon()));
    ran.scattered.push_back(iterate(other, row.iteration).iterations);
  }
  return ran;
}

/// The rows of one table.
std::vector<Row> rows_of(const std::string& table) {
  std::vector<Row> all;
  for (const PrintedRow& row : printed_rows()) {
    if (row.table != table) continue;
    const bool williams = row.model == Model::williams;
    const std::string name = fmt::format("{}-{}", row.table, short_name(row.iteration.scheme));
    const std::string setting = fmt::format(
        "from rest, |F| <= {:.3g} lb{}", row.iteration.tolerance,
        row.iteration.scheme == Scheme::newton ? "" : fmt::format(", Euler's rule, step {}", example_step));
    const Model other = williams ? Model::williams_frozen : Model::element_printed;
    all.push_back(
        {row,
         {name, setting + ", Jacobian is the derivative of F", [row] { return run(row, row.model); }},
         {name + "-other-jacobian",
          setting + (williams ? ", Jacobian with d_5 held constant" : ", A_nd of Eq. 2.35 as printed"),
          [row, other] { return run(row, other); }}});
  }
  return all;
}

/// Name of the printed iteration count or accuracy of a row.
std::string name_of(const PrintedRow& row, bool count) {
  const char* quantity = !count                ? "achieved accuracy"
                         : row.printed == 1000 ? "iterations (no convergence)"
                                               : "iterations";
  return fmt::format("elgohary/{}/{}/{}", row.table, row.method, quantity);
}

/// The accuracy as defined in the source: |F| for Williams' equation, |F|/|F(0)| for elements.
double accuracy_of(const PrintedRow& row, const IterationRun& ran) {
  return row.relative ? ran.count.residual / ran.scale : ran.count.residual;
}

/// A row of the output table.
struct Line {
  const PrintedRow& row;
  const IterationRun &exact, &other;
  std::string verdict, reading;

  [[nodiscard]] const std::string& method() const { return row.method; }
  [[nodiscard]] int printed() const { return row.printed; }
  [[nodiscard]] double accuracy() const { return row.accuracy; }
  [[nodiscard]] std::string count() const { return exact.count_text(); }
  [[nodiscard]] double residual() const { return exact.count.residual; }
  [[nodiscard]] double relative() const { return exact.count.residual / exact.scale; }
  [[nodiscard]] std::string other_count() const { return other.count_text(); }
  [[nodiscard]] double other_relative() const { return other.count.residual / other.scale; }
};

void put_table(const Results& all, scene::Show& show) {
  const auto values = printed_values(all.printed.front().table);
  std::vector<Line> lines;
  for (std::size_t i = 0; i < all.printed.size(); ++i) {
    const PrintedRow& row = all.printed[i];
    const IterationRun &exact = *all.exact[i], &other = *all.misprinted[i];
    // The printed equations give the derivative of F for Williams' equation, but A_nd without the factor l.
    const bool swapped = row.model != Model::williams;
    const auto in_order = [swapped](double with_derivative, double with_other) {
      return swapped ? scene::Measured{with_other, with_derivative}
                     : scene::Measured{with_derivative, with_other};
    };
    const scene::Measured counts = in_order(exact.median_count(), other.median_count()),
                          accuracy = in_order(accuracy_of(row, exact), accuracy_of(row, other));
    show.measured(name_of(row, true), counts.nominal, counts.inferred);
    show.measured(name_of(row, false), accuracy.nominal, accuracy.inferred);
    const scene::PublishedValue& value = values.at(name_of(row, true));
    lines.push_back(
        {row, exact, other, std::string(to_string(scene::verdict_on(value, counts).verdict)), value.reading});
  }
  show.table(lines, {{"method", &Line::method},
                     {"printed iterations", &Line::printed},
                     {"printed accuracy", &Line::accuracy},
                     {"iterations", &Line::count},
                     {"|F| (lb)", &Line::residual},
                     {"|F|/|F(0)|", &Line::relative},
                     {"iterations, other Jacobian", &Line::other_count},
                     {"|F|/|F(0)|, other Jacobian", &Line::other_relative, 4},
                     {"verdict", &Line::verdict},
                     {"cause or reading", &Line::reading}});
}

/// Draws the first iterates: residuals for elements, deflections for Williams' equation.
void draw(scene::Panel& panel, const History& h, const Row& row, const IterationRun& ran,
          const std::string& name, int style, const char* look) {
  std::vector<double> k, value;
  for (const IterationRecord& t : ran.trace) {
    if (k.size() > static_cast<std::size_t>(h.shown)) break;
    k.push_back(static_cast<double>(k.size()));
    value.push_back(row.printed.model == Model::element ? t.residual / ran.scale : t.deflection);
  }
  panel.curve(name, k, value, {look, style});
}

const char* const marked = "linespoints linewidth 1.2";

void check_history(const History& h, const Row& row, const IterationRun& exact, const IterationRun* other,
                   scene::Show& show) {
  const double tolerance = row.printed.iteration.tolerance;
  show.at_most("|F| of the last iterate", {exact.count.residual, "lb"}, tolerance, "the tolerance");
  show.at_most("error of the last deflection", {std::abs(exact.trace.back().deflection - h.root), "in"},
               tolerance / h.stiffness + 1e-9,
               "|F| over the slope of F near the root of tools/oracles/homotopy_williams.py or "
               "homotopy_frames.py");
  if (h.scheme == Scheme::newton && other != nullptr)
    show.equals("iterations with the other Jacobian", other->count.iterations, 1000,
                "it does not converge (misprint-study); printed: 1000");
}

/// Axis label of the iterates.
const char* label_of(const Row& row) {
  return row.printed.model == Model::element ? "|{/:Italic F}|/|{/:Italic F}(0)|"
                                             : "deflection {/:Italic δ} (in)";
}

double level_of(const History& h, const Row& row, const IterationRun& ran) {
  return row.printed.model == Model::element ? row.printed.iteration.tolerance / ran.scale : h.root;
}

const char* level_name(const Row& row) { return row.printed.model == Model::element ? "tolerance" : "root"; }

/// Captions for the derivative of F and for the other Jacobian.
std::pair<const char*, const char*> names_of(const Row& row) {
  if (row.printed.model == Model::element) return {"consistent tangent", "{/:Italic A}_{nd} as printed"};
  return {"derivative of {/:Italic F}", "{/:Italic d}_{5} held constant in the Jacobian"};
}

void put_alone(const History& h, const Row& row, const IterationRun& exact, scene::Show& show) {
  const double level = level_of(h, row, exact);
  scene::Panel& panel = show.plot(h.heading, "iteration", label_of(row));
  panel.x_range(0, h.shown).key("bottom right");
  panel.curve(level_name(row), {0, static_cast<double>(h.shown)}, {level, level}, scene::lines(13));
  draw(panel, h, row, exact, "iterates", 1, marked);
  check_history(h, row, exact, nullptr, show);
}

/// Draws both iterations in stacked panels and checks them.
void put_both(const History& h, const Row& row, const IterationRun& exact, const IterationRun& other,
              scene::Show& show) {
  scene::Plot& plot = show.plots(h.heading);
  plot.stacked();
  const auto add = [&](const IterationRun& ran, const char* caption, int style) {
    scene::Panel& panel = plot.panel("iteration", label_of(row));
    panel.x_range(0, h.shown).caption(caption).key("off").level(level_of(h, row, ran), level_name(row));
    if (row.printed.model == Model::element)
      panel.log_y(1e-9, 1e3).set("ytics 1000");
    else
      panel.y_range(-0.6, 1.6);
    draw(panel, h, row, ran, "", style, marked);
  };
  const auto [derivative, another] = names_of(row);
  add(exact, derivative, 1);
  add(other, another, 5);
  check_history(h, row, exact, &other, show);
}

/// The table row shown by a figure.
Row row_of(const History& h) {
  const std::vector<Row> rows = rows_of(h.table);
  return *std::ranges::find(rows, h.scheme, [](const Row& r) { return r.printed.iteration.scheme; });
}

}  // namespace

double IterationRun::median_count() const { return median({scattered.begin(), scattered.end()}); }

std::string IterationRun::count_text() const {
  const auto [least, most] = std::ranges::minmax(scattered);
  if (least == most && most == count.iterations) return std::to_string(least);
  return fmt::format("{:g} ({} to {})", median_count(), least, most);
}

scene::Scene result_table(const std::string& table, const std::string& title,
                          const std::function<void(const Results&, scene::Show&)>& check) {
  std::vector<PrintedRow> printed;
  std::vector<scene::Result<IterationRun>> exact, misprinted;
  for (const Row& row : rows_of(table)) {
    printed.push_back(row.printed);
    exact.push_back(row.exact);
    misprinted.push_back(row.misprinted);
  }
  const auto put = [printed, check](const std::vector<const IterationRun*>& runs,
                                    const std::vector<const IterationRun*>& other, scene::Show& show) {
    const Results all{printed, runs, other};
    put_table(all, show);
    check(all, show);
  };
  return {.name = table,
          .title = title,
          .place = "Table " + table.substr(6),
          .content = scene::Content(put, exact, misprinted)};
}

scene::Scene history(const History& h) {
  const Row row = row_of(h);
  const auto with_other = [h, row](const IterationRun& exact, const IterationRun& other, scene::Show& show) {
    put_both(h, row, exact, other, show);
  };
  const auto alone = [h, row](const IterationRun& exact, scene::Show& show) {
    put_alone(h, row, exact, show);
  };
  return {.name = h.name,
          .title = h.title,
          .place = "Figure " + h.name.substr(4),
          .content = h.other ? scene::Content(with_other, row.exact, row.misprinted)
                             : scene::Content(alone, row.exact)};
}

}  // namespace nlmech::chapters::homotopy
