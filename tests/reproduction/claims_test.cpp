#include "tools/reproduction/claims.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "nlmech/support/errors.hpp"
#include "tests/scene/temporary_folder.hpp"

namespace nlmech::reproduction::claims_test {
namespace {

using namespace scene;
using tests::put;
using tests::TemporaryFolder;

const std::string header = "source,place,chapter,claim,scene,quantity,means,verdict,reading\n";

TEST(Claims, WordsAreRanges) {
  EXPECT_TRUE(within("at least 2", 2));
  EXPECT_FALSE(within("at least 2", 1.99));
  EXPECT_TRUE(within("at most -1e-3", -0.001));
  EXPECT_FALSE(within("at most -1e-3", 0));
  EXPECT_TRUE(within("0.5 to 2", 0.5));
  EXPECT_FALSE(within("0.5 to 2", 2.01));
  for (const char* words : {"at least 2", "at most 2", "1 to 2"})
    EXPECT_FALSE(within(words, std::nan(""))) << words;
  EXPECT_TRUE(within("at least 2", std::numeric_limits<double>::infinity())) << "a method that overflows";
}

TEST(Claims, OtherWordsAreRefused) {
  for (const char* words : {"", "2", "at least", "at least two", "2 to 1", "1 to", "about 2", "at most nan"})
    EXPECT_THROW(static_cast<void>(within(words, 1)), InputError) << words;
}

/// The sentence that @p row is refused with.
std::string refusal(const std::string& row) {
  try {
    static_cast<void>(parse_claims(header + row + "\n", "claims.csv"));
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Claims, RowsThatSayTooLittleAreRefused) {
  EXPECT_EQ(refusal("roy,1,moon,round,fig-1,radius,at least 2,holds,"), "accepted");
  EXPECT_EQ(refusal("roy,1,moon,round,,,,not stated,no radius"), "accepted");
  EXPECT_EQ(refusal("roy,1,moon,round,fig-1,radius,at least 2"), "claims.csv: line 2: 7 of 9 cells");
  EXPECT_EQ(refusal("roy,1,moon,,fig-1,radius,at least 2,holds,"), "claims.csv: line 2: no claim");
  EXPECT_EQ(refusal("roy,1,moon,round,fig-1,radius,at least 2,better,"),
            "claims.csv: line 2: 'better' is no verdict on a claim");
  EXPECT_EQ(refusal("roy,1,moon,round,fig-1,,at least 2,holds,"),
            "claims.csv: line 2: a verdict without evidence");
  EXPECT_EQ(refusal("roy,1,moon,round,fig-1,radius,,holds,"),
            "claims.csv: line 2: what a claim means for its quantity: of each that is judged");
  EXPECT_EQ(refusal("roy,1,moon,round,,,,not stated,"),
            "claims.csv: line 2: not stated, and not said what is left out");
  EXPECT_EQ(refusal("roy,1,moon,round,fig-1,radius,two,holds,"),
            "claims.csv: line 2: 'two' is not of the form 'at least 2', 'at most 2' or '1 to 2'");
  EXPECT_THROW(static_cast<void>(parse_claims("place\n", "claims.csv")), InputError);
}

/// A chapter that is built, one that is not, and each kind of evidence.
class ClaimsOnDisk : public ::testing::Test {
 protected:
  ClaimsOnDisk() {
    put(folder_ / "tables/places.csv",
        "source,place,chapter,kind,subject,scenes\nroy,table-1,moon,table,tides,\nroy,table-2,sun,table,heat,"
        "\n");
    put(folder_ / "tables/published/roy.csv",
        "place,row,quantity,value,unit,kind,nominal,inferred,expected,tolerance,because,tried,explains,"
        "erratum,reading\ntable-1,low,height,1,m,value,,,differs,digits,,,,,\n");
    put(folder_ / "results/moon/check.csv",
        "name,nominal,inferred,verdict,passes\nroy/table-1/low/height,3,4,differs,1\n");
    put(folder_ / "results/moon/fig-1.json", R"({"quantities": [{"name": "radius", "value": 2.5}]})");
    put(folder_ / "tables/ratios.json",
        R"({"quantities": [{"name": "faster", "value": 10}, {"name": "word", "value": "holds"}]})");
  }
  std::vector<JudgedClaim> judge(const std::string& row) {
    put(folder_ / "tables/claims.csv", header + row + "\n");
    return judge_claims({"moon"}, folder_.path(), folder_.path());
  }

  TemporaryFolder folder_;
};

TEST_F(ClaimsOnDisk, AreJudgedByTheirEvidence) {
  struct Case {
    std::string evidence;
    double value;
    Verdict verdict;
  };
  for (const Case& c : {Case{"fig-1,radius,at least 2,holds", 2.5, Verdict::holds},
                        Case{"fig-1,radius,at most 2,does not hold", 2.5, Verdict::does_not_hold},
                        Case{"REPRODUCTION,table-1/low/height,1 to 3,holds", 3, Verdict::holds},
                        Case{"RATIOS,faster,at least 30,does not hold", 10, Verdict::does_not_hold},
                        Case{"fig-1,radius,,not stated", 2.5, Verdict::not_stated}}) {
    const auto judged = judge("roy,1,moon,round," + c.evidence + ",why");
    ASSERT_EQ(judged.size(), 1U);
    EXPECT_EQ(judged[0].value, c.value) << c.evidence;
    EXPECT_EQ(judged[0].verdict, c.verdict) << c.evidence;
    EXPECT_TRUE(judged[0].passes) << c.evidence;
  }
}

TEST_F(ClaimsOnDisk, ARangeStandsInPlaceOfANumberThatDependsOnRounding) {
  put(folder_ / "tables/published/roy.csv",
      "place,row,quantity,value,unit,kind,nominal,inferred,expected,tolerance,because,tried,explains,"
      "erratum,reading\ntable-1,low,height,1,m,value,2..40 by rounding,,differs,digits,,,,,\n");
  const auto judged = judge("roy,1,moon,round,REPRODUCTION,table-1/low/height,1 to 3,holds,why");
  EXPECT_TRUE(judged[0].passes);
  EXPECT_EQ(judged[0].value, 3) << "which the verdict is of";
  EXPECT_NE(claims_page(judged).find("height | 2..40 by rounding | 1 to 3 | holds | why |"),
            std::string::npos)
      << claims_page(judged);
}

TEST_F(ClaimsOnDisk, AnotherVerdictOrNoEvidenceIsAMiss) {
  EXPECT_FALSE(judge("roy,1,moon,round,fig-1,radius,at least 3,holds,")[0].passes);
  for (const char* evidence : {"fig-1,colour,at most 2,does not hold", "fig-2,radius,at most 2,does not hold",
                               "RATIOS,word,at most 2,does not hold", "fig-1,colour,,not stated"}) {
    const auto judged = judge(std::string("roy,1,moon,round,") + evidence + ",why");
    EXPECT_TRUE(std::isnan(judged[0].value)) << evidence;
    EXPECT_FALSE(judged[0].passes) << evidence << ": a missing number is no evidence";
  }
}

TEST_F(ClaimsOnDisk, OfAChapterThatIsNotBuiltAreLeftOpen) {
  const auto judged = judge("roy,1,sun,hot,fig-1,heat,at least 1,holds,");
  EXPECT_EQ(judged[0].verdict, Verdict::not_built);
  EXPECT_TRUE(judged[0].passes);
}

TEST_F(ClaimsOnDisk, OfAChapterThatThereIsNotAreRefused) {
  EXPECT_THROW(judge("roy,1,mooon,round,fig-1,radius,at least 2,holds,"), InputError);
}

TEST_F(ClaimsOnDisk, ThePageCountsAndLinksThem) {
  const std::string page =
      claims_page(judge("roy,1,moon,round,fig-1,radius,at least 2,holds,of the disc\n"
                        "roy,2,moon,fast,RATIOS,faster,at least 30,does not hold,"));
  EXPECT_NE(page.find("| roy | 1 | 1 | 0 |"), std::string::npos) << page;
  EXPECT_NE(page.find("| 1 | moon | round | [fig-1](../docs/chapters/moon.md#fig-1): radius | 2.5 | at least "
                      "2 | holds | of the disc |"),
            std::string::npos)
      << page;
  EXPECT_NE(page.find("[RATIOS](RATIOS.md): faster | 10 | at least 30 | does not hold |"), std::string::npos)
      << page;
}

}  // namespace
}  // namespace nlmech::reproduction::claims_test
