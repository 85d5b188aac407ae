#include "outrider/jobs/cover/ground/region.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <polyclipping/clipper.hpp>

#include "outrider/geometry/convex.hpp"

namespace outrider {
namespace {

constexpr double per_m = 1048576.0;

ClipperLib::Path path_of(const std::vector<Vec2>& polygon, bool counter_clockwise) {
  ClipperLib::Path path;
  path.reserve(polygon.size());
  for (const Vec2 p : polygon) path.emplace_back(std::llround(p.x * per_m), std::llround(p.y * per_m));
  if (ClipperLib::Orientation(path) != counter_clockwise) ClipperLib::ReversePath(path);
  return path;
}

ClipperLib::Paths paths_of(const Region& region) {
  ClipperLib::Paths paths;
  for (const RingedPolygon& polygon : region) {
    paths.push_back(path_of(polygon.outer, true));
    for (const auto& hole : polygon.holes) paths.push_back(path_of(hole, false));
  }
  return paths;
}

std::vector<Vec2> polygon_of(const ClipperLib::Path& path) {
  std::vector<Vec2> polygon;
  polygon.reserve(path.size());
  for (const ClipperLib::IntPoint& p : path) {
    polygon.push_back({static_cast<double>(p.X) / per_m, static_cast<double>(p.Y) / per_m});
  }
  return polygon;
}

Region region_of(const ClipperLib::PolyTree& tree) {
  Region region;
  for (const ClipperLib::PolyNode* node = tree.GetFirst(); node != nullptr; node = node->GetNext()) {
    if (node->IsHole()) continue;
    RingedPolygon polygon{polygon_of(node->Contour), {}};
    for (const ClipperLib::PolyNode* hole : node->Childs) polygon.holes.push_back(polygon_of(hole->Contour));
    region.push_back(std::move(polygon));
  }
  return region;
}

Region clipped(const Region& a, const Region& b, ClipperLib::ClipType how) {
  ClipperLib::Clipper clipper;
  clipper.AddPaths(paths_of(a), ClipperLib::ptSubject, true);
  clipper.AddPaths(paths_of(b), ClipperLib::ptClip, true);
  ClipperLib::PolyTree tree;
  clipper.Execute(how, tree, ClipperLib::pftNonZero, ClipperLib::pftNonZero);
  return region_of(tree);
}

Region moved(const Region& region, double by_m, double arc_m) {
  ClipperLib::ClipperOffset offset(2.0, std::max(1.0, arc_m * per_m));
  offset.AddPaths(paths_of(region), ClipperLib::jtRound, ClipperLib::etClosedPolygon);
  ClipperLib::PolyTree tree;
  offset.Execute(tree, by_m * per_m);
  return region_of(tree);
}

double signed_area(const std::vector<Vec2>& polygon) {
  double double_area = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    double_area += cross(polygon[i] - polygon[0], polygon[(i + 1) % polygon.size()] - polygon[0]);
  }
  return 0.5 * double_area;
}

enum class Side { outside, border, inside };

Side side_of(const std::vector<Vec2>& polygon, Vec2 p) {
  bool inside = false;
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    const Vec2 a = polygon[j], b = polygon[i];
    const double turn = cross(b - a, p - a);
    if (turn == 0.0 && dot(p - a, p - b) <= 0.0) return Side::border;
    if ((a.y > p.y) != (b.y > p.y) && (turn > 0.0) == (b.y > a.y)) inside = !inside;
  }
  return inside ? Side::inside : Side::outside;
}

}  // namespace

double area_of(const RingedPolygon& polygon) {
  double area = std::abs(signed_area(polygon.outer));
  for (const auto& hole : polygon.holes) area -= std::abs(signed_area(hole));
  return area;
}

double area_of(const Region& region) {
  double area = 0.0;
  for (const RingedPolygon& polygon : region) area += area_of(polygon);
  return area;
}

Region opened(const Region& region, double by_m, double arc_m) {
  return common(grown(shrunk(region, by_m, arc_m), by_m, arc_m), region);
}

std::vector<Segment> edges_of(const Region& region) {
  std::vector<Segment> edges;
  const auto add = [&](const std::vector<Vec2>& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) edges.push_back({ring[i], ring[(i + 1) % ring.size()]});
  };
  for (const RingedPolygon& polygon : region) {
    add(polygon.outer);
    std::ranges::for_each(polygon.holes, add);
  }
  return edges;
}

Vec2 middle_of(const RingedPolygon& polygon) {
  const Vec2 origin = polygon.outer.front();
  Vec2 sum;
  double doubled = 0.0;
  for (std::size_t i = 0; i < polygon.outer.size(); ++i) {
    const Vec2 a = polygon.outer[i] - origin, b = polygon.outer[(i + 1) % polygon.outer.size()] - origin;
    sum = sum + (cross(a, b) / 3.0) * (a + b);
    doubled += cross(a, b);
  }
  return doubled != 0.0 ? origin + (1.0 / doubled) * sum : origin;
}

Box2 bounds_of(const Region& region) {
  Box2 box;
  for (const RingedPolygon& polygon : region) {
    for (const Vec2 p : polygon.outer) box.include(p);
  }
  return box;
}

bool contains(const RingedPolygon& polygon, Vec2 p) {
  return side_of(polygon.outer, p) != Side::outside &&
         std::none_of(polygon.holes.begin(), polygon.holes.end(),
                      [&](const auto& hole) { return side_of(hole, p) == Side::inside; });
}

bool contains(const Region& region, Vec2 p) {
  return std::any_of(region.begin(), region.end(), [&](const auto& polygon) { return contains(polygon, p); });
}

double distance_to_border(const RingedPolygon& polygon, Vec2 p) {
  double least = std::numeric_limits<double>::infinity();
  const auto look_at = [&](const std::vector<Vec2>& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      least = std::min(least, distance(p, Segment{ring[i], ring[(i + 1) % ring.size()]}));
    }
  };
  look_at(polygon.outer);
  for (const auto& hole : polygon.holes) look_at(hole);
  return least;
}

Region region_of(const std::vector<Vec2>& outer, const std::vector<std::vector<Vec2>>& holes) {
  Region solid;
  for (const auto& hole : holes) solid.push_back({hole, {}});
  return without({{outer, {}}}, solid);
}

Region united(const Region& a, const Region& b) { return clipped(a, b, ClipperLib::ctUnion); }
Region common(const Region& a, const Region& b) { return clipped(a, b, ClipperLib::ctIntersection); }
Region without(const Region& a, const Region& b) { return clipped(a, b, ClipperLib::ctDifference); }

Region grown(const Region& region, double by_m, double arc_m) { return moved(region, by_m, arc_m); }
Region shrunk(const Region& region, double by_m, double arc_m) { return moved(region, -by_m, arc_m); }

Region united(const std::vector<Region>& all) {
  ClipperLib::Clipper clipper;
  for (const Region& region : all) clipper.AddPaths(paths_of(region), ClipperLib::ptSubject, true);
  ClipperLib::PolyTree tree;
  clipper.Execute(ClipperLib::ctUnion, tree, ClipperLib::pftNonZero);
  return region_of(tree);
}

}  // namespace outrider
