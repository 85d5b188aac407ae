// Polygon environments: what loads is made into a ground, or refused in a sentence.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>
#include <utility>

#include "fuzz_entry.hpp"
#include "outrider/io/map/polygons.hpp"
#include "outrider/path/visibility/polygon_ground.hpp"

extern "C" int FUZZ_ENTRY(polygons)(const std::uint8_t* data, std::size_t size) {
  const std::string_view input(reinterpret_cast<const char*>(data), size);
  auto map = outrider::polygon_map_from_text(input, "map.txt");
  if (!map) {
    if (map.error().sentence.empty()) std::abort();
    return 0;
  }
  const auto ground = outrider::PolygonGround::of(std::move(map->boundary), std::move(map->obstacles), 0.18);
  if (!ground && ground.error().sentence.empty()) std::abort();
  if (ground && ground->edges.size() < 3) std::abort();
  return 0;
}
