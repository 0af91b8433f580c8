/// @file
/// What methods came to on a problem, and how much of it each gives for how little time.
#pragma once

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

}  // namespace nlmech::scene
