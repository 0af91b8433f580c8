#include <fmt/format.h>

#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "chapters/hermitian/peaks.hpp"
#include "chapters/hermitian/scenes.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::chapters {
namespace {

using scene::Workshop;

constexpr std::array steps = {0.2, 0.1, 0.05};
constexpr std::array columns = {ivp::laier, ivp::argyris, ivp::newmark_pair};
constexpr std::array titles = {"Laier", "Argyris", "Newmark"};
using Grid = std::array<std::array<double, 3>, 3>;  // [step][column]

// oracle: transversal_motions Laier's Duffing peak, Laier's van der Pol peak
constexpr double exact_duffing = 0.53826530480162931, exact_van_der_pol = -0.31932967523380421;

constexpr Grid printed_duffing = {
    {{0.5017, 0.4840, 0.4816}, {0.5217, 0.5117, 0.5111}, {0.5302, 0.5253, 0.5251}}};
constexpr Grid printed_van_der_pol = {
    {{-0.3193, -0.3192, -0.3130}, {-0.3193, -0.3192, -0.3177}, {-0.3193, -0.3193, -0.3189}}};

/// Peaks of one oscillator.
struct Peaks {
  Grid between;  ///< by the dense output
  Grid on_grid;  ///< at the ends of steps
  Grid late;     ///< Duffing: as if the load had begun some steps before
};

double peak_of(const Case& what, std::size_t i, std::size_t k, bool on_grid = false) {
  const Peak peak = first_peak(what, {.operators = columns.at(k), .step = steps.at(i)}, what.t0 + 20);
  if (!peak.status.ok()) throw Failure(peak.status);
  return on_grid ? peak.on_grid : peak.x;
}

// By how many steps the load would have to be ahead for the printed columns: one for Laier's, one and a half
// else.
double steps_ahead(std::size_t column) { return column == 0 ? 1 : 1.5; }

Peaks duffing_peaks() {
  Peaks p{};
  for (std::size_t i = 0; i < steps.size(); ++i) {
    for (std::size_t k = 0; k < columns.size(); ++k) {
      p.between.at(i).at(k) = peak_of(duffing_case(), i, k);
      p.on_grid.at(i).at(k) = peak_of(duffing_case(), i, k, true);
      p.late.at(i).at(k) = peak_of(duffing_case(steps_ahead(k) * steps.at(i)), i, k);
    }
  }
  return p;
}

Peaks van_der_pol_peaks() {
  Peaks p{};
  for (std::size_t i = 0; i < steps.size(); ++i) {
    for (std::size_t k = 0; k < columns.size(); ++k) {
      p.between.at(i).at(k) = peak_of(van_der_pol_case(), i, k);
      p.on_grid.at(i).at(k) = peak_of(van_der_pol_case(), i, k, true);
    }
  }
  return p;
}

/// The order at which a column of the printed table converges, from its three numbers.
double printed_order(const Grid& printed, std::size_t k) {
  return std::log2((printed[1].at(k) - printed[0].at(k)) / (printed[2].at(k) - printed[1].at(k)));
}

scene::Table peak_table(const Peaks& p, const Grid& printed, bool late) {
  std::vector<scene::Column> heads = {
      {"step", 3}, {"operators"}, {"printed", 4}, {"ours", 9}, {"at ends of steps", 6}};
  if (late) heads.push_back({"load ahead by 1 or 1.5 steps", 4});
  scene::Table table(std::move(heads));
  for (std::size_t i = 0; i < steps.size(); ++i) {
    for (std::size_t k = 0; k < columns.size(); ++k) {
      std::vector<scene::Cell> row = {steps.at(i), titles.at(k), printed.at(i).at(k), p.between.at(i).at(k),
                                      p.on_grid.at(i).at(k)};
      if (late) row.emplace_back(p.late.at(i).at(k));
      table.add(std::move(row));
    }
  }
  return table;
}

scene::Table peak_data(const Peaks& p, const Grid& printed, double exact) {
  scene::Table data({{"column"}, {"step"}, {"printed"}, {"ours"}});
  for (std::size_t k = 0; k < columns.size(); ++k) {
    for (std::size_t i = 0; i < steps.size(); ++i) {
      data.add({titles.at(k), steps.at(i), std::abs(printed.at(i).at(k) - exact),
                std::abs(p.between.at(i).at(k) - exact)});
    }
  }
  return data;
}

scene::Showing show_table_4(const Peaks& p) {
  scene::Showing showing;
  showing.figure = {peak_data(p, printed_duffing, exact_duffing),
                    "hermitian-peaks",
                    {{"heading", "Table 4 converges at first order, the methods do not"}}};
  showing.table = peak_table(p, printed_duffing, true);
  // oracle: hermitian_peaks Duffing *
  const char* known = "tools/oracles/hermitian_peaks.py, nine digits";
  constexpr Grid reference = {{{0.538264556, 0.538265355, 0.537396},
                               {0.538265258, 0.538265308, 0.538046},
                               {0.538265302, 0.538265305, 0.538211}}};
  for (std::size_t i = 0; i < steps.size(); ++i) {
    for (std::size_t k = 0; k < columns.size(); ++k) {
      showing.quantities.push_back(scene::near(fmt::format("{}, step {}", titles.at(k), steps.at(i)), "1",
                                               p.between.at(i).at(k), reference.at(i).at(k),
                                               k == 2 ? 2e-6 : 2e-7, known));
    }
  }
  for (std::size_t k = 0; k < columns.size(); ++k) {
    showing.quantities.push_back({fmt::format("order of the printed column, {}", titles.at(k)), "1",
                                  printed_order(printed_duffing, k), 0.9, 1.3,
                                  "from its three numbers; the methods are of order 4, 4 and 2"});
  }
  showing.quantities.push_back(scene::near("first printed number with the load a step ahead", "1",
                                           p.late[0][0], 0.5051, 1e-4,
                                           "tools/oracles/hermitian_peaks.py, four digits"));
  return showing;
}

scene::Showing show_table_5(const Peaks& p) {
  scene::Showing showing;
  showing.figure = {peak_data(p, printed_van_der_pol, exact_van_der_pol),
                    "hermitian-peaks",
                    {{"heading", "Table 5 is what the methods give from (0.01, 0)"}}};
  showing.table = peak_table(p, printed_van_der_pol, false);
  // oracle: hermitian_peaks van der Pol *
  constexpr Grid reference = {{{-0.31932979, -0.31933209, -0.312725},
                               {-0.31932968, -0.31932983, -0.317667},
                               {-0.319329676, -0.319329685, -0.318913}}};
  for (std::size_t i = 0; i < steps.size(); ++i) {
    for (std::size_t k = 0; k < columns.size(); ++k) {
      showing.quantities.push_back(scene::near(
          fmt::format("{}, step {}", titles.at(k), steps.at(i)), "1", p.between.at(i).at(k),
          reference.at(i).at(k), k == 2 ? 3e-6 : 4e-8, "tools/oracles/hermitian_peaks.py, eight digits"));
    }
  }
  return showing;
}

scene::Showing show_table_1() {
  scene::Table table(
      {{"operators"}, {"A"}, {"B"}, {"C"}, {"D"}, {"E"}, {"F"}, {"G"}, {"H"}, {"degree"}, {"order"}});
  scene::Showing showing;
  for (const ivp::HermitianPair& pair : ivp::hermitian_table) {
    const int order = ivp::order_of(ivp::solved_for_end(pair));
    double worst = 0;
    for (const ivp::HermitianOperator* op : {&pair.first, &pair.second}) {
      int degree = 0;
      while (degree < 8 && std::abs(ivp::residual_on_power(*op, degree + 1)) < 1e-12) ++degree;
      table.add({std::string(pair.name), op->A, op->B, op->C, op->D, op->E, op->F, op->G, op->H,
                 std::int64_t{degree}, std::int64_t{order}});
      for (int k = 0; k <= order; ++k) worst = std::max(worst, std::abs(ivp::residual_on_power(*op, k)));
    }
    const bool high = pair.name == "laier" || pair.name == "argyris";
    showing.quantities.push_back(scene::near(fmt::format("order of {}", pair.name), "1", order, high ? 4 : 2,
                                             0, "Taylor's expansion, by hand"));
    showing.quantities.push_back(
        scene::at_most(fmt::format("residual on powers up to the order, {}", pair.name), "1", worst, 1e-14,
                       "rounding of coefficients up to 12"));
  }
  showing.table = std::move(table);
  return showing;
}

void add_measurements(scene::Chapter& chapter, const scene::Run<Peaks>& duffing,
                      const scene::Run<Peaks>& van_der_pol) {
  for (std::size_t i = 0; i < steps.size(); ++i) {
    for (std::size_t k = 0; k < columns.size(); ++k) {
      const std::string row = fmt::format("dt = {} {}", steps.at(i), titles.at(k));
      chapter.add({.name = fmt::format("laier/table-4/{}/first peak of the Duffing oscillator", row),
                   .needs = {&duffing},
                   .measure = [&duffing, i, k](Workshop& w) {
                     const double x = w.result(duffing).between.at(i).at(k);
                     return scene::Measured{x, x};
                   }});
      chapter.add({.name = fmt::format("laier/table-5/{}/first peak of the van der Pol oscillator", row),
                   .needs = {&van_der_pol},
                   .measure = [&van_der_pol, i, k](Workshop& w) {
                     return scene::Measured{{}, w.result(van_der_pol).between.at(i).at(k)};
                   }});
    }
  }
}

}  // namespace

