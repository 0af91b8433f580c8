/// The tests of the published values, on a chapter with made-up values: each one must fail for the reason it
/// exists.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "nlmech/scene/program/process.hpp"
#include "tests/places.hpp"
#include "tests/scene/temporary_folder.hpp"

namespace nlmech::tests::machinery_test {
namespace {

namespace fs = std::filesystem;

const std::string here = NLMECH_SOURCE_DIR "/tests/reproduction/";
const std::string fixture_files = NLMECH_SOURCE_DIR "/tests/scene/fixture/";
const std::string nominal = "made-up/table-1/nominal/reproduced", input = "made-up/table-1/load/input";

class Machinery : public ::testing::Test {
 protected:
  Machinery() {
    fs::copy(fixture_files + "data", folder_ / "data", fs::copy_options::recursive);
    put(folder_ / "build/chapters.txt", "fixture\n");
  }
  scene::Finished run(const std::vector<std::string>& command, const std::string& fault = "") const {
    return scene::run_program(command, folder_ / "build",
                              {"NLMECH_DATA=" + (folder_ / "data").string(), "FIXTURE_FAULT=" + fault});
  }
  /// What CMakeLists.txt of this folder does for a chapter, done for the fixture.
  void list_tests() const {
    const std::string build = (folder_ / "build").string(), data = (folder_ / "data").string();
    const scene::Finished listed =
        run({NLMECH_CMAKE, "-D", fmt::format("PROGRAM={}", NLMECH_REPRODUCTION), "-D", "SOURCE=" + data, "-D",
             fmt::format("CHAPTERS={}/chapters.txt", build), "-D", "OUT=" + build, "-D",
             fmt::format("LIST={}/values.cmake", build), "-P", here + "list_values.cmake"});
    ASSERT_EQ(listed.exit_code, 0) << listed.errors;
    const auto step = [&](const char* name, const char* what) {
      return fmt::format(
          R"(add_test({} "{}" -D STEP={} -D "PROGRAM={}" -D CHAPTER=fixture -D "OUT={}" -P "{}check.cmake"))",
          name, NLMECH_CMAKE, what, NLMECH_FIXTURE, build, here);
    };
    put(folder_ / "build/CTestTestfile.cmake",
        fmt::format(
            "include(\"{}/values.cmake\")\n{}\n{}\n"
            "set_tests_properties(check/fixture PROPERTIES FIXTURES_SETUP check_fixture)\n"
            "set_tests_properties(check/fixture/quantities PROPERTIES FIXTURES_REQUIRED check_fixture)\n",
            build, step("check/fixture", "measure"), step("check/fixture/quantities", "quantities")));
  }
  /// How the test of a name ended, in the words of ctest: "Passed", "***Failed", "***Skipped", "***Not Run".
  std::string outcome(const std::string& report, const std::string& name) const {
    for (std::size_t at = 0; (at = report.find(": " + name + " .", at)) != std::string::npos; ++at) {
      const std::string line = report.substr(at, report.find('\n', at) - at);
      for (const char* word : {"Passed", "***Failed", "***Skipped", "***Not Run"}) {
        if (line.find(word) != std::string::npos) return word;
      }
    }
    return "nowhere in\n" + report;
  }
  std::string ctest(const std::string& fault = "", const std::vector<std::string>& arguments = {}) const {
    std::vector<std::string> command = {NLMECH_CTEST};
    command.insert(command.end(), arguments.begin(), arguments.end());
    return run(command, fault).output;
  }

