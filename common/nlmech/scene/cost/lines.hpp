/// @file
/// Runs of methods on a problem, and rankings by the time for a number of digits.
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

/// Run of a method at one setting.
struct Attempt {
  std::string setting;          ///< "tolerance 1e-06"
  std::string status;           ///< "success"
  std::optional<double> error;  ///< error; nothing if the run failed
  Timing time;                  ///< run time, s
  std::vector<Cell> work = {};  ///< cells of the columns WorkPrecision::work

  /// -log10 of the error, at most the digits of double; nothing without a finite error.
  [[nodiscard]] std::optional<double> digits() const;
};

/// Role of a method on a page, which foreground() uses to select the coloured curves.
enum class Side {
  library,  ///< another nlmech method
  subject,  ///< subject of the page: the source's method and the nlmech methods derived from it
  peer,     ///< method of another library
  floor     ///< lower limit of the cost, or a solution in closed form; does not compete
};

/// Methods of one kind.
struct MethodGroup {
  std::string name;    ///< "Taylor series"
  std::size_t colour;  ///< index of method_styles for its best method, the same in all figures
};

/// Runs of a method at its settings.
struct MethodLine {
  std::string method;             ///< "ode45"; a variant follows after a comma: "rbf-coll, N = 35"
  std::size_t group;              ///< index of WorkPrecision::groups
  std::vector<Attempt> attempts;  ///< runs, cheapest first; empty: method not in this build
  Side side = Side::library;      ///< role of the method

  /// The smallest error; infinite if all runs failed.
  [[nodiscard]] double least_error() const;
  /// The run with the smallest error; null if all failed.
  [[nodiscard]] const Attempt* best() const;
  /// The method without its variant: "rbf-coll".
  [[nodiscard]] std::string family() const { return method.substr(0, method.find(',')); }
};

/// The methods on one problem.
struct ProblemLines {
  std::string problem;            ///< caption of the panel; empty for a single problem
  std::vector<MethodLine> lines;  ///< the same methods for each problem, in the same order

  /// The line of a method. @throws std::out_of_range naming the method if there is none
  [[nodiscard]] const MethodLine& of(const std::string& method) const;
};

/// Pareto front of a method: least time for at least a number of digits, with the logarithm of the time
/// interpolated linearly between the runs.
class Front {
 public:
  /// Uses the runs with digits and a positive time.
  explicit Front(const MethodLine& line);

  /// Least time in s for @p digits; nothing if no run has so many. It is at least the time of the cheapest
  /// run.
  [[nodiscard]] std::optional<double> time(double digits) const;

 private:
  std::vector<std::pair<double, double>> runs_;  // digits and seconds, both rising
};

/// Digits at which work-precision diagrams compare the methods.
inline constexpr std::array asked_digits = {3.0, 6.0, 9.0, 12.0};

/// The fastest methods at a number of digits, by their Front. Of equal times the first line counts.
struct Ranking {
  double digits;                     ///< number of digits
  std::optional<std::size_t> first;  ///< index of the fastest line; nothing: no line has so many digits
  std::optional<std::size_t>
      next;           ///< index of the fastest line of another family; nothing: none has the digits
  double time = 0;    ///< time of the first, s
  double factor = 0;  ///< time of the next over that of the first; 0: no next

  /// "2.1 times as fast as ode45"; "as fast as ode45" up to 5 %; "alone"; "no method" without a first
  [[nodiscard]] std::string margin(const ProblemLines& problem) const;
};

/// Rankings at asked_digits of all lines except Side::floor.
[[nodiscard]] std::vector<Ranking> rankings_of(const ProblemLines& problem);

/// "series is fastest at 3, 6 and 9 digits"; "ode45 is fastest at 3, series at 6 and 9 digits"; "no method
/// has three digits".
[[nodiscard]] std::string fastest_by_digits(const ProblemLines& problem);

/// Colour and symbol of a coloured method.
struct MethodStyle {
  const char* colour;  ///< "#D55E00"
  int symbol;          ///< gnuplot's point type
};

/// The eight colours of Okabe and Ito, with the yellow darkened for white paper, each with its own symbol.
inline constexpr std::array method_styles = {MethodStyle{"#000000", 7},  MethodStyle{"#D55E00", 13},
                                             MethodStyle{"#0072B2", 5},  MethodStyle{"#009E73", 9},
                                             MethodStyle{"#CC79A7", 11}, MethodStyle{"#E69F00", 15},
                                             MethodStyle{"#56B4E9", 6},  MethodStyle{"#8F7F00", 4}};

/// A coloured line.
struct InColour {
  std::size_t line;    ///< index of the line
  std::size_t colour;  ///< index of method_styles
};

/// Selects the coloured lines, the most important ones first: all lines if method_styles suffice; else the
/// best line of each group of subjects, floors and peers, then the fastest lines at asked_digits, then nlmech
/// methods that are the fastest nlmech method at some digits. The best line of a group is the fastest at most
/// digits, or else has the smallest error. The first line of a group has the group's colour if it is free.
/// @param problems problems, which count together
/// @param least least number of digits that counts, the low end of the ordinate
[[nodiscard]] std::vector<InColour> foreground(const std::vector<MethodGroup>& groups,
                                               const std::vector<ProblemLines>& problems, double least = 0);

}  // namespace nlmech::scene
