#include "nlmech/scene/evidence/published.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "nlmech/scene/program/csv.hpp"
#include "nlmech/scene/program/files.hpp"
#include "nlmech/support/errors.hpp"
#include "nlmech/support/quoted_input.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::scene {
namespace fs = std::filesystem;

namespace {

constexpr std::array verdicts = {Verdict::reproduced,    Verdict::reproduced_inferred,
                                 Verdict::same_rounding, Verdict::better,
                                 Verdict::differs,       Verdict::not_stated,
                                 Verdict::holds,         Verdict::does_not_hold,
                                 Verdict::context,       Verdict::input};

struct Range {
  double low, high;
};

/// The number or range "1.1e-6..1.3e-6" at the start of a text, up to a blank or semicolon; nothing for any
/// other start ("2-cycle", "6-7 its").
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
  throw input_error("{}: '{}' is no verdict", where, quoted_input(text));
}

bool close_to(const Tolerance& tolerance, double result, const std::optional<Range>& reference) {
  return reference && tolerance.allows(result, reference->low, reference->high);
}

/// Does @p result agree with an earlier result, given by @p words of the file, within the tolerance or
/// nearly?
bool found_again(const Tolerance& tolerance, double result, std::string_view words) {
  const auto found = leading_range(words);
  return !found || close_to(tolerance, result, found) || close_to(Tolerance("0.05"), result, found);
}

/// Does the number have digits to compare?
bool has_digits(const PublishedValue& p) {
  return p.kind != "rounding" && p.kind != "bound" && p.kind != "claim";
}

bool matches(const PublishedValue& p, const Tolerance& tolerance, const std::optional<double>& result) {
  return has_digits(p) && !tolerance.is_bound() && result && tolerance.allows(*result, p.value);
}

bool same_noise(const PublishedValue& p, const Tolerance& tolerance, const std::optional<double>& result) {
  if (p.kind != "rounding" || !result) return false;
  return tolerance.allows(*result, p.value) && (!tolerance.is_bound() || tolerance.allows(p.value, *result));
}

bool supports(Verdict verdict, const PublishedValue& p, const Measured& m) {
  if (verdict == Verdict::not_stated || verdict == Verdict::context) return true;
  if (verdict == Verdict::input) return m.nominal && *m.nominal == p.value;
  const Tolerance tolerance(p.tolerance, p.printed);
  // A text that cannot be run as printed has only an inferred number.
  const std::optional<double>& result = m.nominal ? m.nominal : m.inferred;
  switch (verdict) {
    case Verdict::reproduced: return matches(p, tolerance, m.nominal);
    case Verdict::reproduced_inferred: return matches(p, tolerance, m.inferred);
    case Verdict::same_rounding:
      // Noise under an inferred reading counts, too; the table shows it as inferred.
      return same_noise(p, tolerance, m.nominal) || same_noise(p, tolerance, m.inferred);
    case Verdict::better:
      return (p.kind == "bound" || p.kind == "rounding") && m.nominal &&
             found_again(tolerance, *m.nominal, p.nominal) && std::abs(*m.nominal) < std::abs(p.value);
    case Verdict::differs:
      return result && found_again(tolerance, *result, m.nominal ? p.nominal : p.inferred) &&
             !std::isnan(*result) && !tolerance.allows(*result, p.value);
    case Verdict::holds: return p.kind == "claim" && m.nominal && tolerance.allows(*m.nominal, p.value);
    case Verdict::does_not_hold:
      return p.kind == "claim" && m.nominal && !std::isnan(*m.nominal) &&
             !tolerance.allows(*m.nominal, p.value);
    default: return false;
  }
}

