#include "nlmech/frames/named/frame_motion.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "nlmech/support/doubles.hpp"
#include "nlmech/support/quoted_input.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::frames {
namespace {

/// Throws if an unknown has no mass, naming a member at it.
void require_masses(const NamedFrame& f) {
  for (std::size_t i = 0; i < f.frame.members().size(); ++i) {
    for (const Eigen::Index at : f.frame.unknowns_of(i)) {
      if (at >= 0 && !(f.mass[at] > 0))
        throw ModelError(ModelPart::members, f.members[i],
                         "a motion in time needs a mass per length of this member: one of its displacements "
                         "moves no mass");
    }
  }
  for (const NamedMotion& m : f.motions) {
    if (!(f.mass[m.unknown] > 0))
      throw ModelError(ModelPart::nodes, static_cast<std::size_t>(m.node),
                       "a motion in time needs an inertia at this node, where only joints hold its rotation");
  }
}

}  // namespace

double LoadHistory::at(double t) const {
  if (kind == Kind::ramp && t < duration) return factor * t / duration;
  return kind == Kind::pulse && t >= duration ? 0 : factor;
}

FrameMotion::FrameMotion(const NamedFrame& frame, const LoadHistory& history, Eigen::VectorXd start)
    : frame_(&frame), history_(history), start_(std::move(start)) {
  if (!frame.given.empty())
    throw ModelError(ModelPart::displacements, 0, "a motion in time has loads, and no given displacements");
  if (!std::isfinite(history.factor) || !std::isfinite(history.duration) ||
      (history.kind != LoadHistory::Kind::step && !(history.duration > 0)))
    throw invalid_argument("FrameMotion: a load factor of {} with a duration of {}", history.factor,
                           history.duration);
  require_masses(frame);
  static_cast<void>(frame.frame.tangent<double>(Eigen::VectorXd::Zero(frame.frame.size()), stiffness_));
  damping_ = frame.damping.stiffness * stiffness_;
  for (Eigen::Index i = 0; i < frame.frame.size(); ++i)
    damping_.coeffRef(i, i) += frame.damping.mass * frame.mass[i];
}

void FrameMotion::acceleration(const double& t, const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                               Eigen::VectorXd& a) const {
  if (!has_values(frame_->frame.force<double>(q, a))) {
    a.setConstant(q.size(), nan);
    return;
  }
  if (frame_->damping.mass > 0 || frame_->damping.stiffness > 0) a.noalias() += damping_ * v;
  a = history_.at(t) * frame_->load - a;
  if (frame_->steady.size() > 0) a += frame_->steady;
  a = a.cwiseQuotient(frame_->mass);
}

void FrameMotion::operator()(const double& t, const Eigen::VectorXd& x, Eigen::VectorXd& dxdt) const {
  const Eigen::Index n = frame_->frame.size();
  Eigen::VectorXd a(n);
  acceleration(t, x.head(n), x.tail(n), a);
  dxdt.resize(2 * n);
  dxdt.head(n) = x.tail(n);
  dxdt.tail(n) = a;
}

void FrameMotion::jacobian(double t, const Eigen::VectorXd& x, Eigen::MatrixXd& j) const {
  static_cast<void>(t);
  const Eigen::Index n = frame_->frame.size();
  Eigen::SparseMatrix<double> k;
  const bool is_there = has_values(frame_->frame.tangent<double>(x.head(n), k));
  j.setZero(2 * n, 2 * n);
  j.topRightCorner(n, n).setIdentity();
  const auto minus_over_mass = [&](const Eigen::SparseMatrix<double>& of, auto block) {
    for (int column = 0; column < of.outerSize(); ++column) {
      for (Eigen::SparseMatrix<double>::InnerIterator at(of, column); at; ++at)
        block(at.row(), column) = is_there ? -at.value() / frame_->mass[at.row()] : nan;
    }
  };
  minus_over_mass(k, j.bottomLeftCorner(n, n));
  minus_over_mass(damping_, j.bottomRightCorner(n, n));
}

std::vector<double> FrameMotion::discontinuities(double t0, double t1) const {
  const double at = history_.duration;
  if (history_.kind != LoadHistory::Kind::step && std::min(t0, t1) < at && at < std::max(t0, t1)) return {at};
  return {};
}

double FrameMotion::highest_frequency() const {
  // Power iteration on M^-1/2 K M^-1/2; the start vector has a component of every shape.
  const Eigen::VectorXd root = frame_->mass.cwiseSqrt();
  Eigen::VectorXd v(root.size());
  for (Eigen::Index i = 0; i < v.size(); ++i) v[i] = 1 + 0.5 * std::sin(1. + static_cast<double>(i * i));
  double size = 0;
  for (int i = 0; i < 60; ++i) {
    v.normalize();
    const Eigen::VectorXd next = (stiffness_ * v.cwiseQuotient(root)).cwiseQuotient(root);
    size = next.norm();
    v = next;
  }
  return std::sqrt(size);
}

FrameEnergies::FrameEnergies(const FrameMotion& motion)
    : motion_(&motion),
      at_rest_(motion.frame().frame.energy<double>(motion.rest().head(motion.size() / 2)).value) {
  strain = at_rest_;
}

double FrameEnergies::along_load(const Eigen::VectorXd& x) const {
  const Eigen::VectorXd& q = motion_->frame().load;
  return q.dot(x.head(q.size()));
}

double FrameEnergies::damping_power(const Eigen::VectorXd& x) const {
  const Eigen::Index n = motion_->frame().load.size();
  return x.tail(n).dot(motion_->damping() * x.tail(n));
}

void FrameEnergies::add(double t0, double t1, double moved, double lost, const Eigen::VectorXd& x0,
                        const Eigen::VectorXd& x1) {
  const NamedFrame& f = motion_->frame();
  const Eigen::Index n = f.load.size();
  // Linear load history from two inner times: it may jump at the ends of the step.
  const double h = t1 - t0, early = motion_->history().at(t0 + h / 4),
               late = motion_->history().at(t1 - h / 4), slope = 2 * (late - early) / h;
  const double first = early - slope * h / 4, last = late + slope * h / 4;
  work += last * along_load(x1) - first * along_load(x0) - slope * moved;
  if (f.steady.size() > 0) work += f.steady.dot(x1.head(n) - x0.head(n));
  dissipated += lost;
  kinetic = 0.5 * x1.tail(n).cwiseAbs2().dot(f.mass);
  strain = f.frame.energy<double>(x1.head(n)).value;
  greatest = std::max(greatest, kinetic + strain);
  imbalance = std::max(imbalance, std::abs(kinetic + strain - at_rest_ + dissipated - work));
}

}  // namespace nlmech::frames
