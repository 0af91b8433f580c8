#include "tools/reproduction/completeness.hpp"

#include <gtest/gtest.h>

#include "nlmech/support/errors.hpp"
#include "tests/scene/temporary_folder.hpp"

namespace nlmech::reproduction::completeness_test {
namespace {

using namespace scene;
using tests::put;
using tests::TemporaryFolder;

const std::string curve = "<svg><g id=\"nlmech_plot_1a\" ><path d='M0,0 L1,1'/></g></svg>";
const std::string passing = R"({"quantities": [{"name": "a", "passes": true}]})";

/// One figure and one table of a chapter that is built, one figure of a chapter that is not; all complete.
class Completeness : public ::testing::Test {
 protected:
  Completeness() {
    put(folder_ / "tables/places.csv",
        "source,place,chapter,kind,subject,scenes\n"
        "roy,fig-1,moon,figure,craters,\n"
        "roy,table-1,moon,table,tides,\n"
        "roy,claim-1,moon,claim,none of these,\n"
        "laier,fig-9,sun,figure,spots,\n");
    put(folder_ / "tables/published/roy.csv",
        "place,row,quantity,value,unit,kind,nominal,inferred,expected,tolerance,because,tried,explains,"
        "erratum,reading\n"
        "table-1,r,q,1,1,value,,,context,,,,,,\n");
    put(folder_ / "results/moon/fig-1.csv", "x,y\n0,0\n1,1\n");
    put(folder_ / "results/moon/fig-1.json", passing);
    put(folder_ / "figures/moon/fig-1.svg", curve);
    put(folder_ / "tables/moon/table-1.csv", "x\n1\n");
    put(folder_ / "results/moon/table-1.json", passing);
  }
  std::vector<Shown> shown() const { return collect_shown({"moon"}, folder_.path(), folder_.path()); }

  TemporaryFolder folder_;
};

TEST_F(Completeness, CountsWhatIsThere) {
  const auto all = shown();
  ASSERT_EQ(all.size(), 3U) << "a claim is neither figure nor table";
  EXPECT_EQ(all[0].numbers, 2U);
  EXPECT_EQ(all[0].checked, 1U);
  EXPECT_EQ(all[0].passed, 1U);
  EXPECT_EQ(all[1].published, 1U);
  EXPECT_FALSE(all[2].built);
  for (const Shown& s : all) EXPECT_TRUE(s.complete()) << s.place.name;
  const std::string page = completeness_page(all);
  EXPECT_NE(page.find("| roy | 1 | 1 | 2 | 0 |"), std::string::npos) << page;
  EXPECT_NE(page.find("| [fig-1](../docs/chapters/moon.md#fig-1) | moon | craters | 2 | 1 | 0 | complete |"),
            std::string::npos)
      << page;
  EXPECT_NE(page.find("| [table-1](../docs/chapters/moon.md#table-1) |"), std::string::npos) << page;
  EXPECT_NE(page.find("| fig-9 | sun | spots | 0 | 0 | 0 | not built |"), std::string::npos) << page;
}

// A paper that repeats figures of another source: all of the scenes that show one have to be there.
TEST_F(Completeness, OfAFigureThatSeveralScenesShow) {
  put(folder_ / "tables/places.csv",
      "source,place,chapter,kind,subject,scenes\n"
      "roy,fig-1,moon,figure,craters,\n"
      "roy,table-1,moon,table,tides,\n"
      "paper,fig-7,moon,figure,craters again,fig-1 fig-2\n");
  EXPECT_FALSE(shown()[2].complete());
  put(folder_ / "results/moon/fig-2.csv", "x,y\n0,0\n");
  put(folder_ / "results/moon/fig-2.json", passing);
  put(folder_ / "figures/moon/fig-2.svg", curve);
  EXPECT_TRUE(shown()[2].complete());
  EXPECT_EQ(shown()[2].numbers, 3U);
  EXPECT_EQ(shown()[2].checked, 2U);
  const std::string page = completeness_page(shown());
  EXPECT_NE(page.find("| fig-7: [fig-1](../docs/chapters/moon.md#fig-1), "
                      "[fig-2](../docs/chapters/moon.md#fig-2) | moon |"),
            std::string::npos)
      << page;
}

TEST_F(Completeness, SeesWhatIsMissing) {
  const auto first_is_incomplete = [&] { return !shown()[0].complete(); };
  put(folder_ / "figures/moon/fig-1.svg", "<svg><g id=\"nlmech_plot_1a\" ></g></svg>");
  EXPECT_TRUE(first_is_incomplete()) << "axes without a curve";
  put(folder_ / "figures/moon/fig-1.svg", "<svg></svg>");
  EXPECT_TRUE(first_is_incomplete()) << "no plot at all";
  put(folder_ / "figures/moon/fig-1.svg", curve);
  EXPECT_FALSE(first_is_incomplete());
  put(folder_ / "results/moon/fig-1.json", R"({"quantities": [{"passes": true}, {"passes": false}]})");
  EXPECT_TRUE(first_is_incomplete()) << "a check that fails";
  put(folder_ / "results/moon/fig-1.json", R"({"quantities": []})");
  EXPECT_TRUE(first_is_incomplete()) << "nothing checked";
  put(folder_ / "results/moon/fig-1.json", passing);
  put(folder_ / "results/moon/fig-1.csv", "x,y\n");
  EXPECT_TRUE(first_is_incomplete()) << "no data";
  EXPECT_NE(completeness_page(shown()).find("| INCOMPLETE |"), std::string::npos);
}

TEST_F(Completeness, RefusesABrokenRecord) {
  put(folder_ / "results/moon/fig-1.json", "{");
  EXPECT_THROW(static_cast<void>(shown()), InputError);
}

}  // namespace
}  // namespace nlmech::reproduction::completeness_test
