// The images of map_server maps: one that loads has all its pixels.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "fuzz_entry.hpp"
#include "map/image.hpp"

extern "C" int FUZZ_ENTRY(map_image)(const std::uint8_t* data, std::size_t size) {
  const std::string_view input(reinterpret_cast<const char*>(data), size);
  const auto image = outrider::image_from_bytes(input, "m.pgm");
  if (!image) return 0;
  const auto pixels = static_cast<std::size_t>(image->width) * static_cast<std::size_t>(image->height);
  if (image->values.size() != pixels) std::abort();
  return 0;
}
