/// @file
/// The program `integrators`, run as a user does.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "nlmech/scene/program/csv.hpp"
#include "nlmech/scene/program/process.hpp"
#include "nlmech/scene/program/typed.hpp"
#include "tests/places.hpp"

namespace nlmech::integrators_commands_test {

using scene::Finished;
using Words = std::vector<std::string>;

/// In a folder; the sources' top without one.
inline Finished integrators(Words words, const std::string& folder = NLMECH_SOURCE_DIR) {
  words.insert(words.begin(), NLMECH_BINARY_DIR "/bin/integrators");
  return scene::run_program(words, folder);
}

/// With words separated by blanks; within a word "_" stands for a blank, and "__" for "_".
inline Finished run(const std::string& words) {
  Words arguments = scene::split(words, ' ');
  for (std::string& argument : arguments) {
    std::string word;
    for (std::size_t i = 0; i < argument.size(); ++i) {
      const bool twice = argument.compare(i, 2, "__") == 0;
      word += twice || argument[i] != '_' ? argument[i] : ' ';
      i += twice ? 1 : 0;
    }
    argument = word;
  }
  return integrators(arguments);
}

/// What `integrate` printed.
struct Rows {
  Words header;
  std::vector<std::vector<double>> values;
  Words events;
};

inline Rows integrate(Words words) {
  words.insert(words.begin(), "integrate");
  const Finished f = integrators(words);
  EXPECT_EQ(f.exit_code, 0) << f.errors;
  Rows rows;
  if (f.exit_code != 0) return rows;
  const auto records = scene::parse_csv(f.output, "output");
  rows.header = records.at(0).cells;
  const bool events = rows.header.back() == "event";
  for (std::size_t i = 1; i < records.size(); ++i) {
    auto cells = records[i].cells;
    if (events) {
      rows.events.push_back(cells.back());
      cells.pop_back();
    }
    rows.values.emplace_back();
    for (const std::string& cell : cells) rows.values.back().push_back(std::stod(cell));
  }
  return rows;
}

/// Words that are refused, and what is said of them.
struct Bad {
  Words words;
  Words says;
};

/// Exit code 2, nothing on standard output, and a message with these words.
inline void expect_refused(const Bad& bad, const std::string& folder = NLMECH_SOURCE_DIR) {
  const Finished f = integrators(bad.words, folder);
  std::string typed;
  for (const std::string& word : bad.words) typed += word.substr(0, 200) + ' ';
  EXPECT_EQ(f.exit_code, 2) << typed << ": " << f.errors;
  EXPECT_EQ(f.output, "") << typed;
  for (const std::string& word : bad.says)
    EXPECT_NE(f.errors.find(word), std::string::npos) << typed << ": no '" << word << "' in: " << f.errors;
}

}  // namespace nlmech::integrators_commands_test
