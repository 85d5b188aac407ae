#include "outrider/path/safety.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "outline_way.hpp"
#include "outrider/motion/footprint.hpp"
#include "outrider/path/check.hpp"
#include "outrider/path/pieces.hpp"

namespace outrider {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double share = 1.0 / 64.0;  // length of a step relative to the clearance
constexpr double contact = 1e-6;      // a distance below this (cell or metre) counts as touching

double to_square(Vec2 p, Cell c) {
  const Vec2 nearest{std::clamp(p.x, double(c.x), c.x + 1.0), std::clamp(p.y, double(c.y), c.y + 1.0)};
  return distance(p, nearest);
}

/// Returns the distance to the nearest blocked cell, cells. Visits the cells around that of p ring by ring.
double clearance_on_grid(const GridMap& ground, Vec2 p) {
  const Cell home{static_cast<int>(std::floor(p.x)), static_cast<int>(std::floor(p.y))};
  double least = infinite;
  const auto look = [&](Cell c) {
    if (ground.blocked(c)) least = std::min(least, to_square(p, c));
  };
  for (int ring = 0; ring - 1.0 < least; ++ring) {
    for (int k = -ring; k <= ring; ++k) {
      look({home.x + k, home.y - ring});
      look({home.x + k, home.y + ring});
      look({home.x - ring, home.y + k});
      look({home.x + ring, home.y + k});
    }
  }
  return least;
}

/// Returns the least clearance along a piece in cells, at most `least`.
double clearance_on_grid(const GridMap& ground, const OutlineWay& way, double least) {
  const auto cell = [](double t) { return static_cast<int>(std::floor(t)); };
  const Box2& box = way.bounds();
  const int last_x = cell(box.high.x + least), last_y = cell(box.high.y + least);
  for (int y = cell(box.low.y - least) - 1; y <= last_y + 1; ++y) {
    for (int x = cell(box.low.x - least) - 1; x <= last_x + 1; ++x) {
      if (ground.blocked({x, y}) && way.may_come_to({x, y}, least)) least = std::min(least, way.gap({x, y}));
    }
  }
  return least;
}

Vec2 point_at(const PathPiece& piece, double along) {
  if (piece.turn_rad == 0.0) return piece.from + along * (piece.to - piece.from);
  const Vec2 arm = piece.from - piece.centre;
  const double angle = along * piece.turn_rad;
  return piece.centre + std::cos(angle) * arm + std::sin(angle) * perpendicular(arm);
}

/// Adds the exposure of a piece; `clearance` is that of a point, in the unit of the piece.
template <class Clearance>
void add_exposure(Safety& safety, const PathPiece& piece, const std::stop_token& stop, Clearance clearance) {
  const double length = length_of(piece);
  double near = clearance(piece.from);
  for (double walked = 0.0; walked < length && !stop.stop_requested();) {
    if (near < contact) {
      safety.exposure = safety.exposure_low = safety.exposure_high = infinite;
      return;
    }
    const double half = std::min(share * near, 0.5 * (length - walked));
    const double middle = clearance(point_at(piece, (walked + half) / length));
    safety.exposure += 2.0 * half / middle;
    safety.exposure_low += 2.0 * std::log1p(half / middle);
    safety.exposure_high -= 2.0 * std::log1p(-half / middle);
    near = middle - half;
    walked = 2.0 * half < length - walked ? walked + 2.0 * half : length;
  }
}

std::vector<PathPiece> pieces_of(const Plan& plan) {
  std::vector<PathPiece> pieces = plan.pieces;
  for (std::size_t i = 1; pieces.size() + 1 < plan.waypoints.size() && plan.pieces.empty(); ++i) {
    pieces.push_back({plan.waypoints[i - 1], plan.waypoints[i], {}, 0.0});
  }
  if (pieces.empty() && !plan.waypoints.empty()) {
    pieces.push_back({plan.waypoints.front(), plan.waypoints.front(), {}, 0.0});
  }
  return pieces;
}

PathPiece in_cells(PathPiece piece, const GridFrame& frame) {
  piece.from = (1.0 / frame.resolution_m) * (piece.from - frame.origin);
  piece.to = (1.0 / frame.resolution_m) * (piece.to - frame.origin);
  piece.centre = (1.0 / frame.resolution_m) * (piece.centre - frame.origin);
  return piece;
}

}  // namespace

double clearance_m(const Plan& plan, const GridMap& ground, const std::vector<Vec2>& outline, double most_m) {
  double least = most_m / ground.frame.resolution_m;
  for (const PathPiece& piece : pieces_of(plan)) {
    least = std::min(least, clearance_on_grid(ground, in_cells(piece, ground.frame).from));
    least = clearance_on_grid(ground, {piece, heading_in(piece), outline, ground.frame}, least);
  }
  return ground.frame.resolution_m * least;
}

double clearance_m(const Plan& plan, const CollisionMap& ground, const std::vector<Vec2>& outline) {
  std::vector<Box2> boxes;
  for (const RoundedPolygon& obstacle : ground.obstacles()) boxes.push_back(obstacle.bounds());
  const Box2& bounds = ground.bounds();
  double least = infinite;
  for (const std::vector<Vec2>& hull : swept_hulls(plan, outline)) {
    Box2 around;
    for (const Vec2 p : hull) {
      around.include(p);
      least =
          std::min({least, p.x - bounds.low.x, bounds.high.x - p.x, p.y - bounds.low.y, bounds.high.y - p.y});
    }
    const Footprint swept({hull, 0.0});
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      if (boxes[i].overlaps(around.grown(std::max(0.0, least))))
        least = std::min(least, swept.gap_m(Pose2{}, ground.obstacles()[i]));
    }
  }
  return least;
}

Safety safety_of(const Plan& plan, const Problem& problem, const std::stop_token& stop) {
  Safety safety;
  for (const PathPiece& piece : pieces_of(plan)) {
    if (problem.polygons) {
      const PolygonGround& ground = *problem.polygons;
      add_exposure(safety, piece, stop, [&](Vec2 p) { return ground.edge_distance(p); });
      continue;
    }
    const GridMap& ground = *problem.grid;
    add_exposure(safety, in_cells(piece, ground.frame), stop,
                 [&](Vec2 p) { return clearance_on_grid(ground, p); });
  }
  safety.clearance_m = problem.polygons ? clearance_m(plan, *problem.polygons)
                                        : clearance_m(plan, *problem.grid, problem.outline, infinite);
  return safety;
}

}  // namespace outrider
