#include "tools/reproduction/errata.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "nlmech/scene/program/csv.hpp"
#include "nlmech/scene/program/files.hpp"
#include "nlmech/scene/table.hpp"
#include "nlmech/support/echo.hpp"
#include "nlmech/support/errors.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::reproduction {
namespace fs = std::filesystem;
using namespace scene;

namespace {

const std::vector<std::string> header = {"id",     "source", "place", "kind",   "printed", "correct",
                                         "effect", "scan",   "test",  "misses", "within"};

std::vector<std::string> words(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> found;
  for (std::string word; in >> word;) found.push_back(word);
  return found;
}

void refuse(bool wrong, const std::string& where, const std::string& what) {
  if (wrong) throw input_error("{}: {}", where, what);
}

bool is_test(const std::string& name) {
  const auto colon = name.find(':');
  return colon != std::string::npos && name.find('.', colon) != std::string::npos;
}

Erratum to_erratum(const CsvRecord& record, const std::string& chapter, const std::string& file) {
  const std::string where = fmt::format("{}: line {}", file, record.line);
  const auto& c = record.cells;
  refuse(c.size() != header.size(), where, fmt::format("{} of {} cells", c.size(), header.size()));
  Erratum e{chapter, c[0], c[1], c[2], c[3], c[4], c[5], c[6], c[7], words(c[8]), c[9], c[10]};
  refuse(!e.id.starts_with(chapter + "-"), where,
         fmt::format("'{}' does not begin with '{}-'", echoed(e.id), chapter));
  const bool computed = e.kind == "formula" || e.kind == "number" || e.kind == "claim";
  refuse(!computed && e.kind != "wording", where, fmt::format("'{}' is no kind of misprint", echoed(e.kind)));
  refuse(e.scan != "no" && e.scan != "perhaps", where,
         fmt::format("'{}' is neither no nor perhaps", echoed(e.scan)));
  refuse(computed != !e.tests.empty(), where, fmt::format("{}: a test for all but wording", echoed(e.id)));
  refuse(!std::all_of(e.tests.begin(), e.tests.end(), is_test), where,
         fmt::format("'{}' is not of the form program:Suite.Name", echoed(c[8])));
  refuse(computed == (e.misses.empty() || e.within.empty()), where,
         fmt::format("{}: misses and within for all but wording", echoed(e.id)));
  return e;
}

/// "no" is not worth a word.
std::string effect(const Erratum& e) {
  const std::string scan = e.scan == "perhaps" ? "perhaps an error of the scan" : "";
  return e.effect + (e.effect.empty() || scan.empty() ? "" : "; ") + scan;
}

constexpr std::string_view page_name = "errata";

using Entries = std::vector<const Erratum*>;

/// @param guide with links and names of tests, for the page of all; none: for a chapter's own page
Table table_of(const Entries& entries, const Guide* guide) {
  std::vector<Column> columns = {
      {"place"}, {"printed"}, {"correct"}, {"printed misses by"}, {"corrected within"}, {"effect"}};
  if (guide) columns.push_back({"test"});
  Table table(columns);
  for (const Erratum* e : entries) {
    std::vector<Cell> row = {guide ? guide->link_words(e->chapter, e->source, e->place) : e->place,
                             e->printed,
                             e->correct,
                             e->misses,
                             e->within,
                             effect(*e)};
    if (guide) {
      std::string tests;
      for (const std::string& test : e->tests) tests += (tests.empty() ? "" : " ") + guide->test_link(test);
      row.emplace_back(std::move(tests));
    }
    table.add(std::move(row));
  }
  return table;
}

/// Entries by kind, a row a chapter: the contents of the page.
Table contents(const std::vector<std::pair<std::string, Entries>>& chapters, const Guide& guide) {
  Table table({{"chapter"}, {"formulas"}, {"numbers"}, {"claims"}, {"wording"}});
  for (const auto& [chapter, entries] : chapters) {
    std::vector<Cell> row = {section_link(page_name, chapter, guide.chapter_title(chapter))};
    for (const char* kind : {"formula", "number", "claim", "wording"}) {
      row.emplace_back(
          std::count_if(entries.begin(), entries.end(), [&](const Erratum* e) { return e->kind == kind; }));
    }
    table.add(std::move(row));
  }
  return table;
}

/// Chapters in the order in which the sources come to them.
std::vector<std::pair<std::string, Entries>> by_chapter(const std::vector<Erratum>& errata,
                                                        const Guide& guide) {
  std::map<std::string, Entries> entries;
  for (const Erratum& e : errata) entries[e.chapter].push_back(&e);
  std::vector<std::pair<std::string, Entries>> chapters(entries.begin(), entries.end());
  std::stable_sort(chapters.begin(), chapters.end(),
                   [&](const auto& a, const auto& b) { return guide.rank(a.first) < guide.rank(b.first); });
  return chapters;
}

/// Formulas of a page, \f$x\f$, as a forge writes them: $`x`$. The book turns them back.
std::string with_forge_formulas(const std::string& text) {
  static const std::regex formula(R"(\\f\$(.*?)\\f\$)");
  return std::regex_replace(text, formula, "$$`$1`$$");
}

}  // namespace

