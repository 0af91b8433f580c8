#include "nlmech/frames/named/frame_forces.hpp"

#include <cmath>

namespace nlmech::frames {
namespace {

/// A beam-column in a state: end forces on it less the loads along it, and what its sections need.
struct BeamState {
  Vector<double, 6> forces;  ///< on the member at its ends, along x and y, and moments
  double angle;              ///< of the chord at rest
  double half;               ///< angle between the chord and the axis of an arc at its ends, at rest
  double bow;                ///< load across the chord times length squared: curvature of the moment
  double turns[2];           ///< rotations of the ends
};

BeamState state_of(const FrameModel& model, const NamedFrame& frame, const Eigen::VectorXd& x, double load,
                   std::size_t index) {
  const Member& m = frame.frame.members()[index];
  const Node &a = frame.frame.nodes()[static_cast<std::size_t>(m.first)],
             &b = frame.frame.nodes()[static_cast<std::size_t>(m.second)];
  const double dx = b.x - a.x, dy = b.y - a.y, length = std::hypot(dx, dy);
  const auto member = frame.frame.member<double>(x, index);
  const Vector<double, 6> ends = frame.frame.ends<double>(x, index);
  const auto at = 2 * static_cast<Eigen::Index>(index);
  const double along_x = load * frame.growing.members[at] + frame.constant.members[at],
               along_y = load * frame.growing.members[at + 1] + frame.constant.members[at + 1];
  const double radius = model.members[frame.members[index]].radius;
  return {member_force(member) - load * frame.growing.at_ends(frame.frame, index) -
              frame.constant.at_ends(frame.frame, index),
          std::atan2(dy, dx),
          radius == 0 ? 0 : std::asin(length / (2 * radius)),
          (member.e[0] * along_y - member.e[1] * along_x) * length * member.length,
          {ends[2], ends[5]}};
}

/// Section at an end of a beam-column: 0 or 1.
SectionForces section(const BeamState& s, int end) {
  const double angle = s.angle + (end == 0 ? s.half : -s.half) + s.turns[end], side = end == 0 ? -1 : 1;
  const double c = std::cos(angle), q = std::sin(angle);
  const Eigen::Vector3d force = s.forces.segment<3>(3L * end);
  return {side * (force[0] * c + force[1] * q), side * (force[0] * q - force[1] * c), side * force[2]};
}

/// The moment of the greatest size along a beam-column.
double greatest_moment(const BeamState& s) {
  const double first = -s.forces[2], second = s.forces[5], rise = second - first;
  double most = std::abs(second) > std::abs(first) ? second : first;
  const double place = s.bow == 0 ? 0 : 0.5 - rise / s.bow;  // of the vertex of the parabola
  if (place > 0 && place < 1) {
    const double vertex = first + rise * place - s.bow / 2 * place * (1 - place);
    if (std::abs(vertex) > std::abs(most)) most = vertex;
  }
  return most;
}

}  // namespace

FrameForces forces_of(const FrameModel& model, const NamedFrame& frame, const Eigen::VectorXd& x,
                      double load) {
  FrameForces all{std::vector<MemberForces>(model.members.size()),
                  -load * frame.growing.nodes - frame.constant.nodes,
                  {}};
  const auto add = [&](int node, const Eigen::Vector3d& force) {
    if (3L * node < all.nodes.size()) all.nodes.segment<3>(3L * node) += force;
  };
  for (std::size_t i = 0; i < frame.members.size(); ++i) {
    const BeamState state = state_of(model, frame, x, load, i);
    const std::size_t member = frame.members[i];
    MemberForces& forces = all.members[member];
    if (i == 0 || frame.members[i - 1] != member) forces.first = section(state, 0);
    forces.second = section(state, 1);
    if (const double moment = greatest_moment(state); std::abs(moment) > std::abs(forces.moment))
      forces.moment = moment;
    add(frame.frame.members()[i].first, state.forces.head<3>());
    add(frame.frame.members()[i].second, state.forces.tail<3>());
  }
  for (std::size_t i = 0; i < frame.frame.springs().size(); ++i) {
    const Spring& s = frame.frame.springs()[i];
    const double force = frame.frame.spring_force(x, i);
    all.springs.push_back(force);
    const Eigen::Vector3d on_second(force * s.x, force * s.y, force * s.rotation);
    add(s.second, on_second);
    if (s.first >= 0) add(s.first, -on_second);
  }
  return all;
}

}  // namespace nlmech::frames
