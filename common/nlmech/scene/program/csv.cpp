#include "nlmech/scene/program/csv.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <numeric>
#include <utility>

#include "nlmech/scene/program/this_process.hpp"
#include "nlmech/scene/program/typed.hpp"
#include "nlmech/support/doubles.hpp"
#include "nlmech/support/errors.hpp"
#include "nlmech/support/quoted_input.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::scene {
namespace {

constexpr std::string_view blanks = " \t\r";

std::string_view trim(std::string_view text) {
  const auto first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

/// Removes the next line from @p rest and returns it without its line end.
std::string_view next_line(std::string_view& rest) {
  const auto end = rest.find('\n');
  const std::string_view line = rest.substr(0, end);
  rest = end == std::string_view::npos ? std::string_view{} : rest.substr(end + 1);
  return line;
}

/// Removes the next cell, with its quotes, from @p rest. @param more true if a comma followed @returns false
/// for an unclosed quote
bool next_cell(std::string_view& rest, std::string_view& cell, bool& more) {
  bool quoted = false;
  std::size_t i = 0;
  for (; i < rest.size() && (quoted || rest[i] != ','); ++i) {
    if (rest[i] == '"') quoted = !quoted;
  }
  more = i < rest.size();
  cell = trim(rest.substr(0, i));
  rest = more ? rest.substr(i + 1) : std::string_view{};
  return !quoted;
}

std::string_view unquoted(std::string_view cell) {
  return cell.size() > 1 && cell.front() == '"' && cell.back() == '"' ? trim(cell.substr(1, cell.size() - 2))
                                                                      : cell;
}

bool is_number(std::string_view cell) {
  double value = 0;
  return parse_number(unquoted(cell), value);
}

bool same_but_for_case(std::string_view a, std::string_view b) {
  const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; };
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [&](char c, char d) { return lower(c) == lower(d); });
}

/// Hint at the likely mistake of a line that could not be parsed.
const char* hint(std::string_view line) {
  if (line.starts_with('#')) return "; put comments before the header";
  if (line.find('\r') != std::string_view::npos) return "; end lines with LF or CR LF, not with CR";
  if (line.find_first_of(";\t") != std::string_view::npos)
    return "; separate cells by commas and write numbers with a decimal point";
  return "";
}

}  // namespace

std::string number_fault(std::string_view text) {
  text = trim(text);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool is_small = error == std::errc::result_out_of_range && end == text.data() + text.size() &&
                        std::abs(std::strtod(std::string(text).c_str(), nullptr)) < 1;
  return is_small ? "smaller in magnitude than the smallest double, 4.9e-324; write 0"
                  : "not a finite number";
}

bool parse_number(std::string_view text, double& value) {
  text = trim(text);
  if (text.size() > 1 && text[0] == '+' && text[1] != '-')
    text.remove_prefix(1);  // std::from_chars accepts no plus sign
  double parsed = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), parsed);
  if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(parsed)) return false;
  value = parsed;
  return true;
}

CsvColumns::CsvColumns(std::string name, const std::vector<std::string>& known, std::size_t required,
                       NameCase fits)
    : name_(std::move(name)), required_(required), fits_(fits) {
  for (const std::string& names : known) known_.push_back(split(names, '|'));
}

std::string_view CsvColumns::content(std::string_view line, std::size_t number) const {
  if (number == 1 && line.starts_with("\xEF\xBB\xBF")) line.remove_prefix(3);
  line = trim(line);
  const bool first_is_text = !column_.empty() && column_[0] < 0;
  return line.starts_with('#') && !first_is_text ? std::string_view{} : line;
}

std::string CsvColumns::expected() const {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < (required_ > 0 ? required_ : known_.size()); ++i) names.push_back(known_[i][0]);
  return fmt::format("{}{}", required_ > 0 ? "" : "some of ", fmt::join(names, ","));
}

void CsvColumns::reset_header() {
  cells_.clear();
  names_.clear();
  column_.clear();
}

void CsvColumns::refuse_empty() const {
  throw input_error("{}: is empty; the first line must name the columns {}", name_, expected());
}

void CsvColumns::assign(std::string_view line, std::size_t number) {
  column_.assign(names_.size(), -1);
  for (std::size_t k = 0; k < known_.size(); ++k) {
    const auto assign_where = [&](const auto& same) {
      const auto fits = [&](const std::string& name) {
        return std::any_of(known_[k].begin(), known_[k].end(),
                           [&](const auto& one) { return same(one, name); });
      };
      const auto count = std::count_if(names_.begin(), names_.end(), fits);
      if (count > 1)
        throw input_error("{}: line {}: two columns are called {}: '{}'", name_, number, known_[k][0],
                          quoted_input(line));
      if (count == 1)
        column_[static_cast<std::size_t>(std::find_if(names_.begin(), names_.end(), fits) - names_.begin())] =
            static_cast<int>(k);
      return count == 1;
    };
    if (!assign_where(std::equal_to<>()) && fits_ == NameCase::any) assign_where(same_but_for_case);
  }
}

