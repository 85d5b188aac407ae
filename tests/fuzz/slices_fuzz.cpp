// Slices: what loads is walls and convex polygons, and stands upright.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "fuzz_entry.hpp"
#include "outrider/io/map/slices.hpp"
#include "outrider/world/upright.hpp"

extern "C" int FUZZ_ENTRY(slices)(const std::uint8_t* data, std::size_t size) {
  const std::string_view input(reinterpret_cast<const char*>(data), size);
  const auto slices = outrider::slices_from_text(input, "s.csv");
  for (std::size_t i = 0; slices && i < slices->size(); ++i) {
    const outrider::WorldSlice& slice = (*slices)[i];
    if (slice.corners.size() < 2) std::abort();
    const outrider::Box3 box = outrider::bounds(outrider::upright(slice.corners, "it", 0.0, 0.5));
    if (!std::isfinite(box.low.x + box.low.y + box.high.x + box.high.y)) std::abort();
    if (outrider::footprint(outrider::upright(slice.corners, "it", 0.0, 0.5), 0.18, 0.18).empty())
      std::abort();
  }
  return 0;
}
