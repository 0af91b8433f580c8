/// @file
/// What the length of its elements costs a frame's paths, estimated by a second mesh.
#pragma once

#include <optional>
#include <vector>

#include "nlmech/frames/named/frame_model.hpp"
#include "nlmech/frames/named/frame_paths.hpp"

namespace nlmech::frames {

/// Elements a member of a second mesh for an estimate: half as many again, and three for one, because two
/// often give what one gives; two thirds of them for frames of more than 2000 beam-columns, where time
/// counts.
/// @param elements of the mesh, positive
/// @param beam_columns of the whole frame with that mesh
[[nodiscard]] int second_mesh(int elements, std::size_t beam_columns);

/// What errors that fall like the square of the elements' length are, over the difference between both
/// meshes.
/// @param elements of the mesh whose errors are meant
/// @param others of the second mesh, another number
[[nodiscard]] double mesh_factor(int elements, int others);

/// The frame's paths with two numbers of elements.
struct MeshPair {
  const NamedFrame& frame;     ///< of which errors are estimated
  const FramePaths& paths;     ///< its paths
  const NamedFrame& second;    ///< with another number of elements: the same named motions
  const FramePaths& compared;  ///< its paths, followed in the same way
  double factor;               ///< mesh_factor()
};

/// The estimated error of each point of the paths by the length of the elements, relative, at most 1. Of a
/// limit or branch point it is that of its load factor, 1 if the second mesh has no such point. Of any other
/// point it is that of its displacements (of named nodes, relative to the largest) and of the forces on given
/// motions, at its load factor; next to a limit point, where the second mesh does not bear that load, that of
/// the load factor. Nothing where the second path was not followed so far, no equilibrium was found, or @p
/// seconds are over.
///
/// Tests hold it within a factor of 2 to errors against closed forms and the elastica (a ring, an arch, a
/// column, a cantilever), with 4 elements a member and more.
[[nodiscard]] std::vector<std::optional<double>> mesh_errors(const MeshPair& meshes, double seconds);

}  // namespace nlmech::frames
