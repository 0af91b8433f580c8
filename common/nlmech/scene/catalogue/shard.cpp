#include "nlmech/scene/catalogue/shard.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <optional>
#include <sstream>
#include <string_view>
#include <system_error>
#include <utility>

#include "nlmech/scene/program/this_process.hpp"
#include "nlmech/scene/program/typed.hpp"
#include "nlmech/support/echo.hpp"
#include "nlmech/support/errors.hpp"
#include "nlmech/support/sentences.hpp"
#include "nlmech/support/threads.hpp"

namespace nlmech::scene {
namespace {

constexpr int most_shards = 1'000'000;

std::uint64_t digest_of(std::string_view text, std::uint64_t hash) {
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
  return hash;
}

/// What the lines of a part add up to, its first two among them: so lines that were lost, doubled, changed or
/// taken from another run are noticed.
struct Tally {
  std::int64_t lines = 0;
  std::uint64_t digest = 0xcbf29ce484222325U;
  void add(std::string_view text) {
    lines += std::count(text.begin(), text.end(), '\n');
    digest = digest_of(text, digest);
  }
};

constexpr std::string_view end_begins = "# end of shard ";

std::string end_mark(const Shard& shard, const Tally& tally, std::int64_t failed) {
  return fmt::format("{}{} / {} lines {} digest {:016x} failed {}", end_begins, shard.part, shard.parts,
                     tally.lines, tally.digest, failed);
}

/// The number that an end mark ends with; -1 if it does not.
std::int64_t failed_in(const std::string& mark) {
  const std::string_view number = std::string_view(mark).substr(mark.rfind(' ') + 1);
  std::int64_t failed = -1;
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), failed);
  return error == std::errc{} && end == number.data() + number.size() ? failed : -1;
}

/// A part, as its first line describes it.
struct Part {
  std::string path, name;
  Shard shard;
  std::int64_t first = 0, last = 0;
  std::string whole;   ///< "1000 run 9f86d081884c7d65": rows of the catalogue, and what they were made of
  std::string header;  ///< its second line
  std::string end;     ///< its last line
  std::int64_t failed = 0;
};

std::ifstream opened(const Part& part) {
  std::error_code unknown;
  const bool is_there = std::filesystem::exists(part.path, unknown);
  if (is_there && !std::filesystem::is_regular_file(part.path, unknown))
    throw input_error("{}: is no file; merge reads each part twice, which a pipe or a folder does not allow",
                      part.name);
  errno = 0;
  std::ifstream in(part.path, std::ios::binary);
  if (!in)
    throw input_error("{}: {}", part.name, std::generic_category().message(errno != 0 ? errno : ENOENT));
  return in;
}

[[noreturn]] void refuse_label(const Part& part, const std::string& line) {
  throw input_error(
      "{}, line 1: '{}' does not say which part of which output this is; merge joins what --shard i/n writes",
      part.name, echoed(line));
}

/// Understands the first two lines. @return the first
std::string read_label(Part& part, std::istream& in) {
  std::string line, mark, shard, slash, rows, to, of, run, digest, rest;
  std::getline(in, line);
  std::istringstream words(line.substr(0, 200));
  std::int64_t all = 0;
  words >> mark >> shard >> part.shard.part >> slash >> part.shard.parts >> rows >> part.first >> to >>
      part.last >> of >> all >> run >> digest;
  const bool fine =
      words && !(words >> rest) && mark + shard + slash + rows + to + of + run == "#shard/rowstoofrun" &&
      part.shard.part >= 1 && part.shard.part <= part.shard.parts && part.shard.parts <= most_shards &&
      all >= 0 && part.shard.rows(all) == std::pair(part.first, part.last);
  if (!fine) refuse_label(part, line);
  part.whole = echoed(fmt::format("{} run {}", all, digest));
  std::getline(in, part.header);
  return line;
}

/// Reads a part through: its rows are there in order, and so is its end, which agrees with them.
Part checked(const std::string& path) {
  Part part;
  part.path = path;
  part.name = echoed_path(path);
  std::ifstream in = opened(part);
  const std::string first = read_label(part, in);
  Tally tally;
  for (const std::string& head : {first, part.header}) tally.add(head + '\n');
  std::string line;
  std::int64_t row = part.first - 1;
  while (std::getline(in, line)) {
    const auto number = tally.lines + 1;
    if (line.starts_with(end_begins)) {
      part.failed = failed_in(line);
      part.end = end_mark(part.shard, tally, part.failed);
      if (line != part.end || row != part.last || part.failed < 0)
        throw input_error(
            "{}, line {}: '{}' does not fit the {} lines above, of which the last is of row {} of {} to {}: "
            "lines are missing, doubled, changed or of another run; compute the part again",
            part.name, number, echoed(line), tally.lines, row, part.first, part.last);
      if (in.peek() != std::ifstream::traits_type::eof())
        throw input_error("{}, line {}: a line stands behind the end of the part", part.name, number + 1);
      return part;
    }
    std::int64_t here = 0;
    const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), here);
    const bool fine = error == std::errc{} && end != line.data() + line.size() && *end == ',';
    if (!fine || (here != row && here != row + 1) || here < part.first || here > part.last)
      throw input_error("{}, line {}: '{}' is no line of row {} or {}", part.name, number, echoed(line), row,
                        row + 1);
    row = here;
    tally.add(line);
    tally.add("\n");
  }
  throw input_error(
      "{}: ends with row {} of {} to {}, without the line '{}{} / {} ...': the file is not whole", part.name,
      row, part.first, part.last, end_begins, part.shard.part, part.shard.parts);
}

