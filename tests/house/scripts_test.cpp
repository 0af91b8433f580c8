/// What CI relies on beside the build: which folders a change touches, and that figures keep their texts.
#include <gtest/gtest.h>

#include "nlmech/scene/program/process.hpp"
#include "tests/house/house.hpp"
#include "tests/places.hpp"
#include "tests/scene/temporary_folder.hpp"

namespace nlmech::tests::scripts_test {
namespace {

namespace fs = std::filesystem;

void write(const fs::path& file, const std::string& text) {
  fs::create_directories(file.parent_path());
  std::ofstream(file) << text;
}

/// A small repository with the script, of the components support, series on it, and orbit on that.
class AffectedTests : public ::testing::Test {
 protected:
  AffectedTests() {
    fs::create_directories(folder_ / "scripts");
    fs::copy_file(NLMECH_SOURCE_DIR "/scripts/affected-tests", folder_ / "scripts/affected-tests");
    write(folder_ / "components.txt", "support: \nseries: support\norbit: support series\ngeodesy: \n");
    for (const char* name : {"support", "series", "orbit", "geodesy", "orbit_long", "chapters", "pages"})
      write(folder_ / "tests" / name / "a_test.cpp", "");
    git({"init", "--quiet"});
    commit();
  }
  void commit() const {
    git({"add", "."});
    git({"-c", "user.name=t", "-c", "user.email=t@t", "commit", "--quiet", "--message", "t"});
  }
  /// The folders for a change of these files.
  [[nodiscard]] std::vector<std::string> after(const std::vector<std::string>& files) const {
    for (const std::string& file : files) write(folder_ / file, "changed");
    commit();
    return folders("HEAD~1");
  }
  [[nodiscard]] std::vector<std::string> folders(const std::string& base) const {
    const scene::Finished done = run_here({"scripts/affected-tests", base, "components.txt"});
    EXPECT_EQ(done.exit_code, 0) << done.errors;
    return words_of(done.output);
  }

 private:
  /// Without what git tells the programs of a hook: it would be another repository.
  [[nodiscard]] scene::Finished run_here(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(),
                     {"env", "-u", "GIT_DIR", "-u", "GIT_WORK_TREE", "-u", "GIT_INDEX_FILE"});
    return scene::run_program(arguments, folder_.path());
  }
  void git(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), {"git", "-c", "commit.gpgsign=false"});
    const scene::Finished done = run_here(arguments);
    ASSERT_EQ(done.exit_code, 0) << done.errors;
  }

  TemporaryFolder folder_;
};

using Folders = std::vector<std::string>;
const Folders every = {"tests/geodesy", "tests/orbit", "tests/orbit_long", "tests/series", "tests/support"};

TEST_F(AffectedTests, AreThoseOfWhatStandsOnAComponent) {
  EXPECT_EQ(after({"common/nlmech/series/a.hpp"}),
            (Folders{"tests/orbit", "tests/orbit_long", "tests/series"}));
  EXPECT_EQ(after({"common/nlmech/geodesy/a.cpp"}), Folders{"tests/geodesy"});
}

TEST_F(AffectedTests, AreThoseThatChanged) {
  EXPECT_EQ(after({"tests/series/a_test.cpp"}), Folders{"tests/series"});
  EXPECT_EQ(after({"tests/orbit_long/a_test.cpp"}), (Folders{"tests/orbit", "tests/orbit_long"}));
}

// Folders that belong to no component come before and after those that do.
TEST_F(AffectedTests, AreNoneOfChaptersAndPages) {
  EXPECT_EQ(after({"tests/chapters/a_test.cpp", "tests/pages/a_test.cpp", "README.md"}), Folders{});
  EXPECT_EQ(after({"tests/chapters/a_test.cpp.orig", "tests/support/a_test.cpp", "tests/pages/b_test.cpp"}),
            Folders{"tests/support"});
}

TEST_F(AffectedTests, AreAllWhereTheBuildChangedOrNothingIsKnown) {
  EXPECT_EQ(after({"cmake/a.cmake"}), every);
  EXPECT_EQ(after({"packages.txt"}), every);
  EXPECT_EQ(folders(""), every);
}

/// A figure whose ylabel is moved by so many characters.
class LostLabels : public ::testing::Test {
 protected:
  [[nodiscard]] scene::Finished sought() const {
    return scene::run_program({NLMECH_SOURCE_DIR "/scripts/lost-labels", folder_.path().string()},
                              folder_.path());
  }
  [[nodiscard]] scene::Finished with_label_moved(const std::string& by) const {
    write(folder_ / "results/chapter/scene.gp",
          "width = '400'\n"
          "height = '300'\n"
          "set terminal svg size width + 0, height + 0\n"
          "set lmargin screen 0.2\n"
          "set ylabel 'miss (m)' offset " +
              by +
              ",0\n"
              "plot [0:1] 1e4*x notitle\n");
    const scene::Finished drawn = scene::run_program({"gnuplot", "results/chapter/scene.gp"}, folder_.path());
    write(folder_ / "figures/chapter/scene.svg", drawn.output);
    return sought();
  }

  TemporaryFolder folder_;
};

TEST_F(LostLabels, AreNoneWhereAllIsDrawn) {
  const scene::Finished done = with_label_moved("0");
  EXPECT_EQ(done.exit_code, 0) << done.output << done.errors;
  EXPECT_EQ(done.output, "");
}

TEST_F(LostLabels, AreNamedWithTheFigure) {
  const scene::Finished done = with_label_moved("-4");
  EXPECT_EQ(done.exit_code, 1) << done.errors;
  EXPECT_NE(done.output.find("miss (m)"), std::string::npos) << done.output;
  EXPECT_NE(done.output.find("scene.gp"), std::string::npos) << done.output;
}

TEST_F(LostLabels, AreNotSoughtWhereNothingIsDrawn) {
  EXPECT_EQ(sought().exit_code, 2);
  write(folder_ / "results/chapter/scene.gp", "plot [0:1] x\n");
  const scene::Finished done = sought();
  EXPECT_EQ(done.exit_code, 2);
  EXPECT_NE(done.errors.find("scene.svg"), std::string::npos) << done.errors;
}

}  // namespace
}  // namespace nlmech::tests::scripts_test
