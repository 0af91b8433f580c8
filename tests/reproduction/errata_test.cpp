#include "tools/reproduction/errata.hpp"

#include <gtest/gtest.h>

#include "nlmech/support/errors.hpp"
#include "tests/scene/temporary_folder.hpp"

namespace nlmech::reproduction::errata_test {
namespace {

using tests::put;
using tests::TemporaryFolder;

const std::string header = "id,source,place,kind,printed,correct,effect,scan,test,misses,within\n";
const std::string sign =
    "moon-1.2-sign,elgohary,(1.2),formula,\"$+a$, twice\",$-a$,the other side,perhaps,"
    "unit_moon:Errata.Sign unit_moon:Errata.Twice,0.5,1e-12\n";
const std::string caption = "moon-caption,elgohary,Figure 3,wording,left,right,,no,,,\n";

std::string complaint(const std::string& rows) {
  const TemporaryFolder folder;
  put(folder / "tables/errata/moon.csv", rows);
  try {
    static_cast<void>(read_errata(folder.path()));
    return "";
  } catch (const InputError& error) {
    return error.what();
  }
}

TEST(ReadErrata, ReadsEveryColumn) {
  const TemporaryFolder folder;
  put(folder / "tables/errata/moon.csv", header + sign + caption);
  put(folder / "tables/errata/README.md", "no list");
  const auto errata = read_errata(folder.path());
  ASSERT_EQ(errata.size(), 2U);
  const Erratum& e = errata[0];
  EXPECT_EQ(e.chapter + " " + e.id + " " + e.source + " " + e.place + " " + e.kind,
            "moon moon-1.2-sign elgohary (1.2) formula");
  EXPECT_EQ(e.printed + " " + e.correct + " " + e.effect + " " + e.scan,
            "$+a$, twice $-a$ the other side perhaps");
  EXPECT_EQ(e.tests, (std::vector<std::string>{"unit_moon:Errata.Sign", "unit_moon:Errata.Twice"}));
  EXPECT_EQ(e.misses + " " + e.within, "0.5 1e-12");
  EXPECT_TRUE(errata[1].tests.empty());
}

TEST(ReadErrata, RefusesWhatNoTestProves) {
  const auto said = [](const std::string& rows, const char* what) {
    const std::string text = complaint(header + rows);
    return text.find(what) != std::string::npos && text.find("moon.csv: line ") != std::string::npos;
  };
  EXPECT_TRUE(said(sign + sign, "'moon-1.2-sign' is there twice"));
  EXPECT_TRUE(said("moon-1,elgohary,(1),formula,a,b,,no,,,\n", "a test for all but wording"));
  EXPECT_TRUE(
      said("moon-1,elgohary,(1),wording,a,b,,no,unit_moon:A.B,1,1e-9\n", "a test for all but wording"));
  EXPECT_TRUE(said("moon-1,elgohary,(1),formula,a,b,,no,unit_moon:A.B,,\n", "misses and within"));
  EXPECT_TRUE(said("moon-1,elgohary,(1),formula,a,b,,no,A.B,1,1e-9\n", "'A.B' is not of the form"));
  EXPECT_TRUE(said("moon-1,elgohary,(1),slip,a,b,,no,,,\n", "'slip' is no kind"));
  EXPECT_TRUE(said("moon-1,elgohary,(1),wording,a,b,,ocr,,,\n", "'ocr' is neither"));
  EXPECT_TRUE(said("sun-1,elgohary,(1),wording,a,b,,no,,,\n", "'sun-1' does not begin with 'moon-'"));
  EXPECT_TRUE(said("moon-1,elgohary\n", "2 of 11 cells"));
  EXPECT_NE(complaint("id,source\n").find("the header is another one"), std::string::npos);
}

TEST(ErrataPages, ShowBothFormsWithTheirDistances) {
  const TemporaryFolder folder;
  put(folder / "tables/errata/moon.csv", header + sign + caption);
  put(folder / "tables/errata/sun.csv", header + "sun-a,roy,(7),claim,3,4,,no,unit_sun:A.B,0.25,1e-9\n");
  const auto errata = read_errata(folder.path());
  put(folder / "tables/places.csv", "source,place,chapter,kind,subject,scenes\n");
  const std::string page = errata_page(errata, Guide(folder.path())), table = errata_table(errata, "moon");
  EXPECT_NE(page.find("3 entries"), std::string::npos);
  EXPECT_NE(page.find("| 0.5 | 1e-12 | the other side; perhaps an error of the scan | "
                      "`unit_moon:Errata.Sign` `unit_moon:Errata.Twice` |"),
            std::string::npos)
      << page;
  EXPECT_EQ(table.find("unit_"), std::string::npos) << "names of tests are for the page of all";
  EXPECT_EQ(table.find("(7)"), std::string::npos) << "another chapter's";
}

}  // namespace
}  // namespace nlmech::reproduction::errata_test
