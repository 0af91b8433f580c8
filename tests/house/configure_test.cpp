/// The build asks for what was selected, and says what is missing.
#include <gtest/gtest.h>

#include "nlmech/scene/program/files.hpp"
#include "nlmech/scene/program/process.hpp"
#include "tests/house/house.hpp"
#include "tests/places.hpp"
#include "tests/scene/temporary_folder.hpp"

namespace nlmech::tests::configure_test {
namespace {

class Configure : public ::testing::Test {
 protected:
  scene::Finished configure(const std::vector<std::string>& settings) const {
    std::vector<std::string> command = {
        NLMECH_CMAKE,        "-S", NLMECH_SOURCE_DIR, "-B",
        folder_.string(),    "-G", NLMECH_GENERATOR,  "-DCMAKE_CXX_COMPILER=" NLMECH_CXX,
        "-DNLMECH_TESTS=OFF"};
    command.insert(command.end(), settings.begin(), settings.end());
    return scene::run_program(command, {});
  }
  void expect_refusal(const scene::Finished& done, const std::string& words) const {
    EXPECT_NE(done.exit_code, 0);
    std::string said;  // CMake wraps its messages
    for (const std::string& word : words_of(done.errors)) said += word + " ";
    EXPECT_NE(said.find(words), std::string::npos) << done.errors;
  }

  TemporaryFolder folder_;
};

TEST_F(Configure, GeodesyNeedsNoNumericalLibrary) {
  const scene::Finished done =
      configure({"-DNLMECH_CHAPTERS=geodesy", "-DCMAKE_DISABLE_FIND_PACKAGE_SUNDIALS=ON",
                 "-DCMAKE_DISABLE_FIND_PACKAGE_GSL=ON", "-DCMAKE_DISABLE_FIND_PACKAGE_Boost=ON",
                 "-DCMAKE_DISABLE_FIND_PACKAGE_Eigen3=ON"});
  EXPECT_EQ(done.exit_code, 0) << done.errors;
  EXPECT_EQ(lines_of(folder_ / "chapters.txt"), std::vector<std::string>{"geodesy"});
}

TEST_F(Configure, NoChapterAtAllIsFine) {
  EXPECT_EQ(configure({"-DNLMECH_CHAPTERS=none", "-DNLMECH_PEERS=none"}).exit_code, 0);
}

// As FetchContent does it with a downloaded source: add_subdirectory().
TEST_F(Configure, WithinAnotherProjectItIsTheLibraryAlone) {
  TemporaryFolder project;
  scene::write_whole((project / "CMakeLists.txt").string(),
                     "cmake_minimum_required(VERSION 3.25)\nproject(mine LANGUAGES CXX)\n"
                     "include(FetchContent)\nFetchContent_Declare(nlmech SOURCE_DIR \"" NLMECH_SOURCE_DIR
                     "\")\nFetchContent_MakeAvailable(nlmech)\n");
  const std::string build = (project / "build").string();
  const scene::Finished made = scene::run_program({NLMECH_CMAKE, "-S", project.string(), "-B", build, "-G",
                                                   NLMECH_GENERATOR, "-DCMAKE_CXX_COMPILER=" NLMECH_CXX},
                                                  {});
  ASSERT_EQ(made.exit_code, 0) << made.errors;
  const std::string targets =
      scene::run_program({NLMECH_CMAKE, "--build", build, "--target", "help"}, {}).output;
  for (const char* there : {"nlmech_ivp", "nlmech_frames", "nlmech_geodesy"})
    EXPECT_NE(targets.find(there), std::string::npos) << there;
  for (const char* absent :
       {"homotopy", "reproduction", "unit_", "figures", "nlmech_scene", "every_integrator"})
    EXPECT_EQ(targets.find(absent), std::string::npos) << absent;
}

TEST_F(Configure, SaysWhichChaptersThereAre) {
  expect_refusal(configure({"-DNLMECH_CHAPTERS=geodesy,astrology"}),
                 "there is no 'astrology'; there is homotopy");
}

TEST_F(Configure, SaysWhichPackageIsMissing) {
  expect_refusal(configure({"-DCMAKE_DISABLE_FIND_PACKAGE_fmt=ON"}),
                 "fmt was not found. On Debian: apt-get install libfmt-dev");
}

/// packages.txt is the only list: what the build asks for by name must be in it.
TEST(Packages, ThatTheBuildNamesAreListed) {
  const auto listed = lines_of(NLMECH_SOURCE_DIR "/packages.txt");
  const std::set<std::string> packages(listed.begin(), listed.end());
  int named = 0;
  std::vector<std::filesystem::path> files;
  for (const char* folder : {"common", "chapters", "tests", "cmake", "tools"}) {
    for (const auto& file : sources_under(folder)) files.push_back(file);
  }
  for (const auto& file : files) {
    if (file.extension() != ".cmake" && file.extension() != ".txt") continue;
    for (std::string line : lines_of(file)) {
      line.erase(0, line.find_first_not_of(' '));
      if (!line.starts_with("nlmech_require")) continue;
      const auto open = line.find('('), close = line.find(')');
      const auto words = words_of(line.substr(open + 1, close - open - 1));
      const std::size_t place = line.starts_with("nlmech_require_pkg") ? 1 : 2;
      ASSERT_GT(words.size(), place) << file << ": " << line;
      EXPECT_TRUE(packages.contains(words[place])) << file << ": " << line;
      ++named;
    }
  }
  EXPECT_GE(named, 5);
}

}  // namespace
}  // namespace nlmech::tests::configure_test
