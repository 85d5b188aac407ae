#include "outrider/estimate/camera.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "outrider/core/units.hpp"

namespace outrider {
namespace {

constexpr int longest_side_px = 100'000;
constexpr double least_depth_m = 1e-6;
constexpr int bend_steps = 64;

/// The distorted image of a point of the plane z = 1, and the columns of its derivative.
struct Bent {
  Vec2 point;
  Vec2 by_x;
  Vec2 by_y;
};

Bent bend(const std::array<double, 5>& lens, Vec2 p) {
  const auto [k1, k2, p1, p2, k3] = lens;
  const double x = p.x, y = p.y, r2 = x * x + y * y;
  const double radial = 1.0 + r2 * (k1 + r2 * (k2 + r2 * k3));
  const double slope = 2.0 * (k1 + r2 * (2.0 * k2 + r2 * 3.0 * k3));  // (d radial / dx) / x, also for y
  const double both = slope * x * y + 2.0 * p1 * x + 2.0 * p2 * y;
  return {
      {x * radial + 2.0 * p1 * x * y + p2 * (r2 + 2.0 * x * x),
       y * radial + p1 * (r2 + 2.0 * y * y) + 2.0 * p2 * x * y},
      {radial + slope * x * x + 2.0 * p1 * y + 6.0 * p2 * x, both},
      {both, radial + slope * y * y + 6.0 * p1 * y + 2.0 * p2 * x},
  };
}

bool is_pinhole(const Camera& camera) {
  return std::ranges::all_of(camera.distortion, [](double k) { return k == 0.0; });
}

/// Returns true if the distortion keeps orientation all the way from the axis to p.
bool unfolded(const Camera& camera, Vec2 p) {
  for (int i = 1; i <= bend_steps; ++i) {
    const Bent bent = bend(camera.distortion, (static_cast<double>(i) / bend_steps) * p);
    if (!(cross(bent.by_x, bent.by_y) > 0.0)) return false;
  }
  return true;
}

Vec2 without_lens(const Camera& camera, Vec2 image) {
  return {(image.x - 0.5 - camera.cx) / camera.fx, (image.y - 0.5 - camera.cy) / camera.fy};
}

}  // namespace

Status check_camera(const Camera& camera) {
  const double numbers[] = {camera.fx, camera.fy, camera.cx, camera.cy};
  const bool finite = std::ranges::all_of(numbers, [](double n) { return std::isfinite(n); }) &&
                      std::ranges::all_of(camera.distortion, [](double k) { return std::isfinite(k); });
  if (!finite)
    return bad_input("the camera matrix or the distortion holds what is no number; calibrate again");
  if (camera.fx <= 0.0 || camera.fy <= 0.0) {
    return bad_input(fmt::format("the camera matrix is singular: fx = {:g} and fy = {:g} must be above 0 px",
                                 camera.fx, camera.fy));
  }
  if (camera.width_px < 1 || camera.height_px < 1 || camera.width_px > longest_side_px ||
      camera.height_px > longest_side_px) {
    return bad_input(fmt::format("an image of {} x {} pixels is none; sides go from 1 to {}", camera.width_px,
                                 camera.height_px, longest_side_px));
  }
  if (is_pinhole(camera)) return {};
  const double right = camera.width_px, low = camera.height_px;
  for (const Vec2 corner : {Vec2{0, 0}, Vec2{right, 0}, Vec2{0, low}, Vec2{right, low}}) {
    const Vec2 ray = ray_through(camera, corner);
    const Vec2 error = bend(camera.distortion, ray).point - without_lens(camera, corner);
    if (unfolded(camera, ray) && norm(error) < 1e-6) continue;
    return bad_input("the distortion folds the image over itself before its corners; calibrate again");
  }
  return {};
}

std::optional<Vec2> project(const Camera& camera, Vec3 point) {
  if (!(point.z > least_depth_m)) return std::nullopt;
  Vec2 p{point.x / point.z, point.y / point.z};
  if (!is_pinhole(camera)) {
    if (!unfolded(camera, p)) return std::nullopt;
    p = bend(camera.distortion, p).point;
  }
  return Vec2{camera.fx * p.x + camera.cx + 0.5, camera.fy * p.y + camera.cy + 0.5};
}

Vec2 ray_through(const Camera& camera, Vec2 image) {
  const Vec2 wanted = without_lens(camera, image);
  if (is_pinhole(camera)) return wanted;
  Vec2 p = wanted;
  for (int step = 0; step < 20; ++step) {
    const Bent bent = bend(camera.distortion, p);
    const Vec2 error = wanted - bent.point;
    const double det = cross(bent.by_x, bent.by_y);
    if (det == 0.0) break;
    const Vec2 move{cross(error, bent.by_y) / det, cross(bent.by_x, error) / det};
    p = p + move;
    if (squared_norm(move) < 1e-26) break;
  }
  return p;
}

Pose3 looking_ahead(Vec3 position, double yaw_rad, double pitch_rad) {
  const Rotation ahead{{Vec3{0, -1, 0}, Vec3{0, 0, -1}, Vec3{1, 0, 0}}};
  return {position, Rotation::from_rpy(0.0, pitch_rad, yaw_rad) * ahead};
}

}  // namespace outrider
