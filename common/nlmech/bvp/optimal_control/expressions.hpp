/// @file
/// Expressions of a graph with their derivatives, exact by dual numbers.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <vector>

#include "nlmech/program/dual.hpp"
#include "nlmech/program/program.hpp"

namespace nlmech::bvp {

/// Values and derivatives of nodes of a graph at a time and a state.
class Expressions {
 public:
  /// No expressions.
  Expressions() = default;
  /// @param nodes expressions of @p graph
  Expressions(const program::Graph& graph, const std::vector<program::NodeId>& nodes)
      : program_(graph, nodes) {}

  /// Number of expressions.
  [[nodiscard]] Eigen::Index count() const { return static_cast<Eigen::Index>(program_.outputs()); }
  /// The values at time @p t and state @p x.
  [[nodiscard]] Eigen::VectorXd values(double t, const Eigen::VectorXd& x) const {
    Eigen::VectorXd result(count());
    program_.run(t, x, 0, program_.outputs(), [&](int i, double value) { result[i] = value; });
    return result;
  }
  /// Sets the values, and the derivatives by time (column 0) and by each component of the state (the columns
  /// after it).
  void differentiate(double t, const Eigen::VectorXd& x, Eigen::VectorXd& values, Eigen::MatrixXd& by) const {
    constexpr int lanes = 4;
    using D = Dual<double, lanes>;
    const int inputs = static_cast<int>(x.size()) + 1;
    values.resize(count());
    by.resize(count(), inputs);
    Vector<D, Eigen::Dynamic> at(x.size());
    for (int first = 0; first < inputs; first += lanes) {
      const auto seed = [first](double value, int index) {
        const int lane = index - first;
        return lane >= 0 && lane < lanes ? D::variable(value, lane) : D(value);
      };
      for (int i = 1; i < inputs; ++i) at[i - 1] = seed(x[i - 1], i);
      program_.run(seed(t, 0), at, 0, program_.outputs(), [&](int output, const D& value) {
        values[output] = value.value;
        for (int lane = 0; lane < std::min(lanes, inputs - first); ++lane)
          by(output, first + lane) = value.partial[static_cast<std::size_t>(lane)];
      });
    }
  }

 private:
  program::Program program_;
};

}  // namespace nlmech::bvp
