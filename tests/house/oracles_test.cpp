/// Numbers of the sources are those that the programs of tools/oracles print; and `scripts/oracles`, which
/// holds them to it, sees what differs.
#include <gtest/gtest.h>

#include "nlmech/scene/program/process.hpp"
#include "tests/house/house.hpp"
#include "tests/places.hpp"
#include "tests/scene/temporary_folder.hpp"

namespace nlmech::tests::oracles_test {
namespace {

namespace fs = std::filesystem;

TEST(Oracles, AreWhatTheSourcesSay) {
  const scene::Finished done = scene::run_program({NLMECH_SOURCE_DIR "/scripts/oracles", "uses"}, {});
  EXPECT_EQ(done.exit_code, 0) << done.output << done.errors;
}

void write(const fs::path& file, const std::string& text) {
  fs::create_directories(file.parent_path());
  std::ofstream(file) << text;
}

/// A small house with one program of two rows, both of which a source uses.
class OraclesScript : public ::testing::Test {
 protected:
  OraclesScript() {
    fs::create_directories(folder_ / "scripts");
    fs::copy_file(NLMECH_SOURCE_DIR "/scripts/oracles", folder_ / "scripts/oracles");
    program("1.4142", "-2.50e-3");
    write(folder_ / "tables/reference/oracles/roots.csv",
          "name,value,digits\ntwo,1.4142,5\nsmall,-2.50e-3,3\n");
    source("// oracle: roots two, small\ndouble a[] = {1.4142, -0.0025};\n");
  }
  void program(const std::string& two, const std::string& small) const {
    write(folder_ / "tools/oracles/roots.py",
          "print('name,value,digits\\ntwo," + two + ",5\\nsmall," + small + ",3')\n");
  }
  void source(const std::string& text) const { write(folder_ / "tests/a_test.cpp", text); }
  [[nodiscard]] scene::Finished said(const std::string& command) const {
    return scene::run_program({(folder_ / "scripts/oracles").string(), command}, folder_.path());
  }
  void expect_complaint(const std::string& command, const std::string& words) const {
    const scene::Finished done = said(command);
    EXPECT_EQ(done.exit_code, 1) << done.errors;
    EXPECT_NE(done.output.find(words), std::string::npos) << done.output << done.errors;
  }

  TemporaryFolder folder_;
};

TEST_F(OraclesScript, IsContentWithWhatAgrees) {
  for (const char* command : {"uses", "run"}) {
    const scene::Finished done = said(command);
    EXPECT_EQ(done.exit_code, 0) << done.output << done.errors;
    EXPECT_EQ(done.output, "");
  }
}

TEST_F(OraclesScript, TakesAUnitOfTheLastDigitOfAProgram) {
  program("1.4143", "-2.51e-3");
  EXPECT_EQ(said("run").exit_code, 0);
}

TEST_F(OraclesScript, NamesAProgramThatPrintsAnotherNumber) {
  program("1.4144", "-2.50e-3");
  expect_complaint("run", "roots two: 1.4144, not 1.4142");
}

TEST_F(OraclesScript, NamesANumberThatHasDrifted) {
  source("// oracle: roots two, small\ndouble a[] = {1.4152, -0.0025};\n");
  expect_complaint("uses", "tests/a_test.cpp:1: 1.4142 of roots two does not stand here");
}

// The empty line ends what a tag speaks for.
TEST_F(OraclesScript, LooksNoFurtherThanTheParagraph) {
  source("// oracle: roots two, small\ndouble a = 1.4142;\n\ndouble b = -0.0025;\n");
  expect_complaint("uses", "-2.50e-3 of roots small does not stand here");
}

TEST_F(OraclesScript, NamesARowThatNobodyUses) {
  source("// oracle: roots two\ndouble a = 1.4142;\n");
  expect_complaint("uses", "roots small: no source names this row");
}

TEST_F(OraclesScript, NamesATagWithoutARow) {
  source("// oracle: roots t*, small\n// oracle: roots three\ndouble a[] = {1.4142, -0.0025};\n");
  expect_complaint("uses", "tests/a_test.cpp:2: roots has no row three");
}

}  // namespace
}  // namespace nlmech::tests::oracles_test
