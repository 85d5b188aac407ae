// Capabilities: what a guard task may ask for beside still targets in a known, level yard without air, and
// which of it combines. src/jobs/guard/capabilities.cpp has the two tables; nothing else excludes anything.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "outrider/core/outcome.hpp"

namespace outrider {

struct GuardScenario;

enum class Capability : std::uint8_t {
  arrivals,     ///< intruders come one after another
  survivors,    ///< who is hit may go elsewhere
  walkers,      ///< intruders walk about
  supplies,     ///< limited water and battery
  terrain,      ///< height fields and slopes
  air,          ///< drag and wind
  on_the_move,  ///< shots from a robot that drives
  unknown,      ///< a yard that is explored first
  rigid,        ///< a robot and balls of rigid bodies
  blocking,     ///< targets that block robot and shots
};

struct CapabilityRow {
  Capability capability = Capability::arrivals;
  std::string_view noun;  ///< "intruders that keep coming"
  std::string_view key;   ///< that asks for it
};

/// All of them, by the order of the enum.
const std::vector<CapabilityRow>& capabilities();

/// Two capabilities that do not combine.
struct Clash {
  Capability one = Capability::arrivals;
  Capability other = Capability::arrivals;
  std::string_view why;  ///< a clause
};
const std::vector<Clash>& clashes();

/// What a scenario asks for, once its world is loaded, by the order of the enum.
std::vector<Capability> asked_of(const GuardScenario& scenario);

/// Refuses the first two that do not combine, at the key of the second one, with one sentence.
Status check_capabilities(const std::vector<Capability>& asked);

}  // namespace outrider
