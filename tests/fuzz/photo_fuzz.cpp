// Whatever stands in a photo, it is refused in a sentence, or has as many pixels as it says.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "fuzz_entry.hpp"
#include "outrider/io/camera/photo.hpp"

extern "C" int FUZZ_ENTRY(photo)(const std::uint8_t* data, std::size_t size) {
  using namespace outrider;
  const auto photo = photo_from_bytes({reinterpret_cast<const char*>(data), size}, "input");
  if (!photo) {
    if (photo.error().sentence.empty()) std::abort();
    return 0;
  }
  const std::size_t pixels = static_cast<std::size_t>(photo->width) * static_cast<std::size_t>(photo->height);
  if (photo->values.size() != pixels) std::abort();
  return 0;
}
