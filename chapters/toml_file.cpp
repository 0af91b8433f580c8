#include "chapters/toml_file.hpp"

#include <cmath>
#include <sstream>

#include "nlmech/support/quoted_input.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::chapters {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }
/// Is it a character that can follow a number?
bool is_blank_or_comma(char c) { return std::string_view(" \t\r\n,]}").find(c) != std::string_view::npos; }

void require_shallow(std::string_view text, const std::string& name) {
  constexpr std::ptrdiff_t most = 2000;
  std::ptrdiff_t dots = 0;
  bool is_last_a_point = false;  // was the previous dot a decimal point, with no separator since?
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '.') {
      is_last_a_point = is_last_a_point && !is_blank_or_comma(text[i]);
      continue;
    }
    // A decimal point is between two digits, and a number has one. Of two successive dots in a key at least
    // one is counted.
    const bool is_point =
        !is_last_a_point && i > 0 && is_digit(text[i - 1]) && i + 1 < text.size() && is_digit(text[i + 1]);
    if (!is_point) ++dots;
    is_last_a_point = is_point;
  }
  if (dots > most)
    throw input_error("{}: {} dots besides decimal points, where {} are more than enough for its names", name,
                      dots, most);
}

}  // namespace

toml::table parse_toml(std::string_view text, const std::string& name) {
  require_shallow(text, name);
  try {
    return toml::parse(text, name);
  } catch (const toml::parse_error& error) {
    throw input_error("{}, line {}, column {}: {}", name, error.source().begin.line,
                      error.source().begin.column, quoted_input(error.description(), 400));
  }
}

void complain(const std::string& name, const toml::node& node, std::string_view key, std::string_view what) {
  std::ostringstream value;
  node.visit([&value](const auto& v) { value << v; });
  throw input_error("{}, line {}: {} = {}: {}", name, node.source().begin.line, quoted_input(key),
                    quoted_input(value.str()), what);
}

double number_of(const std::string& name, const toml::node& node, std::string_view key) {
  if (!node.is_number()) complain(name, node, key, "not a number");
  const double value = node.value<double>().value_or(HUGE_VAL);
  if (!std::isfinite(value)) complain(name, node, key, "not a finite number");
  return value;
}

}  // namespace nlmech::chapters
