// Sheet: the drawing of a plan view in pixels, with a legend of exactly what was drawn. Path data is empty if
// it would hold a number that is not finite.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "outrider/geometry/box.hpp"
#include "outrider/geometry/convex.hpp"

namespace outrider::picture {

/// Samples of a legend, 30 x 14 px: a line, an area, and the shape of a disk as a mark.
inline constexpr std::string_view line_sample = "M1 7H29", area_sample = "M3 1H27V13H3Z";
inline constexpr std::string_view small_disk = "m-4 0a4 4 0 1 0 8 0a4 4 0 1 0-8 0z",
                                  cross = "m-4-4l8 8m0-8l-8 8";

std::string escaped(std::string_view text);
/// Returns a colour between two, as "#rrggbb"; a share of 0 gives the first.
std::string mixed(unsigned first_rgb, unsigned last_rgb, double share);
/// Returns path data of a polyline in pixels.
std::string polyline(const std::vector<Vec2>& points_px);
/// Returns path data of a shape: relative path data that begins at its middle.
std::string shape_at(Vec2 middle_px, std::string_view shape);

struct Sheet {
  Box2 box;                ///< drawn part of the world
  double px_per_m = 1.0;   ///< scale
  double detail_px = 0.3;  ///< what is smaller is left out
  Box2 seen = {};          ///< box of everything that was drawn, m
  std::string body = {};
  std::string names = {};
  std::vector<Box2> named = {};                                   ///< places of the names, px
  std::vector<std::pair<std::string, std::string>> entries = {};  ///< of the legend: words and sample

  Vec2 at(Vec2 world);
  std::string line(const std::vector<Vec2>& points);
  std::string area(const std::vector<Vec2>& corners);
  std::string area(const RoundedPolygon& shape);
  /// The ellipse of two standard deviations.
  std::string ellipse(Vec2 centre, double variance_x, double covariance, double variance_y);

  /// Draws a path in a class of the style sheet. Words that are new to the legend are added with the sample.
  void put(std::string_view kind, const std::string& path, std::string_view sample = {},
           const std::string& words = {}, const std::string& style = {});
  /// Draws a mark at each place, or at an even selection of very many places.
  void marks(std::string_view kind, const std::vector<Vec2>& places, std::string_view shape,
             const std::string& words);
  /// Writes a name beside a place, unless it would cover another name.
  void name(Vec2 place, const std::string& text);
  /// Returns the legend in columns below `top_px`, and sets its height.
  [[nodiscard]] std::string legend(double left_px, double top_px, double width_px, double& height_px) const;
};

}  // namespace outrider::picture
