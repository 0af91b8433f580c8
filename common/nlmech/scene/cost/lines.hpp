/// @file
/// What methods came to on a problem, and how much of it each gives for how little time.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "nlmech/scene/table.hpp"
#include "nlmech/support/stopwatch.hpp"

namespace nlmech::scene {

/// What one setting of a method came to.
struct Attempt {
  std::string setting;          ///< "tolerance 1e-06"
  std::string status;           ///< "success"
  std::optional<double> error;  ///< nothing if it failed
  Timing time;                  ///< s
  std::vector<Cell> work = {};  ///< further columns: WorkPrecision::work

  /// -log10 of the error; a double has no digits below its rounding. Nothing if there is no finite error.
  [[nodiscard]] std::optional<double> digits() const;
};

/// What a method is to the page: it decides whether it is in colour, see foreground().
enum class Side {
  ours,     ///< of the suite
  subject,  ///< what the page is about: the source's method and what became of it
  peer,     ///< of another library
  floor     ///< no competitor: what no method can do without, or a solution in closed form
};

/// Methods of one kind.
struct MethodGroup {
  std::string name;    ///< "Taylor series"
  std::size_t colour;  ///< of its best method: an index of method_looks, so that it is the same everywhere
};

/// A method with what its settings came to.
struct MethodLine {
  std::string method;             ///< "ode45"; what follows a comma is its form: "rbf-coll, N = 35"
  std::size_t group;              ///< index of WorkPrecision::groups
  std::vector<Attempt> attempts;  ///< cheapest first; empty: not in this build
  Side side = Side::ours;         ///< whose it is

  /// The smallest error; infinite if all failed.
  [[nodiscard]] double least_error() const;
  /// The attempt with that error; null if all failed.
  [[nodiscard]] const Attempt* best() const;
  /// The method without its form: "rbf-coll".
  [[nodiscard]] std::string family() const { return method.substr(0, method.find(',')); }
};

/// The methods on one problem.
struct ProblemLines {
  std::string problem;            ///< above the panel; empty if it is the only one
  std::vector<MethodLine> lines;  ///< the same methods for each problem, in the same order

  /// The line of a method. @throws std::out_of_range naming the method, if there is none
  [[nodiscard]] const MethodLine& of(const std::string& method) const;
};

/// The least time for at least so many digits: through the runs that no other run of the line beats in both,
/// and between two of them straight in the logarithm of the time.
class Front {
 public:
  /// Of the runs that have digits and took time.
  explicit Front(const MethodLine& line);

  /// Seconds; nothing if no run has so many digits. Fewer than those of the cheapest run cost what it costs.
  [[nodiscard]] std::optional<double> time(double digits) const;

 private:
  std::vector<std::pair<double, double>> runs_;  // digits and seconds, both rising
};

/// Digits at which work-precision diagrams say who is fastest.
inline constexpr std::array asked_digits = {3.0, 6.0, 9.0, 12.0};

/// Who gives so many digits in the least time, see Front. Of equal times the first counts.
struct Ranking {
  double digits;                     ///< as asked
  std::optional<std::size_t> first;  ///< index of the fastest line; nothing: nobody has so many digits
  std::optional<std::size_t> next;   ///< of the fastest line of another family; nothing: no other arrives
  double time = 0;                   ///< s, of the first
  double factor = 0;                 ///< time of the next over that of the first; 0: there is none

  /// "2.1 times before ode45"; "level with ode45" up to 5 %; "alone"; "nobody" without a first
  [[nodiscard]] std::string margin(const ProblemLines& problem) const;
};

/// The lead at each of asked_digits, among all but Side::floor.
[[nodiscard]] std::vector<Ranking> rankings_of(const ProblemLines& problem);

/// "series is fastest at 3, 6 and 9 digits"; "ode45 is fastest at 3, series at 6 and 9 digits"; "no method
/// has three digits".
[[nodiscard]] std::string who_leads(const ProblemLines& problem);

/// How a method in colour is drawn.
struct MethodLook {
  const char* colour;  ///< "#D55E00"
  int symbol;          ///< gnuplot's point type
};

/// Okabe and Ito's eight colours, their yellow darkened for white paper, each with its own symbol.
inline constexpr std::array method_looks = {
    MethodLook{"#000000", 7},  MethodLook{"#D55E00", 13}, MethodLook{"#0072B2", 5}, MethodLook{"#009E73", 9},
    MethodLook{"#CC79A7", 11}, MethodLook{"#E69F00", 15}, MethodLook{"#56B4E9", 6}, MethodLook{"#8F7F00", 4}};

/// A line in colour.
struct InColour {
  std::size_t line;    ///< its index
  std::size_t colour;  ///< index of method_looks
};

/// The lines in colour, the most important ones first: all, if there are no more than looks; else at most so
/// many: of subjects, floors and peers the best of each group; who leads at asked_digits; then those that are
/// fastest of ours somewhere. The best of a group is fastest in it at most digits, or else comes closest; a
/// group's first has the group's colour if it is free.
/// @param problems several: what counts is all of them together
/// @param least digits that count, and what is below them not: where the ordinate begins
[[nodiscard]] std::vector<InColour> foreground(const std::vector<MethodGroup>& groups,
                                               const std::vector<ProblemLines>& problems, double least = 0);

}  // namespace nlmech::scene
