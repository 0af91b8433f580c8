/// @file
/// Optimal control problem given as text.
#pragma once

#include <string>
#include <vector>

#include "nlmech/bvp/optimal_control/solve_control.hpp"
#include "nlmech/bvp/typed/conditions.hpp"
#include "nlmech/program/equations.hpp"

namespace nlmech::bvp {

/// Texts of an optimal control problem. Messages name the options of `rbf_inverse control`.
struct ControlText {
  std::string name = "--equation";    ///< of the equations in messages: "--equation", or a file
  std::string equations;              ///< equations of motion, definitions, and also conditions
  program::Settings settings = {};    ///< values of definitions
  std::vector<std::string> controls;  ///< names of the controls
  std::string minimise;               ///< cost: "integral(u^2/2) + x(2)^2"
  std::string conditions = {};        ///< "x(0) = 0; x(T) = 1"
  std::string bounds = {};            ///< bounds of controls: "-1 <= u <= 1"
  std::string state_bounds = {};      ///< bounds of states: "x <= 1.2; x + y <= 2"
  std::string from = {};  ///< start of the interval, a number; empty: the first time of a condition
  /// End of the interval: a number; a name that nothing defines, for a free end; empty: the last time of a
  /// condition.
  std::string until = {};
};

/// Optimal control problem made from texts. With a free end T the time of the problem is (t - from)/(T -
/// from), and its last state is log(T - from).
class TypedControl {
 public:
  /// @throws InputError that points at the mistake
  explicit TypedControl(const ControlText& text);

  /// The problem.
  [[nodiscard]] const ControlProblem& problem() const { return problem_; }
  /// Names of the states, without a free end: "x", "x'".
  [[nodiscard]] const std::vector<std::string>& state_names() const { return state_names_; }
  /// Names of the controls.
  [[nodiscard]] const std::vector<std::string>& control_names() const { return text_.controls; }
  /// Is the end free?
  [[nodiscard]] bool has_free_end() const { return !end_name_.empty(); }
  /// Name of the free end; empty if the end is known.
  [[nodiscard]] const std::string& end_name() const { return end_name_; }
  /// Texts of the conditions, in the order of their multipliers.
  [[nodiscard]] const std::vector<std::string>& condition_texts() const { return condition_texts_; }
  /// Texts of the bounds on states, in the order of the problem.
  [[nodiscard]] const std::vector<std::string>& bound_texts() const { return bound_texts_; }
  /// Time and its rate by the time @p s of the problem, for the states @p x.
  [[nodiscard]] std::pair<double, double> true_time(double s, const Eigen::VectorXd& x) const;
  /// Initial values and controls to start from. @param guess functions of t for controls, values at the start
  /// for states, the value of a free end (default: several): "u = sin(t), x = 1, T = 3". Without a control:
  /// control_guesses(). @throws InputError naming `--guess`
  [[nodiscard]] std::vector<ControlGuess> guesses(const std::string& guess) const;

 private:
  /// An integral in the cost, and its factor.
  struct Integral {
    double factor;
    program::NodeId integrand;
  };
  [[nodiscard]] std::vector<program::NodeId> read_bounds();
  void check_controls() const;
  void refuse_switches(const std::vector<program::NodeId>& ids) const;
  void set_interval(const Conditions& read);
  [[nodiscard]] std::vector<Integral> read_ends(const std::vector<ConditionText>& conditions);
  [[nodiscard]] std::vector<Integral> read_cost(const Conditions& read,
                                                const std::vector<program::NodeId>& arguments);
  [[nodiscard]] std::vector<program::NodeId> point_variables(int point);
  void set_expressions(const std::vector<program::NodeId>& state_bounds,
                       const std::vector<Integral>& integrals);

  ControlText text_;
  std::string end_name_;  // of a free end, or empty
  program::Equations equations_;
  ControlProblem problem_;
  std::vector<std::string> state_names_, condition_texts_, bound_texts_;
  std::vector<int> states_, controls_;  // components of the equations
  int end_component_ = -1;              // of the equations
  double from_ = 0, until_ = 1;
};

}  // namespace nlmech::bvp
