/// @file
/// A program as a user runs it, in a folder of its own for each test.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "nlmech/scene/program/files.hpp"
#include "nlmech/scene/program/process.hpp"

namespace nlmech::tests {

/// Of its files nothing stays behind.
class ProgramInFolder : public testing::Test {
 protected:
  explicit ProgramInFolder(std::string program) : program_(std::move(program)) {}

  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() /
              (std::string("nlmech-") + testing::UnitTest::GetInstance()->current_test_info()->name() +
               std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  [[nodiscard]] scene::Finished run(const std::vector<std::string>& words) const {
    std::vector<std::string> arguments = {program_};
    arguments.insert(arguments.end(), words.begin(), words.end());
    return scene::run_program(arguments, folder_);
  }
  /// Of a run that has to succeed.
  [[nodiscard]] std::string output(const std::vector<std::string>& words) const {
    const scene::Finished f = run(words);
    EXPECT_EQ(f.exit_code, 0) << f.errors;
    return f.output;
  }
  void write(const std::string& name, const std::string& text) const {
    scene::write_whole(folder_ / name, text);
  }
  /// Wrong use, which prints nothing and names all these.
  void refused(const std::vector<std::string>& words, const std::vector<std::string>& named) const {
    const scene::Finished f = run(words);
    EXPECT_EQ(f.exit_code, 2) << f.errors;
    EXPECT_TRUE(f.output.empty());
    for (const std::string& part : named)
      EXPECT_NE(f.errors.find(part), std::string::npos) << part << "\n" << f.errors;
  }

  std::string program_;
  std::filesystem::path folder_;
};

}  // namespace nlmech::tests
