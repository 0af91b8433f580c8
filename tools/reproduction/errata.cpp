#include "tools/reproduction/errata.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
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

/// A test's place as a reader looks for it: program and name.
std::string test_names(const Erratum& e) {
  std::string text;
  for (const std::string& test : e.tests) text += (text.empty() ? "`" : " `") + test + "`";
  return text;
}

/// "no" is not worth a word.
std::string effect(const Erratum& e) {
  const std::string scan = e.scan == "perhaps" ? "perhaps an error of the scan" : "";
  return e.effect + (e.effect.empty() || scan.empty() ? "" : "; ") + scan;
}

/// A source as its title page has it; others by their name in the lists.
std::string title_of(const std::string& source) {
  static const std::map<std::string, std::string> titles = {
      {"elgohary", "T. A. Elgohary, dissertation, Texas A&M University (2015)"},
      {"filipich-rosales",
       "C. P. Filipich and M. B. Rosales, A straightforward approach to solve ordinary nonlinear "
       "differential systems"},
      {"laier", "J. E. Laier, High-order algorithm for non-linear dynamics"},
      {"roy", "D. Roy, A multi-step transversal linearization method in nonlinear dynamics"}};
  const auto title = titles.find(source);
  return title == titles.end() ? source : title->second;
}

Table table_of(const std::vector<const Erratum*>& entries, bool with_tests) {
  std::vector<Column> columns = {
      {"place"}, {"printed"}, {"correct"}, {"printed misses by"}, {"corrected within"}, {"effect"}};
  if (with_tests) columns.push_back({"test"});
  Table table(columns);
  for (const Erratum* e : entries) {
    std::vector<Cell> row = {e->place, e->printed, e->correct, e->misses, e->within, effect(*e)};
    if (with_tests) row.emplace_back(test_names(*e));
    table.add(std::move(row));
  }
  return table;
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

std::string errata_page(const std::vector<Erratum>& errata) {
  std::map<std::string, std::vector<const Erratum*>> by_source;
  for (const Erratum& e : errata) by_source[e.source].push_back(&e);
  const auto wording =
      std::count_if(errata.begin(), errata.end(), [](const Erratum& e) { return e.tests.empty(); });
  std::string page = fmt::format(
      "# Errata of the sources {{#errata}}\n\n"
      "{} entries. A test evaluates each printed form and its correction beside an oracle that uses neither: "
      "a closed form, another program in more digits, another set of equations, or, where the question is "
      "which setting a table belongs to, the other numbers that it prints. It fails if the printed form "
      "comes closer than ten times the tolerance, or the correction does not come within it. Both distances "
      "stand here, relative to the oracle or to the scale that the test names; a form without a value misses "
      "by nan. The {} entries without numbers are slips of wording with nothing to compute. The sources at "
      "hand are scanned text: where scanning may have made the misprint, the entry says so. Written by "
      "`make check` from `tables/errata`.\n",
      errata.size(), wording);
  for (const auto& [source, entries] : by_source)
    page += fmt::format("\n## {}\n\n{}", title_of(source), table_of(entries, true).markdown());
  return page;
}

std::string errata_table(const std::vector<Erratum>& errata, const std::string& chapter) {
  std::vector<const Erratum*> entries;
  for (const Erratum& e : errata) {
    if (e.chapter == chapter) entries.push_back(&e);
  }
  return table_of(entries, false).markdown();
}

}  // namespace nlmech::reproduction
