// AreaFrame: the local metres of an area, and the way back to the coordinates of its file.
//
// Metres of a file whose corners lie near (0, 0) are taken as they are. Others, such as UTM coordinates, are
// moved by whole metres, so nothing is lost. Longitude and latitude in degrees (WGS 84) are projected by a
// transverse Mercator of its own meridian, in the middle of the area, with the scale 1 on it. Distances are
// then too long by at most x^2 / (2 R^2), where x is the distance from the meridian and R = 6357 km or more:
// 1.6e-6 of them in an area 0.2 degrees across, 4e-5 in one of 1 degree. The way back is exact within 0.1 mm.
// Source: Karney, Transverse Mercator with an accuracy of a few nanometers, Journal of Geodesy 85 (2011)
// 475-485, the series by Krueger up to n^3.
#pragma once

#include <string>

#include "outrider/geometry/box.hpp"

namespace outrider {

struct AreaFrame {
  bool degrees = false;  ///< the file has longitude and latitude
  Vec2 origin;           ///< of the local metres, in the coordinates of the file
  double meridian_deg = 0.0;
  std::string crs;  ///< the member "crs" of a GeoJSON file as JSON text; empty if it has none

  /// Makes the frame of degrees, whose origin is the south-west corner of the box.
  static AreaFrame of_degrees(const Box2& box);
  /// Makes the frame of metres, which moves the origin only if the box reaches farther than `near_m` from it.
  static AreaFrame of_metres(const Box2& box, double near_m);

  /// Returns true if local coordinates differ from those of the file.
  [[nodiscard]] bool moved() const { return degrees || origin != Vec2{}; }
  [[nodiscard]] Vec2 to_local(Vec2 in_file) const;
  [[nodiscard]] Vec2 to_file(Vec2 local) const;
};

/// Says where the local metres are: "metres east and north of (500000, 5400000)".
std::string sentence_of(const AreaFrame& frame);

/// Returns a place for a sentence, in the coordinates of the file: "(11.5678901, 48.1234567)".
std::string place_text(const AreaFrame& frame, Vec2 local);

}  // namespace outrider
