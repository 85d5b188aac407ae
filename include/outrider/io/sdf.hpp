// Worlds from SDF files (1.5 to 1.9), also the slightly broken ones found in the wild.
//
// Only collisions count. Boxes, cylinders, spheres, planes (half-spaces) and triangle meshes become
// solids as they are; a capsule becomes a cylinder and two spheres; an ellipsoid becomes a mesh around
// it that stands at most 1 % outside. Poses of a saved <state> win over those of the models, as in
// Gazebo. Files that <include> and <mesh> name are looked up beside the file, in its folder's and its
// parent folder's "models", and in SdfOptions::model_path.
//
// Repaired, each with a warning that names the file and the line (docs/formats.md lists them all):
// poses of three numbers, times of <state> that are no pair, several shapes in one <geometry>, equal
// names, a missing <world>. Left out with a warning: includes, meshes and heightmaps that are not found,
// polylines, populations. sdformat's own messages never reach the console.
//
// A <heightmap> of a PNG is the terrain of the world (terrain.hpp) instead of a floor; there is one at most,
// and its pose has no rotation.
//
// World: gravity from the file (straight down, else refused). floor_z_m is the top of the highest
// upright half-space, or of a flat box under everything; without either the file is refused. bounds is
// standing_bounds(), or when nothing stands there the size of the floor, or 20 m x 20 m about its
// origin when it is smaller than 1 m. Names are "model/link/collision" without the parts that say
// nothing, and unique.
//
// Errors: bad_input with file:line or the collision's name: no SDF, numbers that are none or beyond
// 1e6 m, sizes not above 0, no collisions, no floor.
//
// Bounds, each refused with its number and the limit: with everything included 64 MiB, 2 million tags and
// 20,000 models, links, collisions, frames and joints; 1000 includes, 8 deep; 50 models that are more than 2
// deep in other models; 2 million triangles; 200,000 solids. Time and memory grow linearly: a model with one
// collision costs about 0.2 ms and 70 KB, in a world with every kind of element twice that.
// Thread rule: one call at a time, and no other thread may write to std::cerr meanwhile, which is
// muted while sdformat runs. Poses are composed as SDF 1.9 says; source: http://sdformat.org/spec.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "outrider/core/options.hpp"
#include "outrider/world/world.hpp"

namespace outrider {

struct SdfOptions {
  std::string model_path;  ///< folders separated by ':'
};

std::vector<Option> describe(SdfOptions& options);

struct LoadedWorld {
  World world;
  std::vector<std::string> warnings;  ///< sentences for people, each kind once with its count
};

Outcome<LoadedWorld> load_sdf(const std::string& path, const SdfOptions& options = {});

/// The same from text; `name` stands for the file in sentences, and files are looked up beside it.
Outcome<LoadedWorld> sdf_from_text(std::string_view text, const std::string& name,
                                   const SdfOptions& options = {});

}  // namespace outrider
