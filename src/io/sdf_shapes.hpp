// Converts the shapes of SDF collisions to shapes of solids.
#pragma once

#include <map>
#include <sdf/Geometry.hh>
#include <sdf/Heightmap.hh>
#include <string>
#include <vector>

#include "outrider/io/mesh.hpp"
#include "outrider/world/solid.hpp"

namespace outrider {

/// A shape and its pose in the collision.
struct SdfPiece {
  Shape shape;
  Pose3 collision_T_piece = {};
  std::string suffix = {};  ///< suffix of its name, if a collision has several pieces
};

/// The mesh files of one world, each read once.
struct SdfMeshes {
  std::map<std::string, std::vector<Triangle>> by_path;
  std::size_t placed = 0;  ///< number of triangles in the world so far
};

/// Converts a shape. Refuses sizes that are not above 0 and at most 1e6 m, planes without a direction, meshes
/// that cannot be loaded, and more than 2 million triangles in one world.
Outcome<std::vector<SdfPiece>> sdf_pieces(const sdf::Geometry& geometry, SdfMeshes& meshes);

/// Converts a heightmap at a pose. Black is at its position, white above it by the z of its size. Refuses a
/// pose with a rotation; has the faults of terrain.hpp.
Outcome<HeightField> sdf_terrain(const sdf::Heightmap& heightmap, const Pose3& world_T_collision);

}  // namespace outrider
