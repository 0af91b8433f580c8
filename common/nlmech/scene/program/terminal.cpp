#include "nlmech/scene/program/terminal.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <string_view>
#include <vector>

namespace nlmech::scene {
namespace {

bool continues(char c) { return (static_cast<unsigned char>(c) & 0xc0U) == 0x80; }

/// Number of UTF-8 characters.
std::size_t width_of(std::string_view text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return !continues(c); }));
}

std::string padded(const std::string& text, std::size_t width, bool to_the_right) {
  const std::string blanks(width - std::min(width, width_of(text)), ' ');
  return to_the_right ? blanks + text : text + blanks;
}

std::string cut(const std::string& text, std::size_t width) {
  constexpr std::string_view mark = "...";
  if (width_of(text) <= width) return text;
  std::size_t end = 0, characters = 0;
  while (end < text.size() && (continues(text[end]) || characters < width - mark.size()))
    characters += continues(text[end++]) ? 0 : 1;
  return text.substr(0, end).append(mark);
}

/// Shortens the widest columns until all fit.
void narrow(std::vector<std::size_t>& widths, std::size_t gap, std::size_t most) {
  constexpr std::size_t least = 4;
  std::size_t sum = gap * (widths.size() - 1);
  for (const std::size_t w : widths) sum += w;
  for (; sum > most; --sum) {
    const auto widest = std::max_element(widths.begin(), widths.end());
    if (*widest <= least) return;
    --*widest;
  }
}

}  // namespace

std::optional<std::size_t> terminal_width(int stream) {
  if (::isatty(stream) != 1) return {};
  constexpr std::size_t default_width = 80, least = 20, most = 10000;
  if (const char* columns = std::getenv("COLUMNS")) {
    const std::string_view text = columns;
    std::size_t width = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), width);
    if (error == std::errc{} && end == text.data() + text.size() && width >= least && width <= most)
      return width;
  }
  winsize size{};
  return ::ioctl(stream, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? std::size_t{size.ws_col}
                                                                    : default_width;
}

std::string aligned(const Table& table, std::size_t width) {
  const std::size_t columns = table.columns().size(), rows = table.rows().size();
  constexpr std::size_t gap = 2;
  std::vector<std::vector<std::string>> lines(rows + 1);
  std::vector<std::size_t> widths(columns);
  for (std::size_t j = 0; j < columns; ++j) {
    lines[0].push_back(table.columns()[j].name);
    for (std::size_t i = 0; i < rows; ++i) lines[i + 1].push_back(table.text(i, j));
    for (const auto& line : lines) widths[j] = std::max(widths[j], width_of(line[j]));
  }
  narrow(widths, gap, width);
  std::string out;
  for (const auto& line : lines) {
    std::string text;
    for (std::size_t j = 0; j < columns; ++j) {
      text += padded(cut(line[j], widths[j]), widths[j], table.numeric(j));
      if (j + 1 < columns) text.append(gap, ' ');
    }
    out += text.substr(0, text.find_last_not_of(' ') + 1) + '\n';
  }
  return out;
}

}  // namespace nlmech::scene
