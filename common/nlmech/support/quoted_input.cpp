#include "nlmech/support/quoted_input.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

namespace nlmech {
namespace {

struct Character {
  std::size_t length = 1;  ///< in bytes
  bool printable = false;  ///< safe for a terminal without escaping
};

constexpr bool between(std::uint32_t x, std::uint32_t low, std::uint32_t high) {
  return x >= low && x <= high;
}

/// Invisible characters that change the display of others: control characters, line separators, marks of
/// direction, byte order mark.
bool is_control(std::uint32_t code) {
  return code < 0x20 || between(code, 0x7f, 0x9f) || between(code, 0x200b, 0x200f) ||
         between(code, 0x2028, 0x202e) || between(code, 0x2060, 0x206f) || code == 0xfeff;
}

/// The first character of a non-empty text. A byte that does not start a complete UTF-8 character counts as
/// one character.
Character first_character(std::string_view text) {
  const auto byte = [text](std::size_t i) { return static_cast<std::uint8_t>(text[i]); };
  const std::uint8_t lead = byte(0);
  if (lead < 0x80) return {1, !is_control(lead)};
  const std::size_t length = between(lead, 0xc2, 0xdf)   ? 2
                             : between(lead, 0xe0, 0xef) ? 3
                             : between(lead, 0xf0, 0xf4) ? 4
                                                         : 0;
  if (length == 0 || text.size() < length) return {};
  std::uint32_t code = lead & (0xffU >> (length + 1));
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xc0U) != 0x80) return {};
    code = (code << 6U) | (byte(i) & 0x3fU);
  }
  constexpr std::array<std::uint32_t, 5> least = {0, 0, 0x80, 0x800, 0x10000};
  if (code < least[length] || between(code, 0xd800, 0xdfff) || code > 0x10ffff) return {};
  return {length, !is_control(code)};
}

void append_escaped(std::string& out, std::string_view character) {
  if (character == "\n") {
    out += "\\n";
  } else if (character == "\t") {
    out += "\\t";
  } else {
    constexpr std::string_view digits = "0123456789abcdef";
    for (const char c : character) {
      const auto byte = static_cast<std::uint8_t>(c);
      out += {'\\', 'x', digits[byte >> 4U], digits[byte & 0xfU]};
    }
  }
}

}  // namespace

std::string quoted_input(std::string_view text, std::size_t most) {
  std::string out;
  std::size_t done = 0;
  while (done < text.size()) {
    const Character c = first_character(text.substr(done));
    if (done + c.length > most) return out + "... (" + std::to_string(text.size()) + " bytes)";
    const std::string_view bytes = text.substr(done, c.length);
    if (c.printable)
      out += bytes;
    else
      append_escaped(out, bytes);
    done += c.length;
  }
  return out;
}

std::string echoed_path(std::string_view path) { return quoted_input(path, 400); }

std::string printable_message(std::string_view message) {
  constexpr std::size_t longest_word = 400, most = 4000;
  std::string out;
  while (!message.empty()) {
    const std::size_t end = std::min(message.find_first_of(" \n\t"), message.size());
    std::string word = quoted_input(message.substr(0, end), longest_word);
    if (word.size() > longest_word) word = quoted_input(message.substr(0, end));
    if (out.size() + word.size() > most) return out + "...";
    out += word;
    if (end < message.size()) out += message[end];
    message.remove_prefix(std::min(end + 1, message.size()));
  }
  return out;
}

}  // namespace nlmech
