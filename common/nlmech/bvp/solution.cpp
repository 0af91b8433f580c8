#include "nlmech/bvp/solution.hpp"

#include <algorithm>

namespace nlmech::bvp {

using Eigen::Index;

Eigen::VectorXd Solution::at(double t, Side side) const {
  const auto& all = unknowns.intervals;
  const auto later = [side](double time, const Interval& i) {
    return side == Side::after ? time < i.t0 : time <= i.t0;
  };
  auto next = std::upper_bound(all.begin(), all.end(), t, later);
  if (next != all.begin()) --next;
  const double tau = std::clamp((t - next->t0) / next->h, 0.0, 1.0);
  if (tau == 0) return next->values.col(0);
  if (tau == 1) return next->values.rightCols(1);
  Eigen::RowVectorXd of_value, of_slope;
  scheme->row(tau, of_value, of_slope);
  return next->values * of_value.transpose() + next->h * (next->slopes * of_slope.transpose());
}

std::vector<double> Solution::mesh() const {
  std::vector<double> times;
  for (const Interval& interval : unknowns.intervals) times.push_back(interval.t0);
  times.push_back(end());
  return times;
}

std::vector<double> Solution::node_times() const {
  std::vector<double> times;
  for (const Interval& i : unknowns.intervals) {
    const Index first = times.empty() ? 0 : 1;
    for (Index j = first; j < scheme->nodes.size(); ++j) times.push_back(i.t0 + scheme->nodes[j] * i.h);
  }
  return times;
}

Eigen::MatrixXd Solution::node_values() const {
  const auto& all = unknowns.intervals;
  const Index nodes = scheme->nodes.size();
  Eigen::MatrixXd values(all.front().values.rows(), static_cast<Index>(all.size()) * (nodes - 1) + 1);
  values.col(0) = all.front().values.col(0);
  Index column = 1;
  for (const Interval& interval : all) {
    values.middleCols(column, nodes - 1) = interval.values.rightCols(nodes - 1);
    column += nodes - 1;
  }
  return values;
}

double Solution::integral(const std::function<double(double, const Eigen::VectorXd&)>& g) const {
  double sum = 0;
  for (const Interval& interval : unknowns.intervals) {
    for (Index j = 0; j < scheme->nodes.size(); ++j) {
      if (scheme->weights[j] == 0) continue;
      sum += interval.h * scheme->weights[j] *
             g(interval.t0 + scheme->nodes[j] * interval.h, interval.values.col(j));
    }
  }
  return sum;
}

Start start_from(const Solution& solution) {
  auto copy = std::make_shared<const Solution>(solution);
  return {[copy](double t, Eigen::VectorXd& x) { x = copy->at(std::clamp(t, copy->begin(), copy->end())); },
          solution.parameters(), solution.mesh()};
}

}  // namespace nlmech::bvp
