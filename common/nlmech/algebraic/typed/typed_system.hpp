/// @file
/// Typed equations F(x) = 0: unknowns, bounds, values, exact derivatives, and enclosures over boxes.
#pragma once

#include <Eigen/Core>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "nlmech/program/equations.hpp"
#include "nlmech/program/program.hpp"

namespace nlmech::algebraic {

/// An interval for each unknown.
using Box = std::vector<program::Interval>;

/// First and last value of names.
using NamedRanges = std::map<std::string, std::pair<double, double>>;

/// Reads "x = -5:5, y = 0:2 pi". @throws InputError that names @p option for a range that is not written so
/// or has a limit that is not finite
[[nodiscard]] NamedRanges read_ranges(const std::string& option, const std::string& text);

/// Names on the left sides of "x=1, y=-1". @throws InputError with the position of a mistake
[[nodiscard]] std::set<std::string> assigned_names(const std::string& option, const std::string& text);

/// What is given beside a text of equations.
struct SystemInput {
  program::Settings settings = {};      ///< `--set a=2`: replace definitions or give names a value
  std::set<std::string> unknowns = {};  ///< names that are unknowns although the text has `name = ...`
  std::string parameter = {};           ///< name of a parameter that varies; empty: none
};

/// n equations F(x) = 0 for n unknowns, as a user types them: "x^2 + y^2 = 4; exp(x) + y = r; r = 1".
///
/// `name = expression` defines the name, unless it is given as an unknown, has a start value in the text, or
/// depends on itself (`x = cos(x)`); every other statement with = is an equation. The names that nothing
/// defines are the unknowns, in the order of the text. `x(0) = 1` is a start value, `x >= 0` a bound. A text
/// without equations that defines `energy` means its stationary points: F is the gradient, dF/dx the Hessian.
///
/// Derivatives are exact to rounding: they are formed from the expressions.
class TypedSystem {
 public:
  /// @throws InputError with the position of a mistake, for numbers of equations and unknowns that differ,
  /// and for a setting or parameter that the text does not have
  explicit TypedSystem(program::SourceText source, const SystemInput& input = {});

  /// Number n of unknowns.
  [[nodiscard]] Eigen::Index size() const { return static_cast<Eigen::Index>(names_.size()); }
  /// The unknowns.
  [[nodiscard]] const std::vector<std::string>& names() const { return names_; }
  /// Is F the gradient of an energy?
  [[nodiscard]] bool has_energy() const { return has_energy_; }
  /// Adds bounds: "x >= 0; y < 2". @throws InputError with the position of a mistake
  void add_bounds(const std::string& option, const std::string& text);
  /// Start values of @p text, "x=1, y=-1", and of the equations, over which those of @p text take precedence.
  /// @throws InputError for a value that is missing, not a number, outside its bounds, or of no unknown
  [[nodiscard]] Eigen::VectorXd start(const std::string& option, const std::string& text) const;
  /// Lower bounds; -infinity: none.
  [[nodiscard]] const Eigen::VectorXd& lower() const { return lower_; }
  /// Upper bounds; infinity: none.
  [[nodiscard]] const Eigen::VectorXd& upper() const { return upper_; }
  /// Are all unknowns within their bounds?
  [[nodiscard]] bool contains(const Eigen::VectorXd& x) const {
    return (x.array() >= lower_.array()).all() && (x.array() <= upper_.array()).all();
  }

  /// f = F(x). With a parameter its value is component n of @p x. f is not finite where F does not exist.
  void residual(const Eigen::VectorXd& x, Eigen::VectorXd& f) const;
  /// j = dF/dx, and with a parameter the derivative by it as column n.
  void derivative(const Eigen::VectorXd& x, Eigen::MatrixXd& j) const;
  /// The energy. Call it only if there is one.
  [[nodiscard]] double energy(const Eigen::VectorXd& x) const;
  /// What is known of F in a box.
  enum class Domain {
    outside,  ///< F exists nowhere in the box
    rough,    ///< there may be a jump, a kink, or the end of the domain of a power
    smooth    ///< F is smooth wherever the enclosures of its derivatives are finite
  };
  /// Encloses all values of F over @p x, and all derivatives in @p j, row by row.
  Domain enclose(const Box& x, Box& f, Box& j) const;

 private:
  friend class SystemReader;
  /// Operands whose enclosures decide on the Domain of a box.
  struct Guard {
    program::Operation
        operation;       ///< choice, floor or atan2; another one has an operand that must be positive
    std::size_t output;  ///< index of the first operand among the outputs of all_
  };

  program::SourceText source_;
  std::vector<std::string> names_;
  std::map<std::string, double> starts_;
  program::Program values_, all_, energy_;
  std::vector<std::pair<int, int>> entries_;  // row and column of each output of all_ after the residuals
  std::vector<Guard> guards_;
  Eigen::VectorXd lower_, upper_;
  [[nodiscard]] Domain domain_of(const Guard& guard, const Box& outputs) const;

  int columns_ = 0;
  bool has_energy_ = false, has_choices_ = false;
};

}  // namespace nlmech::algebraic
