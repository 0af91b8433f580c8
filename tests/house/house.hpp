/// @file
/// What the tests of the house know about this build.
#pragma once

#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/places.hpp"

namespace nlmech::tests {

/// Lines of a text file. @throws std::runtime_error if there is no such file
[[nodiscard]] inline std::vector<std::string> lines_of(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in) throw std::runtime_error("cannot open " + file.string());
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

[[nodiscard]] inline std::vector<std::string> words_of(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> words;
  for (std::string word; in >> word;) words.push_back(word);
  return words;
}

/// The chapters of this build.
[[nodiscard]] inline std::vector<std::string> chapters() { return words_of(NLMECH_CHAPTERS); }

using Uses = std::map<std::string, std::set<std::string>>;

/// Components and those that each one uses directly.
[[nodiscard]] inline Uses components() {
  Uses uses;
  for (const std::string& line : lines_of(NLMECH_BINARY_DIR "/components.txt")) {
    const auto colon = line.find(':');
    if (colon == std::string::npos) continue;
    const auto words = words_of(line.substr(colon + 1));
    uses[line.substr(0, colon)] = {words.begin(), words.end()};
  }
  return uses;
}

/// Our own sources under a folder of the project: .hpp, .cpp, CMakeLists.txt, .cmake.
[[nodiscard]] inline std::vector<std::filesystem::path> sources_under(const std::string& folder) {
  std::vector<std::filesystem::path> files;
  const std::filesystem::path top = std::filesystem::path(NLMECH_SOURCE_DIR) / folder;
  if (!std::filesystem::exists(top)) return files;
  const std::set<std::string> extensions = {".hpp", ".cpp", ".cmake", ".txt"};
  for (const auto& entry : std::filesystem::recursive_directory_iterator(top)) {
    if (entry.is_regular_file() && extensions.contains(entry.path().extension().string()))
      files.push_back(entry.path());
  }
  return files;
}

}  // namespace nlmech::tests
