/// @file
/// Running another program without a shell.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace nlmech::scene {

/// Output and exit code of a program.
struct Finished {
  int exit_code = 0;   ///< exit code; 128 + number of the signal if a signal ended the program
  std::string output;  ///< standard output
  std::string errors;  ///< standard error
};

/// Runs @p arguments (the program first, looked up in PATH) in @p folder and waits for its end. Its standard
/// input is empty.
/// @param folder empty for the current one
/// @param settings environment variables that differ from those of this process: "LC_ALL=C.UTF-8"
/// @throws Failure naming the program if it cannot be started
[[nodiscard]] Finished run_program(const std::vector<std::string>& arguments,
                                   const std::filesystem::path& folder,
                                   const std::vector<std::string>& settings = {});

}  // namespace nlmech::scene
