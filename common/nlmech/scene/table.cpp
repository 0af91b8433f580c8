#include "nlmech/scene/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <stdexcept>
#include <utility>

#include "nlmech/support/sentences.hpp"

namespace nlmech::scene {
namespace {

/// Text of a cell; @p real and @p text format the two kinds that differ between CSV and Markdown.
template <class Real, class Text>
std::string show(const Cell& cell, Real real, Text text) {
  if (const auto* s = std::get_if<std::string>(&cell)) return text(*s);
  if (const auto* x = std::get_if<double>(&cell)) return real(*x);
  if (const auto* n = std::get_if<std::int64_t>(&cell)) return fmt::format("{}", *n);
  return "";
}

std::string markdown_text(std::string_view text) {
  std::string out;
  std::size_t backslashes = 0;
  for (const char c : text) {
    // a pipe after an odd number of backslashes is literal, so existing backslashes are doubled
    if (c == '|') out.append(backslashes + 1, '\\');
    backslashes = c == '\\' ? backslashes + 1 : 0;
    out += c == '\n' || c == '\r' ? ' ' : c;
  }
  return out;
}

}  // namespace

Cell::Cell(const std::optional<double>& value) {
  if (value) *this = Cell(*value);
}

Table::Table(std::vector<Column> columns) : columns_(std::move(columns)) {
  if (columns_.empty()) throw std::invalid_argument("Table: needs at least one column");
}

void Table::add(std::vector<Cell> row) {
  if (row.size() != columns_.size()) {
    throw invalid_argument("Table: a row of {} cells for {} columns", row.size(), columns_.size());
  }
  rows_.push_back(std::move(row));
}

std::string Table::text(std::size_t row, std::size_t column) const {
  return show(
      rows_.at(row).at(column), [&](double x) { return format_number(x, columns_[column].digits); },
      [](const std::string& words) { return words; });
}

bool Table::numeric(std::size_t column) const {
  return std::all_of(rows_.begin(), rows_.end(),
                     [column](const auto& row) { return !std::holds_alternative<std::string>(row[column]); });
}

std::string Table::csv() const {
  std::string out;
  for (std::size_t i = 0; i < columns_.size(); ++i) out += (i ? "," : "") + csv_field(columns_[i].name);
  out += '\n';
  const auto real = [](double x) { return fmt::format("{:.17g}", x); };
  const auto scan =
      std::find_if(columns_.begin(), columns_.end(), [](const Column& c) { return c.scan_lines; });
  const auto scan_index = static_cast<std::size_t>(scan - columns_.begin());
  const std::vector<Cell>* previous = nullptr;
  for (const auto& row : rows_) {
    if (scan != columns_.end() && previous && (*previous)[scan_index] != row[scan_index]) out += '\n';
    for (std::size_t i = 0; i < row.size(); ++i) out += (i ? "," : "") + show(row[i], real, csv_field);
    out += '\n';
    previous = &row;
  }
  return out;
}

std::string Table::markdown() const {
  std::string out = "|";
  for (const Column& c : columns_) out += fmt::format(" {} |", markdown_text(c.name));
  out += "\n|";
  for (std::size_t i = 0; i < columns_.size(); ++i) out += numeric(i) ? " ---: |" : " :--- |";
  out += '\n';
  for (const auto& row : rows_) {
    out += '|';
    for (std::size_t i = 0; i < row.size(); ++i) {
      const auto real = [&](double x) { return format_number(x, columns_[i].digits); };
      out += fmt::format(" {} |", show(row[i], real, markdown_text));
    }
    out += '\n';
  }
  return out;
}

std::string format_number(double value, int digits) {
  std::string text = fmt::format("{:.{}g}", value, digits);
  // "1.5e-03" -> "1.5e-3", "1e+06" -> "1e6"
  const auto e = text.find('e');
  if (e == std::string::npos) return text;
  std::string exponent = text.substr(e + 1);
  const bool negative = exponent[0] == '-';
  exponent.erase(0, exponent.find_first_not_of("+-0"));
  return text.substr(0, e) + (negative ? "e-" : "e") + exponent;
}

std::string csv_field(std::string_view text) {
  if (text.find_first_of(",\"\n\r") == std::string_view::npos) return std::string(text);
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + '"';
}

}  // namespace nlmech::scene
