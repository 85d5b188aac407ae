#include <fmt/format.h>

#include "files/yaml.hpp"
#include "map/area_formats.hpp"

namespace outrider {
namespace {

Outcome<AreaRing> ring_of(const YAML::Node& ring_node, const std::string& name) {
  const YAML::Node points = ring_node.IsMap() ? ring_node["points"] : YAML::Node();
  if (!points.IsDefined() || !points.IsSequence()) {
    return bad_input("a ring has a list of points", yaml_where(name, ring_node));
  }
  AreaRing ring{{}, yaml_where(name, points)};
  for (const YAML::Node& point : points) {
    const auto x = point.IsMap() ? yaml_number(point["x"]) : std::nullopt;
    const auto y = point.IsMap() ? yaml_number(point["y"]) : std::nullopt;
    if (!x || !y) return bad_input("a corner is {x: 1.5, y: -2} in metres", yaml_where(name, point));
    ring.corners.push_back({*x, *y});
  }
  return ring;
}

}  // namespace

Outcome<AreaRings> rings_from_yaml(std::string_view text, const std::string& name) {
  auto root = yaml_map(text, name);
  if (!root) return pass_on(root);
  YAML::Node polygon = *root;
  for (int depth = 0; depth < 2 && polygon["polygon"].IsDefined() && polygon["polygon"].IsMap(); ++depth) {
    polygon.reset(polygon["polygon"]);
  }
  if (!polygon["hull"].IsDefined()) {
    return bad_input("it has no polygon with a hull; write polygon: {hull: {points: [...]}, holes: [...]}",
                     yaml_where(name, polygon));
  }
  AreaRings rings;
  auto hull = ring_of(polygon["hull"], name);
  if (!hull) return pass_on(hull);
  rings.push_back(std::move(*hull));
  const YAML::Node holes = polygon["holes"];
  if (holes.IsDefined() && !holes.IsNull() && !holes.IsSequence()) {
    return bad_input("holes are a list of rings", yaml_where(name, holes));
  }
  for (std::size_t i = 0; holes.IsDefined() && i < holes.size(); ++i) {
    auto hole = ring_of(holes[i], name);
    if (!hole) return pass_on(hole);
    rings.push_back(std::move(*hole));
  }
  return rings;
}

}  // namespace outrider
