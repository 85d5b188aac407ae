// Terrain: a field that loads has a finite distance from every place.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "fuzz_entry.hpp"
#include "outrider/io/map/terrain.hpp"

extern "C" int FUZZ_ENTRY(terrain)(const std::uint8_t* data, std::size_t size) {
  const std::string_view input(reinterpret_cast<const char*>(data), size);
  const auto field = input.starts_with("\x89PNG")
                         ? outrider::terrain_from_png(input, "terrain.png", {}, {10.0, 10.0, 1.0})
                         : outrider::terrain_from_grid(input, "terrain.asc");
  if (!field) return 0;
  if (!std::isfinite(field->distance({1.0, 2.0, field->highest_m() + 1.0}))) std::abort();
  return 0;
}
