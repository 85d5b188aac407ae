#include "outrider/ballistics/blocker.hpp"

#include <cmath>
#include <limits>

namespace outrider {
namespace {

constexpr double chord_rad = radians(46.0);  // angle of each chord that replaces an arc

bool is_upright_prism(const Solid& solid) {
  const bool upright = std::abs(solid.world_T_solid.rotation.axes[2].z) >= 1.0 - 1e-12;
  return upright && (std::holds_alternative<BoxShape>(solid.shape) ||
                     std::holds_alternative<CylinderShape>(solid.shape));
}

/// Returns the convex pieces of a solid; a mesh is split into its triangles.
std::vector<Solid> convex_pieces(const Solid& solid) {
  const auto* mesh = std::get_if<MeshShape>(&solid.shape);
  if (mesh == nullptr) return {solid};
  std::vector<Solid> pieces;
  for (const auto& triangle : mesh->triangles) {
    pieces.push_back({solid.name, solid.world_T_solid, MeshShape{{triangle}}});
  }
  return pieces;
}

Blocker blocker_of(const Solid& piece, std::size_t index, double grow_m) {
  Blocker blocker{piece, index, {}, {}, {}, 0.0, 0.0};
  const Box3 box = bounds(piece);
  blocker.low_m = box.low.z;
  blocker.high_m = box.high.z;
  constexpr double inf = std::numeric_limits<double>::infinity();
  const auto shapes = footprint(piece, -inf, inf);
  if (shapes.empty()) return blocker;  // a half-space: met everywhere
  RoundedPolygon grown = shapes.front();
  if (is_upright_prism(piece)) blocker.core = inscribed(grown, chord_rad);
  grown.radius_m += grow_m;
  if (is_upright_prism(piece)) blocker.side = inscribed(grown, chord_rad);
  blocker.hull = circumscribed(grown, chord_rad);
  return blocker;
}

}  // namespace

std::vector<Blocker> blockers(const FlightSpace& space, double grow_m) {
  std::vector<Blocker> all;
  for (std::size_t i = 0; i < space.solids().size(); ++i) {
    for (const Solid& piece : convex_pieces(space.solids()[i])) {
      all.push_back(blocker_of(piece, i, grow_m));
    }
  }
  return all;
}

}  // namespace outrider
