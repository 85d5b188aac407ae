// Whatever stands in a calibration file, it is refused in a sentence, or a camera with focal lengths.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "fuzz_entry.hpp"
#include "outrider/io/camera/camera_file.hpp"

extern "C" int FUZZ_ENTRY(camera_file)(const std::uint8_t* data, std::size_t size) {
  using namespace outrider;
  const auto camera = camera_from_text({reinterpret_cast<const char*>(data), size}, "input");
  if (camera ? !(camera->fx > 0.0 && camera->fy > 0.0) : camera.error().sentence.empty()) std::abort();
  return 0;
}
