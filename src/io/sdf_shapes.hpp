// The shapes of SDF collisions as shapes of solids.
#pragma once

#include <map>
#include <sdf/Geometry.hh>
#include <sdf/Heightmap.hh>
#include <string>
#include <vector>

#include "outrider/io/mesh.hpp"
#include "outrider/world/solid.hpp"

namespace outrider {

/// A shape and where it stands in its collision.
struct SdfPiece {
  Shape shape;
  Pose3 collision_T_piece = {};
  std::string suffix = {};  ///< of its name, where a collision has several
};

/// The mesh files of one world, each read once.
struct SdfMeshes {
  std::map<std::string, std::vector<Triangle>> by_path;
  std::size_t placed = 0;  ///< triangles in the world so far
};

/// Refuses sizes that are not above 0 and at most 1e6 m, planes without a direction, meshes that do not
/// load and more than 2 million triangles in one world.
Outcome<std::vector<SdfPiece>> sdf_pieces(const sdf::Geometry& geometry, SdfMeshes& meshes);

/// A heightmap where it stands: black lies at its position, white as high above as its size says. Refuses a
/// pose with a rotation, and what terrain.hpp refuses.
Outcome<HeightField> sdf_terrain(const sdf::Heightmap& heightmap, const Pose3& world_T_collision);

}  // namespace outrider
