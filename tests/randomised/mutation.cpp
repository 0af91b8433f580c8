#include "tests/randomised/mutation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>
#include <stdexcept>

#include "nlmech/support/errors.hpp"
#include "nlmech/support/quoted_input.hpp"
#include "tests/places.hpp"

namespace nlmech::randomised {
namespace {

constexpr std::array numbers = {"0",
                                "-0",
                                "1e308",
                                "1e309",
                                "-1e-324",
                                "4.9e-324",
                                "nan",
                                "inf",
                                "-inf",
                                "0x1p3",
                                "1e",
                                "+",
                                "+-1",
                                "1_000",
                                "1e-400",
                                "00012",
                                ".5",
                                "5.",
                                "1,5",
                                "true",
                                "1979-05-27",
                                "1e+05",
                                "--1",
                                "1d5",
                                "1e99999",
                                "2147483648",
                                "-2147483649",
                                "9223372036854775808",
                                "\"1\"",
                                "0b101",
                                "0o17",
                                "1e5.5",
                                "1/0",
                                "[1]",
                                "{}",
                                "''",
                                "99999999999999999999999999"};

constexpr std::array pieces = {"\"",
                               "'''",
                               "\"\"\"",
                               "[",
                               "]]",
                               "[[",
                               "{",
                               "=",
                               "\\u0000",
                               "\\UFFFFFFFF",
                               "#",
                               ",",
                               "\n",
                               "\r\n",
                               "\r",
                               "\t",
                               "\xEF\xBB\xBF",
                               "\xFF",
                               "\xC0\xAF",
                               "\x1b[2J",
                               "=,=",
                               ":",
                               "-",
                               "--",
                               "/",
                               "\xE2\x80\xAE",
                               ".",
                               " ",
                               "a.b.c.d = 1\n",
                               "[a.b]\n",
                               "@"};

std::size_t place(Draw& draw, const std::string& text) {
  return static_cast<std::size_t>(draw.whole(0, static_cast<int>(text.size())));
}

/// Usually short, sometimes very long.
std::size_t length(Draw& draw) {
  return static_cast<std::size_t>(draw.log_uniform(1, draw.chance(0.02) ? 1e5 : 300));
}

/// Replaces a run of characters that form a number.
void replace_number(Draw& draw, std::string& text) {
  const auto is_part = [](char c) {
    return (c >= '0' && c <= '9') || c == '.' || c == '-' || c == 'e' || c == '+';
  };
  std::size_t begin = place(draw, text);
  begin = static_cast<std::size_t>(
      std::find_if(text.begin() + static_cast<std::ptrdiff_t>(begin), text.end(), is_part) - text.begin());
  std::size_t end = begin;
  while (end < text.size() && is_part(text[end])) ++end;
  text.replace(begin, end - begin, draw.one_of(numbers));
}

void deepen(Draw& draw, std::string& text) {
  const std::string one = draw.one_of({"[", "{a=", "a.", "\"", "(", "[[", "-", "'"});
  std::string all;
  for (std::size_t n = length(draw); n > 0; --n) all += one;
  text.insert(place(draw, text), all);
}

void other_line_ends(std::string& text) {
  std::string out;
  for (const char c : text) out += c == '\n' ? std::string("\r\n") : std::string(1, c);
  text = std::move(out);
}

void damage(Draw& draw, std::string& text, const std::vector<std::string>& examples) {
  const std::size_t at = place(draw, text), count = std::min(length(draw), text.size() - at);
  switch (draw.whole(0, 11)) {
    case 0:
      if (at < text.size()) text[at] = static_cast<char>(text[at] ^ (1 << draw.whole(0, 7)));
      return;
    case 1: text.erase(at, count); return;
    case 2: text.insert(at, text.substr(at, count)); return;
    case 3: {
      const std::string& other = draw.one_of(examples);
      text.insert(at, other.substr(place(draw, other), length(draw)));
      return;
    }
    case 4: text.resize(at); return;
    case 5:
    case 6: replace_number(draw, text); return;
    case 7: text.insert(at, length(draw), draw.one_of({'1', 'a', '.', '-', ',', '"', ' ', '0', 'e'})); return;
    case 8: text.insert(at, 1, '\0'); return;
    case 9: text.insert(at, draw.one_of(pieces)); return;
    case 10:
      if (draw.chance(0.5))
        other_line_ends(text);
      else
        text.insert(0, "\xEF\xBB\xBF");
      return;
    default: deepen(draw, text); return;
  }
}

}  // namespace

std::string damaged(Draw& draw, const std::vector<std::string>& examples) {
  std::string text = draw.one_of(examples);
  if (draw.chance(0.02)) return text;
  for (int n = draw.whole(1, 6); n > 0; --n) damage(draw, text, examples);
  return text;
}

bool is_sentence(const std::string& message) {
  constexpr std::size_t most = 1000;
  return !message.empty() && message.size() <= most && quoted_input(message, most) == message;
}

std::string shown(const std::string& text) {
  return fmt::format("{} bytes: {}", text.size(), quoted_input(text, 300));
}

Case read_or_refused(const std::string& text, const std::function<bool(const std::string&)>& read) {
  try {
    if (read(text)) return Case::judged(0, 1, shown(text));
    return Case::wrong("accepted, and what was read is not what stands there; " + shown(text));
  } catch (const InputError& error) {
    if (is_sentence(error.what())) return Case::refused(shown(text));
    return Case::wrong(fmt::format("refused with {} bytes that are no sentence: {}; {}",
                                   std::string(error.what()).size(), quoted_input(error.what(), 300),
                                   shown(text)));
  } catch (const std::exception& error) {
    return Case::wrong(
        fmt::format("another exception: {}; {}", quoted_input(error.what(), 300), shown(text)));
  }
}

std::string source_lines(const std::string& path, int count) {
  std::ifstream in(std::string(NLMECH_SOURCE_DIR "/") + path, std::ios::binary);
  if (!in) throw std::runtime_error("no file " + path);
  std::string text;
  for (std::string line; count > 0 && std::getline(in, line); --count) text += line + '\n';
  return text;
}

}  // namespace nlmech::randomised
