#include "nlmech/scene/catalogue/catalogue.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <iostream>
#include <system_error>
#include <utility>

#include "nlmech/scene/program/csv.hpp"
#include "nlmech/scene/program/this_process.hpp"
#include "nlmech/support/doubles.hpp"
#include "nlmech/support/echo.hpp"
#include "nlmech/support/errors.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::scene {
namespace {

/// A line longer than this is none of a table.
constexpr std::size_t longest_line = std::size_t{1} << 20U;

std::string_view trim(std::string_view text) {
  constexpr std::string_view blanks = " \t\r";
  const auto first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

/// Cuts the next cell off @p rest, quotes and all; @p more says whether a comma followed. False: a quote is
/// open.
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
  return cell.size() > 1 && cell.front() == '"' && cell.back() == '"' ? cell.substr(1, cell.size() - 2)
                                                                      : cell;
}

}  // namespace

Catalogue::Catalogue(std::string path, std::vector<std::string> required, std::vector<std::string> optional,
                     RowCheck check)
    : path_(std::move(path)),
      name_(path_ == "-" ? "standard input" : echoed_path(path_)),
      known_(std::move(required)),
      required_(known_.size()),
      check_(std::move(check)) {
  known_.insert(known_.end(), optional.begin(), optional.end());
  open();
  read_header();
  std::error_code ignored;
  if (path_ == "-" || !std::filesystem::is_regular_file(path_, ignored)) return;
  const Doing doing("reading " + name_);
  Line line;
  std::vector<double> numbers;
  std::string rest;
  std::int64_t rows = 0;
  for (; read_row(line); ++rows) understand(line, numbers, rest);
  rows_ = rows;
  open();
  read_header();
}

void Catalogue::open() {
  buffer_.clear();
  place_ = line_number_ = 0;
  ended_ = false;
  if (path_ == "-") return;
  file_ = std::ifstream(path_, std::ios::binary);
  if (!file_ || std::filesystem::is_directory(path_))
    throw input_error("{}: {}", name_,
                      std::generic_category().message(!file_ && errno != 0 ? errno : EISDIR));
}

bool Catalogue::has(std::string_view column) const {
  return std::any_of(column_.begin(), column_.end(), [&](int known) {
    return known >= 0 && known_[static_cast<std::size_t>(known)] == column;
  });
}

bool Catalogue::read_line(Line& line) {
  std::size_t end = buffer_.find('\n', place_);
  while (end == std::string::npos && !ended_) {
    if (buffer_.size() - place_ > longest_line)
      throw input_error("{}: line {}: more than {} bytes; this is no table", name_, line_number_ + 1,
                        longest_line);
    buffer_.erase(0, place_);
    place_ = 0;
    constexpr std::size_t portion = std::size_t{1} << 18U;
    const std::size_t before = buffer_.size();
    buffer_.resize(before + portion);
    std::istream& in = path_ == "-" ? std::cin : file_;
    in.read(buffer_.data() + before, static_cast<std::streamsize>(portion));
    buffer_.resize(before + static_cast<std::size_t>(in.gcount()));
    ended_ = !in;
    end = buffer_.find('\n', before);
  }
  if (place_ == buffer_.size()) return false;
  end = std::min(end, buffer_.size());
  line = {std::string_view(buffer_).substr(place_, end - place_), ++line_number_};
  place_ = std::min(end + 1, buffer_.size());
  return true;
}

bool Catalogue::read_row(Line& line) {
  while (read_line(line)) {
    line.text = trim(line.text);
    if (line.number == 1 && line.text.starts_with("\xEF\xBB\xBF")) line.text = trim(line.text.substr(3));
    // Behind the header '#' is a character like others: a row that begins with it must not vanish.
    if (line.text.empty() || (names_.empty() && line.text.front() == '#')) continue;
    if (rows_) return true;  // read through already
    for (const char c : line.text) digest_ = (digest_ ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
    digest_ = (digest_ ^ '\n') * 0x100000001b3U;
    return true;
  }
  return false;
}

void Catalogue::read_header() {
  Line line;
  column_.clear();
  names_.clear();
  rest_names_.clear();
  next_row_ = 1;
  if (!read_row(line))
    throw input_error("{}: is empty; a header with {} is needed", name_, fmt::join(known_, ","));
  std::string_view rest = line.text, cell;
  for (bool more = true; more;) {
    if (!next_cell(rest, cell, more))
      throw input_error("{}: line {}: a quote is never closed", name_, line.number);
    const std::string_view name = unquoted(cell);
    const auto place = std::find(known_.begin(), known_.end(), name);
    const bool is_known = place != known_.end();
    if (is_known && std::find(names_.begin(), names_.end(), name) != names_.end())
      throw input_error("{}: line {}: two columns are called {}", name_, line.number, echoed(name));
    names_.emplace_back(name);
    column_.push_back(is_known ? static_cast<int>(place - known_.begin()) : -1);
    if (!is_known) rest_names_.append(",").append(cell);
  }
  for (std::size_t i = 0; i < required_; ++i) {
    if (std::find(names_.begin(), names_.end(), known_[i]) == names_.end())
      throw input_error("{}: line {}: there is no column {}; the header is '{}'", name_, line.number,
                        known_[i], echoed(line.text));
  }
}

void Catalogue::understand(const Line& line, std::vector<double>& numbers, std::string& rest) const {
  numbers.assign(known_.size(), nan);
  rest.clear();
  std::string_view text = line.text, cell;
  const char* const hint = text.starts_with('#') ? "; comments stand before the header" : "";
  bool more = true;
  for (std::size_t i = 0; i < column_.size(); ++i) {
    if (!more)
      throw input_error("{}: line {}: {} of {} cells{}", name_, line.number, i, column_.size(), hint);
    if (!next_cell(text, cell, more))
      throw input_error("{}: line {}: a quote is never closed", name_, line.number);
    if (column_[i] < 0) {
      rest.append(",").append(cell);
    } else if (!parse_number(unquoted(cell), numbers[static_cast<std::size_t>(column_[i])])) {
      throw input_error("{}: line {}, column {} ({}): '{}' is not a finite number{}", name_, line.number,
                        i + 1, echoed(names_[i]), echoed(cell), hint);
    }
  }
  if (more)
    throw input_error("{}: line {}, column {}: '{}' is beyond the {} columns{}", name_, line.number,
                      column_.size() + 1, echoed(text), column_.size(), hint);
  const std::string wrong = check_ ? check_(numbers) : std::string();
  if (!wrong.empty()) throw input_error("{}: line {}: {}", name_, line.number, wrong);
}

CatalogueRows Catalogue::next(const Portion& portion, std::int64_t last) {
  CatalogueRows rows;
  rows.first = next_row_;
  Line line;
  double sum = 0;
  const auto is_full = [&] {
    return sum >= portion.weight && (rows.line.size() >= portion.rows || sum >= portion.most);
  };
  while (!is_full() && next_row_ <= last && read_row(line)) {
    understand(line, rows.numbers.emplace_back(), rows.rest.emplace_back());
    rows.line.push_back(line.number);
    sum += weight_ ? weight_(rows.numbers.back()) : 1;
    ++next_row_;
  }
  return rows;
}

void Catalogue::skip_to(std::int64_t row) {
  Line line;
  while (next_row_ < row && read_row(line)) ++next_row_;
}

}  // namespace nlmech::scene
