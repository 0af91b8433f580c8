#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <string>
#include <vector>

#include "chapters/hermitian/peak_search.hpp"
#include "chapters/hermitian/scenes.hpp"

namespace nlmech::chapters {
namespace {

using scene::Workshop;

constexpr int surrogate_tables = 499;
constexpr std::array kinds = {Surrogates::same_peak, Surrogates::any_peak};

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

Search search(std::string table, std::vector<Combination> combinations, const Nine& printed, double peak) {
  Search s{std::move(table), std::move(combinations), {}, {}, {}};
  std::vector<Nine> all;
  all.reserve(s.combinations.size());
  for (const Combination& c : s.combinations) all.push_back(c.peaks);
  s.fit = best_fit(all, printed);
  for (const Nine& nine : all) ++s.meeting.at(static_cast<std::size_t>(rows_met(nine, printed)));
  for (std::size_t k = 0; k < kinds.size(); ++k)
    s.chance.at(k) = by_chance(all, surrogates(printed, peak, kinds.at(k), surrogate_tables));
  return s;
}

std::vector<Search> searches() {
  return {search("Table 4", duffing_combinations(), printed_duffing, exact_duffing),
          search("Table 5", van_der_pol_combinations(), printed_van_der_pol, exact_van_der_pol)};
}

// "(0.01, 0), 2 updates, parabola through three ends"
std::string in_words(const Combination& c, bool has_load) {
  const Program& p = c.program;
  std::string text = fmt::format("({:g}, {:g})", p.x0[0], p.x0[1]);
  if (has_load) {
    constexpr std::array loads = {"cos", "-sin", "-cos", "sin"};
    const double quarter = p.begin * laier_duffing().frequency / (std::numbers::pi / 2);
    text +=
        fmt::format(", {} ahead by {:g}", loads.at(static_cast<std::size_t>(std::lround(quarter))), p.ahead);
  }
  if (p.no_first) text += ", no first acceleration";
  text += p.updates == 50 ? ", converged" : p.updates == 1 ? ", 1 update" : ", 2 updates";
  if (p.old_load) text += " with the old load";
  return text + ", " + std::string(to_string(c.reading));
}

scene::Table fits(const std::vector<Search>& all) {
  scene::Table table({{"table"},
                      {"combination for"},
                      {"greatest miss (1e-4)", 3},
                      {"by chance, same peak", 3},
                      {"by chance, any peak", 3},
                      {"combination"}});
  constexpr std::array names = {"Laier's column", "Argyris' column", "Newmark's column"};
  for (const Search& s : all) {
    const bool has_load = s.table == "Table 4";
    const auto add = [&](const char* what, const Best& best, const std::vector<double>& same,
                         const std::vector<double>& any) {
      table.add({s.table, what, best.miss, chance_of(same, best.miss), chance_of(any, best.miss),
                 in_words(s.combinations.at(best.number), has_load)});
    };
    add("all nine", s.fit.all, s.chance[0].all, s.chance[1].all);
    for (std::size_t k = 0; k < names.size(); ++k)
      add(names.at(k), s.fit.columns.at(k), s.chance[0].column.at(k), s.chance[1].column.at(k));
  }
  return table;
}

// Each surrogate's fit and the share of them that is fitted as well or better; the printed table's last.
scene::Table distributions(const std::vector<Search>& all) {
  scene::Table data({{"table"}, {"of"}, {"miss"}, {"share"}});
  constexpr std::array names = {"same peak", "any peak"};
  for (const Search& s : all) {
    for (std::size_t k = 0; k < names.size(); ++k) {
      std::vector<double> sorted = s.chance.at(k).all;
      std::sort(sorted.begin(), sorted.end());
      for (std::size_t i = 0; i < sorted.size(); ++i)
        data.add({s.table, names.at(k), sorted[i], static_cast<double>(i + 1) / surrogate_tables});
    }
    for (const double share : {0.0, 1.0}) data.add({s.table, "printed", s.fit.all.miss, share});
  }
  return data;
}

void add_chances(std::vector<scene::Quantity>& quantities, const Search& s) {
  const std::string& t = s.table;
  const bool found = t == "Table 5";
  const auto add = [&](const char* what, double value, double low, double high, const char* reason) {
    quantities.push_back({fmt::format("{}: {}", t, what), "1", value, low, high, reason});
  };
  const auto& [same, any] = s.chance;
  const char* verdict = found ? "a reading is inferred only where chance fits as well once in 100 or less"
                              : "nothing is inferred where chance fits as well more than once in 100";
  const double low = found ? 0 : 0.01, high = found ? 0.01 : 1;
  add("share of surrogates with any peak that are fitted as well", chance_of(any.all, s.fit.all.miss), low,
      high, verdict);
  add("share of surrogates with any peak of which as many rows are met", chance_of(any.fewest, -s.fit.most),
      low, high, verdict);
  const char* open = "above once in 100: beyond the peak nothing is explained";
  add("share of surrogates with the same peak that are fitted as well", chance_of(same.all, s.fit.all.miss),
      0.01, 1, open);
  add("share of surrogates with the same peak of which as many rows are met",
      chance_of(same.fewest, -s.fit.most), 0.01, 1, open);
  add("share of surrogates with the same peak that are fitted as well by columns",
      chance_of(same.by_columns, s.fit.by_columns()), 0.01, 1, open);
  add("share of surrogates with any peak that are fitted as well by columns",
      chance_of(any.by_columns, s.fit.by_columns()), 0, 0.01,
      "the peaks 0.538 and -0.3193 are those of searched starts");
}

scene::Showing show_fits(const std::vector<Search>& all) {
  scene::Showing showing;
  showing.figure = {distributions(all),
                    "hermitian-peak-search",
                    {{"heading", "No reading of Table 4 is better than chance; the start of Table 5 is"},
                     {"width", "900"}}};
  showing.table = fits(all);
  auto& q = showing.quantities;
  const Search &duffing = all[0], &van_der_pol = all[1];
  q.push_back(scene::near("combinations for Table 4", "1", static_cast<double>(duffing.combinations.size()),
                          64800, 0,
                          "45 starts, 4 loads, 9 timings, 2 first steps, 4 iterations, 5 readings"));
  q.push_back(scene::near("combinations for Table 5", "1",
                          static_cast<double>(van_der_pol.combinations.size()), 1320, 0,
                          "44 starts, 2 first steps, 3 iterations, 5 readings"));
  q.push_back(
      {"Table 4: greatest miss of the best combination", "1", duffing.fit.all.miss, 10, 567,
       "the plain run from rest misses by 567, 0.5383 - 0.4816; a reading would have to miss by units"});
  q.push_back({"Table 4: greatest miss with a combination for each column", "1", duffing.fit.by_columns(), 1,
               duffing.fit.all.miss, "no worse than one combination for all; a unit would be a fit"});
  q.push_back({"Table 5: greatest miss of the best combination", "1", van_der_pol.fit.all.miss, 1, 2.75,
               "the plain run from (0.01, 0) misses by 2.75, -0.312725 against -0.3130"});
  for (const Search& s : all) add_chances(q, s);
  return showing;
}

scene::Showing show_rows(const std::vector<Search>& all) {
  scene::Showing showing;
  scene::Table table({{"numbers met to a unit"}, {"combinations, Table 4"}, {"combinations, Table 5"}});
  for (std::size_t k = 0; k < 10; ++k)
    table.add({static_cast<std::int64_t>(k), std::int64_t{all[0].meeting.at(k)},
               std::int64_t{all[1].meeting.at(k)}});
  showing.table = std::move(table);
  showing.quantities = {{"greatest number met of Table 4", "1", static_cast<double>(all[0].fit.most), 0, 3,
                         "a reading that gives fewer than half of the nine explains none of them"},
                        scene::near("greatest number met of Table 5", "1", all[1].fit.most, 6, 0,
                                    "the plain run from (0.01, 0) by tools/oracles/hermitian_peaks.py")};
  return showing;
}

}  // namespace

void add_search(scene::Chapter& chapter) {
  const auto& run =
      chapter.add_run<std::vector<Search>>("peak-searches",
                                           "one combination of start, load's timing, first step, iterations "
                                           "and reading for all numbers of a table",
                                           {}, [](Workshop&) { return searches(); });
  chapter.add({.name = "peak-search",
               .title = "What fits Tables 4 and 5, and how well chance alone is fitted",
               .place = "our own",
               .needs = {&run},
               .show = [&run](Workshop& w) { return show_fits(w.result(run)); }});
  chapter.add({.name = "peak-search-rows",
               .title = "How many of the nine numbers the combinations give",
               .place = "our own",
               .needs = {&run},
               .show = [&run](Workshop& w) { return show_rows(w.result(run)); }});
}

}  // namespace nlmech::chapters
