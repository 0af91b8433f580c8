#include <fmt/format.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "chapters/hermitian/peaks.hpp"
#include "chapters/printed_values.hpp"
#include "nlmech/scene/scene.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::chapters::hermitian::tables {
namespace {

/// First peaks by the operators of Laier, Argyris and Newmark: step size 0.2, then 0.1, then 0.05.
using Nine = std::array<double, 9>;
constexpr std::array peak_steps = {0.2, 0.1, 0.05};
constexpr std::array peak_operators = {ivp::laier, ivp::argyris, ivp::newmark_pair};
constexpr std::array peak_columns = {"Laier", "Argyris", "Newmark"};

/// One of the paper's two tables of first peaks.
struct PeakTable {
  const char *place, *oscillator;
  Case what;     ///< equation and initial state
  double exact;  ///< reference value of the first peak

  /// Name of printed number @p i, as PublishedValue::name().
  [[nodiscard]] std::string name(std::size_t i) const {
    return fmt::format("laier/{}/dt = {} {}/first peak of the {} oscillator", place, peak_steps.at(i / 3),
                       peak_columns.at(i % 3), oscillator);
  }
};

/// A value of Table 4 or 5.
struct Row {
  std::string column;  ///< operators, such as "Laier"
  double step;
  double printed, computed, on_grid;  ///< `computed`: dense output; `on_grid`: ends of steps
  double printed_error, error;        ///< errors of `printed` and `computed` against the exact peak
  std::string name;                   ///< PublishedValue::name()
};

// oracle: transversal_motions Laier's Duffing peak, Laier's van der Pol peak
PeakTable table_4() { return {"table-4", "Duffing", duffing_case(), 0.53826530480162931}; }
PeakTable table_5() { return {"table-5", "van der Pol", van_der_pol_case(), -0.31932967523380421}; }

std::vector<Row> peaks(const PeakTable& table) {
  const auto values = printed_values(table.place);
  std::vector<Row> rows;
  for (std::size_t i = 0; i < 9; ++i) {
    const double step = peak_steps.at(i / 3);
    const Peak peak = first_peak(table.what, {.operators = peak_operators.at(i % 3), .step = step}, 20);
    if (!peak.status.ok()) throw Failure(peak.status);
    const double printed = values.at(table.name(i)).value;
    rows.push_back({peak_columns.at(i % 3), step, printed, peak.x, peak.on_grid,
                    std::abs(printed - table.exact), std::abs(peak.x - table.exact), table.name(i)});
  }
  return rows;
}

void draw(const std::vector<Row>& rows, const std::string& heading, scene::Show& show) {
  scene::Panel& panel = show.plot(heading, "step (s)", "error of the first peak");
  panel.log_x(0.045, 0.22).set("xtics (0.05, 0.1, 0.2)").set("format x '%g'").log_y(1e-10, 1);
  panel.set("bmargin 8.5").key("at screen 0.55, screen 0.02 center bottom horizontal maxrows 2 width 2");
  constexpr std::array styles = {1, 5, 3};
  scene::Table data({{"column"}, {"step"}, {"printed"}, {"computed"}});
  for (std::size_t k = 0; k < 3; ++k) {
    for (const std::size_t i : {k, k + 3, k + 6})
      data.add({rows[i].column, rows[i].step, rows[i].printed_error, rows[i].error});
  }
  const auto curve = [&](std::size_t k, const char* what, int dashes) {
    panel.columns(
        fmt::format("{}, {}", peak_columns.at(k), what),
        fmt::format("step:(strcol('column') eq '{}' ? column('{}') : NaN)", peak_columns.at(k), what),
        {fmt::format("linespoints dashtype {}", dashes), styles.at(k)});
  };
  for (std::size_t k = 0; k < 3; ++k) curve(k, "printed", 3);
  for (std::size_t k = 0; k < 3; ++k) curve(k, "computed", 1);
  show.figure().data(std::move(data));
}

/// Reference values of the nine peaks and their relative tolerances for orders 4 and 2.
struct Known {
  Nine values;
  double fourth, second;
  const char* reason;
};

void put(const std::vector<Row>& rows, const std::string& heading, const Known& known, scene::Show& show) {
  draw(rows, heading, show);
  show.table(rows, {{"step", &Row::step},
                    {"operators", &Row::column},
                    {"printed", &Row::printed, 4},
                    {"computed", &Row::computed, 9},
                    {"at ends of steps", &Row::on_grid, 6}});
  for (std::size_t i = 0; i < 9; ++i) {
    const Row& r = rows[i];
    show.near(fmt::format("{}, step {}", r.column, r.step), r.computed, known.values.at(i),
              r.column == "Newmark" ? known.second : known.fourth, known.reason);
    show.measured(r.name, {}, r.computed);
  }
}

void put_duffing(const std::vector<Row>& rows, scene::Show& show) {
  // oracle: hermitian_peaks Duffing * h = 0.?, Duffing * h = 0.05
  constexpr Nine known = {0.538264556, 0.538265355, 0.537396,    0.538265258, 0.538265308,
                          0.538046,    0.538265302, 0.538265305, 0.538211};
  put(rows, "First peak: printed errors of order 1, computed errors of order 2 and 4",
      {known, 2e-7, 2e-6, "tools/oracles/hermitian_peaks.py, nine digits"}, show);
  for (std::size_t k = 0; k < 3; ++k) {
    const double coarse = rows[k].printed, middle = rows[k + 3].printed, fine = rows[k + 6].printed;
    show.between("order of the printed column, " + rows[k].column,
                 std::log2((middle - coarse) / (fine - middle)), 0.9, 1.3,
                 "from its three numbers; the methods are of order 4, 4 and 2");
  }
}

void put_van_der_pol(const std::vector<Row>& rows, scene::Show& show) {
  // oracle: hermitian_peaks van der Pol *
  constexpr Nine known = {-0.31932979, -0.31933209,  -0.312725,    -0.31932968, -0.31932983,
                          -0.317667,   -0.319329676, -0.319329685, -0.318913};
  put(rows, "First peak from (0.01, 0): six numbers of Table 5 are reproduced",
      {known, 4e-8, 3e-6, "tools/oracles/hermitian_peaks.py, eight digits"}, show);
}

/// Highest power that an operator reproduces exactly.
int degree_of(const ivp::HermitianOperator& op) {
  int degree = 0;
  while (degree < 8 && std::abs(ivp::residual_on_power(op, degree + 1)) < 1e-12) ++degree;
  return degree;
}

void put_operators(scene::Show& show) {
  scene::Table table(
      {{"operators"}, {"A"}, {"B"}, {"C"}, {"D"}, {"E"}, {"F"}, {"G"}, {"H"}, {"degree"}, {"order"}});
  for (const ivp::HermitianPair& pair : ivp::hermitian_table) {
    const int order = ivp::order_of(ivp::solved_for_end(pair));
    double worst = 0;
    for (const ivp::HermitianOperator* op : {&pair.first, &pair.second}) {
      table.add({pair.name, op->A, op->B, op->C, op->D, op->E, op->F, op->G, op->H, degree_of(*op), order});
      for (int k = 0; k <= order; ++k) worst = std::max(worst, std::abs(ivp::residual_on_power(*op, k)));
    }
    const bool high = pair.name == "laier" || pair.name == "argyris";
    show.equals(fmt::format("order of {}", pair.name), order, high ? 4 : 2, "Taylor's expansion, by hand");
    show.at_most(fmt::format("residual on powers up to the order, {}", pair.name), worst, 1e-14,
                 "rounding of coefficients up to 12");
  }
  show.table(std::move(table));
}

}  // namespace

std::vector<scene::Scene> scenes() {
  const scene::Result duffing(
      "duffing-peaks",
      "start: at rest, which the paper does not state; peak: zero of the velocity in the dense output",
      [] { return peaks(table_4()); });
  const scene::Result van_der_pol("van-der-pol-peaks",
                                  "start: (0.01, 0), which tools/oracles/hermitian_search.py finds and the "
                                  "paper does not state; peak as for Duffing",
                                  [] { return peaks(table_5()); });
  return {{.name = "table-1",
           .title = "The operators, corrected, and their orders",
           .place = "Table 1",
           .content = scene::Content(put_operators)},
          {.name = "table-4",
           .title = "First peak of the Duffing oscillator",
           .place = "Table 4",
           .content = scene::Content(put_duffing, duffing)},
          {.name = "table-5",
           .title = "First peak of the van der Pol oscillator",
           .place = "Table 5",
           .content = scene::Content(put_van_der_pol, van_der_pol)}};
}

}  // namespace nlmech::chapters::hermitian::tables
