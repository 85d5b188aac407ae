// Scenarios: whatever the text, options stay within their ranges.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "fuzz_entry.hpp"
#include "outrider/io/scenario/scenario.hpp"

extern "C" int FUZZ_ENTRY(scenario)(const std::uint8_t* data, std::size_t size) {
  const std::string_view input(reinterpret_cast<const char*>(data), size);
  std::int64_t seed = 1;
  double radius_m = 0.26;
  bool block = false;
  std::string world = "yard.sdf";
  const std::vector<outrider::OptionGroup> groups = {
      {"", "", {{"seed", "", 0, 1e18, "seed", &seed}, {"world", "", 0, 0, "world", &world}}},
      {"robot", "", {{"radius", "m", 0.01, 10, "radius", &radius_m}, {"block", "", 0, 0, "block", &block}}}};
  (void)outrider::scenario_from_text(input, "s.yaml", groups);
  if (!(radius_m >= 0.01 && radius_m <= 10.0 && seed >= 0)) std::abort();
  return 0;
}
