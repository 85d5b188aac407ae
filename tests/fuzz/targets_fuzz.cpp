// Target lists: a target that loads has a size.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "fuzz_entry.hpp"
#include "outrider/io/scenario/targets.hpp"

extern "C" int FUZZ_ENTRY(targets)(const std::uint8_t* data, std::size_t size) {
  const std::string_view input(reinterpret_cast<const char*>(data), size);
  const auto targets = outrider::targets_from_text(input, "targets.txt");
  if (!targets) return 0;
  for (const outrider::Target& target : *targets) {
    if (!(target.size.x > 0.0 && target.size.y > 0.0 && target.size.z > 0.0)) std::abort();
  }
  return 0;
}
