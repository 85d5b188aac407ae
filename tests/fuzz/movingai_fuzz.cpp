// MovingAI maps and scenarios: a map that loads has all its cells.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "fuzz_entry.hpp"
#include "outrider/io/map/movingai.hpp"

extern "C" int FUZZ_ENTRY(movingai)(const std::uint8_t* data, std::size_t size) {
  const std::string_view input(reinterpret_cast<const char*>(data), size);
  const auto map = outrider::movingai_map_from_text(input, "m.map");
  if (map && map->cells.size() != map->frame.size()) std::abort();
  const auto queries = outrider::movingai_scenario_from_text(input, "m.scen");
  if (!queries) return 0;
  for (const outrider::MovingAiQuery& query : *queries) {
    if (query.start.y < 0 || query.goal.y < 0) std::abort();
  }
  return 0;
}
