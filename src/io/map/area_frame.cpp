#include "outrider/io/map/area_frame.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "outrider/core/text.hpp"
#include "outrider/core/units.hpp"

namespace outrider {
namespace {

// WGS 84, NIMA TR8350.2 (2000), and the third flattening n.
constexpr double equator_m = 6378137.0, flattening = 1.0 / 298.257223563;
constexpr double n = flattening / (2.0 - flattening), n2 = n * n, n3 = n2 * n;
constexpr double mean_m = equator_m / (1.0 + n) * (1.0 + n2 / 4.0 + n2 * n2 / 64.0);
constexpr double alpha[] = {n / 2.0 - 2.0 * n2 / 3.0 + 5.0 * n3 / 16.0, 13.0 * n2 / 48.0 - 3.0 * n3 / 5.0,
                            61.0 * n3 / 240.0};
constexpr double beta[] = {n / 2.0 - 2.0 * n2 / 3.0 + 37.0 * n3 / 96.0, n2 / 48.0 + n3 / 15.0,
                           17.0 * n3 / 480.0};

/// Adds sign x the series of Krueger: x is the northing and y the easting, both over the mean radius.
Vec2 corrected(Vec2 p, const double (&series)[3], double sign) {
  Vec2 result = p;
  for (int j = 1; j <= 3; ++j) {
    result.x += sign * series[j - 1] * std::sin(2.0 * j * p.x) * std::cosh(2.0 * j * p.y);
    result.y += sign * series[j - 1] * std::cos(2.0 * j * p.x) * std::sinh(2.0 * j * p.y);
  }
  return result;
}

/// Returns by how much the isometric latitude of the ellipsoid is less than that of the sphere.
double isometric_correction(double sine) {
  const double eccentricity = 2.0 * std::sqrt(n) / (1.0 + n);
  return eccentricity * std::atanh(eccentricity * sine);
}

/// Projects longitude and latitude to metres east of the meridian and north of the equator.
Vec2 projected(Vec2 lon_lat, double meridian_deg) {
  const double east = radians(lon_lat.x - meridian_deg), sine = std::sin(radians(lon_lat.y));
  const double t = std::sinh(std::atanh(sine) - isometric_correction(sine));
  const Vec2 sphere{std::atan2(t, std::cos(east)), std::atanh(std::sin(east) / std::sqrt(1.0 + t * t))};
  const Vec2 at = corrected(sphere, alpha, 1.0);
  return {mean_m * at.y, mean_m * at.x};
}

Vec2 unprojected(Vec2 metres, double meridian_deg) {
  const Vec2 at = corrected({metres.y / mean_m, metres.x / mean_m}, beta, -1.0);
  const double conformal_sine = std::sin(at.x) / std::cosh(at.y);
  double sine = conformal_sine;
  for (int i = 0; i < 6; ++i)  // each is 150 times as near
    sine = std::tanh(std::atanh(conformal_sine) + isometric_correction(sine));
  return {meridian_deg + degrees(std::atan2(std::sinh(at.y), std::cos(at.x))), degrees(std::asin(sine))};
}

}  // namespace

AreaFrame AreaFrame::of_degrees(const Box2& box) {
  return {true, box.low, 0.5 * (box.low.x + box.high.x), {}};
}

AreaFrame AreaFrame::of_metres(const Box2& box, double near_m) {
  const double farthest =
      std::max({std::abs(box.low.x), std::abs(box.low.y), std::abs(box.high.x), std::abs(box.high.y)});
  if (farthest <= near_m) return {};
  return {false, {std::floor(box.low.x), std::floor(box.low.y)}, 0.0, {}};
}

Vec2 AreaFrame::to_local(Vec2 in_file) const {
  if (!degrees) return in_file - origin;
  return projected(in_file, meridian_deg) - projected(origin, meridian_deg);
}

std::string place_text(const AreaFrame& frame, Vec2 local) {
  const Vec2 at = frame.to_file(local);
  if (!frame.degrees) return place_text(at.x, at.y);
  return fmt::format("({:.7f}, {:.7f})", at.x, at.y);  // to the centimetre
}

std::string sentence_of(const AreaFrame& frame) {
  return frame.degrees
             ? fmt::format("metres east and north of longitude {:.6f}, latitude {:.6f}", frame.origin.x,
                           frame.origin.y)
             : fmt::format("metres east and north of ({:.0f}, {:.0f})", frame.origin.x, frame.origin.y);
}

Vec2 AreaFrame::to_file(Vec2 local) const {
  if (!degrees) return local + origin;
  return unprojected(local + projected(origin, meridian_deg), meridian_deg);
}

}  // namespace outrider
