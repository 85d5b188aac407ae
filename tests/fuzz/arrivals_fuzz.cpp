// Entrances and schedules: what loads is inside the yard, and in the order of entering.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "fuzz_entry.hpp"
#include "outrider/jobs/guard/yard/inputs.hpp"

extern "C" int FUZZ_ENTRY(arrivals)(const std::uint8_t* data, std::size_t size) {
  const std::string_view input(reinterpret_cast<const char*>(data), size);
  outrider::GuardProblem problem;
  problem.world.bounds = {{-5, -5}, {5, 5}};
  problem.targets = {{"fox", {1, 1, 0}, {0.3, 0.3, 0.3}, 0.0}};
  if (const auto doors = outrider::entrances_from_text(input, problem.world.bounds)) {
    for (const outrider::Entrance& door : *doors) {
      if (!problem.world.bounds.contains(door.position)) std::abort();
    }
  }
  const auto list = outrider::arrivals_from_text(input, "list.txt", problem, {{"gate", {0, 0}}}, {});
  for (std::size_t i = 1; list && i < list->size(); ++i) {
    if ((*list)[i].enters_s < (*list)[i - 1].enters_s) std::abort();
  }
  return 0;
}