/// All parts in order, each there once.
std::vector<Part> in_order(const std::vector<std::string>& paths) {
  std::vector<std::optional<Part>> ordered;
  std::optional<Part> first;
  for (const std::string& path : paths) {
    Part part = checked(path);
    if (!first) {
      first = part;
      ordered.resize(static_cast<std::size_t>(part.shard.parts));
    }
    if (part.whole != first->whole || part.shard.parts != first->shard.parts || part.header != first->header)
      throw input_error("{}, line 1: shard {} / {} of {} is no part of that of {}: {} shards of {}",
                        part.name, part.shard.part, part.shard.parts, part.whole, first->name,
                        first->shard.parts, first->whole);
    std::optional<Part>& place = ordered[static_cast<std::size_t>(part.shard.part - 1)];
    if (place)
      throw input_error("{}: shard {} / {} is in {} already", part.name, part.shard.part, part.shard.parts,
                        place->name);
    place = std::move(part);
  }
  std::string missing;
  std::vector<Part> all;
  for (std::size_t k = 0; k < ordered.size(); ++k) {
    if (ordered[k]) {
      all.push_back(std::move(*ordered[k]));
    } else if (missing.size() < 60) {
      missing += fmt::format("{}{}", missing.empty() ? "" : ", ", k + 1);
    }
  }
  if (!missing.empty())
    throw input_error("{}: shards {} of {} are missing", first->name, missing, first->shard.parts);
  return all;
}

}  // namespace

std::pair<std::int64_t, std::int64_t> Shard::rows(std::int64_t rows) const {
  // Rows before part k: rows k/parts, rounded down, without a product that could overflow.
  const auto before = [&](std::int64_t k) { return rows / parts * k + rows % parts * k / parts; };
  return {before(part - 1) + 1, before(part)};
}

Shard typed_shard(const std::string& option, const std::string& text) {
  const std::size_t place = text.find('/');
  if (place == std::string::npos) throw input_error("{} {}: needs two numbers and '/'", option, echoed(text));
  const auto whole = [&](const std::string& half) { return typed_whole(option, half, 1, most_shards); };
  const Shard shard{whole(text.substr(0, place)), whole(text.substr(place + 1))};
  if (shard.part > shard.parts)
    throw input_error("{} {}: there are {} shards", option, echoed(text), shard.parts);
  return shard;
}

void print_catalogue(Catalogue& catalogue, const CatalogueRun& run) {
  std::string text = run.header + '\n';
  std::optional<Shard> part;
  std::int64_t last = std::numeric_limits<std::int64_t>::max();
  if (!run.shard.empty()) {
    const Shard shard = typed_shard("--shard", run.shard);
    if (!catalogue.rows())
      throw input_error("--shard {}: needs a file; how many rows {} has is not known", run.shard,
                        catalogue.name());
    const auto [from, to] = shard.rows(*catalogue.rows());
    text = fmt::format("# shard {} / {} rows {} to {} of {} run {:016x}\n", shard.part, shard.parts, from, to,
                       *catalogue.rows(), digest_of(run.options, catalogue.digest())) +
           text;
    part = shard;
    last = to;
    catalogue.skip_to(from);
  }
  const std::string of = catalogue.rows() ? fmt::format(" of {}", *catalogue.rows()) : std::string();
  Tally tally;
  for (;;) {
    const CatalogueRows rows = catalogue.next(run.portion, last);
    if (rows.line.empty()) {
      if (rows.first == 1 && catalogue.rows().value_or(0) == 0) tell_of_no_rows(catalogue.name());
      break;
    }
    const Doing doing(fmt::format("at row {}{}", rows.first, of));
    // The header waits for the first rows: if they turn out to be a mistake, nothing was printed.
    std::string lines = run.work(rows);
    if (text.empty()) {
      text = std::move(lines);  // they may be many
    } else {
      text += lines;
    }
    print_result(text);
    if (part) tally.add(text);
    text.clear();
  }
  if (part) {
    tally.add(text);
    text += end_mark(*part, tally, run.failed()) + '\n';
  }
  print_result(text);
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

void print_merged(const std::vector<std::string>& paths) {
  const std::vector<Part> parts = in_order(paths);
  std::int64_t failed = 0;
  print_result(parts.at(0).header + '\n');
  for (const Part& part : parts) {
    std::ifstream in = opened(part);
    std::string line, text;
    Tally tally;
    for (int k = 0; k < 2 && std::getline(in, line); ++k) tally.add(line + '\n');
    while (std::getline(in, line) && !line.starts_with(end_begins)) {
      text.append(line).append("\n");
      if (text.size() < std::size_t{1} << 18U) continue;
      print_result(text);
      tally.add(text);
      text.clear();
    }
    print_result(text);
    tally.add(text);
    if (line != part.end || end_mark(part.shard, tally, part.failed) != part.end)
      throw Failure(
          fmt::format("{}: was changed while it was being read; what is printed is not whole", part.name));
    failed += part.failed;
  }
  if (failed > 0) throw Failure(fmt::format("{} of the rows failed; their status says how", failed));
}

}  // namespace nlmech::scene
