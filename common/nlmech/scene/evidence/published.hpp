/// @file
/// Numbers printed in the sources: reader, look-up by name, and the verdict on each of them.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace nlmech::scene {

/// Verdict on a printed number by the evidence.
enum class Verdict {
  reproduced,           ///< the text as printed gives the printed number
  reproduced_inferred,  ///< a reading inferred from evidence gives the printed number
  same_rounding,        ///< printed and reproduced rounding noise have the same level; no digit is compared
  better,               ///< the reproduced number is below a printed bound or rounding noise of the procedure
  differs,              ///< the numbers differ, with the cause or "cause unknown"
  not_stated,           ///< the source omits what is needed, or one setting was fitted to the number
  holds,                ///< the claim holds for the text as printed
  does_not_hold,        ///< the claim does not hold
  context,              ///< run time on an unknown machine
  input                 ///< parameter, used as printed
};

/// Text of a verdict in files: "reproduced, inferred reading".
[[nodiscard]] std::string_view to_string(Verdict verdict);

/// Permitted difference of two numbers, from the words of the file:
///   - "digits": the reproduced number, rounded or truncated to the printed digits, is the printed one: its
///     magnitude is at most half a unit of the last digit less and one unit more;
///   - "3 units": at most three units of the last digit on either side;
///   - a number: relative difference; "factor 5": ratio; "order of magnitude": a factor of sqrt(10), for
///   numbers
///     printed as powers of ten;
///   - "at least 100" and "below 1e-15": bounds on the reproduced number alone.
class Tolerance {
 public:
  /// @param words tolerance in one of these forms
  /// @param printed the number as printed, for its last digit
  /// @throws InputError for words of another form
  explicit Tolerance(std::string_view words, std::string_view printed = "1");
  /// Is @p result within the tolerance of @p published? False for NaN.
  [[nodiscard]] bool allows(double result, double published) const;
  /// Is @p result within the tolerance of some number of a range?
  [[nodiscard]] bool allows(double result, double low, double high) const;
  /// Is it a bound on the reproduced number alone?
  [[nodiscard]] bool is_bound() const { return kind_ == Kind::at_least || kind_ == Kind::below; }

 private:
  enum class Kind { digits, absolute, relative, factor, at_least, below } kind_ = Kind::relative;
  double amount_ = 0;
};

/// One printed number, a row of `tables/published/<source>.csv`; the README there explains the columns.
struct PublishedValue {
  std::string source;    ///< name of the file: "elgohary"
  std::string place;     ///< "table-4.2"
  std::string row;       ///< the method or case, in the source's words
  std::string quantity;  ///< printed quantity
  std::string printed;   ///< number as printed
  double value = 0;      ///< value of the number
  std::string unit;      ///< "1" if it has none
  std::string
      kind;  ///< "error", "rounding" (noise), "bound", "count", "time", "value", "claim" or "parameter"
  std::string nominal;   ///< earlier result by the text as printed, number or words: "2.4e-11"
  std::string inferred;  ///< earlier result under an inferred reading: "1.1e-6..1.3e-6 with c = 2.5"
  Verdict expected = Verdict::not_stated;  ///< verdict that the findings support
  std::string tolerance;                   ///< words of a Tolerance
  std::string because;                     ///< reason for the tolerance; "digits" needs none
  int tried = 0;                           ///< number of readings tried, if one is inferred or none was found
  std::string explains;  ///< "5 of 6": rows that the reading explains, of those that it affects
  std::string erratum;   ///< id of the misprint, if the number is one
  std::string reading;   ///< interpretation of the text, or the cause of a difference

  /// "elgohary/claim-2.4/order 4/height error, order of magnitude"
  [[nodiscard]] std::string name() const;
};

/// A figure, table, claim or equation of a source, and the chapter that owns it: a row of
/// `tables/places.csv`.
struct Place {
  std::string source;   ///< "elgohary"
  std::string name;     ///< "fig-2.23"
  std::string chapter;  ///< chapter that owns it
  std::string kind;     ///< "figure", "table", "algorithm", "claim" or "equation"
  std::string subject;  ///< subject
  /// Scenes that show it: those of its name or, if it repeats another source, those of the other source.
  std::vector<std::string> scenes;
};

/// All values of all files in `<data>/tables/published`, files in alphabetical order.
/// @throws InputError naming file, line and cell
[[nodiscard]] std::vector<PublishedValue> read_published(const std::filesystem::path& data_folder);

/// The values of one such file. @param source name of the file without extension @param file its name in
/// messages
/// @throws InputError naming file, line and cell
[[nodiscard]] std::vector<PublishedValue> parse_published(std::string_view text, const std::string& source,
                                                          const std::string& file);

/// The rows of a list of places. @throws InputError naming file and line
[[nodiscard]] std::vector<Place> parse_places(std::string_view text, const std::string& file);

/// All rows of `<data>/tables/places.csv`. @throws InputError naming file and line
[[nodiscard]] std::vector<Place> read_places(const std::filesystem::path& data_folder);

/// The chapter that owns a published value. @throws InputError if `places.csv` does not list its place
[[nodiscard]] const std::string& owner(const PublishedValue& value, const std::vector<Place>& places);

/// Reproduced values of a printed number.
struct Measured {
  std::optional<double> nominal;   ///< value by the text as printed
  std::optional<double> inferred;  ///< value under an inferred reading
  std::string setting = {};        ///< setting of both runs as text; empty: see PublishedValue::reading
};

/// A verdict, and whether it is the expected one.
struct Judgement {
  Verdict verdict = Verdict::not_stated;  ///< verdict by the evidence
  bool passes = false;                    ///< is it the expected one?
};

/// Verdict by the evidence: the expected verdict if @p measured supports it, else the one that it supports.
///  - `reproduced` needs the nominal number within the tolerance of the printed one, and a significant
///  number: no
///    rounding noise and no bound;
///  - `reproduced, inferred reading` needs the same of the inferred number;
///  - `same rounding level` needs the kind "rounding", and the nominal or the inferred number within a factor
///  of
///    the printed one or both below a bound;
///  - `better` needs the kind "bound" or "rounding", and a nominal number smaller than the printed one and
///  within
///    the tolerance of `nominal`;
///  - `differs` needs a number outside the tolerance of the printed one, and within it, or 5 %, of the
///  earlier
///    result in the file; the inferred number counts if there is no nominal one;
///  - `holds` and `does not hold` need the kind "claim", and the nominal number within or outside its
///  tolerance;
///  - `input` needs the printed number itself.
/// `context` and `not stated` have no conditions.
[[nodiscard]] Judgement verdict_on(const PublishedValue& value, const Measured& measured);

/// All numbers that the sources print.
class Printed {
 public:
  /// Reads all files. @throws InputError naming file, line and cell
  Printed();
  /// The value of a number. @param name as PublishedValue::name() @throws std::logic_error if no source
  /// prints it
  [[nodiscard]] double operator[](const std::string& name) const;

 private:
  std::map<std::string, double> values_;
};

}  // namespace nlmech::scene
