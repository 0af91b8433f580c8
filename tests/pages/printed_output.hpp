/// @file
/// The output of a program as a page prints it, beside what the program writes today.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tests/pages/page.hpp"

namespace nlmech::tests {

/// Are two numbers of outputs the same but for the machine? Noise is what rounding leaves of zero. Numbers
/// that are printed with ten digits and more are results, and agree to 1e-5: the problems of the pages
/// multiply rounding by 1e9 at most. Others are errors, counts and digits: a factor of two.
[[nodiscard]] inline bool same_number(double a, double b, bool result) {
  const double greater = std::max(std::abs(a), std::abs(b));
  if (greater < 1e-7) return true;
  if (result) return std::abs(a - b) <= 1e-5 * greater;
  return a * b > 0 && std::abs(a) <= 2 * std::abs(b) && std::abs(b) <= 2 * std::abs(a);
}

/// A line of CSV without its field number @p column, from 0; none before it is quoted.
[[nodiscard]] inline std::string without_field(const std::string& line, std::size_t column) {
  std::size_t begin = 0;
  for (std::size_t i = 0; i < column; ++i) {
    const std::size_t comma = line.find(',', begin);
    if (comma == std::string::npos) return line;
    begin = comma + 1;
  }
  const std::size_t end = std::min(line.find(',', begin), line.size());
  return line.substr(0, begin) + line.substr(end);
}

/// Are two lines the same but for the machine? One that ends with " ..." on the page goes on in the output.
[[nodiscard]] inline bool same_line(const std::string& written, std::string printed) {
  const bool goes_on = printed.ends_with(" ...");
  if (goes_on) printed.resize(printed.size() - 4);
  const Read w = read(written), p = read(printed);
  const bool words = goes_on ? w.words.starts_with(p.words) : w.words == p.words;
  if (!words || w.numbers.size() < p.numbers.size()) return false;
  for (std::size_t i = 0; i < p.numbers.size(); ++i) {
    if (!same_number(w.numbers[i], p.numbers[i], p.digits[i] >= 10)) return false;
  }
  return true;
}

/// The first line of a printed output that is not in what a program writes, in its order; empty if all are. A
/// line "..." stands for lines that are left out; what follows it as the last line is the last of both.
/// Seconds, a column of that name, are not compared.
[[nodiscard]] inline std::string differs_from(const std::string& output, std::vector<std::string> printed) {
  std::vector<std::string> written = lines_in(output);
  if (!written.empty()) {
    const std::string heading = "," + written.front() + ",";
    if (const std::size_t at = heading.find(",seconds,"); at != std::string::npos) {
      const auto column = static_cast<std::size_t>(
          std::count(heading.begin() + 1, heading.begin() + static_cast<std::ptrdiff_t>(at) + 1, ','));
      for (auto* lines : {&written, &printed}) {
        for (std::string& line : *lines) line = without_field(line, column);
      }
    }
  }
  auto next = written.begin();
  bool left_out = false;
  for (const std::string& line : printed) {
    if (line == "...") {
      left_out = true;
      continue;
    }
    if (left_out && &line == &printed.back() && next != written.end()) next = written.end() - 1;
    while (left_out && next != written.end() && !same_line(*next, line)) ++next;
    if (next == written.end() || !same_line(*next, line)) return line;
    ++next;
    left_out = false;
  }
  return left_out || next == written.end() ? "" : "the output goes on: " + *next;
}

}  // namespace nlmech::tests
