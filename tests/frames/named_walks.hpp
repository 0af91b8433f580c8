/// @file
/// Paths of frames described by names, and what tests look up on them.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <string>
#include <vector>

#include "nlmech/frames/named/frame_paths.hpp"
#include "tests/frames/named_models.hpp"

namespace nlmech::frames::walks {

using Kind = FramePoint::Kind;

/// The unknown of a motion.
inline Eigen::Index unknown_of(const NamedFrame& f, const std::string& name) {
  const auto at =
      std::find_if(f.motions.begin(), f.motions.end(), [&](const NamedMotion& m) { return m.name == name; });
  EXPECT_NE(at, f.motions.end()) << name;
  return at->unknown;
}

/// Points of one kind on a branch.
inline std::vector<FramePoint> only(const FramePaths& paths, Kind kind, int branch = 0) {
  std::vector<FramePoint> some;
  std::copy_if(paths.points.begin(), paths.points.end(), std::back_inserter(some),
               [&](const FramePoint& p) { return p.kind == kind && p.branch == branch; });
  return some;
}

/// The paths, which have to come to their ends.
inline FramePaths paths_of(const NamedFrame& f, const FrameWalk& walk = {}) {
  FramePaths paths = equilibrium_paths(f, walk);
  EXPECT_TRUE(paths.status.ok()) << paths.status.text();
  return paths;
}

/// Columns of models::column() side by side, which nothing joins, the first of stiffness 1 and others of
/// more.
inline FrameModel columns(const std::vector<double>& stiffnesses) {
  FrameModel m = models::column(1e6);
  const FrameModel one = m;
  double place = 0;
  for (const double stiffness : stiffnesses) {
    place += 3;
    const std::string name = std::to_string(place) + ' ';
    for (const NamedNode& n : one.nodes) m.nodes.push_back({name + n.name, n.x + place, n.y});
    for (NamedMember member : one.members) {
      member.first = name + member.first;
      member.second = name + member.second;
      member.ei *= stiffness;
      m.members.push_back(member);
    }
    for (const NamedSupport& s : one.supports) m.supports.push_back({name + s.node, s.motion});
    for (const NamedLoad& l : one.loads) m.loads.push_back({name + l.node, l.motion, l.value});
  }
  return m;
}

}  // namespace nlmech::frames::walks
