#include <fmt/format.h>

#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "chapters/hermitian/peak_search.hpp"
#include "chapters/hermitian/scenes.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::chapters {
namespace {

using scene::Workshop;

constexpr std::array titles = {"Laier", "Argyris", "Newmark"};
using Grid = std::array<std::array<double, 3>, 3>;  // [step][column]

/// Peaks of one oscillator.
struct Peaks {
  Grid between;  ///< by the dense output
  Grid on_grid;  ///< at the ends of steps
};

double peak_of(const Case& what, std::size_t i, std::size_t k, bool on_grid = false) {
  const Peak peak = first_peak(what, {.operators = peak_operators.at(k), .step = peak_steps.at(i)}, 20);
  if (!peak.status.ok()) throw Failure(peak.status);
  return on_grid ? peak.on_grid : peak.x;
}

Peaks peaks(const Case& what) {
  Peaks p{};
  for (std::size_t i = 0; i < peak_steps.size(); ++i) {
    for (std::size_t k = 0; k < peak_operators.size(); ++k) {
      p.between.at(i).at(k) = peak_of(what, i, k);
      p.on_grid.at(i).at(k) = peak_of(what, i, k, true);
    }
  }
  return p;
}

/// The order at which a column of the printed table converges, from its three numbers.
double printed_order(const Nine& printed, std::size_t k) {
  return std::log2((printed.at(3 + k) - printed.at(k)) / (printed.at(6 + k) - printed.at(3 + k)));
}

scene::Table peak_table(const Peaks& p, const Nine& printed) {
  scene::Table table({{"step", 3}, {"operators"}, {"printed", 4}, {"ours", 9}, {"at ends of steps", 6}});
  for (std::size_t i = 0; i < peak_steps.size(); ++i) {
    for (std::size_t k = 0; k < peak_operators.size(); ++k) {
      table.add({peak_steps.at(i), titles.at(k), printed.at(3 * i + k), p.between.at(i).at(k),
                 p.on_grid.at(i).at(k)});
    }
  }
  return table;
}

scene::Table peak_data(const Peaks& p, const Nine& printed, double exact) {
  scene::Table data({{"column"}, {"step"}, {"printed"}, {"ours"}});
  for (std::size_t k = 0; k < peak_operators.size(); ++k) {
    for (std::size_t i = 0; i < peak_steps.size(); ++i) {
      data.add({titles.at(k), peak_steps.at(i), std::abs(printed.at(3 * i + k) - exact),
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
  showing.table = peak_table(p, printed_duffing);
  // oracle: hermitian_peaks Duffing * h = 0.?, Duffing * h = 0.05
  const char* known = "tools/oracles/hermitian_peaks.py, nine digits";
  constexpr Grid reference = {{{0.538264556, 0.538265355, 0.537396},
                               {0.538265258, 0.538265308, 0.538046},
                               {0.538265302, 0.538265305, 0.538211}}};
  for (std::size_t i = 0; i < peak_steps.size(); ++i) {
    for (std::size_t k = 0; k < peak_operators.size(); ++k) {
      showing.quantities.push_back(scene::near(fmt::format("{}, step {}", titles.at(k), peak_steps.at(i)),
                                               "1", p.between.at(i).at(k), reference.at(i).at(k),
                                               k == 2 ? 2e-6 : 2e-7, known));
    }
  }
  for (std::size_t k = 0; k < peak_operators.size(); ++k) {
    showing.quantities.push_back({fmt::format("order of the printed column, {}", titles.at(k)), "1",
                                  printed_order(printed_duffing, k), 0.9, 1.3,
                                  "from its three numbers; the methods are of order 4, 4 and 2"});
  }
  return showing;
}

scene::Showing show_table_5(const Peaks& p) {
  scene::Showing showing;
  showing.figure = {peak_data(p, printed_van_der_pol, exact_van_der_pol),
                    "hermitian-peaks",
                    {{"heading", "From (0.01, 0) the methods give six numbers of Table 5"}}};
  showing.table = peak_table(p, printed_van_der_pol);
  // oracle: hermitian_peaks van der Pol *
  constexpr Grid reference = {{{-0.31932979, -0.31933209, -0.312725},
                               {-0.31932968, -0.31932983, -0.317667},
                               {-0.319329676, -0.319329685, -0.318913}}};
  for (std::size_t i = 0; i < peak_steps.size(); ++i) {
    for (std::size_t k = 0; k < peak_operators.size(); ++k) {
      showing.quantities.push_back(scene::near(
          fmt::format("{}, step {}", titles.at(k), peak_steps.at(i)), "1", p.between.at(i).at(k),
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
  for (std::size_t i = 0; i < peak_steps.size(); ++i) {
    for (std::size_t k = 0; k < peak_operators.size(); ++k) {
      const std::string row = fmt::format("dt = {} {}", peak_steps.at(i), titles.at(k));
      chapter.add({.name = fmt::format("laier/table-4/{}/first peak of the Duffing oscillator", row),
                   .needs = {&duffing},
                   .measure = [&duffing, i, k](Workshop& w) {
                     return scene::Measured{{}, w.result(duffing).between.at(i).at(k)};
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
      [](Workshop&) { return peaks(duffing_case()); });
  const auto& van_der_pol = chapter.add_run<Peaks>(
      "van-der-pol-peaks",
      "start: (0.01, 0), which the search finds and the paper does not say; peak as for Duffing", {},
      [](Workshop&) { return peaks(van_der_pol_case()); });
  chapter.add({.name = "table-1",
               .title = "The operators, corrected, and their orders",
               .place = "Table 1",
               .needs = {},
               .show = [](Workshop&) { return show_table_1(); }});
  chapter.add({.name = "table-4",
               .title = "First peak of the Duffing oscillator",
               .place = "Table 4",
               .needs = {&duffing},
               .show = [&duffing](Workshop& w) { return show_table_4(w.result(duffing)); }});
  chapter.add({.name = "table-5",
               .title = "First peak of the van der Pol oscillator",
               .place = "Table 5",
               .needs = {&van_der_pol},
               .show = [&van_der_pol](Workshop& w) { return show_table_5(w.result(van_der_pol)); }});
  add_measurements(chapter, duffing, van_der_pol);
}

}  // namespace nlmech::chapters
