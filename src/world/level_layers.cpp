#include "outrider/world/level_layers.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace outrider {
namespace {

constexpr double thickest_m = 0.03;
constexpr double least_cosine = 0.99863;  // of 3 degrees
constexpr int side = 128;

/// A level convex surface with three or four corners, in counter-clockwise order.
struct Surface {
  std::array<Vec2, 4> corners;
  std::size_t count = 3;
  double height_m = 0.0;
  double area_m2 = 0.0;

  [[nodiscard]] std::span<const Vec2> outline() const { return {corners.data(), count}; }
};

void add_top(std::vector<Surface>& surfaces, const Pose3& pose, const BoxShape& box) {
  if (pose.rotation.axes[2].z < 1.0 - 1e-9) return;
  const Vec3 half = box.half_size;
  const auto corner = [&](double x, double y) { return xy(pose * Vec3{x * half.x, y * half.y, 0.0}); };
  surfaces.push_back({{corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1)},
                      4,
                      pose.position.z + half.z,
                      4.0 * half.x * half.y});
}

void add_level_triangles(std::vector<Surface>& surfaces, const Pose3& pose, const MeshShape& mesh) {
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3 p = pose * a;
    const Vec3 q = pose * b;
    const Vec3 r = pose * c;
    const Vec3 normal = cross(q - p, r - p);
    if (std::abs(normal.z) < least_cosine * norm(normal) || normal.z == 0.0) continue;
    const bool up = normal.z > 0.0;
    surfaces.push_back({{xy(p), up ? xy(q) : xy(r), up ? xy(r) : xy(q)},
                        3,
                        std::max({p.z, q.z, r.z}),
                        0.5 * std::abs(normal.z)});
  }
}

std::vector<Surface> level_surfaces(const World& world) {
  std::vector<Surface> surfaces;
  for (const Solid& solid : world.solids) {
    if (const auto* box = std::get_if<BoxShape>(&solid.shape)) add_top(surfaces, solid.world_T_solid, *box);
    if (const auto* mesh = std::get_if<MeshShape>(&solid.shape))
      add_level_triangles(surfaces, solid.world_T_solid, *mesh);
  }
  std::ranges::stable_sort(surfaces, {}, &Surface::height_m);
  return surfaces;
}

/// Counts the places of a raster that surfaces cover.
class Raster {
 public:
  explicit Raster(const Box2& over) : over_(over), step_((1.0 / side) * over.size()) {}

  double covered_m2(std::span<const Surface> surfaces) {
    std::ranges::fill(covered_, false);
    count_ = 0;
    for (const Surface& surface : surfaces) {
      if (count_ < covered_.size()) mark(surface.outline());
    }
    return static_cast<double>(count_) * step_.x * step_.y;
  }

 private:
  void mark(std::span<const Vec2> outline) {
    Box2 box;
    for (const Vec2 corner : outline) box.include(corner);
    const auto from = [](double t) {
      return static_cast<int>(std::clamp(std::ceil(t - 0.5), 0.0, 1.0 * side));
    };
    const int x0 = from((box.low.x - over_.low.x) / step_.x);
    const int x1 = from((box.high.x - over_.low.x) / step_.x);
    const int y0 = from((box.low.y - over_.low.y) / step_.y);
    const int y1 = from((box.high.y - over_.low.y) / step_.y);
    for (int y = y0; y < y1; ++y) {
      for (int x = x0; x < x1; ++x) {
        const Vec2 place = over_.low + Vec2{(x + 0.5) * step_.x, (y + 0.5) * step_.y};
        bool& covered = covered_[static_cast<std::size_t>(y * side + x)];
        if (covered || !inside(place, outline)) continue;
        covered = true;
        ++count_;
      }
    }
  }
  static bool inside(Vec2 p, std::span<const Vec2> outline) {
    for (std::size_t i = 0; i < outline.size(); ++i) {
      const Vec2 a = outline[i];
      if (cross(outline[(i + 1) % outline.size()] - a, p - a) < 0.0) return false;
    }
    return true;
  }

  Box2 over_;
  Vec2 step_;
  std::array<bool, static_cast<std::size_t>(side* side)> covered_{};
  std::size_t count_ = 0;  // of the covered places
};

}  // namespace

std::vector<Layer> level_layers(const World& world, const Box2& over, double least_m2) {
  std::vector<Layer> layers;
  if (over.empty() || over.size().x <= 0.0 || over.size().y <= 0.0) return layers;
  const std::vector<Surface> surfaces = level_surfaces(world);
  Raster raster(over);
  std::size_t end = 0;
  double area_m2 = 0.0;  // of the surfaces from `first` to `end`, overlaps counted each time
  for (std::size_t first = 0; first < surfaces.size();) {
    const double lowest_m = surfaces[first].height_m;
    while (end < surfaces.size() && surfaces[end].height_m <= lowest_m + thickest_m)
      area_m2 += surfaces[end++].area_m2;
    std::size_t next = first + 1;
    if (area_m2 >= least_m2) {
      const double covered_m2 = raster.covered_m2({surfaces.data() + first, end - first});
      const bool found = covered_m2 >= least_m2;
      if (found) layers.push_back({surfaces[end - 1].height_m, covered_m2});
      // A raster costs as much as all its surfaces, so the next one begins half a layer higher, or behind
      // this one.
      while (next < end && (found || surfaces[next].height_m < lowest_m + 0.5 * thickest_m)) ++next;
    }
    for (; first < next; ++first) area_m2 -= surfaces[first].area_m2;
  }
  return layers;
}

}  // namespace outrider