bool CsvColumns::read_header(std::string_view line, std::size_t number) {
  bool has_numbers = false;
  std::string_view rest = line, cell;
  for (bool more = true; more;) {
    if (!next_cell(rest, cell, more))
      throw input_error("{}: line {}: a quote is never closed", name_, number);
    cells_.emplace_back(cell);
    names_.emplace_back(unquoted(cell));
    has_numbers = has_numbers || is_number(cell);
  }
  while (names_.size() > 1 && names_.back().empty()) {
    cells_.pop_back();
    names_.pop_back();
  }
  assign(line, number);
  const bool has_names = std::any_of(column_.begin(), column_.end(), [](int known) { return known >= 0; });
  if (has_numbers && !has_names) {
    if (names_.size() != required_)
      throw input_error("{}: line {}: '{}' does not name the columns; the first line must name {}{}", name_,
                        number, quoted_input(line), expected(), hint(line));
    std::iota(column_.begin(), column_.end(), 0);
    for (std::size_t i = 0; i < required_; ++i) cells_[i] = names_[i] = known_[i][0];
    return false;
  }
  for (std::size_t k = 0; k < required_; ++k) {
    if (!has(known_[k][0]))
      throw input_error(
          "{}: line {}: there is no column {}; the header must name {}, separated by commas, and is '{}'{}",
          name_, number, known_[k][0], expected(), quoted_input(line), hint(line));
  }
  return true;
}

void CsvColumns::read_row(std::string_view line, std::size_t number, std::vector<double>& numbers,
                          std::string& rest) const {
  numbers.assign(known_.size(), nan);
  rest.clear();
  std::string_view text = line, cell;
  bool more = true;
  for (std::size_t i = 0; i < column_.size(); ++i) {
    if (!more)
      throw input_error("{}: line {}: {} of {} cells{}", name_, number, i, column_.size(), hint(line));
    if (!next_cell(text, cell, more))
      throw input_error("{}: line {}: a quote is never closed", name_, number);
    if (column_[i] < 0) {
      rest.append(",").append(cell);
    } else if (!parse_number(unquoted(cell), numbers[static_cast<std::size_t>(column_[i])])) {
      throw input_error("{}: line {}, column {} ({}): '{}' is {}{}", name_, number, i + 1,
                        quoted_input(names_[i]), quoted_input(cell), number_fault(unquoted(cell)),
                        hint(line));
    }
  }
  if (more && text.find_first_not_of(", \t\r") != std::string_view::npos)
    throw input_error("{}: line {}, column {}: '{}' is beyond the {} columns {}{}", name_, number,
                      column_.size() + 1, quoted_input(trim(text)), column_.size(),
                      quoted_input(fmt::format("{}", fmt::join(cells_, ","))), hint(line));
}

bool CsvColumns::has(std::string_view column) const {
  return std::any_of(column_.begin(), column_.end(), [&](int known) {
    return known >= 0 && known_[static_cast<std::size_t>(known)][0] == column;
  });
}

std::string CsvColumns::rest_names(const std::vector<std::string>& own) const {
  std::string all;
  for (std::size_t i = 0; i < column_.size(); ++i) {
    if (column_[i] >= 0) continue;
    std::string name = names_[i];
    while (std::find(own.begin(), own.end(), name) != own.end() ||
           (name != names_[i] && std::find(names_.begin(), names_.end(), name) != names_.end()))
      name.insert(0, "input_");
    all.append(",").append(name == names_[i] ? cells_[i] : name);
  }
  return all;
}

NumberColumns parse_numbers(std::string_view text, const std::string& name,
                            const std::vector<std::string>& names, const std::vector<std::string>& own) {
  CsvColumns columns(name, names, names.size());
  NumberColumns out;
  out.column.resize(names.size());
  const auto most_rows = static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')) + 1;
  out.line.reserve(most_rows);
  for (auto& column : out.column) column.reserve(most_rows);

  bool first = true;
  std::vector<double> numbers;
  for (std::size_t number = 1; !text.empty(); ++number) {
    const std::string_view line = columns.content(next_line(text), number);
    if (line.empty() || (std::exchange(first, false) && columns.read_header(line, number))) continue;
    columns.read_row(line, number, numbers, out.rest.emplace_back());
    for (std::size_t i = 0; i < numbers.size(); ++i) out.column[i].push_back(numbers[i]);
    out.line.push_back(number);
  }
  if (first) columns.refuse_empty();
  out.rest_names = columns.rest_names(own);
  return out;
}

void print_no_rows(const std::string& name) {
  print_message(fmt::format("{}: no row follows the header", name));
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
