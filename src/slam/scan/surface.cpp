#include "scan/surface.hpp"

#include <algorithm>
#include <cmath>

#include "graph/graph_edges.hpp"

namespace outrider {
namespace {

constexpr double spacing_m = 0.05;
constexpr double filled_to_m = 0.1;
constexpr double breadth_m = 0.12;

struct End {
  Vec2 position;  ///< in the frame of the laser
  double range_m = 0.0;
  bool joined = false;  ///< on one surface with the next
};

/// Returns true if the ends a and b of neighbouring beams lie on one surface.
bool on_one_surface(const End& a, const End& b, double step_rad) {
  constexpr double surely_m = 0.15;
  constexpr double steps = 6.0;
  constexpr double least_sine = 0.17;  // 10 degrees
  const Vec2 between = b.position - a.position;
  const double gap_m = norm(between);
  if (gap_m <= surely_m) return true;
  const double near_m = std::min(a.range_m, b.range_m);
  const Vec2 beam = a.position + b.position;
  return gap_m <= steps * near_m * std::abs(step_rad) &&
         std::abs(cross(between, beam)) >= least_sine * gap_m * norm(beam);
}

std::vector<End> ends_of(const LaserScan& scan, double reach_m) {
  std::vector<End> ends;
  const double most_m = std::min(scan.most_m, reach_m);
  bool follows = false;
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    const auto range_m = static_cast<double>(scan.ranges_m[i]);
    const bool hits = range_m >= scan.least_m && range_m <= most_m && range_m > 0.0;
    if (hits) {
      const double bearing = scan.first_rad + static_cast<double>(i) * scan.step_rad;
      ends.push_back({range_m * direction(bearing), range_m, false});
      if (follows) {
        End& before = ends[ends.size() - 2];
        before.joined = on_one_surface(before, ends.back(), scan.step_rad);
      }
    }
    follows = hits;
  }
  return ends;
}

/// Returns the normal of the line through the joined ends within `breadth_m` to both sides.
Vec2 normal_at(const std::vector<End>& ends, std::size_t i) {
  std::size_t low = i, high = i;
  while (low > 0 && ends[low - 1].joined && distance(ends[low].position, ends[i].position) < breadth_m) --low;
  while (ends[high].joined && distance(ends[high].position, ends[i].position) < breadth_m) ++high;
  const Vec2 along = ends[high].position - ends[low].position;
  const double length_m = norm(along);
  if (length_m < spacing_m) return {};
  const Vec2 normal = (1.0 / length_m) * perpendicular(along);
  return dot(normal, ends[i].position) > 0.0 ? -normal : normal;
}

}  // namespace

Surface surface_of(const LaserScan& scan, const Pose2& robot_T_laser, double reach_m) {
  const std::vector<End> ends = ends_of(scan, reach_m);
  Surface surface;
  const auto add = [&](Vec2 position, Vec2 normal) {
    surface.push_back({robot_T_laser * position, rotated(robot_T_laser.heading_rad, normal)});
  };
  Vec2 last{1e9, 1e9};
  for (std::size_t i = 0; i < ends.size(); ++i) {
    const Vec2 here = ends[i].position;
    if (distance(here, last) >= spacing_m) {
      add(here, normal_at(ends, i));
      last = here;
    }
    if (!ends[i].joined) continue;
    const Vec2 way = ends[i + 1].position - here;
    const int parts = static_cast<int>(std::ceil(norm(way) / filled_to_m));
    if (parts < 2) continue;
    Vec2 normal = (1.0 / norm(way)) * perpendicular(way);
    if (dot(normal, here) > 0.0) normal = -normal;
    for (int k = 1; k < parts; ++k) add(here + (static_cast<double>(k) / parts) * way, normal);
  }
  return surface;
}

Surface thinned(const Surface& surface, std::size_t most) {
  if (surface.size() <= most) return surface;
  Surface result;
  for (std::size_t i = 0; i < most; ++i) result.push_back(surface[i * surface.size() / most]);
  return result;
}

}  // namespace outrider
