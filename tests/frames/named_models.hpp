/// @file
/// Models of frames for tests, their equilibrium paths, and functions that select unknowns and points.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <string>
#include <vector>

#include "nlmech/frames/named/frame_paths.hpp"

namespace nlmech::frames::models {

/// Supports both displacements of a node.
inline void pin(FrameModel& m, const std::string& node) {
  m.supports.push_back({node, Motion::x});
  m.supports.push_back({node, Motion::y});
}

/// Supports both displacements and the rotation of a node.
inline void clamp(FrameModel& m, const std::string& node) {
  pin(m, node);
  m.supports.push_back({node, Motion::rotation});
}

/// A bar of stiffness 1, pinned at both ends.
inline NamedMember bar(const std::string& first, const std::string& second) {
  return {
      .first = first, .second = second, .ea = 1, .ei = 1, .is_first_pinned = true, .is_second_pinned = true};
}

/// A beam of length 1, EI = 1 and EA = 1e4, each end clamped or pinned, loaded at its middle.
inline FrameModel beam(bool is_left_pinned, bool is_right_pinned) {
  FrameModel m;
  m.nodes = {{"left", 0, 0}, {"middle", 0.5, 0}, {"right", 1, 0}};
  m.members = {
      {.first = "left", .second = "middle", .ea = 1e4, .ei = 1, .is_first_pinned = is_left_pinned},
      {.first = "middle", .second = "right", .ea = 1e4, .ei = 1, .is_second_pinned = is_right_pinned}};
  clamp(m, "left");
  clamp(m, "right");
  m.loads = {{"middle", Motion::y, -1}};
  return m;
}

/// Two pinned bars over half spans of 1, with the apex at height 0.5.
inline FrameModel truss() {
  FrameModel m;
  m.nodes = {{"left", -1, 0}, {"apex", 0, 0.5}, {"right", 1, 0}};
  m.members = {bar("left", "apex"), bar("apex", "right")};
  pin(m, "left");
  pin(m, "right");
  m.loads = {{"apex", Motion::y, -1}};
  return m;
}

/// A column of length 1 and EI = 1 with one node at its middle, pinned at its base and guided at its top; the
/// load is in units of the buckling load pi^2.
inline FrameModel column(double ea) {
  FrameModel m;
  m.nodes = {{"base", 0, 0}, {"middle", 0, 0.5}, {"top", 0, 1}};
  m.members = {{.first = "base", .second = "middle", .ea = ea, .ei = 1},
               {.first = "middle", .second = "top", .ea = ea, .ei = 1}};
  pin(m, "base");
  m.supports.push_back({"top", Motion::x});
  m.loads = {{"top", Motion::y, -std::acos(-1.) * std::acos(-1.)}};
  return m;
}

/// A cantilever of length 1 and EI = 1 that a moment at the load factor 1 rolls up to a full circle.
inline FrameModel cantilever(double ea) {
  FrameModel m;
  m.nodes = {{"base", 0, 0}, {"tip", 1, 0}};
  m.members = {{.first = "base", .second = "tip", .ea = ea, .ei = 1}};
  clamp(m, "base");
  m.loads = {{"tip", Motion::rotation, 2 * std::acos(-1.)}};
  return m;
}

/// Lee's frame.
inline FrameModel lee() {
  FrameModel m;
  m.nodes = {{"base", 0, 0}, {"corner", 0, 120}, {"load", 24, 120}, {"end", 120, 120}};
  m.members = {{.first = "base", .second = "corner", .ea = 4320, .ei = 1440, .elements = 5},
               {.first = "corner", .second = "load", .ea = 4320, .ei = 1440},
               {.first = "load", .second = "end", .ea = 4320, .ei = 1440, .elements = 4}};
  pin(m, "base");
  pin(m, "end");
  m.loads = {{"load", Motion::y, -1}};
  return m;
}

/// A circular arch loaded at the crown downwards.
struct Arch {
  double radius, half_angle;  ///< half the opening angle in degrees
  double ea, ei;
  bool is_right_clamped = true;  ///< otherwise pinned
  /// Model the left half only, with symmetry conditions at the crown; the load is that of the whole arch.
  bool is_half = false;
};
/// The arch of 215 degrees, clamped left and pinned right, of DaDeppo and Schmidt (1975).
inline constexpr Arch deep_arch{100, 107.5, 1e8, 1e6, false};
/// The clamped shallow arch of Gjelsvik and Bodner (1962), thickness 3/16: it snaps through, with a
/// bifurcation to an antisymmetric branch.
inline constexpr Arch shallow_arch{133.114, 7.3397, 1e7 * 3 / 16, 1e7 * (27. / 4096) / 12};

/// Two circular members, or one from the support to the crown.
inline FrameModel arch(const Arch& a) {
  FrameModel m;
  const double angle = a.half_angle * std::numbers::pi / 180, half = std::sin(angle / 2),
               x = a.radius * std::sin(angle), y = -2 * a.radius * half * half;
  m.nodes = {{"left", -x, y}, {"crown", 0, 0}};
  m.members = {{.first = "left", .second = "crown", .ea = a.ea, .ei = a.ei, .radius = a.radius}};
  clamp(m, "left");
  if (a.is_half) {
    m.supports.push_back({"crown", Motion::x});
    m.supports.push_back({"crown", Motion::rotation});
  } else {
    m.nodes.push_back({"right", x, y});
    m.members.push_back({.first = "crown", .second = "right", .ea = a.ea, .ei = a.ei, .radius = a.radius});
    a.is_right_clamped ? clamp(m, "right") : pin(m, "right");
  }
  m.loads = {{"crown", Motion::y, a.is_half ? -0.5 : -1}};
  return m;
}

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

/// The equilibrium paths; expects success.
inline FramePaths paths_of(const NamedFrame& f, const PathOptions& walk = {}) {
  FramePaths paths = equilibrium_paths(f, walk);
  EXPECT_TRUE(paths.status.ok()) << paths.status.text();
  return paths;
}

/// Unconnected columns of column(): the first with stiffness 1, the others with @p stiffnesses.
inline FrameModel columns(const std::vector<double>& stiffnesses) {
  FrameModel m = column(1e6);
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

}  // namespace nlmech::frames::models
