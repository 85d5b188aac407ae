// Areas to cover, in each of their formats: what loads has a boundary, or is refused in a sentence.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "fuzz_entry.hpp"
#include "outrider/io/map/cover_area.hpp"

extern "C" int FUZZ_ENTRY(cover_area)(const std::uint8_t* data, std::size_t size) {
  const std::string_view input(reinterpret_cast<const char*>(data), size);
  for (const char* name : {"area.json", "area.xml", "area.yaml", "area.txt"}) {
    const auto area = outrider::cover_area_from_text(input, name, outrider::Units::told_by_size);
    if (!area && area.error().sentence.empty()) std::abort();
    if (area && area->polygons.empty()) std::abort();
    if (area && area->polygons.front().boundary.corners.size() < 3) std::abort();
  }
  return 0;
}
