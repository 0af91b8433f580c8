#include "nlmech/scene/published.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "nlmech/scene/csv.hpp"
#include "nlmech/scene/files.hpp"
#include "nlmech/support/echo.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::scene {
namespace fs = std::filesystem;

namespace {

constexpr std::array verdicts = {Verdict::reproduced, Verdict::reproduced_inferred,
                                 Verdict::better,     Verdict::differs,
                                 Verdict::not_stated, Verdict::context,
                                 Verdict::input,      Verdict::not_built};

struct Range {
  double low, high;
};

/// The number or range "1.1e-6..1.3e-6" that a text begins with, up to a blank or semicolon; nothing if it
/// begins otherwise
/// ("2-cycle", "6-7 its").
std::optional<Range> leading_range(std::string_view text) {
  const std::string_view first = text.substr(0, text.find_first_of(" ;"));
  const auto dots = first.find("..");
  Range range{};
  if (!parse_number(first.substr(0, dots), range.low)) return std::nullopt;
  range.high = range.low;
  if (dots != std::string_view::npos && !parse_number(first.substr(dots + 2), range.high))
    return std::nullopt;
  return range;
}

Verdict parse_verdict(const std::string& text, const std::string& where) {
  for (const Verdict v : verdicts) {
    if (to_string(v) == text) return v;
  }
  throw InputError(fmt::format("{}: '{}' is no verdict", where, echoed(text)));
}

bool close_to(const Tolerance& tolerance, double ours, const std::optional<Range>& reference) {
  return reference && tolerance.allows(ours, reference->low, reference->high);
}

bool supports(Verdict verdict, const PublishedValue& p, const Measured& m) {
  const Tolerance tolerance(p.tolerance);
  const auto nominal = leading_range(p.nominal), inferred = leading_range(p.inferred);
  switch (verdict) {
    case Verdict::reproduced: return m.nominal && tolerance.allows(*m.nominal, p.value);
    case Verdict::reproduced_inferred: {
      const Range printed{p.value, p.value};
      return m.inferred && close_to(tolerance, *m.inferred, inferred ? inferred : printed);
    }
    case Verdict::better:
      return m.nominal && p.kind == "error" && std::abs(*m.nominal) < std::abs(p.value) &&
             (!nominal || close_to(tolerance, *m.nominal, nominal));
    case Verdict::differs:
      return m.nominal && !std::isnan(*m.nominal) && !tolerance.allows(*m.nominal, p.value) &&
             (!nominal || close_to(tolerance, *m.nominal, nominal));
    case Verdict::input: return m.nominal && *m.nominal == p.value;
    case Verdict::not_stated:
    case Verdict::context: return true;
    case Verdict::not_built: return false;
  }
  return false;
}

/// For numbers that miss their expected verdict, where the file's own `nominal` says nothing about the new
/// one.
Verdict fallback(const PublishedValue& p, const Measured& m) {
  PublishedValue bare = p;
  bare.nominal.clear();
  bare.inferred.clear();
  for (const Verdict v : {Verdict::reproduced, Verdict::reproduced_inferred, Verdict::better}) {
    if (supports(v, bare, m)) return v;
  }
  return Verdict::differs;
}

PublishedValue to_value(const CsvRecord& record, const std::string& source, const std::string& file) {
  const std::string where = fmt::format("{}: line {}", file, record.line);
  const auto& c = record.cells;
  if (c.size() != 11) throw InputError(fmt::format("{}: {} of 11 cells", where, c.size()));
  PublishedValue p{source, c[0], c[1], c[2], c[3], 0, c[4], c[5], c[6], c[7], parse_verdict(c[8], where),
                   c[9],   c[10]};
  if (!parse_number(p.printed, p.value)) {
    throw InputError(
        fmt::format("{}, column 4 (value): '{}' is not a finite number", where, echoed(p.printed)));
  }
  try {
    static_cast<void>(Tolerance(p.tolerance));
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", where, error.what()));
  }
  return p;
}

}  // namespace

