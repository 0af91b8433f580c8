#include <cmath>
#include <optional>

#include "nlmech/algebraic/symmetric_solver.hpp"
#include "nlmech/frames/named/frame_model.hpp"

namespace nlmech::frames {
namespace {

constexpr double no_energy = 1e-18;

/// Twice the strain energy of small displacements, from the strains.
double twice_energy(const Frame& frame, const Eigen::VectorXd& x) {
  double sum = 0;
  for (std::size_t i = 0; i < frame.members().size(); ++i) {
    const Member& m = frame.members()[i];
    const Node &a = frame.nodes()[static_cast<std::size_t>(m.first)],
               &b = frame.nodes()[static_cast<std::size_t>(m.second)];
    const double dx = b.x - a.x, dy = b.y - a.y, length = std::hypot(dx, dy);
    const Vector<double, 6> d = frame.ends<double>(x, i);
    const double u = d[3] - d[0], v = d[4] - d[1];
    const double stretch = (dx * u + dy * v) / length, turn = (dx * v - dy * u) / (length * length);
    // Of a beam: g_a = 12 and g_s = 4.
    const double a_part = (d[2] + d[5]) / 2 - turn, s_part = (d[2] - d[5]) / 2;
    sum += m.ea / length * stretch * stretch + m.ei / length * (12 * a_part * a_part + 4 * s_part * s_part);
  }
  return sum;
}

/// Which node has this unknown; the rotation of a pinned end has none.
std::optional<Mechanism> owner_of(const Frame& frame, Eigen::Index unknown) {
  for (int node = 0; node < static_cast<int>(frame.nodes().size()); ++node) {
    for (const Motion motion : {Motion::x, Motion::y, Motion::rotation}) {
      if (frame.unknown(node, motion) == unknown) return Mechanism{node, motion};
    }
  }
  return std::nullopt;
}

}  // namespace

std::optional<Mechanism> find_mechanism(const Frame& frame) {
  Eigen::SparseMatrix<double> k;
  const Eigen::VectorXd rest = Eigen::VectorXd::Zero(frame.size());
  if (!frame.tangent<double>(rest, k).ok()) return std::nullopt;
  const Eigen::VectorXd scale = algebraic::scale_of(k.diagonal());
  algebraic::SymmetricSolver solver;
  solver.take(k, scale);
  static_cast<void>(solver.factorise(1e-15 * solver.norm()));
  // Nodes that turn or move alone are not meant; the start has a share of every shape.
  Eigen::VectorXd v(frame.size()), next(frame.size());
  for (Eigen::Index i = 0; i < v.size(); ++i) v[i] = 1 + 0.5 * std::sin(1. + static_cast<double>(i));
  for (int iteration = 0; iteration < 4; ++iteration) {
    solver.solve(v, next);
    v = next.normalized();
  }
  if (twice_energy(frame, v.cwiseQuotient(scale)) > no_energy) return std::nullopt;
  for (;;) {
    Eigen::Index most = 0;
    if (!(v.cwiseAbs().maxCoeff(&most) > 0)) return std::nullopt;
    if (const auto owner = owner_of(frame, most)) return owner;
    v[most] = 0;
  }
}

}  // namespace nlmech::frames
