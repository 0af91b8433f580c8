/// @file
/// Typed and recorded equations as a problem for all methods.
#pragma once

#include <algorithm>
#include <memory>
#include <span>
#include <type_traits>
#include <vector>

#include "nlmech/program/dual.hpp"
#include "nlmech/program/equations.hpp"
#include "nlmech/program/linear_terms.hpp"
#include "nlmech/program/program.hpp"
#include "nlmech/program/repeated_program.hpp"
#include "nlmech/program/switches.hpp"
#include "nlmech/program/time_features.hpp"
#include "nlmech/program/vector.hpp"

namespace nlmech::program {

/// The right-hand side of equations for every number type: a problem for ivp::System and ivp::Direct. Copies
/// share the program.
class Problem {
 public:
  static constexpr int dimension = Eigen::Dynamic;  ///< components of the state: size()

  /// Problem of @p equations.
  explicit Problem(const Equations& equations)
      : Problem(equations.graph(), equations.slopes(), equations.layout()) {
    stated_ = std::make_shared<const Stated>(equations);
  }
  /// Problem of the derivatives @p slopes, nodes of @p graph, of a state with @p layout: for instance a
  /// recording's, or variational_equations().
  Problem(const Graph& graph, const std::vector<NodeId>& slopes, const VariationalLayout& layout)
      : program_(std::make_shared<const RepeatedProgram>(graph, slopes)),
        switches_(std::make_shared<const Switches>(graph, slopes)),
        features_(std::make_shared<const TimeFeatures>(graph, slopes)),
        stated_(std::make_shared<const Stated>()),
        linear_(std::make_shared<const LinearTerms>(program::linear_terms(graph, slopes))),
        layout_(layout),
        size_(graph.size()),
        smooth_(switches_->count() == 0) {}

  /// The same problem with the derivatives @p slopes, nodes of @p graph.
  [[nodiscard]] Problem with_slopes(const Graph& graph, const std::vector<NodeId>& slopes) const {
    Problem other = *this;
    other.program_ = std::make_shared<const RepeatedProgram>(graph, slopes);
    other.switches_ = std::make_shared<const Switches>(graph, slopes);
    other.linear_ = std::make_shared<const LinearTerms>(program::linear_terms(graph, slopes));
    other.smooth_ = other.switches_->count() == 0;
    return other;
  }

  /// Components of the state.
  [[nodiscard]] int size() const { return size_; }
  /// Is every unknown of second order?
  [[nodiscard]] bool second_order() const { return layout_.second_order; }
  /// Places of the unknowns and of their sensitivities, if there are any, in the state.
  [[nodiscard]] const VariationalLayout& layout() const { return layout_; }

  /// The times between @p t0 and @p t1, in the direction of integration, at which the equations change or at
  /// which a step must end (TimeFeatures).
  [[nodiscard]] std::vector<double> discontinuities(double t0, double t1) const {
    std::vector<double> between = features_->between(std::min(t0, t1), std::max(t0, t1));
    const std::vector<double> switches = switches_->times(std::min(t0, t1), std::max(t0, t1));
    between.insert(between.end(), switches.begin(), switches.end());
    std::ranges::sort(between);
    between.erase(std::unique(between.begin(), between.end()), between.end());
    if (t1 < t0) std::reverse(between.begin(), between.end());
    return between;
  }
  /// Can the times of discontinuities() differ by rounding in other precisions?
  [[nodiscard]] bool has_rounded_times() const { return switches_->has_rounded_times(); }
  /// Number of switching functions, whose cells select the equations; 0 within a mode.
  [[nodiscard]] int switches() const { return smooth_ ? 0 : switches_->count(); }
  /// Does switching function @p i switch at every integer? Others switch at zero.
  [[nodiscard]] bool is_rounded(int i) const { return switches_->is_rounded(static_cast<std::size_t>(i)); }
  /// The smooth equations of a mode. They have no bounds and invariants: steps may continue beyond the
  /// switch.
  [[nodiscard]] Problem in_mode(const Mode& mode) const {
    Problem smooth = *this;
    smooth.program_ = switches_->in_mode(mode);
    smooth.stated_ = std::make_shared<const Stated>();
    smooth.smooth_ = true;
    return smooth;
  }
  /// Within a mode: the switching functions, or on a surface the share of its upper side, and the derivatives
  /// of the functions along a solution.
  void surfaces(double t, const Vector<double, Eigen::Dynamic>& x, std::span<double> values,
                std::span<double> rates) const {
    const auto size = static_cast<std::size_t>(size_), count = values.size();
    program_->run(t, x, size, size + 2 * count, [&](int i, double value) {
      const auto k = static_cast<std::size_t>(i);
      (k < count ? values[k] : rates[k - count]) = value;
    });
  }

