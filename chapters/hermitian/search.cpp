#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>
#include <numbers>
#include <ranges>
#include <string>
#include <utility>
#include <vector>

#include "chapters/hermitian/peak_search.hpp"
#include "nlmech/problems/texts.hpp"
#include "nlmech/scene/scene.hpp"

namespace nlmech::chapters::hermitian::search {
namespace {

constexpr int surrogate_tables = 499;
constexpr std::array kinds = {Surrogates::same_peak, Surrogates::any_peak};
constexpr std::array kind_names = {"same peak", "any peak"};

/// Fits of the surrogates of one kind, one a table.
struct ByChance {
  std::vector<double> all, by_columns, fewest;  ///< misses; minus the rows met
  std::array<std::vector<double>, 3> column;    ///< misses
};

/// All combinations for one table.
struct Search {
  std::string table;
  std::vector<Combination> combinations;
  std::array<int, 10> meeting{};  ///< combinations by the rows that they meet
  Fit fit;
  std::array<ByChance, 2> chance;  ///< same peak, any peak
};

ByChance by_chance(const std::vector<Nine>& all, const std::vector<Nine>& tables) {
  ByChance found;
  for (const Nine& table : tables) {
    const Fit fit = best_fit(all, table);
    found.all.push_back(fit.all.miss);
    found.by_columns.push_back(fit.by_columns());
    found.fewest.push_back(-fit.most);
    for (std::size_t k = 0; k < 3; ++k) found.column.at(k).push_back(fit.columns.at(k).miss);
  }
  return found;
}

Search search_for(const PeakTable& table, std::vector<Combination> combinations) {
  Search s{table.title, std::move(combinations), {}, {}, {}};
  const Nine printed = table.printed();
  std::vector<Nine> all;
  all.reserve(s.combinations.size());
  for (const Combination& c : s.combinations) all.push_back(c.peaks);
  s.fit = best_fit(all, printed);
  for (const Nine& nine : all) ++s.meeting.at(static_cast<std::size_t>(rows_met(nine, printed)));
  for (std::size_t k = 0; k < kinds.size(); ++k)
    s.chance.at(k) = by_chance(all, surrogates(printed, table.exact, kinds.at(k), surrogate_tables));
  return s;
}

std::vector<Search> searches() {
  return {search_for(table_4(), duffing_combinations()), search_for(table_5(), van_der_pol_combinations())};
}

// "(0.01, 0), 2 updates, parabola through three ends"
std::string in_words(const Combination& c, bool has_load) {
  const Program& p = c.program;
  std::string text = fmt::format("({:g}, {:g})", p.x0[0], p.x0[1]);
  if (has_load) {
    constexpr std::array loads = {"cos", "-sin", "-cos", "sin"};
    const double quarter =
        p.begin * problems::TextProblem("laier-duffing").parameter("frequency") / (std::numbers::pi / 2);
    text +=
        fmt::format(", {} ahead by {:g}", loads.at(static_cast<std::size_t>(std::lround(quarter))), p.ahead);
  }
  if (p.no_first) text += ", no first acceleration";
  text += p.updates == 50 ? ", converged" : p.updates == 1 ? ", 1 update" : ", 2 updates";
  if (p.old_load) text += " with the old load";
  return text + ", " + std::string(to_string(c.reading));
}

// Each surrogate's fit and the share of them that is fitted as well or better; the printed table's last.
void draw(const std::vector<Search>& all, scene::Show& show) {
  scene::Plot& plot = show.plots("No reading of Table 4 beats chance; Table 5's start does");
  scene::Table data({{"table"}, {"of"}, {"miss"}, {"share"}});
  for (const Search& s : all) {
    const bool first = s.table == "Table 4";
    scene::Panel& panel =
        plot.panel("greatest miss of the best combination (10^{−4})", "share of tables by chance");
    panel.caption(s.table)
        .set("bmargin at screen 0.28")
        .set("logscale x")
        .x_range(first ? 5 : 0.5, 1000)
        .y_range(0, 1);
    panel.key(first ? "at screen 0.53, screen 0.01 center bottom maxrows 1 width -2 samplen 3" : "off");
    const auto curve = [&](const char* name, const char* of, const char* look, int style) {
      panel.columns(name,
                    fmt::format("(strcol('table') eq '{}' && strcol('of') eq '{}' ? column('miss') : "
                                "NaN):share",
                                s.table, of),
                    {look, style});
    };
    for (std::size_t k = 0; k < kinds.size(); ++k) {
      std::vector<double> sorted = s.chance.at(k).all;
      std::ranges::sort(sorted);
      for (std::size_t i = 0; i < sorted.size(); ++i)
        data.add({s.table, kind_names.at(k), sorted[i], static_cast<double>(i + 1) / surrogate_tables});
    }
    for (const double share : {0.0, 1.0}) data.add({s.table, "printed", s.fit.all.miss, share});
    curve("by chance, same peak", "same peak", "lines dashtype 1", 1);
    curve("by chance, any peak", "any peak", "lines dashtype 2", 2);
    curve("as printed", "printed", "lines dashtype 1", 3);
  }
  plot.size(900, 520).data(std::move(data));
}

/// A row of the table: what one combination is best for.
struct Row {
  std::string table, what;
  double miss, same_peak, any_peak;  ///< in 1e-4; how often chance fits as well
  std::string combination;
};

std::vector<Row> rows_of(const Search& s) {
  const auto row = [&](const std::string& what, const Best& best, const std::vector<double>& same,
                       const std::vector<double>& any) {
    return Row{s.table,
               what,
               best.miss,
               chance_of(same, best.miss),
               chance_of(any, best.miss),
               in_words(s.combinations.at(best.number), s.table == "Table 4")};
  };
  const auto& [same, any] = s.chance;
  std::vector<Row> rows = {row("all nine", s.fit.all, same.all, any.all)};
  constexpr std::array names = {"Laier's column", "Argyris' column", "Newmark's column"};
  for (std::size_t k = 0; k < names.size(); ++k)
    rows.push_back(row(names.at(k), s.fit.columns.at(k), same.column.at(k), any.column.at(k)));
  return rows;
}

void check_chances(const Search& s, scene::Show& show) {
  const bool found = s.table == "Table 5";
  const auto share = [&](const char* of, double value, double low, double high, const char* reason) {
    show.between(fmt::format("{}: share of surrogates with {}", s.table, of), value, low, high, reason);
  };
  const auto& [same, any] = s.chance;
  const char* verdict = found ? "a reading is inferred only where chance fits as well once in 100 or less"
                              : "nothing is inferred where chance fits as well more than once in 100";
  const double low = found ? 0 : 0.01, high = found ? 0.01 : 1;
  share("any peak that are fitted as well", chance_of(any.all, s.fit.all.miss), low, high, verdict);
  share("any peak of which as many rows are met", chance_of(any.fewest, -s.fit.most), low, high, verdict);
  const char* open = "above once in 100: beyond the peak nothing is explained";
  share("the same peak that are fitted as well", chance_of(same.all, s.fit.all.miss), 0.01, 1, open);
  share("the same peak of which as many rows are met", chance_of(same.fewest, -s.fit.most), 0.01, 1, open);
  share("the same peak that are fitted as well by columns", chance_of(same.by_columns, s.fit.by_columns()),
        0.01, 1, open);
  share("any peak that are fitted as well by columns", chance_of(any.by_columns, s.fit.by_columns()), 0, 0.01,
        "the peaks 0.538 and -0.3193 are those of searched starts");
}

void put_fits(const std::vector<Search>& all, scene::Show& show) {
  draw(all, show);
  std::vector<Row> rows;
  for (const Search& s : all) std::ranges::move(rows_of(s), std::back_inserter(rows));
  show.table(rows, {{"table", &Row::table},
                    {"combination for", &Row::what},
                    {"greatest miss (1e-4)", &Row::miss},
                    {"by chance, same peak", &Row::same_peak},
                    {"by chance, any peak", &Row::any_peak},
                    {"combination", &Row::combination}});
  const Search &duffing = all[0], &van_der_pol = all[1];
  show.equals("combinations for Table 4", duffing.combinations.size(), 64800,
              "45 starts, 4 loads, 9 timings, 2 first steps, 4 iterations, 5 readings");
  show.equals("combinations for Table 5", van_der_pol.combinations.size(), 1320,
              "44 starts, 2 first steps, 3 iterations, 5 readings");
  show.between(
      "Table 4: greatest miss of the best combination", duffing.fit.all.miss, 10, 567,
      "the plain run from rest misses by 567, 0.5383 - 0.4816; a reading would have to miss by units");
  show.between("Table 4: greatest miss with a combination for each column", duffing.fit.by_columns(), 1,
               duffing.fit.all.miss, "no worse than one combination for all; a unit would be a fit");
  show.between("Table 5: greatest miss of the best combination", van_der_pol.fit.all.miss, 1, 2.75,
               "the plain run from (0.01, 0) misses by 2.75, -0.312725 against -0.3130");
  for (const Search& s : all) check_chances(s, show);
}

void put_rows(const std::vector<Search>& all, scene::Show& show) {
  show.table(std::views::iota(std::size_t{0}, std::size_t{10}),
             {{"numbers met to a unit", std::identity()},
              {"combinations, Table 4", [&](std::size_t k) { return all[0].meeting.at(k); }},
              {"combinations, Table 5", [&](std::size_t k) { return all[1].meeting.at(k); }}});
  show.between("greatest number met of Table 4", all[0].fit.most, 0, 3,
               "a reading that gives fewer than half of the nine explains none of them");
  show.equals("greatest number met of Table 5", all[1].fit.most, 6,
              "the plain run from (0.01, 0) by tools/oracles/hermitian_peaks.py");
}

}  // namespace

std::vector<scene::Scene> scenes() {
  const scene::Result result("peak-searches",
                             "one combination of start, load's timing, first step, iterations "
                             "and reading for all numbers of a table",
                             searches);
  return {{.name = "peak-search",
           .title = "What fits Tables 4 and 5, and how well chance alone is fitted",
           .content = scene::Content(put_fits, result)},
          {.name = "peak-search-rows",
           .title = "How many of the nine numbers the combinations give",
           .content = scene::Content(put_rows, result)}};
}

}  // namespace nlmech::chapters::hermitian::search