std::string_view to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::reproduced: return "reproduced";
    case Verdict::reproduced_inferred: return "reproduced, inferred reading";
    case Verdict::better: return "better";
    case Verdict::differs: return "differs";
    case Verdict::not_stated: return "not stated";
    case Verdict::context: return "context";
    case Verdict::input: return "input";
    case Verdict::not_built: return "not built";
  }
  return "";
}

Tolerance::Tolerance(std::string_view words) {
  if (words.empty()) return;
  if (words == "order of magnitude") {
    kind_ = Kind::factor;
    amount_ = std::sqrt(10.0);
    return;
  }
  constexpr std::array<std::pair<std::string_view, Kind>, 4> forms = {
      {{"factor ", Kind::factor},
       {"at least ", Kind::at_least},
       {"below ", Kind::below},
       {"rounding floor: below ", Kind::below}}};
  std::string_view number = words;
  for (const auto& [prefix, kind] : forms) {
    if (!words.starts_with(prefix)) continue;
    kind_ = kind;
    number = words.substr(prefix.size());
  }
  if (!parse_number(number, amount_) || amount_ <= 0 || (kind_ == Kind::factor && amount_ < 1)) {
    throw InputError(fmt::format("'{}' is no tolerance", echoed(words)));
  }
}

bool Tolerance::allows(double ours, double theirs) const {
  switch (kind_) {
    case Kind::relative: return std::abs(ours - theirs) <= amount_ * std::abs(theirs);
    case Kind::factor: {
      if (ours == theirs) return true;
      const double ratio = ours / theirs;
      return ratio <= amount_ && ratio >= 1 / amount_;
    }
    case Kind::at_least: return ours >= amount_;
    case Kind::below: return std::abs(ours) <= amount_;
  }
  return false;
}

bool Tolerance::allows(double ours, double low, double high) const {
  return allows(ours, std::clamp(ours, std::min(low, high), std::max(low, high)));
}

std::string PublishedValue::name() const { return fmt::format("{}/{}/{}/{}", source, place, row, quantity); }

std::vector<PublishedValue> parse_published(std::string_view text, const std::string& source,
                                            const std::string& file) {
  std::vector<PublishedValue> values;
  const auto records = parse_csv(text, file);
  for (std::size_t i = 1; i < records.size(); ++i) values.push_back(to_value(records[i], source, file));
  return values;
}

std::vector<PublishedValue> read_published(const fs::path& data_folder) {
  std::vector<PublishedValue> values;
  for (const fs::path& file : files_with(data_folder / "tables" / "published", ".csv")) {
    for (PublishedValue& value : parse_published(read_whole(file), file.stem().string(), file.string()))
      values.push_back(std::move(value));
  }
  return values;
}

std::vector<Place> parse_places(std::string_view text, const std::string& file) {
  const auto records = parse_csv(text, file);
  std::vector<Place> places;
  for (std::size_t i = 1; i < records.size(); ++i) {
    const auto& c = records[i].cells;
    if (c.size() != 5)
      throw InputError(fmt::format("{}: line {}: {} of 5 cells", file, records[i].line, c.size()));
    places.push_back({c[0], c[1], c[2], c[3], c[4]});
  }
  return places;
}

std::vector<Place> read_places(const fs::path& data_folder) {
  const fs::path file = data_folder / "tables" / "places.csv";
  return parse_places(read_whole(file), file.string());
}

const std::string& owner(const PublishedValue& value, const std::vector<Place>& places) {
  for (const Place& place : places) {
    if (place.source == value.source && place.name == value.place) return place.chapter;
  }
  throw InputError(fmt::format("tables/places.csv does not list {} of {}", value.place, value.source));
}

Judgement judge(const PublishedValue& value, const Measured& measured) {
  if (supports(value.expected, value, measured)) return {value.expected, true};
  return {fallback(value, measured), false};
}

}  // namespace nlmech::scene
