#include "nlmech/scene/evidence/published.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <set>

#include "nlmech/scene/program/csv.hpp"
#include "nlmech/support/errors.hpp"
#include "tests/places.hpp"
#include "tests/scene/temporary_folder.hpp"
#include "tests/thrown.hpp"

namespace nlmech::scene::published_test {
namespace {

using tests::put;
using tests::TemporaryFolder;

const char* header =
    "place,row,quantity,value,unit,kind,nominal,inferred,expected,tolerance,because,tried,explains,erratum,"
    "reading\n";

std::string complaint(const std::filesystem::path& folder) {
  return tests::thrown<InputError>([&] { return read_published(folder); });
}

TEST(ReadPublished, ReadsEveryColumn) {
  const TemporaryFolder folder;
  put(folder / "tables/published/roy.csv",
      std::string(header) +
          "fig-2,\"RK6; p = 3\",\"step, smallest\",0.210,s,error,0.19..0.20 s,0.2,\"reproduced, inferred "
          "reading\","
          "factor 2,two steps,7,3 of 4,,\"a, b\"\n");
  const auto values = read_published(folder.path());
  ASSERT_EQ(values.size(), 1U);
  const PublishedValue& v = values[0];
  EXPECT_EQ(v.name(), "roy/fig-2/RK6; p = 3/step, smallest");
  EXPECT_EQ(v.printed, "0.210") << "digits as printed";
  EXPECT_EQ(v.value, 0.21);
  EXPECT_EQ(v.unit + v.kind, "serror");
  EXPECT_EQ(v.nominal, "0.19..0.20 s");
  EXPECT_EQ(v.inferred, "0.2");
  EXPECT_EQ(v.expected, Verdict::reproduced_inferred);
  EXPECT_EQ(v.tolerance, "factor 2");
  EXPECT_EQ(v.because, "two steps");
  EXPECT_EQ(v.tried, 7);
  EXPECT_EQ(v.explains, "3 of 4");
  EXPECT_EQ(v.erratum, "");
  EXPECT_EQ(v.reading, "a, b");
}

TEST(ReadPublished, TakesFilesInAlphabeticalOrderAndOnlyCsv) {
  const TemporaryFolder folder;
  const std::string row = "t,r,q,1,1,value,,,context,,,,,,\n";
  for (const char* name : {"c.csv", "a.csv", "b.csv", "README.md", ".a.csv.17"}) {
    put(folder / "tables/published" / name, header + row);
  }
  std::string order;
  for (const PublishedValue& v : read_published(folder.path())) order += v.source;
  EXPECT_EQ(order, "abc");
}

TEST(ReadPublished, NamesFileAndLineOfWhatItRefuses) {
  const TemporaryFolder folder;
  const std::string file = (folder / "tables/published/a.csv").string();
  const auto refused = [&](const std::string& row) {
    put(file, std::string(header) + "t,r,q,1,1,value,,,context,,,,,,\n" + row + "\n");
    return complaint(folder.path());
  };
  EXPECT_EQ(refused("t,r,q,1,1,value,,,context,,,,,"), file + ": line 3: 14 of 15 cells");
  EXPECT_EQ(refused("t,r,q,1,1,value,,,context,,,,,,,"), file + ": line 3: 16 of 15 cells");
  EXPECT_EQ(refused("t,r,q,1 s,1,value,,,context,,,,,,"),
            file + ": line 3, column 4 (value): '1 s' is not a finite number");
  EXPECT_EQ(refused("t,r,q,,1,value,,,context,,,,,,"),
            file + ": line 3, column 4 (value): '' is not a finite number");
  EXPECT_EQ(refused("t,r,q,1,1,value,,,splendid,,,,,,"), file + ": line 3: 'splendid' is no verdict");
  EXPECT_EQ(refused("t,r,q,1,1,value,,,context,roughly,why,,,,"),
            file + ": line 3: 'roughly' is no tolerance");
}

// A verdict without its evidence is refused.
TEST(ReadPublished, AsksForTheEvidence) {
  const TemporaryFolder folder;
  const auto refused = [&](const std::string& end) {
    put(folder / "tables/published/a.csv", std::string(header) + "t,r,q,1,1,value,,," + end + "\n");
    const std::string said = complaint(folder.path());
    return said.substr(std::min(said.size(), said.find("line 2: ") + 8));
  };
  EXPECT_EQ(refused("reproduced,digits,,,,,"), "");
  EXPECT_EQ(refused("reproduced,0.1,two steps,,,,"), "");
  EXPECT_EQ(refused("\"reproduced, inferred reading\",digits,,7,3 of 4,,"), "");
  EXPECT_EQ(refused("not stated,,,7,3 of 4,,"), "");
  EXPECT_EQ(refused("not stated,,,,,,"), "");
  for (const char* verdict :
       {"reproduced", "same rounding level", "better", "differs", "holds", "does not hold"})
    EXPECT_EQ(refused(verdict + std::string(",,,,,,")), "a verdict that compares, and no tolerance");
  EXPECT_EQ(refused("reproduced,0.1,,,,,"), "no reason for the tolerance '0.1'");
  for (const char* part : {",,", "7,,", ",3 of 4,"})
    EXPECT_EQ(refused(std::string("\"reproduced, inferred reading\",digits,,") + part + ","),
              "readings tried and rows explained belong to an inferred reading or one not stated, both");
  for (const char* part : {"7,,", ",3 of 4,"})
    EXPECT_EQ(refused(std::string("not stated,,,") + part + ","),
              "readings tried and rows explained belong to an inferred reading or one not stated, both");
  EXPECT_EQ(refused("reproduced,digits,,7,3 of 4,,"),
            "readings tried and rows explained belong to an inferred reading or one not stated, both");
  for (const char* share : {"5 of 4", "0 of 4", "all", "3 of", "3 of 4 rows"})
    EXPECT_EQ(refused(std::string("\"reproduced, inferred reading\",digits,,7,") + share + ",,"),
              "'" + std::string(share) + "' is not of the form '5 of 6'");
  for (const char* tried : {"0", "-1", "2.5", "some"})
    EXPECT_EQ(refused(std::string("\"reproduced, inferred reading\",digits,,") + tried + ",3 of 4,,"),
              "'" + std::string(tried) + "' is no number of readings");
  EXPECT_EQ(refused("reproduced,digits,,,,book-1,"), "a misprint (book-1) cannot be reproduced");
  EXPECT_EQ(refused("\"reproduced, inferred reading\",digits,,7,3 of 4,book-1,"),
            "a misprint (book-1) cannot be reproduced");
}

TEST(ReadPublished, NamesTheFolderThatIsMissing) {
  const TemporaryFolder folder;
  EXPECT_EQ(complaint(folder.path()), (folder / "tables/published").string() + ": No such file or directory");
}

TEST(ReadPlaces, NamesFileAndLineOfAShortRow) {
  const TemporaryFolder folder;
  const std::string file = (folder / "tables/places.csv").string();
  put(file, "source,place,chapter,kind,subject,scenes\nroy,fig-1,transversal,figure\n");
  EXPECT_EQ(tests::thrown<InputError>([&] { return read_places(folder.path()); }),
            file + ": line 2: 4 of 6 cells");
}

TEST(Owner, IsTheChapterOfThePlaceInThatSource) {
  const std::vector<Place> places = {{"roy", "table-1", "transversal", "table", "", {"table-1"}},
                                     {"laier", "table-1", "hermitian", "table", "", {"table-1"}}};
  PublishedValue value;
  value.source = "laier";
  value.place = "table-1";
  EXPECT_EQ(owner(value, places), "hermitian");
  value.place = "table-9";
  EXPECT_THROW((void)owner(value, places), InputError);
}

// The files of this project.

std::vector<PublishedValue> all_values() { return read_published(NLMECH_SOURCE_DIR); }

/// The numbers at the start of a text, parsed independently of the tested code: "4.7..1800 m" has two,
/// "2-cycle" none.
std::vector<double> numbers_at_front(const std::string& text) {
  const std::string first = text.substr(0, text.find_first_of(" ;"));
  const auto dots = first.find("..");
  double low = 0, high = 0;
  if (dots == std::string::npos) return parse_number(first, low) ? std::vector{low} : std::vector<double>{};
  return parse_number(first.substr(0, dots), low) && parse_number(first.substr(dots + 2), high)
             ? std::vector{low, high}
             : std::vector<double>{};
}

// The recorded numbers must support the verdict of their row. A range shows the scatter due to rounding noise
// or unstated settings; for a reproduced value the printed number must lie within the range or within the
// tolerance of it.
TEST(PublishedFiles, AgreeWithThemselves) {
  int judged = 0;
  for (const PublishedValue& value : all_values()) {
    std::vector<Measured> found;
    for (const double x : numbers_at_front(value.nominal)) found.push_back({x, {}});
    if (value.expected == Verdict::reproduced_inferred) {
      found.clear();
      for (const double x : numbers_at_front(value.inferred)) found.push_back({{}, x});
    }
    if (value.expected == Verdict::reproduced && found.size() == 2) {
      EXPECT_TRUE(
          Tolerance(value.tolerance, value.printed).allows(value.value, *found[0].nominal, *found[1].nominal))
          << value.name();
      found.clear();
      ++judged;
    }
    for (const Measured& m : found) {
      EXPECT_TRUE(verdict_on(value, m).passes) << value.name() << ": expected " << to_string(value.expected)
                                               << ", found " << m.nominal.value_or(m.inferred.value_or(0));
      ++judged;
    }
  }
  EXPECT_GT(judged, 80);
}

// "Reproduced" under an inferred reading is a statement about the printed number, whatever the measured
// range.
TEST(PublishedFiles, InferReadingsThatGiveThePrintedNumber) {
  for (const PublishedValue& value : all_values()) {
    const auto range = numbers_at_front(value.inferred);
    if (value.expected != Verdict::reproduced_inferred || range.empty()) continue;
    EXPECT_TRUE(Tolerance(value.tolerance, value.printed).allows(value.value, range.front(), range.back()))
        << value.name();
  }
}

}  // namespace
}  // namespace nlmech::scene::published_test
