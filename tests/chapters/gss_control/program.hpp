/// @file
/// `gss_control` as a user types it.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "nlmech/scene/program/csv.hpp"
#include "nlmech/scene/program/process.hpp"
#include "tests/places.hpp"

namespace nlmech::tests {

/// Runs a program with words separated by blanks.
inline scene::Finished run_words(const std::string& program, const std::string& words) {
  std::vector<std::string> arguments = {NLMECH_BINARY_DIR "/bin/" + program};
  for (std::size_t begin = 0; begin < words.size();) {
    const std::size_t end = std::min(words.find(' ', begin), words.size());
    if (end > begin) arguments.push_back(words.substr(begin, end - begin));
    begin = end + 1;
  }
  return scene::run_program(arguments, {});
}

/// A number that stands in a cell.
inline double number(const std::string& text) {
  double value = NAN;
  EXPECT_TRUE(scene::parse_number(text, value)) << text;
  return value;
}

/// Header and rows of numbers that `gss_control WORDS` writes; it has to succeed.
struct Rows {
  std::string header;
  std::vector<std::vector<double>> row;
};
inline Rows rows_of(const std::string& words) {
  const scene::Finished f = run_words("gss_control", words);
  EXPECT_EQ(f.exit_code, 0) << words << ": " << f.errors;
  Rows rows;
  rows.header = f.output.substr(0, f.output.find('\n'));
  const auto records = scene::parse_csv(f.output, "output");
  for (std::size_t i = 1; i < records.size(); ++i) {
    rows.row.emplace_back();
    for (const std::string& cell : records[i].cells) rows.row.back().push_back(number(cell));
  }
  return rows;
}

}  // namespace nlmech::tests
