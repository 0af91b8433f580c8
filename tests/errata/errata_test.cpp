/// The lists of misprints: each entry's test is there, evaluates the printed and the corrected form beside an
/// oracle, passes, and says the numbers that the list gives.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "nlmech/scene/evidence/published.hpp"
#include "nlmech/scene/program/csv.hpp"
#include "nlmech/scene/program/files.hpp"
#include "nlmech/scene/program/process.hpp"
#include "tests/places.hpp"
#include "tools/reproduction/errata.hpp"

namespace nlmech::tests::errata_test {
namespace {

namespace fs = std::filesystem;

/// What the tests said about an entry: the largest of each, should there be several pieces of evidence.
struct Said {
  double misses = 0, within = 0;
  std::set<std::string> tests;
};

/// "unit_frames:Errata.BeamColumn" -> program and filter.
std::pair<std::string, std::string> split(const std::string& test) {
  const auto colon = test.find(':');
  return {test.substr(0, colon), test.substr(colon + 1)};
}

std::set<std::string> built_chapters() {
  std::istringstream in(scene::read_whole(NLMECH_BINARY_DIR "/chapters.txt"));
  std::set<std::string> chapters;
  for (std::string line; std::getline(in, line);) chapters.insert(line);
  return chapters;
}

/// Collects the lines `erratum ID misses X within Y` of one test.
void listen(const std::string& output, const std::string& test, std::map<std::string, Said>& said) {
  std::istringstream lines(output);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string erratum, id, misses, miss, within, tolerance;
    if (!(words >> erratum >> id >> misses >> miss >> within >> tolerance) || erratum != "erratum") continue;
    Said& entry = said[id];
    // A printed form that gives no number misses by "inf" or "nan".
    double number = 0;
    if (!scene::parse_number(miss, number)) number = std::numeric_limits<double>::infinity();
    entry.misses = std::max(entry.misses, number);
    ASSERT_TRUE(scene::parse_number(tolerance, number)) << line;
    entry.within = std::max(entry.within, number);
    entry.tests.insert(test);
  }
}

std::map<std::string, Said> run_tests(const std::set<std::string>& tests) {
  std::map<std::string, Said> said;
  for (const std::string& test : tests) {
    const auto [program, name] = split(test);
    const fs::path file = fs::path(NLMECH_BINARY_DIR) / "test-bin" / program;
    if (!fs::exists(file)) {
      ADD_FAILURE() << test << ": there is no program " << program;
      continue;
    }
    const scene::Finished run = scene::run_program({file.string(), "--gtest_filter=" + name}, {});
    EXPECT_EQ(run.exit_code, 0) << test << "\n" << run.output;
    EXPECT_NE(run.output.find("[  PASSED  ]"), std::string::npos) << test;
    EXPECT_EQ(run.output.find("[  PASSED  ] 0 tests"), std::string::npos)
        << test << ": there is no such test";
    listen(run.output, test, said);
  }
  return said;
}

/// As the list gives it: two digits, or "inf" and "nan".
bool agrees(double said, const std::string& listed) {
  double number = 0;
  if (!scene::parse_number(listed, number)) return std::isinf(said);
  return std::abs(said - number) <= 0.1 * number;  // a misprint's size may change in its second digit
}

TEST(Errata, OfChaptersBuiltAreProved) {
  const std::set<std::string> built = built_chapters();
  std::vector<reproduction::Erratum> errata = reproduction::read_errata(NLMECH_SOURCE_DIR);
  std::erase_if(errata, [&](const reproduction::Erratum& e) { return !built.contains(e.chapter); });
  std::set<std::string> tests, ids;
  for (const reproduction::Erratum& e : errata) {
    tests.insert(e.tests.begin(), e.tests.end());
    ids.insert(e.id);
  }
  const std::map<std::string, Said> said = run_tests(tests);
  for (const reproduction::Erratum& e : errata) {
    if (e.tests.empty()) continue;
    const auto found = said.find(e.id);
    if (found == said.end()) {
      ADD_FAILURE() << e.id << ": none of its tests says `erratum " << e.id << " ...`";
      continue;
    }
    for (const std::string& test : e.tests)
      EXPECT_TRUE(found->second.tests.contains(test)) << test << " says nothing about " << e.id;
    EXPECT_TRUE(agrees(found->second.misses, e.misses))
        << e.id << ": its tests miss by " << found->second.misses << ", the list says " << e.misses;
    EXPECT_TRUE(agrees(found->second.within, e.within))
        << e.id << ": its tests hold " << found->second.within << ", the list says " << e.within;
  }
  for (const auto& [id, what] : said)
    EXPECT_TRUE(ids.contains(id)) << *what.tests.begin() << " proves " << id << ", which no list has";
}

/// A printed number that is a misprint names an entry, and is not said to be reproduced (which its file
/// refuses). An entry that names the digits of a table stands beside a number that differs.
TEST(Errata, OfPrintedNumbersAreThoseThatTheFilesName) {
  std::map<std::string, std::string> sources;
  for (const reproduction::Erratum& e : reproduction::read_errata(NLMECH_SOURCE_DIR))
    sources[e.id] = e.source;
  int named = 0;
  for (const scene::PublishedValue& value : scene::read_published(NLMECH_SOURCE_DIR)) {
    if (value.erratum.empty()) continue;
    ++named;
    EXPECT_EQ(value.expected, scene::Verdict::differs) << value.name();
    ASSERT_TRUE(sources.contains(value.erratum)) << value.name() << ": no entry " << value.erratum;
    EXPECT_EQ(sources[value.erratum], value.source) << value.name();
  }
  EXPECT_GT(named, 0);
}

// A chapter that reproduces no source has none.
TEST(Errata, EveryChapterHasAList) {
  std::set<std::string> owners;
  for (const scene::Place& place : scene::read_places(NLMECH_SOURCE_DIR)) owners.insert(place.chapter);
  std::set<std::string> listed;
  for (const reproduction::Erratum& e : reproduction::read_errata(NLMECH_SOURCE_DIR))
    listed.insert(e.chapter);
  for (const std::string& chapter : built_chapters())
    EXPECT_EQ(listed.contains(chapter), owners.contains(chapter)) << chapter;
}

}  // namespace
}  // namespace nlmech::tests::errata_test
