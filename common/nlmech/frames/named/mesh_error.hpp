/// @file
/// Discretisation error of the paths of a frame, estimated by a second mesh.
#pragma once

#include <optional>
#include <vector>

#include "nlmech/frames/named/frame_model.hpp"
#include "nlmech/frames/named/frame_paths.hpp"

namespace nlmech::frames {

/// Elements per member of the second mesh: one and a half times as many; 3 for 1, because 2 often give the
/// same result as 1; two thirds for frames of more than 2000 beam-columns, to save time.
/// @param elements elements per member of the mesh, positive
/// @param beam_columns number of beam-columns of the frame with that mesh
[[nodiscard]] int second_mesh(int elements, std::size_t beam_columns);

/// Ratio of the error of a mesh to the difference between both meshes, for errors proportional to the square
/// of the element length.
/// @param elements elements per member of the mesh whose error is estimated
/// @param others elements per member of the second mesh, different from @p elements
[[nodiscard]] double mesh_factor(int elements, int others);

/// Paths of a frame on two meshes.
struct MeshPair {
  const NamedFrame& frame;   ///< frame whose errors are estimated
  const FramePaths& paths;   ///< its paths
  const NamedFrame& second;  ///< frame with another number of elements and the same named degrees of freedom
  const FramePaths& compared;  ///< its paths, followed with the same options
  double factor;               ///< mesh_factor()
};

/// Estimated relative discretisation error of each point of the paths, at most 1. For a limit or bifurcation
/// point: error of its load factor, 1 if the second mesh has no such point. For any other point: error of the
/// displacements along x and y of named nodes, relative to the largest of these, of their rotations, relative
/// to the largest rotation, and likewise of forces and moments at prescribed displacements, at the same load
/// factor; near a limit point, where the second mesh does not reach that load: error of the
/// load factor. Empty where the second path does not reach, no equilibrium was found, or @p seconds have
/// passed.
///
/// Tests compare it with the errors against closed forms and the elastica (a ring, an arch, a column, a
/// cantilever), within a factor of 2, for 4 or more elements per member.
[[nodiscard]] std::vector<std::optional<double>> mesh_errors(const MeshPair& meshes, double seconds);

}  // namespace nlmech::frames
