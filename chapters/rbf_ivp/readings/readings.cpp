#include "chapters/rbf_ivp/readings/readings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <tuple>

#include "chapters/printed_values.hpp"
#include "nlmech/scene/evidence/published.hpp"
#include "nlmech/scene/scene.hpp"

namespace nlmech::chapters::rbf_ivp::readings {
namespace {

using Questions = std::vector<ReadingChoice>;

/// The option that explains most rows, except the chosen one.
const Option& best_other(const ReadingChoice& q) {
  return *std::ranges::max_element(q.options, {}, [&](const Option& o) {
    return std::tuple(o.text != q.chosen, o.score.exact, o.score.close);
  });
}

std::string of_rows(int explained, const Score& score) {
  return fmt::format("{} of {}", explained, score.rows);
}

scene::Table tabulate(const Questions& questions) {
  return scene::table_of(
      questions,
      {{"question", &ReadingChoice::text},
       {"tables", &ReadingChoice::tables},
       {"options tried", [](const ReadingChoice& q) { return q.options.size(); }},
       {"the text, literally",
        [](const ReadingChoice& q) { return q.literal.empty() ? "not stated" : q.literal; }},
       {"explains",
        [](const ReadingChoice& q) {
          return q.literal.empty() ? "" : of_rows(q.option(q.literal).score.exact, q.option(q.chosen).score);
        }},
       {"chosen", &ReadingChoice::chosen},
       {"explains",
        [](const ReadingChoice& q) {
          const Score& chosen = q.option(q.chosen).score;
          return of_rows(chosen.exact, chosen);
        }},
       {"rounded or cut off",
        [](const ReadingChoice& q) {
          const Score& chosen = q.option(q.chosen).score;
          return of_rows(chosen.close, chosen);
        }},
       {"best of the others", [](const ReadingChoice& q) { return best_other(q).text; }},
       {"explains",
        [](const ReadingChoice& q) { return of_rows(best_other(q).score.exact, best_other(q).score); }}});
}

void check(const Questions& questions, scene::Show& show) {
  const auto explained = [&](const std::string& text, const std::string& option, int low, int high,
                             const char* reason) {
    const auto q = std::ranges::find(questions, text,
                                     [](const ReadingChoice& one) { return one.text + " " + one.tables; });
    show.between(fmt::format("rows explained by '{}'", option), q->option(option).score.exact, low, high,
                 reason);
  };
  explained("end time and period 4.2", "P exact, to 100 P", 7, 9,
            "regression value: nine rows; ODE45-1 and HHT-1 lie within a tenth of a unit of the edge");
  explained("end time and period 4.2", "P = 4.77, to 500 s", 0, 3, "regression value: 500 s misses");
  explained("end time 4.4", "499 s", 5, 5,
            "tools/oracles/rbf_ivp_methods.py: all but HHT-2, probably a misprint");
  explained("alpha of HHT and its form 4.2 4.4 4.6", "alpha = -0.1, form of 1977", 4, 5,
            "regression value: all but HHT-2 of Table 4.4; HHT-1 of Table 4.2 lies on the edge");
  const char* both_rows = "both rows, of which 4.4 and x3 are tools/oracles/rbf_ivp_methods.py";
  explained("restart of the explicit rows 4.4", "v(t_1 - h/2), read as v(t_1 - h/2), to 499 s", 2, 2,
            both_rows);
  explained("component in the explicit rows 4.6", "x3, v0 - h/2 a0, v(-h/2) first", 2, 2, both_rows);
}

/// Checks the counts stated with the rows of a table: options of all questions about the table, and
/// reproduced rows among those of kind `error`.
void check_counts(const Questions& questions, const std::string& table, scene::Show& show) {
  std::size_t options = 0, rows = 0, explained = 0;
  for (const ReadingChoice& q : questions)
    if (q.tables.find(table) != std::string::npos) options += q.options.size();
  const auto printed = printed_values("table-" + table);
  for (const auto& [name, value] : printed) {
    if (value.kind != "error") continue;
    ++rows;
    explained +=
        value.expected == scene::Verdict::reproduced || value.expected == scene::Verdict::reproduced_inferred;
  }
  const std::string share = fmt::format("{} of {}", explained, rows);
  const auto others = std::ranges::count_if(printed, [&](const auto& named) {
    const scene::PublishedValue& value = named.second;
    return value.tried > 0 && (static_cast<std::size_t>(value.tried) != options || value.explains != share);
  });
  show.equals(
      fmt::format("rows of Table {} that state another count of options", table), static_cast<double>(others),
      0, fmt::format("{} options of all its questions; {} rows with digits are reproduced", options, share));
}

void put(const Questions& questions, scene::Show& show) {
  show.table(tabulate(questions));
  check(questions, show);
  if (show.quick()) return;  // a quick run tries fewer options
  for (const char* table : {"4.2", "4.4", "4.6"}) check_counts(questions, table, show);
}

}  // namespace

std::vector<scene::Scene> scenes() {
  const scene::Result tried(
      "readings-tried", "every option of every question that the text leaves open, one question at a time",
      try_readings);
  return {{.name = "readings",
           .title = "Readings tried, and printed errors that each explains",
           .place = "our own, for the readings of Tables 4.2, 4.4 and 4.6",
           .content = scene::Content(put, tried)}};
}

}  // namespace nlmech::chapters::rbf_ivp::readings
