// Recorded positions and preferences: what loads is finite, in the order of time, and of the targets' number.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "fuzz_entry.hpp"
#include "outrider/jobs/guard/yard/inputs.hpp"

extern "C" int FUZZ_ENTRY(sightings)(const std::uint8_t* data, std::size_t size) {
  const std::string_view input(reinterpret_cast<const char*>(data), size);
  if (const auto tracks = outrider::sightings_from_text(input, "history.csv")) {
    for (const outrider::Track& track : *tracks) {
      if (track.empty()) std::abort();
      for (std::size_t i = 0; i < track.size(); ++i) {
        if (!std::isfinite(track[i].position.x) || !std::isfinite(track[i].position.y)) std::abort();
        if (i > 0 && track[i].time_s <= track[i - 1].time_s) std::abort();
      }
    }
  }
  const std::vector<outrider::Target> targets = {{"fox", {}, {}, 0.0}};
  const auto weights = outrider::preferences_from_text(input, targets);
  if (weights && (weights->size() != 1 || !(weights->front() >= 0.0))) std::abort();
  return 0;
}
