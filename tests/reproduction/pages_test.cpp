/// The pages of evidence: what they are grouped by, and where their links lead.
#include <gtest/gtest.h>

#include "nlmech/scene/evidence/check.hpp"
#include "tests/scene/temporary_folder.hpp"
#include "tools/reproduction/errata.hpp"
#include "tools/reproduction/guide.hpp"
#include "tools/reproduction/values.hpp"

namespace nlmech::reproduction::pages_test {
namespace {

using namespace scene;
using tests::put;
using tests::TemporaryFolder;

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

class Pages : public ::testing::Test {
 protected:
  void SetUp() override {
    put(folder_ / "tables/places.csv",
        "source,place,chapter,kind,subject,scenes\n"
        "elgohary,table-1,sun,table,its light,\nroy,fig-2,moon,figure,its path,fig-2a\n"
        "roy,claim-3,moon,claim,its speed,\n");
    put(folder_ / "docs/chapters.txt", "# names\nsun: The Sun\n");
    put(folder_ / "tests/chapters/moon/errata_test.cpp", "\nTEST(Errata, Sign) {}\n");
    put(folder_ / "tests/chapters/sun/errata_test.cpp", "\nTEST_F(Errata, Sign) {}\n");
  }

  /// As if its chapter had been checked.
  static Checked checked(const std::string& chapter, const std::string& row, Verdict verdict,
                         std::string reading = "", std::string because = "") {
    PublishedValue value;
    value.source = chapter == "sun" ? "elgohary" : "roy";
    value.place = chapter == "sun" ? "table-1" : "claim-3";
    value.row = row;
    value.quantity = "x";
    value.printed = "1.5";
    value.unit = chapter == "sun" ? "lb" : "1";
    value.expected = verdict;
    value.tolerance = "digits";
    value.because = std::move(because);
    value.reading = std::move(reading);
    return {value, chapter, {1.51, {}}, {verdict, true}, {}};
  }

