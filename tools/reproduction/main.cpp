/// @file
/// `reproduction`: published beside reproduced over all chapters of the build.
///
/// `report --chapters FILE [--out DIR] [--page FILE]`: all values; exit code 1 if one has another verdict
/// than expected.
///
/// `verdict NAME --chapters FILE [--out DIR]`: one value; exit code 77 if its chapter is not built.
///
/// `completeness --chapters FILE [--out DIR] [--page FILE]`: figures and tables of the sources; exit code 1
/// if one is not drawn or not checked.
///
/// `claims --chapters FILE [--out DIR] [--page FILE]`: what the sources claim in prose; exit code 1 if the
/// evidence gives another verdict than the expected one.
///
/// `errata [--out DIR] [--page FILE]`: misprints, a table a chapter and all on one page.
///
/// `tests`: names of all values, one a line.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <sstream>

#include "nlmech/scene/evidence/check.hpp"
#include "nlmech/scene/program/command.hpp"
#include "nlmech/scene/program/files.hpp"
#include "nlmech/scene/program/this_process.hpp"
#include "nlmech/support/echo.hpp"
#include "nlmech/support/errors.hpp"
#include "tools/reproduction/claims.hpp"
#include "tools/reproduction/completeness.hpp"
#include "tools/reproduction/errata.hpp"
#include "tools/reproduction/guide.hpp"
#include "tools/reproduction/values.hpp"

namespace {

using namespace nlmech::scene;
using namespace nlmech::reproduction;

constexpr int passed = 0, failed = 1, skipped = 77;

/// What was typed.
struct Words {
  std::string chapters, out = ".", page, name;
};

std::vector<std::string> read_built(const Words& options) {
  std::vector<std::string> built;
  std::istringstream lines(read_whole(options.chapters));
  for (std::string line; std::getline(lines, line);) {
    if (!line.empty()) built.push_back(line);
  }
  return built;
}

/// The chapter that owns a value, if it is built.
std::vector<std::string> built_owner(const Words& options) {
  const std::vector<Place> places = read_places(data_folder());
  std::vector<std::string> built = read_built(options);
  for (const PublishedValue& value : read_published(data_folder())) {
    if (value.name() != options.name) continue;
    std::erase_if(built, [&](const std::string& chapter) { return chapter != owner(value, places); });
    return built;
  }
  throw nlmech::InputError(fmt::format("no source prints '{}'", nlmech::echoed(options.name)));
}

bool fails(const Checked& c) { return c.judgement.verdict != Verdict::not_built && !c.judgement.passes; }

int report(const Words& options) {
  const std::vector<Checked> values = collect_checks(read_built(options), data_folder(), options.out);
  if (!options.page.empty()) write_whole(options.page, reproduction_page(values, Guide(data_folder())));
  const auto misses = std::count_if(values.begin(), values.end(), fails);
  print_result(reproduction_text(values) +
               fmt::format("{} published values, {} fail\n", values.size(), misses));
  return misses == 0 ? passed : failed;
}

/// Looks at the chapter that owns the value and at no other: they may not have been checked.
int verdict(const Words& options) {
  const std::vector<Checked> values = collect_checks(built_owner(options), data_folder(), options.out);
  const auto c = std::find_if(values.begin(), values.end(),
                              [&](const Checked& other) { return other.value.name() == options.name; });
  print_result(reproduction_text({*c}));
  if (c->judgement.verdict == Verdict::not_built) return skipped;
  return fails(*c) ? failed : passed;
}

int completeness(const Words& options) {
  const std::vector<Shown> shown = collect_shown(read_built(options), data_folder(), options.out);
  if (!options.page.empty()) write_whole(options.page, completeness_page(shown));
  std::size_t incomplete = 0;
  for (const Shown& s : shown) {
    if (s.complete()) continue;
    ++incomplete;
    tell(fmt::format("INCOMPLETE {} {}: {}", s.place.source, s.place.name,
                     !s.drawn         ? "nothing is drawn"
                     : s.checked == 0 ? "nothing is checked"
                                      : "a check fails"));
  }
  print_result(fmt::format("{} figures and tables, {} incomplete\n", shown.size(), incomplete));
  return incomplete == 0 ? passed : failed;
}

int claims(const Words& options) {
  const std::vector<JudgedClaim> all = judge_claims(read_built(options), data_folder(), options.out);
  if (!options.page.empty()) write_whole(options.page, claims_page(all));
  std::size_t misses = 0;
  for (const JudgedClaim& c : all) {
    if (c.passes) continue;
    ++misses;
    tell(fmt::format("FAILS {} {}, {}: {} = {:.6g}, {}; expected: {}", c.claim.source, c.claim.place,
                     c.claim.scene, c.claim.quantity, c.value,
                     std::isnan(c.value) ? "no such quantity" : to_string(c.verdict),
                     to_string(c.claim.expected)));
  }
  print_result(fmt::format("{} claims in prose, {} fail\n", all.size(), misses));
  return misses == 0 ? passed : failed;
}

/// A table for each chapter's page, and all of them on one.
void errata(const Words& options) {
  const std::vector<Erratum> all = read_errata(data_folder());
  std::set<std::string> chapters;
  for (const Erratum& e : all) chapters.insert(e.chapter);
  for (const std::string& chapter : chapters) {
    write_whole(std::filesystem::path(options.out) / "tables" / chapter / "errata.md",
                errata_table(all, chapter));
  }
  if (!options.page.empty()) write_whole(options.page, errata_page(all, Guide(data_folder())));
  print_result(fmt::format("{} errata\n", all.size()));
}

std::string names() {
  std::string all;
  for (const PublishedValue& value : read_published(data_folder())) all += value.name() + '\n';
  return all;
}

/// @tparam chapters, page which options a command has
template <bool chapters, bool page>
void declare(Options& options, Words& words) {
  if (chapters)
    options.add("--chapters", words.chapters, "file with the names of the chapters built").required();
  if (chapters || page)
    options.add("--out", words.out,
                "folder with the chapters' results/, and that gets tables/<chapter>/errata.md");
  if (page) options.add("--page", words.page, "write the Markdown page to this file too");
  options.unlimited();
}

void declare_verdict(Options& options, Words& words) {
  options.add("name", words.name, "source/place/row/quantity").required();
  declare<true, false>(options, words);
}

}  // namespace

int main(int argc, char** argv) {
  Commands commands("reproduction");
  commands.add("report", "all values; exit code 1 if one has another verdict", declare<true, true>, report);
  commands.add("completeness", "figures and tables; exit code 1 if one is lacking", declare<true, true>,
               completeness);
  commands.add("claims", "claims in prose; exit code 1 if one has another verdict than expected",
               declare<true, true>, claims);
  commands.add("errata", "misprints: a table a chapter, and all on one page", declare<false, true>, errata);
  commands.add("verdict", "one value; exit code 77 if its chapter is not built", declare_verdict, verdict);
  commands.add("tests", "names of all values, one a line", declare<false, false>,
               [](const Words&) { return names(); });
  return run_command(commands, "Published beside reproduced, over all chapters", argc, argv);
}
