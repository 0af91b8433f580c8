/// @file
/// Numbers that the sources print: read, looked up by name, and the verdict on each of them.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace nlmech::scene {

/// What the evidence says about a printed number.
enum class Verdict {
  reproduced,           ///< the text as it stands gives the printed number
  reproduced_inferred,  ///< a reading that evidence points to gives it
  same_rounding,        ///< rounding noise, theirs and ours, of the same level: no digit is compared
  better,               ///< a printed bound or rounding noise of the same procedure, and ours lies below
  differs,              ///< with the cause, or "cause unknown"
  not_stated,           ///< the source leaves out what is needed, or one setting was fitted to it
  holds,                ///< a claim, as the text stands
  does_not_hold,        ///< a claim
  context,              ///< run times on unknown machines
  input                 ///< a parameter, used as printed
};

/// As it stands in files: "reproduced, inferred reading".
[[nodiscard]] std::string_view to_string(Verdict verdict);

/// How far apart two numbers may be. Built from the words of the file:
///   - "digits": ours, rounded to the printed digits or cut off after them, is the printed number: its
///     magnitude is at most half a unit of the last digit less and one unit more;
///   - "3 units": by three units of the last digit, to either side;
///   - a number: relative; "factor 5"; "order of magnitude": a factor of sqrt(10), of what is printed as a
///     power of ten;
///   - "at least 100" and "below 1e-15", of ours alone.
class Tolerance {
 public:
  /// @param printed the number as printed, for its last digit
  /// @throws InputError if the words are not of these forms
  explicit Tolerance(std::string_view words, std::string_view printed = "1");
  /// Is @p ours as close to @p theirs as allowed? Never true for NaN.
  [[nodiscard]] bool allows(double ours, double theirs) const;
  /// The same for a range: true if it is for a number of the range.
  [[nodiscard]] bool allows(double ours, double low, double high) const;
  /// Does it bound ours and say nothing of its distance from theirs?
  [[nodiscard]] bool is_bound() const { return kind_ == Kind::at_least || kind_ == Kind::below; }

 private:
  enum class Kind { digits, absolute, relative, factor, at_least, below } kind_ = Kind::relative;
  double amount_ = 0;
};

/// One printed number. The columns of `tables/published/<source>.csv`, which its README explains.
struct PublishedValue {
  std::string source;    ///< name of the file: "elgohary"
  std::string place;     ///< "table-4.2"
  std::string row;       ///< the method or case, in the source's words
  std::string quantity;  ///< what is printed
  std::string printed;   ///< as printed
  double value = 0;      ///< the same as a number
  std::string unit;      ///< "1" if it has none
  std::string
      kind;  ///< "error", "rounding" (noise), "bound", "count", "time", "value", "claim" or "parameter"
  std::string nominal;   ///< what was found before from the text as it stands, number or words: "2.4e-11"
  std::string inferred;  ///< the same under a reading, in words: "1.1e-6..1.3e-6 with c = 2.5"
  Verdict expected = Verdict::not_stated;  ///< which verdict the findings support
  std::string tolerance;                   ///< see Tolerance
  std::string because;                     ///< why that tolerance; "digits" needs no reason
  int tried = 0;         ///< readings that were tried, where one is inferred or none was found
  std::string explains;  ///< "5 of 6": of the rows that such a reading bears on
  std::string erratum;   ///< id of the misprint that it is, if it is one
  std::string reading;   ///< how the text was understood, or the cause of a difference

  /// "elgohary/claim-2.4/order 4/height error, order of magnitude"
  [[nodiscard]] std::string name() const;
};

/// A figure, table, claim or equation of a source, and the chapter that owns it: a row of
/// `tables/places.csv`.
struct Place {
  std::string source;   ///< "elgohary"
  std::string name;     ///< "fig-2.23"
  std::string chapter;  ///< that owns it
  std::string kind;     ///< "figure", "table", "algorithm", "claim" or "equation"
  std::string subject;  ///< what it is about
  /// That show it: those of its own name, or where one source repeats another, the other's.
  std::vector<std::string> scenes;
};

/// All values of all files in `<data>/tables/published`, files in alphabetical order.
/// @throws InputError naming file, line and cell
[[nodiscard]] std::vector<PublishedValue> read_published(const std::filesystem::path& data_folder);

/// The values of one such file. @param source its name without the ending @param file what complaints call it
/// @throws InputError naming file, line and cell
[[nodiscard]] std::vector<PublishedValue> parse_published(std::string_view text, const std::string& source,
                                                          const std::string& file);

/// The rows of a list of places. @throws InputError naming file and line
[[nodiscard]] std::vector<Place> parse_places(std::string_view text, const std::string& file);

/// All rows of `<data>/tables/places.csv`. @throws InputError naming file and line
[[nodiscard]] std::vector<Place> read_places(const std::filesystem::path& data_folder);

/// The chapter that owns a published value. @throws InputError if `places.csv` does not list its place
[[nodiscard]] const std::string& owner(const PublishedValue& value, const std::vector<Place>& places);

/// What our own computation gives for a printed number under the nominal and under an inferred reading.
struct Measured {
  std::optional<double> nominal;   ///< from the text as it stands
  std::optional<double> inferred;  ///< under a reading that evidence points to
  std::string setting = {};        ///< of the runs behind both, in words; empty: the file's `reading` says it
};

/// A verdict, and whether it is the expected one.
struct Judgement {
  Verdict verdict = Verdict::not_stated;  ///< by the evidence
  bool passes = false;                    ///< is it the expected one?
};

/// Judges by the evidence: the expected verdict if @p measured supports it, else the verdict that it does
/// support.
///  - `reproduced` needs the nominal number within the tolerance of the printed one, and a number that means
///    something: no rounding noise and no bound;
///  - `reproduced, inferred reading` needs the same of the inferred number;
///  - `same rounding level` needs noise by name (kind "rounding"), and the nominal or the inferred number
///    within a factor of the printed one or both below a bound;
///  - `better` needs a bound or noise by name, and a nominal number smaller than the printed one and within
///  the
///    tolerance of `nominal`;
///  - `differs` needs a number outside the tolerance of the printed one, and within it, or 5 %, of what the
///    file has found before; the inferred number counts where there is no nominal one;
///  - `holds` and `does not hold` need a claim by name, and the nominal number within its tolerance or
///  outside;
///  - `input` needs the printed number itself.
/// `context` and `not stated` judge nothing.
[[nodiscard]] Judgement judge(const PublishedValue& value, const Measured& measured);

/// All numbers that the sources print.
class Printed {
 public:
  /// Reads them. @throws InputError naming file, line and cell
  Printed();
  /// @param name as PublishedValue::name() @throws std::logic_error if no source prints it
  [[nodiscard]] double operator[](const std::string& name) const;

 private:
  std::map<std::string, double> values_;
};

}  // namespace nlmech::scene
