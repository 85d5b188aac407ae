// Vectors in the plane and in space, and rotations in space. Plain values, in metres unless stated otherwise.
#pragma once

#include <array>
#include <cmath>

namespace outrider {

struct Vec2 {
  double x = 0.0;
  double y = 0.0;

  friend constexpr Vec2 operator+(Vec2 a, Vec2 b) { return {a.x + b.x, a.y + b.y}; }
  friend constexpr Vec2 operator-(Vec2 a, Vec2 b) { return {a.x - b.x, a.y - b.y}; }
  friend constexpr Vec2 operator-(Vec2 a) { return {-a.x, -a.y}; }
  friend constexpr Vec2 operator*(double s, Vec2 a) { return {s * a.x, s * a.y}; }
  friend constexpr bool operator==(Vec2 a, Vec2 b) = default;
};

constexpr double dot(Vec2 a, Vec2 b) { return a.x * b.x + a.y * b.y; }
/// Returns the z component of the cross product; it is positive if b points to the left of a.
constexpr double cross(Vec2 a, Vec2 b) { return a.x * b.y - a.y * b.x; }
constexpr double squared_norm(Vec2 a) { return dot(a, a); }
inline double norm(Vec2 a) { return std::sqrt(squared_norm(a)); }
inline double distance(Vec2 a, Vec2 b) { return norm(b - a); }
/// Returns a, rotated by +90 degrees.
constexpr Vec2 perpendicular(Vec2 a) { return {-a.y, a.x}; }
inline double heading_of(Vec2 a) { return std::atan2(a.y, a.x); }
inline Vec2 direction(double heading_rad) { return {std::cos(heading_rad), std::sin(heading_rad)}; }
/// Transforms a vector from a frame with that heading to the parent frame. unrotated() is the inverse.
inline Vec2 rotated(double heading_rad, Vec2 v) {
  const Vec2 x = direction(heading_rad);
  return {x.x * v.x - x.y * v.y, x.y * v.x + x.x * v.y};
}
inline Vec2 unrotated(double heading_rad, Vec2 v) {
  const Vec2 x = direction(heading_rad);
  return {x.x * v.x + x.y * v.y, -x.y * v.x + x.x * v.y};
}
inline bool finite(Vec2 a) { return std::isfinite(a.x) && std::isfinite(a.y); }

struct Vec3 {
  double x = 0.0;
  double y = 0.0;
  double z = 0.0;

  friend constexpr Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend constexpr Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend constexpr Vec3 operator*(double s, Vec3 a) { return {s * a.x, s * a.y, s * a.z}; }
  friend constexpr bool operator==(Vec3 a, Vec3 b) = default;
};

constexpr double dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
constexpr Vec3 cross(Vec3 a, Vec3 b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
constexpr double squared_norm(Vec3 a) { return dot(a, a); }
inline double norm(Vec3 a) { return std::sqrt(squared_norm(a)); }
constexpr Vec2 xy(Vec3 a) { return {a.x, a.y}; }

/// A rotation in space, given by the columns of its matrix: the images of the x, y and z axes.
struct Rotation {
  std::array<Vec3, 3> axes = {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};

  /// Makes a rotation from fixed-axis roll, pitch, yaw as in SDF and URDF: R = Rz(yaw) Ry(pitch) Rx(roll).
  static Rotation from_rpy(double roll_rad, double pitch_rad, double yaw_rad);

  friend constexpr Vec3 operator*(const Rotation& r, Vec3 v) {
    return v.x * r.axes[0] + v.y * r.axes[1] + v.z * r.axes[2];
  }
  friend constexpr Rotation operator*(const Rotation& a, const Rotation& b) {
    return {{a * b.axes[0], a * b.axes[1], a * b.axes[2]}};
  }
  /// Applies the inverse rotation to v.
  [[nodiscard]] constexpr Vec3 unrotate(Vec3 v) const {
    return {dot(axes[0], v), dot(axes[1], v), dot(axes[2], v)};
  }
};

}  // namespace outrider
