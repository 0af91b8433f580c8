/// @file
/// Running the fixture chapter as a user would, with its own data.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "nlmech/scene/program/process.hpp"
#include "tests/places.hpp"
#include "tests/scene/temporary_folder.hpp"

namespace nlmech::tests {

using scene::Finished;

/// A test with a folder of its own for what the fixture writes.
class FixtureProgram : public ::testing::Test {
 protected:
  /// @param settings environment variables, besides NLMECH_DATA
  Finished fixture(std::vector<std::string> arguments, std::vector<std::string> settings = {}) const {
    arguments.insert(arguments.begin(), NLMECH_FIXTURE);
    settings.push_back("NLMECH_DATA=" + data_.string());
    return scene::run_program(arguments, folder_.path(), settings);
  }
  /// The same through a shell, in which $fixture stands for the program: "$fixture list > /dev/full".
  Finished shell(const std::string& command) const {
    return scene::run_program(
        {"sh", "-c", command}, folder_.path(),
        {"NLMECH_DATA=" + data_.string(), std::string("fixture=").append(NLMECH_FIXTURE)});
  }
  /// What the fixture wrote, by the paths from the folder.
  std::map<std::string, std::string> written(const std::string& out = ".") const {
    auto files = files_in(folder_ / out);
    files.erase("figures/style.gp");  // which scripts load: one for all scenes
    return files;
  }

  TemporaryFolder folder_;
  std::filesystem::path data_ = NLMECH_SOURCE_DIR "/tests/scene/fixture/data";
};

/// A sentence for people: one line, and no trace of an abort.
inline void expect_sentence(const std::string& errors, const std::string& part) {
  EXPECT_NE(errors.find(part), std::string::npos) << "'" << errors << "' does not say '" << part << "'";
  EXPECT_EQ(errors.find("terminate called"), std::string::npos) << errors;
  EXPECT_TRUE(errors.ends_with('\n')) << errors;
}

}  // namespace nlmech::tests
