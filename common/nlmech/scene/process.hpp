/// @file
/// Running another program without a shell.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace nlmech::scene {

/// What a program wrote, and how it ended.
struct Finished {
  int exit_code = 0;  ///< 128 + number of the signal if a signal ended it
  std::string output, errors;
};

/// Runs @p arguments (the program first, looked up in PATH) in @p folder and waits for its end. Its standard input is empty.
/// @throws Failure naming the program if it cannot be started
[[nodiscard]] Finished run_program(const std::vector<std::string>& arguments, const std::filesystem::path& folder);

}  // namespace nlmech::scene
