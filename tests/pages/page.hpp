/// @file
/// What the tests of the printed pages read: fenced blocks, and texts that may differ in numbers alone.
#pragma once

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace nlmech::tests {

/// A fenced block of a page.
struct Block {
  std::string language;            ///< after the opening fence: "sh"
  int line = 0;                    ///< number of the opening fence, from 1
  std::vector<std::string> lines;  ///< what stands between the fences
};

/// The lines of a text.
[[nodiscard]] inline std::vector<std::string> lines_in(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

/// A text file as a whole. @throws std::runtime_error if there is no such file
[[nodiscard]] inline std::string text_of(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in) throw std::runtime_error("cannot open " + file.string());
  return {std::istreambuf_iterator<char>(in), {}};
}

/// The blocks of a page, in its order. @throws std::runtime_error if there is no such file
[[nodiscard]] inline std::vector<Block> blocks_of(const std::filesystem::path& page) {
  std::vector<Block> blocks;
  bool inside = false;
  int number = 0;
  for (const std::string& line : lines_in(text_of(page))) {
    ++number;
    if (line.starts_with("```")) {
      if (!inside) blocks.push_back({line.substr(3), number, {}});
      inside = !inside;
    } else if (inside) {
      blocks.back().lines.push_back(line);
    }
  }
  return blocks;
}

/// A text with its numbers taken out.
struct Read {
  std::string words;            ///< each number is a '#'
  std::vector<double> numbers;  ///< in their order
  std::vector<int> digits;      ///< of each number, without those of its exponent
};

/// Takes the numbers out of a text; a sign counts to the number.
[[nodiscard]] inline Read read(std::string_view text) {
  Read found;
  const char* at = text.data();
  const char* const end = at + text.size();
  while (at != end) {
    double number = 0;
    const bool begins = (*at >= '0' && *at <= '9') || *at == '-' || *at == '.';
    const auto [stop, error] = begins ? std::from_chars(at, end, number) : std::from_chars_result{at, {}};
    if (begins && error == std::errc{} && std::isfinite(number)) {  // "-information" begins with an infinity
      found.words += '#';
      found.numbers.push_back(number);
      const char* const mantissa_end = std::find(at, stop, 'e');
      found.digits.push_back(
          static_cast<int>(std::count_if(at, mantissa_end, [](char c) { return c >= '0' && c <= '9'; })));
      at = stop;
    } else {
      found.words += *at++;
    }
  }
  return found;
}

/// Are two texts the same but for numbers that are close?
[[nodiscard]] inline bool alike(std::string_view a, std::string_view b,
                                const std::function<bool(double, double)>& close) {
  const Read first = read(a), second = read(b);
  if (first.words != second.words || first.numbers.size() != second.numbers.size()) return false;
  for (std::size_t i = 0; i < first.numbers.size(); ++i) {
    if (!close(first.numbers[i], second.numbers[i])) return false;
  }
  return true;
}

}  // namespace nlmech::tests