void add_tables(scene::Chapter& chapter) {
  const auto& duffing = chapter.add_run<Peaks>(
      "duffing-peaks",
      "start: at rest, which the paper does not say; peak: zero of the velocity in the dense output", {},
      [](Workshop&) { return duffing_peaks(); });
  const auto& van_der_pol = chapter.add_run<Peaks>(
      "van-der-pol-peaks", "start: (0.01, 0), inferred from the printed limit; peak as for Duffing", {},
      [](Workshop&) { return van_der_pol_peaks(); });
  chapter.add({.name = "table-1",
               .title = "The operators, corrected, and their orders",
               .place = "Table 1",
               .needs = {},
               .seconds = 0.1,
               .show = [](Workshop&) { return show_table_1(); }});
  chapter.add({.name = "table-4",
               .title = "First peak of the Duffing oscillator",
               .place = "Table 4",
               .needs = {&duffing},
               .seconds = 0.1,
               .show = [&duffing](Workshop& w) { return show_table_4(w.result(duffing)); }});
  chapter.add({.name = "table-5",
               .title = "First peak of the van der Pol oscillator",
               .place = "Table 5",
               .needs = {&van_der_pol},
               .seconds = 0.1,
               .show = [&van_der_pol](Workshop& w) { return show_table_5(w.result(van_der_pol)); }});
  add_measurements(chapter, duffing, van_der_pol);
}

}  // namespace nlmech::chapters
