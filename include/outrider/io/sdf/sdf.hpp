// Worlds from SDF files (1.4 to 1.12, of Gazebo and Gazebo Classic), including slightly broken ones.
//
// Only collisions are read. Boxes, cylinders, spheres, planes (half-spaces) and triangle meshes become solids
// without change. A capsule becomes a cylinder and two spheres. An ellipsoid or a cone becomes a mesh around
// it that is at most 1 % larger. Polylines become the mesh around what they enclose, with their holes. A mesh
// may name one of its parts (<submesh>). Poses follow the pose frame semantics of SDF: frames, joints at
// zero, nested and merged models. Poses in a saved <state> override those of the models, as in Gazebo.
//
// Plain paths and file:// in <include> and <mesh> are relative to the folder of the file or, if there is no
// such file, to the nearest of the four folders above it that has one. model://, package:// and https:// (a
// model of Gazebo Fuel, by its name or as its cache has it, with its version or the newest) are searched in
// that folder, in its parent folder, in the folders "models" of both, in SdfOptions::model_path, and in the
// folders of the environment variables GZ_SIM_RESOURCE_PATH and GAZEBO_MODEL_PATH. In a model folder,
// model.config picks the file of the newest version that is read. The models ground_plane and sun are built
// in, for when they are not found.
//
// Repaired, each with a warning that names file and line (docs/formats.md lists them all): poses of three
// numbers, times in <state> that are not a pair, several shapes in one <geometry>, missing and duplicate
// names, a missing <world> (the models then stand on a floor at z = 0). Omitted with a warning: includes,
// meshes and heightmaps that are not found, populations.
//
// A <heightmap> with a PNG is the terrain of the world (terrain.hpp) and replaces the floor. There is at most
// one, and its pose must have no rotation.
//
// World: gravity is that of the file and must point straight down. floor_z_m is the top of the highest
// horizontal half-space, else of a flat box under everything, else of the lowest level surface of boxes or
// meshes that covers half of everything; a world without any is refused. A level surface with less than 0.5 m
// of room below that covers three quarters of everything is driven on (docs/formats.md). bounds is
// standing_bounds(); if nothing stands there, it is the area of the floor, where a side of a plane below 1 m
// counts as 20 m. Names are "model/link/collision", without the parts that are not needed, and unique.
//
// Faults: bad_input with file:line or the name of the collision: no SDF, numbers that are invalid or beyond
// 1e6 m, sizes not above 0, frames that do not exist or are relative to themselves, no collisions, no floor.
//
// Bounds, each refused with its number and the limit; they count everything included, as often as it is:
// 64 MiB; 2 million tags; 200,000 models, links, collisions, frames, joints and saved poses, whose names have
// 64 MiB; 20,000 includes, 8 deep; models 100 deep; 2 million triangles; 200,000 solids. Time and memory grow
// linearly: a model with one collision costs about 8 us and 5 KB. No recursion on the depth of the input.
// Thread rule: safe to call concurrently. Source: http://sdformat.org/spec.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "outrider/core/options.hpp"
#include "outrider/world/world.hpp"

namespace outrider {

struct SdfOptions {
  std::string model_path;  ///< folders with models, separated by ':'
};

std::vector<Option> describe(SdfOptions& options);

struct LoadedWorld {
  World world;
  std::vector<std::string> warnings;  ///< one sentence for each kind of warning, with its count
};

Outcome<LoadedWorld> load_sdf(const std::string& path, const SdfOptions& options = {});

/// Reads a world from text. `name` is the name of the file in faults; other files are searched beside it.
Outcome<LoadedWorld> sdf_from_text(std::string_view text, const std::string& name,
                                   const SdfOptions& options = {});

}  // namespace outrider
