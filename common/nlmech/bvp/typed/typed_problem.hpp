/// @file
/// Boundary value problem from equations, conditions and a guess as text.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "nlmech/bvp/problem.hpp"
#include "nlmech/bvp/solution.hpp"
#include "nlmech/bvp/typed/conditions.hpp"
#include "nlmech/program/equations.hpp"
#include "nlmech/program/program.hpp"

namespace nlmech::bvp {

/// A boundary value problem as text.
struct ProblemText {
  std::string name;                 ///< of the equations in messages: "--equation", "column.ode"
  std::string equations;            ///< equations, definitions and conditions
  program::Settings settings = {};  ///< values of definitions
  std::string conditions = {};      ///< further conditions
  std::string unknowns = {};        ///< names of unknown constants, separated by commas
  /// One more unknown constant, the last; a definition of it in the equations is left out.
  std::string parameter = {};
  std::string from = {};  ///< start of the interval, a number; empty: the first time of a condition
  /// End of the interval: a number, an unknown constant, or `inf`; empty: the last time of a condition.
  std::string until = {};
};

/// Boundary value problem of Equations, with conditions (see Conditions) on values at any times of its
/// interval, on integrals and on unknown constants. All derivatives are exact, by dual numbers.
///
/// The components of the equations become the states, except that a component k with k' = 0 is a parameter,
/// unless there are no others. An integral is a further state. The points are the ends of the interval, the
/// times in the conditions, and known times at which the equations jump, if these are at most `most_jumps`.
///
/// Time s of the problem is the time t of the equations, except
///  - with an unknown end T: after the last known point t_l, t = t_l + (T - t_l) (s - t_l) / (T_0 - t_l),
///  with
///    the guess T_0 of T;
///  - at ends t_e of a known interval where the equations are singular: |t - t_e| grows like (s - t_e)^2,
///  which
///    makes solutions smooth that are series in the square root of t - t_e.
class TypedProblem final : public Problem {
 public:
  /// Largest number of jumps that are points; each adds one condition per state.
  static constexpr std::size_t most_jumps = 200;

  /// Interval as typed; see ProblemText.
  struct Interval {
    std::string from;   ///< start
    std::string until;  ///< end
  };

  /// @param equations unknown constants are components k with k' = 0
  /// @param guess initial guess as functions of time, separated by commas: "x = sin(pi t), k = 10"; missing
  ///   x', x'', ... are derivatives of a given x, other missing components are 0, and a missing unknown end
  ///   is the last known point + 1
  /// @throws InputError naming the option and what is wrong, for text that cannot be read, too many or too
  /// few
  ///   conditions, and times outside the interval
  TypedProblem(program::Equations equations, const std::vector<ConditionText>& conditions,
               const Interval& interval, const std::string& guess = {});

  /// Names of the components: "x", "k", "x'".
  [[nodiscard]] const std::vector<std::string>& names() const { return equations_.state_names(); }
  /// The equations.
  [[nodiscard]] const program::Equations& equations() const { return equations_; }
  /// The initial guess.
  [[nodiscard]] Start guess() const;
  /// Guess that is linear between rows of values.
  /// @param times ascending times of the equations, two or more
  /// @param values one row for each component of the equations, one column for each time
  [[nodiscard]] Start guess_from(const std::vector<double>& times, const Eigen::MatrixXd& values) const;
  /// Does the guess give a state, and not only constants?
  [[nodiscard]] bool has_guess_of_states() const;
  /// Random cubics of @p size for the states, and random numbers up to @p size for parameters without a
  /// guess.
  [[nodiscard]] Start random_guess(double size, unsigned seed) const;
  /// First mesh with points where functions of time start to change, as pulses do; empty if there are none.
  [[nodiscard]] std::vector<double> mesh() const;

  /// Is the end infinite? Then the interval ends at points().back(), and conditions at infinity hold there.
  [[nodiscard]] bool is_infinite() const { return is_infinite_; }
  /// Sets the end of an infinite interval, later than all other points.
  void truncate(double end) { points_.back() = end; }
  /// Time of the problem after which functions of time alone rest or change slowly, as after the last pulse:
  /// searched up to 1e6 after the start.
  [[nodiscard]] double last_pulse() const;
  /// Components with a condition on their value at infinity.
  [[nodiscard]] std::vector<int> components_at_infinity() const;
  /// Index of the parameter that is the end of the interval; none if the end is known.
  [[nodiscard]] std::optional<int> end_parameter() const;
  /// Index of the parameter that component @p i of the equations is; none for a state.
  [[nodiscard]] std::optional<int> parameter_of(int i) const;