  /// Within a mode: the derivatives of the switching functions along a direction of the state.
  void surfaces_along(double t, const Vector<double, Eigen::Dynamic>& x,
                      const Vector<double, Eigen::Dynamic>& direction, std::span<double> derivatives) const {
    using D = Dual<double, 1>;
    Vector<D, Eigen::Dynamic> at(size_);
    for (int i = 0; i < size_; ++i) {
      at[i] = D(x[i]);
      at[i].partial[0] = direction[i];
    }
    const auto size = static_cast<std::size_t>(size_);
    program_->run(D(t), at, size, size + derivatives.size(), [&](int i, const D& value) {
      derivatives[static_cast<std::size_t>(i)] = value.partial[0];
    });
  }

  /// The conserved quantities of the text; empty without any.
  template <class T>
  [[nodiscard]] Vector<T, Eigen::Dynamic> invariants(const T& t, const Vector<T, Eigen::Dynamic>& x) const {
    const std::size_t count = stated_->conserved.outputs();
    Vector<T, Eigen::Dynamic> values(static_cast<Eigen::Index>(count));
    stated_->conserved.run(t, x, 0, count, [&](int i, const T& value) { values[i] = value; });
    return values;
  }
  /// The bounds of each component at later times. @return false, with nothing written, if the text gives none
  [[nodiscard]] bool bounds(Vector<double, Eigen::Dynamic>& lower,
                            Vector<double, Eigen::Dynamic>& upper) const {
    if (stated_->lower.empty()) return false;
    lower = Eigen::Map<const Eigen::VectorXd>(stated_->lower.data(), size_);
    upper = Eigen::Map<const Eigen::VectorXd>(stated_->upper.data(), size_);
    return true;
  }

  /// The linear terms with constant coefficients, and the harmonic loads.
  [[nodiscard]] const LinearTerms& linear_terms() const { return *linear_; }

  /// Machine code for the tapes of these equations, which copies and modes share.
  [[nodiscard]] std::shared_ptr<machine_code::SeriesCodes> series_codes() const { return series_codes_; }

  /// dx/dt.
  template <class T>
  void operator()(const T& t, const Vector<T, Eigen::Dynamic>& x, Vector<T, Eigen::Dynamic>& dxdt) const {
    if constexpr (std::is_same_v<T, double>)
      program_->slopes(t, x, dxdt);
    else
      program_->run(t, x, 0, static_cast<std::size_t>(size_),
                    [&](int i, const T& value) { dxdt[i] = value; });
  }
  /// The accelerations of second-order equations at positions @p q and velocities @p v.
  template <class T, int m>
  void acceleration(const T& t, const Vector<T, m>& q, const Vector<T, m>& v, Vector<T, m>& a) const {
    if constexpr (std::is_same_v<T, double>) return program_->accelerations(t, q, v, a);
    const int half = size_ / 2;
    const auto state = [&](int i) -> const T& { return i < half ? q[i] : v[i - half]; };
    program_->run(t, Halves<decltype(state)>{state}, static_cast<std::size_t>(half),
                  static_cast<std::size_t>(size_), [&](int i, const T& value) { a[i] = value; });
  }

 private:
  /// Positions and velocities as one state.
  template <class Get>
  struct Halves {
    const Get& get;
    decltype(auto) operator[](int i) const { return get(i); }
  };

  /// Conserved quantities and bounds of the text.
  struct Stated {
    Stated() = default;
    explicit Stated(const Equations& equations)
        : conserved(equations.graph(), equations.conserved()),
          lower(equations.lower_bounds()),
          upper(equations.upper_bounds()) {}
    Program conserved;
    std::vector<double> lower, upper;
  };

  std::shared_ptr<const RepeatedProgram> program_;
  std::shared_ptr<const Switches> switches_;
  std::shared_ptr<const TimeFeatures> features_;
  std::shared_ptr<const Stated> stated_;
  std::shared_ptr<const LinearTerms> linear_;
  std::shared_ptr<machine_code::SeriesCodes> series_codes_ = std::make_shared<machine_code::SeriesCodes>();
  VariationalLayout layout_;
  int size_;
  bool smooth_;
};

}  // namespace nlmech::program