/// Verdict on a number that misses its expected one. The earlier results in the file do not count for it.
Verdict fallback(const PublishedValue& p, const Measured& m) {
  PublishedValue bare = p;
  bare.nominal.clear();
  bare.inferred.clear();
  if (bare.tolerance.empty()) bare.tolerance = "digits";  // for a parameter
  for (const Verdict v : {Verdict::reproduced, Verdict::reproduced_inferred, Verdict::same_rounding,
                          Verdict::better, Verdict::holds}) {
    if (supports(v, bare, m)) return v;
  }
  return p.kind == "claim" ? Verdict::does_not_hold : Verdict::differs;
}

/// Does a verdict compare numbers?
bool compares(Verdict verdict) {
  return verdict != Verdict::context && verdict != Verdict::input && verdict != Verdict::not_stated;
}

void refuse(bool wrong, const std::string& where, const std::string& what) {
  if (wrong) throw input_error("{}: {}", where, what);
}

/// Does the text have the form "5 of 6"?
bool is_share(std::string_view text) {
  const auto at = text.find(" of ");
  double rows = 0, of = 0;
  return at != std::string_view::npos && parse_number(text.substr(0, at), rows) &&
         parse_number(text.substr(at + 4), of) && rows >= 1 && rows <= of;
}

/// Checks that a comparison has a tolerance with its reason, and a reading its evidence.
void check_evidence(const PublishedValue& p, const std::string& where) {
  const bool is_inferred = p.expected == Verdict::reproduced_inferred;
  refuse(compares(p.expected) && p.tolerance.empty(), where, "a verdict that compares, and no tolerance");
  refuse(!p.erratum.empty() && (p.expected == Verdict::reproduced || is_inferred), where,
         fmt::format("a misprint ({}) cannot be reproduced", quoted_input(p.erratum)));
  refuse(!p.tolerance.empty() && p.tolerance != "digits" && p.because.empty(), where,
         fmt::format("no reason for the tolerance '{}'", quoted_input(p.tolerance)));
  // A search without a reading that explains the number is evidence, too.
  const bool has_search = p.tried > 0 || !p.explains.empty();
  refuse((p.tried > 0) == p.explains.empty() || is_inferred > has_search ||
             (has_search && !is_inferred && p.expected != Verdict::not_stated),
         where, "readings tried and rows explained belong to an inferred reading or one not stated, both");
  if (has_search)
    refuse(!is_share(p.explains), where,
           fmt::format("'{}' is not of the form '5 of 6'", quoted_input(p.explains)));
}

PublishedValue to_value(const CsvRecord& record, const std::string& source, const std::string& file) {
  const std::string where = fmt::format("{}: line {}", file, record.line);
  const auto& c = record.cells;
  refuse(c.size() != 15, where, fmt::format("{} of 15 cells", c.size()));
  PublishedValue p{
      source, c[0],  c[1], c[2],  c[3],  0,    c[4], c[5], c[6], c[7], parse_verdict(c[8], where),
      c[9],   c[10], 0,    c[12], c[13], c[14]};
  if (!parse_number(p.printed, p.value)) {
    throw input_error("{}, column 4 (value): '{}' is not a finite number", where, quoted_input(p.printed));
  }
  double tried = 0;
  refuse(!c[11].empty() &&
             (!parse_number(c[11], tried) || tried != std::floor(tried) || tried < 1 || tried > 1e6),
         where, fmt::format("'{}' is no number of readings", quoted_input(c[11])));
  p.tried = static_cast<int>(tried);
  try {
    if (!p.tolerance.empty()) static_cast<void>(Tolerance(p.tolerance, p.printed));
  } catch (const InputError& error) {
    throw input_error("{}: {}", where, error.what());
  }
  check_evidence(p, where);
  return p;
}

}  // namespace

std::string_view to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::reproduced: return "reproduced";
    case Verdict::reproduced_inferred: return "reproduced, inferred reading";
    case Verdict::same_rounding: return "same rounding level";
    case Verdict::better: return "better";
    case Verdict::differs: return "differs";
    case Verdict::not_stated: return "not stated";
    case Verdict::holds: return "holds";
    case Verdict::does_not_hold: return "does not hold";
    case Verdict::context: return "context";
    case Verdict::input: return "input";
  }
  return "";
}