  /// Time of the equations at the time @p s of the problem.
  [[nodiscard]] double time(double s, const Eigen::VectorXd& p) const;
  /// Derivative of time() by @p s.
  [[nodiscard]] double rate(double s, const Eigen::VectorXd& p) const;
  /// Time of the problem at the time @p t of the equations.
  [[nodiscard]] double place(double t, const Eigen::VectorXd& p) const;
  /// All components of the equations from states and parameters.
  [[nodiscard]] Eigen::VectorXd components(const Eigen::VectorXd& x, const Eigen::VectorXd& p) const;
  /// All components of a solution at the time @p t of the equations.
  [[nodiscard]] Eigen::VectorXd components_at(const Solution& solution, double t) const;

  /// See Problem.
  [[nodiscard]] int states() const override { return static_cast<int>(slopes_.outputs()); }
  /// See Problem.
  [[nodiscard]] int parameters() const override { return static_cast<int>(parameters_.size()); }
  /// See Problem.
  [[nodiscard]] std::vector<double> points() const override { return points_; }
  /// See Problem.
  [[nodiscard]] bool is_singular_at_ends() const override { return is_singular_; }
  /// Name of a component, or "integral 1".
  [[nodiscard]] std::string unknown_name(int i) const override;
  /// See Problem.
  void rhs(double s, const Eigen::VectorXd& x, const Eigen::VectorXd& p,
           Eigen::VectorXd& dxds) const override;
  /// See Problem.
  void jacobian(double s, const Eigen::VectorXd& x, const Eigen::VectorXd& p, Eigen::MatrixXd& by_state,
                Eigen::MatrixXd& by_parameter) const override;
  /// See Problem.
  void conditions(const Eigen::MatrixXd& ends, const Eigen::VectorXd& p, Eigen::VectorXd& r) const override;
  /// See Problem.
  void condition_jacobian(const Eigen::MatrixXd& ends, const Eigen::VectorXd& p, Eigen::MatrixXd& by_ends,
                          Eigen::MatrixXd& by_parameter) const override;

 private:
  struct Component {
    bool is_parameter;
    int index;
  };
  /// The components of the equations, read from states and parameters.
  struct Components {
    const std::vector<Component>& places;
    const Eigen::VectorXd &x, &p;

    [[nodiscard]] double operator[](int i) const {
      const Component& c = places[static_cast<std::size_t>(i)];
      return c.is_parameter ? p[c.index] : x[c.index];
    }
  };
  /// A value in the conditions: its point, and the column of its state among the ends of the phases.
  struct Value {
    program::Program what;
    std::size_t point;
    Eigen::Index column;
  };
  void divide_components();
  void set_points(const Interval& interval);
  void place_values();
  void find_singular_ends();
  void map_singular_ends();
  void read_guess(const std::string& text);
  /// Slopes of the equations, then integrands.
  [[nodiscard]] std::vector<program::NodeId> integrated() const;
  [[nodiscard]] std::string unknown_end(const std::string& until) const;
  [[nodiscard]] Eigen::VectorXd arguments(const Eigen::MatrixXd& ends, const Eigen::VectorXd& p) const;

  program::Equations equations_;
  Conditions conditions_;
  std::vector<Component> components_;
  std::vector<int> states_, parameters_;  // components of the equations
  std::vector<double> points_;            // in the time of the problem
  std::vector<Value> values_;
  std::vector<std::optional<program::Program>> guess_;  // by component
  program::Program slopes_;                             // states, then integrals
  int end_ = -1;                                        // parameter that is the end
  bool is_infinite_ = false, is_singular_ = false;
  bool maps_start_ = false, maps_end_ = false;  // ends at which t is quadratic in s
  double from_ = 0, until_ = 1;                 // of t, if an end is mapped; until_ = from_ + 1 if infinite
};

/// Reads a problem. @param guess see TypedProblem
/// @throws InputError as TypedProblem, and for an unknown constant that the equations define too
[[nodiscard]] TypedProblem read_problem(const ProblemText& text, const std::string& guess = {});

}  // namespace nlmech::bvp