  TemporaryFolder folder_;
};

TEST_F(Machinery, PassesValuesThatAreKeptAndSkipsWhatIsNotBuilt) {
  list_tests();
  const std::string report = ctest();
  for (const std::string& name :
       {nominal, input, std::string("made-up/table-1/inferred/reproduced (inferred)"),
        std::string("made-up/table-1/start; guess, \"seed\" #1/not stated"), std::string("check/fixture"),
        std::string("check/fixture/quantities")}) {
    EXPECT_EQ(outcome(report, name), "Passed") << name;
  }
  EXPECT_EQ(outcome(report, "made-up/table-2/foreign/reproduced"), "***Skipped");
  EXPECT_NE(report.find("100% tests passed, 0 tests failed out of 10"), std::string::npos) << report;
}

TEST_F(Machinery, FailsEachValueThatIsMissedAndNoOther) {
  fs::copy_file(fixture_files + "missed.csv", folder_ / "data/tables/published/made-up.csv",
                fs::copy_options::overwrite_existing);
  list_tests();
  const std::string report = ctest();
  for (const std::string& name :
       {nominal, input, std::string("made-up/table-1/inferred/reproduced (inferred)"),
        std::string("made-up/table-1/smaller/better"), std::string("made-up/table-1/other/differs")}) {
    EXPECT_EQ(outcome(report, name), "***Failed") << name;
  }
  EXPECT_EQ(outcome(report, "made-up/table-1/old machine/context"), "Passed");
  EXPECT_EQ(outcome(report, "check/fixture/quantities"), "Passed");
}

TEST_F(Machinery, FailsTheQuantitiesAndLetsTheValuesStand) {
  list_tests();
  const std::string report = ctest("quantity");
  EXPECT_EQ(outcome(report, "check/fixture"), "Passed");
  EXPECT_EQ(outcome(report, "check/fixture/quantities"), "***Failed");
  EXPECT_EQ(outcome(report, nominal), "Passed");
}

TEST_F(Machinery, DoesNotTakeTheValuesOfAnEarlierCheck) {
  list_tests();
  EXPECT_EQ(outcome(ctest(), nominal), "Passed");
  put(folder_ / "data/tables/published/made-up.csv", "place,row\nnot,a row\n");
  const std::string report = ctest();
  EXPECT_EQ(outcome(report, "check/fixture"), "***Failed");
  EXPECT_EQ(outcome(report, nominal), "***Not Run");
}

TEST_F(Machinery, ComputesOnlyWhatIsAskedFor) {
  list_tests();
  const std::string report = ctest("", {"-R", "made-up/table-2"});
  EXPECT_EQ(outcome(report, "made-up/table-2/foreign/reproduced"), "***Skipped");
  EXPECT_NE(outcome(report, "check/fixture"), "Passed") << "the chapter was checked for nothing";
  EXPECT_EQ(outcome(ctest("", {"-R", "made-up/table-1/load"}), "check/fixture"), "Passed");
}

TEST_F(Machinery, CopesWithEveryCharacter) {
  std::ofstream(folder_ / "data/tables/published/made-up.csv", std::ios::app)
      << "table-2,\"a;b [c] ]] (d) #e $f ${g} \\h 'i' \"\"j\"\" k\",\"l, m %n &o *p |q "
         "~r\",1,1,value,,,context,,,,,,\n";
  list_tests();
  EXPECT_EQ(outcome(ctest(), "made-up/table-2/a;b [c] ]] (d) #e $f ${g} \\h 'i' \"j\" k/l, m %n &o *p |q ~r"),
            "***Skipped");
}

TEST_F(Machinery, ReportsOverAllChapters) {
  list_tests();
  static_cast<void>(ctest());
  const auto report = [&] {
    return run({NLMECH_REPRODUCTION, "report", "--chapters", "chapters.txt", "--page", "page.md"});
  };
  EXPECT_EQ(report().exit_code, 0);
  EXPECT_NE(report().output.find("8 published values, 0 fail\n"), std::string::npos);
  const std::string page = bytes_of(folder_ / "build/page.md");
  EXPECT_NE(page.find("## fixture\n\nmade-up. "), std::string::npos) << page;
  fs::copy_file(fixture_files + "missed.csv", folder_ / "data/tables/published/made-up.csv",
                fs::copy_options::overwrite_existing);
  EXPECT_EQ(report().exit_code, 1);
  EXPECT_NE(report().output.find("8 published values, 5 fail\n"), std::string::npos);
}

TEST_F(Machinery, RefusesWhatItDoesNotKnow) {
  const auto refused = [&](const std::vector<std::string>& arguments, const std::string& said) {
    std::vector<std::string> command = {NLMECH_REPRODUCTION};
    command.insert(command.end(), arguments.begin(), arguments.end());
    const scene::Finished done = run(command);
    EXPECT_EQ(done.exit_code, 2) << said;
    EXPECT_EQ(done.output, "") << said;
    EXPECT_NE(done.errors.find(said), std::string::npos) << done.errors;
  };
  refused({"verdict", "nobody/said/such a/thing", "--chapters", "chapters.txt"},
          "no source prints 'nobody/said/such a/thing'");
  refused({"verdict", nominal, "--chapters", "none.txt"}, "none.txt: No such file or directory");
  refused({"verdict", nominal, "--chapters", "chapters.txt"},
          "results/fixture/check.csv: No such file or directory");
  refused({"report"}, "--chapters");
  refused({}, "subcommand");
}

}  // namespace
}  // namespace nlmech::tests::machinery_test
