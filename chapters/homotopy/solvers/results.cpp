#include "chapters/homotopy/solvers/results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "nlmech/scene/evidence/published.hpp"
#include "nlmech/scene/program/files.hpp"

namespace nlmech::chapters::homotopy {
namespace {

/// What the tables of the source call a row's two numbers.
std::string name_of(const PrintedRow& row, bool count) {
  const char* quantity = !count                ? "achieved accuracy"
                         : row.printed == 1000 ? "iterations (no convergence)"
                                               : "iterations";
  return fmt::format("elgohary/{}/{}/{}", row.table, row.method, quantity);
}

/// The residual as the row prints it: Williams' equation |F| itself, elements |F| over that at rest; in Table
/// 2.4 Newton's is too large for that, and taken for pounds of load.
double accuracy_of(const PrintedRow& row, const Ran& ran) {
  if (!row.relative) return ran.count.residual;
  return ran.count.residual / ran.scale * (row.accuracy > 1 ? row.load : 1);
}

/// The printed values by name.
std::map<std::string, scene::PublishedValue> printed_values() {
  std::map<std::string, scene::PublishedValue> values;
  for (scene::PublishedValue& value : scene::read_published(scene::data_folder()))
    values.emplace(value.name(), std::move(value));
  return values;
}

/// A line of the table.
struct Line {
  const PrintedRow& row;
  const Ran &exact, &other;
  std::string verdict, reading;

  [[nodiscard]] const std::string& method() const { return row.method; }
  [[nodiscard]] int printed() const { return row.printed; }
  [[nodiscard]] double accuracy() const { return row.accuracy; }
  [[nodiscard]] int count() const { return exact.count.iterations; }
  [[nodiscard]] double residual() const { return exact.count.residual; }
  [[nodiscard]] double relative() const { return exact.count.residual / exact.scale; }
  [[nodiscard]] int other_count() const { return other.count.iterations; }
  [[nodiscard]] double other_relative() const { return other.count.residual / other.scale; }
};

void put_table(const Results& all, scene::Show& show) {
  const auto values = printed_values();
  std::vector<Line> lines;
  for (std::size_t i = 0; i < all.printed.size(); ++i) {
    const PrintedRow& row = all.printed[i];
    const Ran &exact = *all.exact[i], &other = *all.misprinted[i];
    show.measured(name_of(row, true), all.count(i), all.other_count(i));
    show.measured(name_of(row, false), accuracy_of(row, exact), accuracy_of(row, other));
    const scene::PublishedValue& value = values.at(name_of(row, true));
    const scene::Measured ours{all.count(i), all.other_count(i)};
    lines.push_back(
        {row, exact, other, std::string(to_string(scene::judge(value, ours).verdict)), value.reading});
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

void draw(scene::Panel& panel, const History& h, const Row& row, const Ran& ran, const std::string& name,
          int style) {
  std::vector<double> k, value;
  for (const Trace& t : ran.trace) {
    if (k.size() > static_cast<std::size_t>(h.shown)) break;
    k.push_back(static_cast<double>(k.size()));
    value.push_back(row.printed.model == Model::element ? t.residual / ran.scale : t.deflection);
  }
  panel.curve(name, k, value, scene::linespoints(style));
}

/// @param other null if only the iteration with the derivative of F is shown
void put_history(const History& h, const Row& row, const Ran& exact, const Ran* other, scene::Show& show) {
  const bool element = row.printed.model == Model::element;
  const double tolerance = row.printed.iteration.tolerance;
  scene::Panel& panel =
      show.plot(h.heading, "iteration",
                element ? "|{/:Italic F}|/|{/:Italic F}(0)|" : "deflection of the apex {/:Italic δ} (in)");
  panel.x_range(0, h.shown);
  if (element) panel.log_y().set("ytics 100");
  if (!element && other != nullptr) panel.y_range(-0.6, 1.6);
  panel.key(other != nullptr ? "below" : "bottom right");
  const double level = element ? tolerance / exact.scale : h.root;
  panel.curve(element ? "tolerance" : "root", {0, static_cast<double>(h.shown)}, {level, level},
              scene::lines(13));
  if (other != nullptr)
    draw(panel, h, row, *other,
         element ? "{/:Italic A}_{nd} as printed" : "{/:Italic d}_{5} held constant in the Jacobian", 5);
  const char* name = element ? "consistent tangent" : "derivative of {/:Italic F}";
  draw(panel, h, row, exact, other != nullptr ? name : "iterates", 1);
  show.at_most("|F| of the last iterate", {exact.count.residual, "lb"}, tolerance, "the tolerance");
  show.at_most("error of the last deflection", {std::abs(exact.trace.back().deflection - h.root), "in"},
               tolerance / h.stiffness + 1e-9,
               "|F| over the slope of F near the root of tools/oracles/homotopy_williams.py or "
               "homotopy_frames.py");
  if (h.scheme == Scheme::newton && other != nullptr)
    show.equals("iterations with the other Jacobian", other->count.iterations, 1000,
                "it does not converge (misprint-study); printed: 1000");
}

}  // namespace

scene::Scene result_table(const std::string& table, const std::string& title,
                          const std::function<void(const Results&, scene::Show&)>& check) {
  std::vector<PrintedRow> printed;
  std::vector<scene::Result<Ran>> exact, misprinted;
  for (const Row& row : rows_of(table)) {
    printed.push_back(row.printed);
    exact.push_back(row.exact);
    misprinted.push_back(row.misprinted);
  }
  const auto put = [printed, check](const std::vector<const Ran*>& ours, const std::vector<const Ran*>& other,
                                    scene::Show& show) {
    const Results all{printed, ours, other};
    put_table(all, show);
    check(all, show);
  };
  return {.name = table,
          .title = title,
          .place = "Table " + table.substr(6),
          .content = scene::Content(put, exact, misprinted)};
}

scene::Scene history(const History& h) {
  const std::vector<Row> rows = rows_of(h.table);
  const Row row = *std::ranges::find(rows, h.scheme, [](const Row& r) { return r.printed.iteration.scheme; });
  const auto with_other = [h, row](const Ran& exact, const Ran& other, scene::Show& show) {
    put_history(h, row, exact, &other, show);
  };
  const auto alone = [h, row](const Ran& exact, scene::Show& show) {
    put_history(h, row, exact, nullptr, show);
  };
  return {.name = h.name,
          .title = h.title,
          .place = "Figure " + h.name.substr(4),
          .content = h.other ? scene::Content(with_other, row.exact, row.misprinted)
                             : scene::Content(alone, row.exact)};
}

}  // namespace nlmech::chapters::homotopy
