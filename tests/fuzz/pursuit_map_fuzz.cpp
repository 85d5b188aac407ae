// Pursuit maps: a problem that loads has its cells, and everyone stands on them.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "fuzz_entry.hpp"
#include "outrider/io/map/pursuit_map.hpp"

extern "C" int FUZZ_ENTRY(pursuit_map)(const std::uint8_t* data, std::size_t size) {
  const std::string_view input(reinterpret_cast<const char*>(data), size);
  const auto problem = outrider::pursuit_map_from_text(input, "m.txt");
  if (!problem) return 0;
  if (problem->costs->cells.size() != problem->costs->frame.size()) std::abort();
  if (!problem->costs->contains(problem->start) || problem->target.empty()) std::abort();
  for (const outrider::Cell cell : problem->target) {
    if (!problem->costs->contains(cell)) std::abort();
  }
  return 0;
}
