#include "range_bias.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace outrider {
namespace {

constexpr double near_m = 0.25;        ///< farthest apart that two points of one wall may lie
constexpr double least_cosine = 0.95;  ///< between normals of one wall
constexpr double most_off_m = 0.2;     ///< across the wall; beyond, it is another one
constexpr double least_information = 100.0;

/// A point of a wall in the world, and the direction of the beam that hit it.
struct HitPoint {
  Vec2 position;
  Vec2 normal;
  Vec2 beam;
};

/// Returns the points with a normal, by rising x.
std::vector<HitPoint> hit_points(const Surface& surface, const Pose2& world_T_robot, Vec2 robot_T_laser) {
  std::vector<HitPoint> points;
  for (const SurfacePoint& point : surface) {
    const Vec2 from_laser = point.position - robot_T_laser;
    if (point.normal == Vec2{} || norm(from_laser) == 0.0) continue;
    points.push_back({world_T_robot * point.position, rotated(world_T_robot.heading_rad, point.normal),
                      rotated(world_T_robot.heading_rad, 1.0 / norm(from_laser) * from_laser)});
  }
  std::ranges::stable_sort(points, {}, [](const HitPoint& point) { return point.position.x; });
  return points;
}

/// Returns the nearest of the points, which rise in x; null if none is near.
const HitPoint* nearest(const std::vector<HitPoint>& points, Vec2 place) {
  const auto x_of = [](const HitPoint& point) { return point.position.x; };
  const HitPoint* found = nullptr;
  double least_m = near_m;
  for (auto at = std::ranges::lower_bound(points, place.x - near_m, {}, x_of);
       at != points.end() && at->position.x <= place.x + near_m; ++at) {
    const double away_m = distance(at->position, place);
    if (away_m >= least_m) continue;
    least_m = away_m;
    found = &*at;
  }
  return found;
}

/// The normal equation of the bias.
struct BiasSum {
  double information = 0.0;
  double moment_m = 0.0;

  void add(const HitPoint& a, const HitPoint& b) {
    const double off_m = dot(b.normal, a.position - b.position);
    if (dot(a.normal, b.normal) < least_cosine || std::abs(off_m) > most_off_m) return;
    const double by_bias = dot(b.normal, a.beam - b.beam);
    information += by_bias * by_bias;
    moment_m += by_bias * off_m;
  }
};

}  // namespace

double range_bias_m(const KeyframeGraph& graph, KeyframeSurfaces& surfaces) {
  constexpr std::array<std::uint32_t, 4> steps_back = {1, 3, 6, 12};
  constexpr std::size_t kept = steps_back.back() + 1;
  std::array<std::vector<HitPoint>, kept> recent;  // by keyframe, modulo their number
  BiasSum sum;
  for (std::uint32_t key = 0; key < graph.keyframes.size(); ++key) {
    const Pose2& pose = graph.keyframes[key].pose;
    recent[key % kept] = hit_points(surfaces.of(graph, key), pose, surfaces.robot_T_laser().position);
    for (const std::uint32_t back : steps_back) {
      if (back > key) break;
      const std::vector<HitPoint>& earlier = recent[(key - back) % kept];
      for (const HitPoint& point : recent[key % kept]) {
        if (const HitPoint* same = nearest(earlier, point.position)) sum.add(point, *same);
      }
    }
  }
  return sum.information < least_information ? 0.0 : sum.moment_m / sum.information;
}

}  // namespace outrider
