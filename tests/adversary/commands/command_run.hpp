/// @file
/// Whole programs, for hunts: what they print and say.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tests/adversary/adversary.hpp"

namespace nlmech::adversary {

/// A command that has ended.
struct Ran {
  std::string words;                           ///< as typed
  int exit_code = 0;                           ///< 0, 1, 2
  std::string errors;                          ///< on standard error
  std::vector<std::string> header;             ///< the first row of its CSV
  std::vector<std::vector<std::string>> rows;  ///< those below it
};

/// Runs a command of the build. @param limit for its option of that name, in seconds
[[nodiscard]] Ran ran(const std::string& words, int limit = 5);

/// A failure that says something, or something worse; nothing for a success.
[[nodiscard]] std::optional<Case> failed(const Ran& r);

/// The number of a cell; not a number if it is none.
[[nodiscard]] double number(const std::string& cell);

/// That a program is not built; empty if it is.
[[nodiscard]] std::string missing_program(const std::string& program);

}  // namespace nlmech::adversary
