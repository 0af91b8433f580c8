#include "nlmech/scene/program/csv.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include "nlmech/support/echo.hpp"
#include "nlmech/support/errors.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::scene {
namespace {

constexpr std::string_view blanks = " \t\r";

std::string_view trim(std::string_view text) {
  const auto first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

/// Cuts the next line off @p rest; the line end is dropped.
std::string_view next_line(std::string_view& rest) {
  const auto end = rest.find('\n');
  const std::string_view line = rest.substr(0, end);
  rest = end == std::string_view::npos ? std::string_view{} : rest.substr(end + 1);
  return line;
}

/// Cuts the next comma-separated piece off @p rest; @p more says whether a comma followed.
std::string_view next_piece(std::string_view& rest, bool& more) {
  const auto comma = rest.find(',');
  more = comma != std::string_view::npos;
  const std::string_view piece = rest.substr(0, comma);
  rest = more ? rest.substr(comma + 1) : std::string_view{};
  return trim(piece);
}

bool is_header(std::string_view line, const std::vector<std::string>& names) {
  bool more = true;
  for (const std::string& name : names) {
    if (!more || next_piece(line, more) != name) return false;
  }
  return !more;
}

[[noreturn]] void complain(const std::string& name, std::size_t line, std::size_t column,
                           const std::string& column_name, std::string_view cell) {
  throw input_error("{}: line {}, column {} ({}): '{}' is not a finite number", name, line, column + 1,
                    column_name, echoed(cell));
}

}  // namespace

bool parse_number(std::string_view text, double& value) {
  text = trim(text);
  if (text.size() > 1 && text[0] == '+' && text[1] != '-')
    text.remove_prefix(1);  // std::from_chars knows no plus sign
  double parsed = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), parsed);
  if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(parsed)) return false;
  value = parsed;
  return true;
}

NumberColumns parse_numbers(std::string_view text, const std::string& name,
                            const std::vector<std::string>& names) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);  // the mark that some spreadsheets put first
  NumberColumns out;
  out.column.resize(names.size());
  const auto most_rows = static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')) + 1;
  out.line.reserve(most_rows);
  for (auto& column : out.column) column.reserve(most_rows);

  bool first = true;
  for (std::size_t number = 1; !text.empty(); ++number) {
    std::string_view line = next_line(text);
    if (trim(line).empty() || trim(line).front() == '#') continue;
    if (std::exchange(first, false) && is_header(line, names)) continue;
    bool more = true;
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (!more) throw input_error("{}: line {}: {} of {} cells", name, number, i, names.size());
      const std::string_view cell = next_piece(line, more);
      double value = 0;
      if (!parse_number(cell, value)) complain(name, number, i, names[i], cell);
      out.column[i].push_back(value);
    }
    if (more) {
      throw input_error("{}: line {}, column {}: '{}' is beyond the {} columns {}", name, number,
                        names.size() + 1, echoed(trim(line)), names.size(), fmt::join(names, ","));
    }
    out.line.push_back(number);
  }
  return out;
}

std::vector<CsvRecord> parse_csv(std::string_view text, const std::string& name) {
  std::vector<CsvRecord> records;
  std::size_t line = 1;
  for (std::size_t i = 0; i < text.size();) {
    CsvRecord record{line, {}};
    std::string cell;
    bool quoted = false;
    for (; i < text.size() && (quoted || text[i] != '\n'); ++i) {
      const char c = text[i];
      if (c == '\n') ++line;
      if (c == '"' && quoted && i + 1 < text.size() && text[i + 1] == '"')
        cell += text[++i];
      else if (c == '"')
        quoted = !quoted;
      else if (c == ',' && !quoted)
        record.cells.push_back(std::exchange(cell, {}));
      else if (c != '\r' || quoted)
        cell += c;
    }
    if (quoted) throw input_error("{}: line {}: a quote is never closed", name, record.line);
    ++i;
    ++line;
    if (record.cells.empty() && trim(cell).empty()) continue;
    record.cells.push_back(std::move(cell));
    records.push_back(std::move(record));
  }
  return records;
}

}  // namespace nlmech::scene
