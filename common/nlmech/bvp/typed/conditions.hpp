/// @file
/// Boundary conditions as text: equations between values of the solution at points, integrals and constants.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "nlmech/program/equations.hpp"
#include "nlmech/program/program.hpp"

namespace nlmech::bvp {

/// One condition as text, "x(0) = x(1)", with the name of its option or file for messages.
struct ConditionText {
  std::string name;  ///< "--conditions"
  std::string text;  ///< one equation
};

/// Names between commas, semicolons and blanks in the text of an option.
/// @throws InputError naming @p option for what is no name, or that of a function or the time
[[nodiscard]] std::vector<std::string> names_in(const std::string& option, const std::string& text);

/// The name of a free end of the interval: @p until if it is a name that neither the equations nor the
/// settings define, and not "inf" or "pi"; else empty.
/// @throws InputError for the name of a function or the time
[[nodiscard]] std::string free_end_name(const std::string& equations, const program::Settings& settings,
                                        const std::string& until);

/// Divides the text of an option into conditions, at semicolons, at line ends and at commas outside brackets.
[[nodiscard]] std::vector<ConditionText> conditions_of(const std::string& name, const std::string& text);

/// A text of equations and conditions, divided.
struct DividedText {
  std::string equations;                  ///< the text with blanks in place of the conditions
  std::vector<ConditionText> conditions;  ///< the conditions in it
};

/// Does @p name stand in a text of equations or conditions?
[[nodiscard]] bool mentions(const std::string& text, const std::string& name);

/// Takes the conditions out of a text of equations. A condition is an equation with a value, x'(0), or an
/// integral, integral(x^2), and without a derivative for all times, x'. `r = x(1 + a)` is a definition, with
/// a product, unless r is an unknown.
/// @param constants names of unknown constants that are declared outside the text
/// @param parameter one of them, whose definition in the text is blanked; empty: none
[[nodiscard]] DividedText divide(const std::string& name, const std::string& text,
                                 const std::vector<std::string>& constants,
                                 const std::string& parameter = {});

/// Equations of a divided text, to which declarations may have been added. @param text before the division
/// @throws InputError that quotes the text before the division
[[nodiscard]] program::Equations equations_of(const std::string& name, const std::string& text,
                                              const DividedText& divided, const program::Settings& settings);

/// Derivatives of the outputs of a program by each component of the state and, with @p with_time, by the time
/// as component x.size(). Calls put(output, component, value).
void differentiate(const program::Program& program, double t, const Eigen::VectorXd& x, bool with_time,
                   const std::function<void(int output, int component, double value)>& put);

/// Conditions of a boundary value problem. In them stand
///  - x(0.3), x'(0), x''(1): values of components, of highest derivatives and of definitions at a time, which
///    is an expression of numbers or the name of the end of the interval;
///  - integral(x^2): an integral over the whole interval;
///  - the names of unknown constants: components k of equations k' = 0.
/// These are the arguments of the residuals, in this order.
class Conditions {
 public:
  /// A value of the solution in the conditions.
  struct Value {
    program::NodeId what;  ///< expression of time and state, in the graph of the equations
    double time;           ///< time of the value; infinity: the end of the interval, by its name
  };

  /// @param equations receives the expressions of values and integrals
  /// @param texts the conditions
  /// @param end_name name of the end of the interval: of an unknown constant, or "inf"; may be empty
  /// @throws InputError with the position of the mistake
  Conditions(program::Equations& equations, const std::vector<ConditionText>& texts,
             const std::string& end_name);

  /// Number of conditions.
  [[nodiscard]] int count() const { return static_cast<int>(residuals_.outputs()); }
  /// The values of the solution.
  [[nodiscard]] const std::vector<Value>& values() const { return values_; }
  /// The integrands of the integrals, in the graph of the equations.
  [[nodiscard]] const std::vector<program::NodeId>& integrands() const { return integrands_; }
  /// The components of the equations that are unknown constants.
  [[nodiscard]] const std::vector<int>& constants() const { return constants_; }
  /// Number of arguments of the residuals: values, integrals and constants.
  [[nodiscard]] int arguments() const {
    return static_cast<int>(values_.size() + integrands_.size() + constants_.size());
  }
  /// The residuals, left side minus right side, as a program whose state is the arguments.
  [[nodiscard]] const program::Program& residuals() const { return residuals_; }
  /// The residuals as nodes of residual_graph().
  [[nodiscard]] const std::vector<program::NodeId>& residual_nodes() const { return residual_nodes_; }
  /// Expressions of the arguments.
  [[nodiscard]] const program::Graph& residual_graph() const { return residual_graph_; }

 private:
  class Reader;
  std::vector<Value> values_;
  std::vector<program::NodeId> integrands_;
  std::vector<int> constants_;
  program::Graph residual_graph_{0};
  std::vector<program::NodeId> residual_nodes_;
  program::Program residuals_;
};

}  // namespace nlmech::bvp
