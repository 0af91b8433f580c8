#include "tests/frames/structures.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>
#include <vector>

namespace nlmech::frames {
namespace {

constexpr double degree = std::numbers::pi / 180;

LoadedStructure loaded_at(Frame frame, int node, double part) {
  const Eigen::Index at = frame.unknown(node, Motion::y), sideways = frame.unknown(node, Motion::x);
  Eigen::VectorXd load = Eigen::VectorXd::Zero(frame.size());
  load[at] = -part;
  return {std::move(frame), at, sideways, std::move(load)};
}

void hold(std::vector<Support>& supports, int node, bool is_clamped) {
  supports.push_back({node, Motion::x});
  supports.push_back({node, Motion::y});
  if (is_clamped) supports.push_back({node, Motion::rotation});
}

}  // namespace

Arch deep_arch(int elements) {
  return {.radius = 100,
          .half_angle = 107.5 * degree,
          .ea = 1e8,
          .ei = 1e6,
          .elements = elements,
          .is_right_clamped = false};
}

Arch shallow_arch(int elements) {
  const double thickness = 3. / 16, e = 1e7;
  return {.radius = 133.114,
          .half_angle = 7.3397 * degree,
          .ea = e * thickness,
          .ei = e * thickness * thickness * thickness / 12,
          .elements = elements};
}

LoadedStructure make_frame(const LeeFrame& lee) {
  if (lee.elements < 5 || lee.elements % 5 != 0)
    throw std::invalid_argument(
        fmt::format("LeeFrame: {} elements; a multiple of 5 is needed", lee.elements));
  if (!(lee.length > 0 && std::isfinite(lee.length)))
    throw std::invalid_argument(fmt::format("LeeFrame: length {}; it must be positive", lee.length));
  std::vector<Node> nodes;
  std::vector<Member> members;
  const int n = lee.elements;
  for (int i = 0; i <= 2 * n; ++i) {
    const double along = lee.length * (i <= n ? i : i - n) / n;
    nodes.push_back(i <= n ? Node{0, along} : Node{along, lee.length});
    if (i > 0) members.push_back({i - 1, i, lee.ea, lee.ei});
  }
  std::vector<Support> supports;
  hold(supports, 0, false);
  hold(supports, 2 * n, false);
  return loaded_at(Frame(std::move(nodes), std::move(members), supports), n + n / 5, 1);
}

LoadedStructure make_frame(const Arch& arch) {
  if (arch.elements < 2 || arch.elements % 2 != 0)
    throw std::invalid_argument(
        fmt::format("Arch: {} elements; an even number, at least 2, is needed", arch.elements));
  if (!(arch.radius > 0 && std::isfinite(arch.radius) && arch.half_angle > 0 &&
        arch.half_angle < 180 * degree))
    throw std::invalid_argument(fmt::format(
        "Arch: radius {}, half angle {} rad; the first must be positive, the second between 0 and pi",
        arch.radius, arch.half_angle));
  if (arch.is_half && arch.is_left_clamped != arch.is_right_clamped)
    throw std::invalid_argument("Arch: half of an arch whose ends are held differently");
  const int crown = arch.elements / 2, last = arch.is_half ? crown : arch.elements;
  std::vector<Node> nodes;
  std::vector<Member> members;
  for (int i = 0; i <= last; ++i) {
    // Mirrored places are exact mirror images; the crown is at the height 0.
    const double angle = arch.half_angle * std::abs(i - crown) / crown, half = std::sin(angle / 2);
    nodes.push_back({(i < crown ? -1 : 1) * arch.radius * std::sin(angle), -2 * arch.radius * half * half});
    if (i > 0) members.push_back({i - 1, i, arch.ea, arch.ei});
  }
  std::vector<Support> supports;
  hold(supports, 0, arch.is_left_clamped);
  if (arch.is_half) {
    supports.push_back({crown, Motion::x});
    supports.push_back({crown, Motion::rotation});
  } else {
    hold(supports, last, arch.is_right_clamped);
  }
  return loaded_at(Frame(std::move(nodes), std::move(members), supports), crown, arch.is_half ? 0.5 : 1);
}

}  // namespace nlmech::frames
