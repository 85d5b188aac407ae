#include "outrider/motion/footprint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "outrider/core/units.hpp"

namespace outrider {
namespace {

constexpr std::size_t most_corners = 32;
constexpr double most_m = 100.0;  // a side of a robot

/// Returns the sum of the angles by which the border turns left at its corners: one turn if it is simple.
double turned_rad(const std::vector<Vec2>& core) {
  double sum = 0.0;
  for (std::size_t i = 0; i < core.size(); ++i) {
    const Vec2 in = core[(i + 1) % core.size()] - core[i];
    const Vec2 out = core[(i + 2) % core.size()] - core[(i + 1) % core.size()];
    sum += std::atan2(cross(in, out), dot(in, out));
  }
  return sum;
}

}  // namespace

Footprint::Footprint(RoundedPolygon shape) : shape_(std::move(shape)) {
  inner_m_ = -signed_distance(Vec2{}, shape_);
  for (const Vec2 corner : shape_.core) outer_m_ = std::max(outer_m_, norm(corner) + shape_.radius_m);
}

Footprint Footprint::disk(double radius_m) { return Footprint(RoundedPolygon{{Vec2{}}, radius_m}); }

double Footprint::gap_m(const Pose2& pose, const RoundedPolygon& thing) const {
  RoundedPolygon placed{{}, shape_.radius_m};
  for (const Vec2 corner : shape_.core) placed.core.push_back(pose * corner);
  double least = signed_distance(thing.core.front(), placed) - thing.radius_m;  // the thing may be inside
  for (std::size_t i = 0; i < placed.core.size(); ++i) {
    const Segment side{placed.core[i], placed.core[(i + 1) % placed.core.size()]};
    least = std::min(least, signed_distance(side, thing) - placed.radius_m);
  }
  return least;
}

Status check_footprint(const RoundedPolygon& shape) {
  const auto& core = shape.core;
  const auto refuse = [](std::string sentence) { return bad_input(std::move(sentence), "footprint"); };
  if (core.empty() || core.size() > most_corners)
    return refuse(fmt::format("a footprint has 1 to {} corners, this one has {}", most_corners, core.size()));
  const bool has_size = shape.radius_m > 0.0 || core.size() >= 3;
  const bool in_range = shape.radius_m >= 0.0 && shape.radius_m <= most_m;
  if (!has_size || !in_range)
    return refuse(fmt::format("the radius of a footprint must be more than 0 and at most {} m", most_m));
  for (std::size_t i = 0; i < core.size(); ++i) {
    const Vec2 a = core[i], b = core[(i + 1) % core.size()], c = core[(i + 2) % core.size()];
    if (!finite(a) || norm(a) > most_m)
      return refuse(fmt::format("corner {} of the footprint is not within {} m of the robot", i + 1, most_m));
    if (core.size() > 2 && cross(b - a, c - b) <= 0.0)
      return refuse(
          fmt::format("the footprint does not turn left at corner {}; list the corners of a convex polygon "
                      "counter-clockwise",
                      (i + 1) % core.size() + 1));
  }
  if (core.size() > 2 && turned_rad(core) > 2.5 * pi)
    return refuse(
        "the footprint goes around more than once; list the corners of a convex polygon counter-clockwise");
  if (signed_distance(Vec2{}, shape) >= 0.0)
    return refuse("the origin of the robot, about which it turns, is outside its footprint");
  return {};
}

Outcome<RoundedPolygon> parse_footprint(const std::string& text) {
  RoundedPolygon shape;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    const char* at = word.c_str();
    char* end = nullptr;
    const double first = std::strtod(at, &end);
    if (end != at && *end == '\0' && shape.core.empty() && (words >> std::ws).eof()) {
      shape = {{Vec2{}}, first};
      break;
    }
    const bool pair = end != at && *end == ',';
    const char* const rest = pair ? end + 1 : end;
    const double second = pair ? std::strtod(rest, &end) : 0.0;
    if (!pair || end == rest || *end != '\0')
      return bad_input(
          fmt::format("'{}' is no corner of a footprint; write corners as x,y in metres, or one radius",
                      word.substr(0, 40)),
          "footprint");
    shape.core.push_back({first, second});
    if (shape.core.size() > most_corners) break;
  }
  if (auto status = check_footprint(shape); !status) return pass_on(status);
  return shape;
}

}  // namespace outrider
