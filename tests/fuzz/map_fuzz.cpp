// The kind of a map: an image, text or a world is taken for one kind, whatever its name.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "fuzz_entry.hpp"
#include "outrider/io/map/map.hpp"

extern "C" int FUZZ_ENTRY(map)(const std::uint8_t* data, std::size_t size) {
  const std::string_view input(reinterpret_cast<const char*>(data), size);
  const auto by_content = outrider::map_kind(input, "map");
  const auto named = outrider::map_kind(input, "m.txt.gz");
  if (!named) std::abort();
  if (by_content && *by_content != *named) std::abort();
  if (!by_content && *named != outrider::MapKind::polygons) std::abort();
  return 0;
}