  TemporaryFolder folder_;
};

TEST_F(Pages, OfValuesHaveASectionAChapterWithContentsThatLeadToIt) {
  const std::string page = reproduction_page({checked("moon", "a", Verdict::reproduced),
                                              checked("sun", "t|u", Verdict::differs, "as printed", "noise")},
                                             Guide(folder_.path()));
  EXPECT_TRUE(has(page, "| [The Sun](#reproduction_sun) | 0 | 0 | 0 | 0 | 1 | 0 | 0 | 0 | 0 | 0 | 0 |"))
      << page;
  EXPECT_TRUE(has(page, "| [moon](#reproduction_moon) | 1 |")) << page;
  EXPECT_LT(page.find("<a id=\"reproduction_sun\"></a>\n## The Sun\n\nT. A. Elgohary"),
            page.find("<a id=\"reproduction_moon\"></a>\n## moon\n\nD. Roy"))
      << "the order of places.csv\n"
      << page;
  EXPECT_TRUE(has(page,
                  "| [table-1](../docs/chapters/sun.md#table-1) | t\\|u | x | 1.5 lb | digits | 1.51 |  | "
                  "differs | as printed; tolerance: noise |"))
      << page;
  EXPECT_TRUE(has(page, "| [claim-3](../docs/chapters/moon.md) | a | x | 1.5 | digits |"))
      << "a claim has no scene\n"
      << page;
  EXPECT_TRUE(has(page, "-R '^elgohary/table-1/'"));
}

TEST_F(Pages, OfValuesFoldAwayWhatIsContext) {
  const std::string page =
      reproduction_page({checked("sun", "a", Verdict::context, "in MATLAB"),
                         checked("sun", "b", Verdict::reproduced), checked("sun", "c", Verdict::context)},
                        Guide(folder_.path()));
  const auto fold = page.find("<details>\n<summary>"), end = page.find("</details>");
  ASSERT_NE(fold, std::string::npos);
  EXPECT_TRUE(has(page.substr(fold, end - fold), "2 run times"));
  EXPECT_TRUE(has(page.substr(fold, end - fold), "| a | x | 1.5 lb | in MATLAB |"));
  EXPECT_FALSE(has(page.substr(fold), "| b |"));
  EXPECT_LT(page.find("| b | x |"), fold);
}

TEST_F(Pages, OfErrataHaveASectionAChapterWithLinksToScenesAndTests) {
  Erratum sign{"sun",
               "sun-1",
               "elgohary",
               "Table 1, C3",
               "formula",
               R"(\f$+|a|\f$)",
               R"(\f$-a\f$, \f$b\f$)",
               "",
               "no",
               {"chapter_sun:Errata.Sign", "unit_sun:A.B"},
               "2",
               "1e-9"};
  Erratum word{"moon", "moon-2", "roy", "before (2)", "wording", "left", "right", "", "no", {}, "", ""};
  const std::string page = errata_page({word, sign}, Guide(folder_.path()));
  EXPECT_TRUE(has(page, "| [The Sun](#errata_sun) | 1 | 0 | 0 | 0 |")) << page;
  EXPECT_TRUE(has(page, "| [moon](#errata_moon) | 0 | 0 | 0 | 1 |")) << page;
  EXPECT_LT(page.find("<a id=\"errata_sun\"></a>\n## The Sun"),
            page.find("<a id=\"errata_moon\"></a>\n## moon"));
  EXPECT_TRUE(
      has(page,
          R"(| [Table 1](../docs/chapters/sun.md#table-1), C3 | $`+\|a\|`$ | $`-a`$, $`b`$ | 2 | 1e-9 |  | )"
          "[Sign](../tests/chapters/sun/errata_test.cpp) `unit_sun:A.B` |"))
      << page;
  EXPECT_TRUE(has(page, "| before (2) | left | right |")) << page;
  EXPECT_TRUE(has(errata_table({sign}, "sun"), R"(| Table 1, C3 | \f$+\|a\|\f$ | \f$-a\f$, \f$b\f$ |)"));
}

TEST_F(Pages, CallTestsBySentences) {
  put(folder_ / "tests/moon/more_test.cpp",
      "\nTEST(Errata, Table2_6_TheSign) {}\n\nTEST(Errata, C8_ForAPoint3) {}\n\nTEST(Errata,\n     Sign) "
      "{}\n");
  const Guide guide(folder_.path());
  EXPECT_EQ(guide.test_link("unit_moon:Errata.Table2_6_TheSign"),
            "[Table 2.6 the sign](../tests/moon/more_test.cpp)");
  EXPECT_EQ(guide.test_link("unit_moon:Errata.C8_ForAPoint3"),
            "[C8 for a point 3](../tests/moon/more_test.cpp)");
  EXPECT_EQ(guide.test_link("chapter_sun:Errata.Sign"), "[Sign](../tests/chapters/sun/errata_test.cpp)");
}

TEST_F(Pages, OfAnInstalledFolderHaveNoTitlesAndTests) {
  std::filesystem::remove_all(folder_ / "docs");
  std::filesystem::remove_all(folder_ / "tests");
  const Guide guide(folder_.path());
  EXPECT_EQ(guide.chapter_title("sun"), "sun");
  EXPECT_EQ(guide.test_link("chapter_sun:Errata.Sign"), "`chapter_sun:Errata.Sign`");
  EXPECT_EQ(guide.link("moon", "roy", "fig-2", "there"), "[there](../docs/chapters/moon.md#fig-2a)");
  EXPECT_EQ(guide.link_words("moon", "roy", "Figure 2"), "[Figure 2](../docs/chapters/moon.md#fig-2a)");
  EXPECT_EQ(guide.link_words("moon", "roy", "Figure 7"), "Figure 7");
}

}  // namespace
}  // namespace nlmech::reproduction::pages_test