namespace {

/// Unit of the last printed digit: 0.01e-4 for "1.18e-4".
double last_unit(std::string_view printed) {
  const auto e = printed.find('e');
  const std::string_view digits = printed.substr(0, e);
  const auto point = digits.find('.');
  const double decimals =
      point == std::string_view::npos ? 0 : static_cast<double>(digits.size() - point - 1);
  double exponent = 0;
  if (e != std::string_view::npos) static_cast<void>(parse_number(printed.substr(e + 1), exponent));
  return std::pow(10, exponent - decimals);
}

}  // namespace

Tolerance::Tolerance(std::string_view words, std::string_view printed) {
  if (words == "order of magnitude") {
    kind_ = Kind::factor;
    amount_ = std::sqrt(10.0);
    return;
  }
  // A number on the edge is within, despite rounding.
  constexpr double edge = 1 + 1e-12;
  if (words == "digits") {
    kind_ = Kind::digits;
    amount_ = last_unit(printed) * edge;
    return;
  }
  constexpr std::array<std::pair<std::string_view, Kind>, 3> forms = {
      {{"factor ", Kind::factor}, {"at least ", Kind::at_least}, {"below ", Kind::below}}};
  std::string_view number = words;
  if (words.ends_with(" units")) {
    kind_ = Kind::absolute;
    number.remove_suffix(6);
  }
  for (const auto& [prefix, kind] : forms) {
    if (!words.starts_with(prefix) || kind_ == Kind::absolute) continue;
    kind_ = kind;
    number = words.substr(prefix.size());
  }
  if (!parse_number(number, amount_) || amount_ <= 0 || (kind_ == Kind::factor && amount_ < 1)) {
    throw input_error("'{}' is no tolerance", quoted_input(words));
  }
  if (kind_ == Kind::absolute) amount_ *= last_unit(printed) * edge;
}

bool Tolerance::allows(double result, double published) const {
  switch (kind_) {
    case Kind::digits: {
      if (published == 0) return std::abs(result) <= amount_;
      const double more = published < 0 ? published - result : result - published;
      return more >= -amount_ / 2 && more <= amount_;
    }
    case Kind::absolute: return std::abs(result - published) <= amount_;
    case Kind::relative: return std::abs(result - published) <= amount_ * std::abs(published);
    case Kind::factor: {
      if (result == published) return true;
      const double ratio = result / published;
      return ratio <= amount_ && ratio >= 1 / amount_;
    }
    case Kind::at_least: return result >= amount_;
    case Kind::below: return std::abs(result) <= amount_;
  }
  return false;
}

bool Tolerance::allows(double result, double low, double high) const {
  return allows(result, std::clamp(result, std::min(low, high), std::max(low, high)));
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
    if (c.size() != 6) throw input_error("{}: line {}: {} of 6 cells", file, records[i].line, c.size());
    std::istringstream words(c[5]);
    std::vector<std::string> scenes{std::istream_iterator<std::string>(words), {}};
    if (scenes.empty()) scenes = {c[1]};
    places.push_back({c[0], c[1], c[2], c[3], c[4], std::move(scenes)});
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
  throw input_error("tables/places.csv does not list {} of {}", value.place, value.source);
}

Judgement verdict_on(const PublishedValue& value, const Measured& measured) {
  if (supports(value.expected, value, measured)) return {value.expected, true};
  return {fallback(value, measured), false};
}

Printed::Printed() {
  for (const PublishedValue& value : read_published(data_folder())) values_[value.name()] = value.value;
}

double Printed::operator[](const std::string& name) const {
  const auto found = values_.find(name);
  if (found == values_.end()) throw std::logic_error("no source prints " + name);
  return found->second;
}

}  // namespace nlmech::scene
