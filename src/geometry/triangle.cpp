#include "outrider/geometry/triangle.hpp"

namespace outrider {

// Finds the closest point by the Voronoi regions of the triangle.
double distance_to_triangle(Vec3 p, const std::array<Vec3, 3>& t) {
  const Vec3 ab = t[1] - t[0];
  const Vec3 ac = t[2] - t[0];
  const double d1 = dot(ab, p - t[0]);
  const double d2 = dot(ac, p - t[0]);
  if (d1 <= 0.0 && d2 <= 0.0) return norm(p - t[0]);
  const double d3 = dot(ab, p - t[1]);
  const double d4 = dot(ac, p - t[1]);
  if (d3 >= 0.0 && d4 <= d3) return norm(p - t[1]);
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return norm(p - (t[0] + d1 / (d1 - d3) * ab));
  const double d5 = dot(ab, p - t[2]);
  const double d6 = dot(ac, p - t[2]);
  if (d6 >= 0.0 && d5 <= d6) return norm(p - t[2]);
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return norm(p - (t[0] + d2 / (d2 - d6) * ac));
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0) {
    const double w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return norm(p - (t[1] + w * (t[2] - t[1])));
  }
  const double scale = 1.0 / (va + vb + vc);
  return norm(p - (t[0] + vb * scale * ab + vc * scale * ac));
}

}  // namespace outrider
