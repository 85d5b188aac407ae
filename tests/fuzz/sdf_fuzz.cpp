// SDF worlds: a world that loads has finite solids.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "fuzz_entry.hpp"
#include "outrider/io/sdf/sdf.hpp"

extern "C" int FUZZ_ENTRY(sdf)(const std::uint8_t* data, std::size_t size) {
  const std::string_view input(reinterpret_cast<const char*>(data), size);
  const auto loaded = outrider::sdf_from_text(input, "world.sdf");
  if (!loaded) return 0;
  for (const outrider::Solid& solid : loaded->world.solids) {
    if (!std::isfinite(norm(solid.world_T_solid.position))) std::abort();
  }
  return 0;
}
