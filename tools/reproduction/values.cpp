#include "tools/reproduction/values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "nlmech/scene/table.hpp"

namespace nlmech::reproduction {
using namespace scene;

namespace {

using Rows = std::vector<const Checked*>;

constexpr std::string_view page_name = "reproduction";

std::string shown(const std::optional<double>& value) { return value ? format_number(*value, 4) : ""; }

/// With its unit, if it has one.
std::string printed(const PublishedValue& value) {
  return value.printed + (value.unit == "1" ? "" : " " + value.unit);
}

/// How the text was understood, and why the tolerance is what it is.
std::string reading_and_reason(const PublishedValue& value) {
  std::string reading = reading_text(value);
  if (value.because.empty()) return reading;
  return reading + (reading.empty() ? "" : "; ") + "tolerance: " + value.because;
}

/// Chapters in the order of the sources.
std::vector<std::pair<std::string, Rows>> by_chapter(const std::vector<Checked>& values, const Guide& guide) {
  std::vector<std::pair<std::string, Rows>> chapters;
  for (const Checked& c : values) {
    auto found = std::find_if(chapters.begin(), chapters.end(),
                              [&](const auto& chapter) { return chapter.first == c.chapter; });
    if (found == chapters.end()) found = chapters.insert(chapters.end(), {c.chapter, {}});
    found->second.push_back(&c);
  }
  std::stable_sort(chapters.begin(), chapters.end(),
                   [&](const auto& a, const auto& b) { return guide.rank(a.first) < guide.rank(b.first); });
  return chapters;
}

Table counts(const std::vector<std::pair<std::string, Rows>>& chapters, const Guide& guide) {
  constexpr std::array order = {Verdict::reproduced,    Verdict::reproduced_inferred,
                                Verdict::same_rounding, Verdict::better,
                                Verdict::differs,       Verdict::not_stated,
                                Verdict::holds,         Verdict::does_not_hold,
                                Verdict::context,       Verdict::input,
                                Verdict::not_built};
  std::vector<Column> columns = {{"chapter"}};
  for (const Verdict v : order) columns.push_back({std::string(to_string(v))});
  Table table(columns);
  for (const auto& [chapter, rows] : chapters) {
    std::vector<Cell> cells = {section_link(page_name, chapter, guide.chapter_title(chapter))};
    for (const Verdict v : order) {
      cells.emplace_back(std::count_if(rows.begin(), rows.end(),
                                       [&](const Checked* c) { return c->judgement.verdict == v; }));
    }
    table.add(std::move(cells));
  }
  return table;
}

std::string place_link(const Checked& c, const Guide& guide) {
  return guide.link(c.chapter, c.value.source, c.value.place, c.value.place);
}

std::string judged_table(const Rows& rows, const Guide& guide) {
  Table table({{"place"},
               {"row"},
               {"quantity"},
               {"published"},
               {"within"},
               {"nominal"},
               {"inferred"},
               {"verdict"},
               {"reading"}});
  for (const Checked* c : rows) {
    table.add({place_link(*c, guide), c->value.row, c->value.quantity, printed(c->value), c->value.tolerance,
               nominal_text(*c), shown(c->measured.inferred), verdict_text(*c),
               reading_and_reason(c->value)});
  }
  return table.markdown();
}

/// What is quoted and never judged, behind a line that opens it.
std::string folded_table(const Rows& rows, const Guide& guide) {
  Table table({{"place"}, {"row"}, {"quantity"}, {"published"}, {"reading"}});
  for (const Checked* c : rows) {
    table.add(
        {place_link(*c, guide), c->value.row, c->value.quantity, printed(c->value), reading_text(c->value)});
  }
  return fmt::format(
      "<details>\n<summary>For context, not judged: {} run times on machines that are not known</summary>\n\n"
      "{}\n</details>\n",
      rows.size(), table.markdown());
}

/// Source by source, where the numbers are from and what judges them again.
std::string head(const std::string& chapter, const Rows& rows, const Guide& guide) {
  std::set<std::string> sources;
  std::string from;
  for (const Checked* c : rows) {
    if (sources.insert(c->value.source).second)
      from += (from.empty() ? "" : "; ") + source_title(c->value.source);
  }
  const PublishedValue& first = rows.front()->value;
  return fmt::format(
      "\n{}\n## {}\n\n{}. Shown by [the chapter]({}). Judged again by `build/bin/{} check`, and each row by "
      "a "
      "test: those of a place with `ctest --test-dir build -R '^{}/{}/'`.\n\n",
      section_mark(page_name, chapter), guide.chapter_title(chapter), from, Guide::page(chapter), chapter,
      first.source, first.place);
}

}  // namespace

std::string reproduction_page(const std::vector<Checked>& values, const Guide& guide) {
  const auto chapters = by_chapter(values, guide);
  std::string page =
      "# What was reproduced\n\n"
      "One row for every number that a source prints. *Nominal* is what we get from the text as it stands, "
      "*inferred* what we get under a reading that evidence points to, *within* the tolerance that decides: "
      "`digits` is one unit of the last printed digit. A range *by rounding* stands in place of a number "
      "that "
      "differs from machine to machine within it. The words of the verdicts are explained in the "
      "[glossary](../docs/glossary.md). Written by `make check`.\n\n" +
      counts(chapters, guide).markdown();
  for (const auto& [chapter, rows] : chapters) {
    Rows judged, context;
    for (const Checked* c : rows) (c->value.expected == Verdict::context ? context : judged).push_back(c);
    page += head(chapter, rows, guide);
    if (!judged.empty()) page += judged_table(judged, guide);
    if (!judged.empty() && !context.empty()) page += "\n";
    if (!context.empty()) page += folded_table(context, guide);
  }
  return page;
}

}  // namespace nlmech::reproduction
