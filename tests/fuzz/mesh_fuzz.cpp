// Meshes: the first byte chooses the format; what loads has finite corners.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "fuzz_entry.hpp"
#include "outrider/io/mesh/mesh.hpp"

extern "C" int FUZZ_ENTRY(mesh)(const std::uint8_t* data, std::size_t size) {
  const std::string_view input(reinterpret_cast<const char*>(data), size);
  if (input.empty()) return 0;
  const char* const names[] = {"m.stl", "m.obj", "m.dae"};
  const auto mesh = outrider::mesh_from_bytes(input.substr(1), names[data[0] % 3]);
  if (!mesh) return 0;
  for (const outrider::Triangle& triangle : *mesh) {
    for (const outrider::Vec3 corner : triangle) {
      if (!std::isfinite(norm(corner))) std::abort();
    }
  }
  return 0;
}
