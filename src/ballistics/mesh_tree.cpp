#include "outrider/ballistics/mesh_tree.hpp"

#include "outrider/geometry/triangle.hpp"

namespace outrider {
namespace {

std::vector<Box3> boxes_of(const std::vector<std::array<Vec3, 3>>& triangles) {
  std::vector<Box3> boxes(triangles.size());
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    for (const Vec3 corner : triangles[i]) boxes[i].include(corner);
  }
  return boxes;
}

}  // namespace

MeshTree::MeshTree(const MeshShape& mesh) : triangles_(mesh.triangles), tree_(boxes_of(triangles_)) {}

double MeshTree::distance(Vec3 p) const {
  return tree_.least_distance(p, [&](std::uint32_t i) { return distance_to_triangle(p, triangles_[i]); });
}

}  // namespace outrider
