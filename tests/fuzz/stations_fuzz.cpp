// Stations: what loads is inside the yard, gives something, and has a name of its own.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "fuzz_entry.hpp"
#include "outrider/jobs/guard/yard/inputs.hpp"

extern "C" int FUZZ_ENTRY(stations)(const std::uint8_t* data, std::size_t size) {
  const std::string_view input(reinterpret_cast<const char*>(data), size);
  const outrider::Box2 bounds{{-5, -5}, {5, 5}};
  const auto stations = outrider::stations_from_text(input, bounds);
  for (std::size_t i = 0; stations && i < stations->size(); ++i) {
    const outrider::Station& station = (*stations)[i];
    if (!bounds.contains(station.position) || !(station.gives_water || station.gives_charge)) std::abort();
    for (std::size_t j = 0; j < i; ++j) {
      if ((*stations)[j].name == station.name) std::abort();
    }
  }
  return 0;
}