std::vector<Erratum> parse_errata(std::string_view text, const std::string& chapter,
                                  const std::string& file) {
  std::vector<Erratum> errata;
  std::set<std::string> ids;
  const auto records = parse_csv(text, file);
  refuse(records.empty() || records[0].cells != header, file, "the header is another one");
  for (std::size_t i = 1; i < records.size(); ++i) {
    errata.push_back(to_erratum(records[i], chapter, file));
    refuse(!ids.insert(errata.back().id).second, fmt::format("{}: line {}", file, records[i].line),
           fmt::format("'{}' is there twice", echoed(errata.back().id)));
  }
  return errata;
}

// Each id begins with its chapter's name, which is the file's: one file cannot repeat an id of another.
std::vector<Erratum> read_errata(const fs::path& data_folder) {
  std::vector<Erratum> errata;
  for (const fs::path& file : files_with(data_folder / "tables" / "errata", ".csv")) {
    for (Erratum& e : parse_errata(read_whole(file), file.stem().string(), file.string()))
      errata.push_back(std::move(e));
  }
  return errata;
}

std::string errata_page(const std::vector<Erratum>& errata, const Guide& guide) {
  const auto chapters = by_chapter(errata, guide);
  const auto wording =
      std::count_if(errata.begin(), errata.end(), [](const Erratum& e) { return e.tests.empty(); });
  std::string page = fmt::format(
      "# Errata of the sources\n\n"
      "{} entries. A test evaluates each printed form and its correction beside an oracle that uses neither: "
      "a closed form, another program in more digits, another set of equations, or, where the question is "
      "which setting a table belongs to, the other numbers that it prints. It fails if the printed form "
      "comes closer than ten times the tolerance, or the correction does not come within it. Both distances "
      "stand here, relative to the oracle or to the scale that the test names; a form without a value misses "
      "by nan. The {} entries without numbers are slips of wording with nothing to compute. The sources at "
      "hand are scanned text: where scanning may have made the misprint, the entry says so. Written by "
      "`make check` from `tables/errata`.\n\n{}",
      errata.size(), wording, contents(chapters, guide).markdown());
  for (const auto& [chapter, entries] : chapters) {
    page += fmt::format("\n{}\n## {}\n\n{}. What they change, [the chapter]({}) shows.\n\n{}",
                        section_mark(page_name, chapter), guide.chapter_title(chapter),
                        source_title(entries.front()->source), Guide::page(chapter),
                        table_of(entries, &guide).markdown());
  }
  return with_forge_formulas(page);
}

std::string errata_table(const std::vector<Erratum>& errata, const std::string& chapter) {
  Entries entries;
  for (const Erratum& e : errata) {
    if (e.chapter == chapter) entries.push_back(&e);
  }
  return table_of(entries, nullptr).markdown();
}

}  // namespace nlmech::reproduction
