#include "nlmech/scene/catalogue/catalogue.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <iostream>
#include <system_error>
#include <utility>

#include "nlmech/scene/program/this_process.hpp"
#include "nlmech/support/errors.hpp"
#include "nlmech/support/quoted_input.hpp"
#include "nlmech/support/sentences.hpp"
#include "nlmech/support/threads.hpp"

namespace nlmech::scene {
namespace {

/// Greatest length of a line; a longer one cannot belong to a table.
constexpr std::size_t longest_line = std::size_t{1} << 20U;

std::vector<std::string> joined(std::vector<std::string> first, const std::vector<std::string>& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

}  // namespace

Catalogue::Catalogue(std::string path, const std::vector<std::string>& required,
                     const std::vector<std::string>& optional, RowCheck check, NameCase fits)
    : path_(std::move(path)),
      name_(path_ == "-" ? "standard input" : echoed_path(path_)),
      columns_(name_, joined(required, optional), required.size(), fits),
      check_(std::move(check)) {
  open();
  read_header();
  std::error_code ignored;
  if (path_ == "-" || !std::filesystem::is_regular_file(path_, ignored)) return;
  const ProgressScope doing("reading " + name_);
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
  columns_.reset_header();
  if (path_ == "-") return;
  file_ = std::ifstream(path_, std::ios::binary);
  if (!file_ || std::filesystem::is_directory(path_))
    throw input_error("{}: {}", name_,
                      std::generic_category().message(!file_ && errno != 0 ? errno : EISDIR));
}

bool Catalogue::read_line(Line& line) {
  std::size_t end = buffer_.find('\n', place_);
  while (end == std::string::npos && !ended_) {
    if (buffer_.size() - place_ > longest_line)
      throw input_error("{}: line {}: more than {} bytes; a line of a table is shorter", name_,
                        line_number_ + 1, longest_line);
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
    line.text = columns_.content(line.text, line.number);
    if (!line.text.empty()) return true;
  }
  return false;
}

void Catalogue::read_header() {
  Line line;
  next_row_ = 1;
  if (!read_row(line)) columns_.refuse_empty();
  if (columns_.read_header(line.text, line.number)) return;
  place_ =
      static_cast<std::size_t>(line.text.data() - buffer_.data());  // it is a row, and will be read as one
  --line_number_;
}

void Catalogue::understand(const Line& line, std::vector<double>& numbers, std::string& rest) const {
  columns_.read_row(line.text, line.number, numbers, rest);
  const std::string wrong = check_ ? check_(numbers) : std::string();
  if (!wrong.empty()) throw input_error("{}: line {}: {}", name_, line.number, wrong);
}

CatalogueRows Catalogue::next(const Portion& portion) {
  CatalogueRows rows;
  rows.first = next_row_;
  Line line;
  double sum = 0;
  const auto is_full = [&] {
    return sum >= portion.weight && (rows.line.size() >= portion.rows || sum >= portion.most);
  };
  while (!is_full() && read_row(line)) {
    understand(line, rows.numbers.emplace_back(), rows.rest.emplace_back());
    rows.line.push_back(line.number);
    sum += weight_ ? weight_(rows.numbers.back()) : 1;
    ++next_row_;
  }
  return rows;
}

void print_catalogue(Catalogue& catalogue, const CatalogueOutput& output) {
  const std::string of = catalogue.rows() ? fmt::format(" of {}", *catalogue.rows()) : std::string();
  // The header is printed with the first rows, so that nothing is printed if they contain a mistake.
  std::string header = output.header + '\n';
  for (;;) {
    const CatalogueRows rows = catalogue.next(output.portion);
    if (rows.line.empty()) {
      if (rows.first == 1) print_no_rows(catalogue.name());
      break;
    }
    const ProgressScope doing(fmt::format("at row {}{}", rows.first, of));
    const std::string lines = output.work(rows);
    print_result(std::exchange(header, {}));
    print_result(lines);
  }
  print_result(header);
}

Portion portion_for(double lines, int threads) {
  constexpr std::size_t lanes = 16, lines_of_thread = std::size_t{1} << 18U;
  const std::size_t count = threads_for(threads);
  return {lines, count * lanes, static_cast<double>(count * lines_of_thread)};
}

std::string lines_in_threads(std::size_t count, int threads,
                             const std::function<void(std::size_t task, std::string& lines)>& add) {
  const std::size_t portion = std::clamp<std::size_t>(count / (8 * threads_for(threads)), 1, 64);
  std::vector<std::string> pieces((count + portion - 1) / portion);
  share_out(count, portion, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) add(i, pieces[begin / portion]);
  });
  std::size_t size = 0;
  for (const std::string& piece : pieces) size += piece.size();
  std::string lines;
  lines.reserve(size);
  for (std::string& piece : pieces) lines += std::exchange(piece, {});
  return lines;
}

}  // namespace nlmech::scene
