#include "nlmech/frames/named/walked_frame.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "nlmech/algebraic/symmetric_solver.hpp"

namespace nlmech::frames {
namespace {

double size_of(const Frame& frame) {
  const auto& nodes = frame.nodes();
  const auto [left, right] =
      std::minmax_element(nodes.begin(), nodes.end(), [](const Node& a, const Node& b) { return a.x < b.x; });
  const auto [low, high] =
      std::minmax_element(nodes.begin(), nodes.end(), [](const Node& a, const Node& b) { return a.y < b.y; });
  return std::hypot(right->x - left->x, high->y - low->y);
}

/// How many times too great displacements are: 1 if a first step may make them.
double excess_of(const Frame& frame, const Eigen::VectorXd& x) {
  const double far = 1e-3 * size_of(frame), turn = 0.02;
  double worst = 0;
  for (std::size_t i = 0; i < frame.members().size(); ++i) {
    const Vector<double, 6> d = frame.ends<double>(x, i);
    for (int j = 0; j < 6; ++j) worst = std::max(worst, std::abs(d[j]) / (j % 3 == 2 ? turn : far));
    // A member that is short beside the frame is not to be turned inside out.
    const Member& m = frame.members()[i];
    const Node &a = frame.nodes()[static_cast<std::size_t>(m.first)],
               &b = frame.nodes()[static_cast<std::size_t>(m.second)];
    worst = std::max(worst, std::hypot(d[3] - d[0], d[4] - d[1]) / (0.1 * std::hypot(b.x - a.x, b.y - a.y)));
  }
  return worst;
}

}  // namespace

Eigen::VectorXd WalkedFrame::scale() const {
  Eigen::VectorXd all = Eigen::VectorXd::Ones(frame.size());
  const double translation = 1 / size_of(frame);
  for (int node = 0; node < static_cast<int>(frame.nodes().size()); ++node) {
    for (const Motion motion : {Motion::x, Motion::y}) {
      if (const Eigen::Index at = frame.unknown(node, motion); at >= 0) all[at] = translation;
    }
  }
  return driven != nullptr ? driven->free(all) : all;
}

void WalkedFrame::forget_turns(Eigen::VectorXd& change) const {
  if (driven != nullptr) return;  // a displacement that grows with the load does not return
  constexpr double turn = 2 * std::numbers::pi;
  const auto turns = [&](Eigen::Index i) { return i < 0 ? 0 : std::round(change[i] / turn); };
  for (std::size_t i = 0; i < frame.members().size(); ++i) {
    if (turns(frame.unknowns_of(i)[2]) != turns(frame.unknowns_of(i)[5])) return;
  }
  for (std::size_t i = 0; i < frame.members().size(); ++i) {
    for (const Eigen::Index at : {frame.unknowns_of(i)[2], frame.unknowns_of(i)[5]}) {
      if (at >= 0) change[at] -= turn * turns(at);
    }
  }
}

ShortestMember WalkedFrame::shortest(const Eigen::VectorXd& x, double load) const {
  ShortestMember found{HUGE_VAL, 0, 0};
  const Eigen::VectorXd all = whole(x, load);
  for (std::size_t i = 0; i < frame.members().size(); ++i) {
    const Node &a = frame.nodes()[static_cast<std::size_t>(frame.members()[i].first)],
               &b = frame.nodes()[static_cast<std::size_t>(frame.members()[i].second)];
    const Vector<double, 6> d = frame.ends<double>(all, i);
    const double left =
        std::hypot(b.x - a.x + d[3] - d[0], b.y - a.y + d[4] - d[1]) / std::hypot(b.x - a.x, b.y - a.y);
    if (left < found.left) found = {left, a.x, a.y};
  }
  return found;
}

double first_load(const WalkedFrame& walked) {
  algebraic::Loaded& equations = walked.equations;
  const Eigen::VectorXd rest = Eigen::VectorXd::Zero(equations.size());
  equations.linearise(rest, 0);
  algebraic::SymmetricSolver solver;
  const Eigen::VectorXd scale = algebraic::scale_of(equations.sparse()->diagonal());
  solver.take(*equations.sparse(), scale);
  const Eigen::Index negative = solver.factorise().negative;
  Eigen::VectorXd column;
  equations.load_vector(column);
  const Eigen::VectorXd scaled = (-column).cwiseQuotient(scale);
  Eigen::VectorXd x(equations.size());
  solver.solve(scaled, x);
  x = x.cwiseQuotient(scale);
  double first = 1 / excess_of(walked.frame, walked.whole(x, 1));
  if (!(std::isfinite(first) && first > 0)) return 1;
  for (int halving = 0; halving < 60; ++halving, first /= 2) {
    equations.linearise(first * x, first);
    solver.take(*equations.sparse(), scale);
    if (solver.is_finite() && solver.factorise().negative == negative) break;
  }
  return first;
}

}  // namespace nlmech::frames
