// Capabilities: the optional features of a guard task, and which of them combine. A task without any has
// still targets in a known, level yard without air. src/jobs/guard/capabilities.cpp holds the two tables;
// only these tables exclude combinations, whoever asks: the tool, a node or Python.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "outrider/core/outcome.hpp"

namespace outrider {

struct GuardScenario;

enum class Capability : std::uint8_t {
  own_robot,  ///< a robot that is no simulation of the job carries the mission out
  topics,     ///< the same, and it is known from topics alone
  arrivals,   ///< intruders enter one after another
  survivors,  ///< an intruder may survive a hit and move to another place
  walkers,    ///< intruders walk about
  supplies,   ///< limited water and battery
  terrain,    ///< height fields and slopes
  air,        ///< drag and wind
  unknown,    ///< an unknown yard, which is explored first
  rigid,      ///< rigid-body simulation of robot and balls
  navigated,  ///< a robot that its navigator takes to places, around what no map has
  blocking,   ///< targets that block robot and shots
  faults,     ///< faults of the robot that the mission is not told
  held_up,    ///< drives that end before their goal, because the robot is moved, blocked or stuck
  team,       ///< several robots that share the targets
  planner,    ///< a planner that is not the first of the catalogue
  proof,      ///< a proof that the tour is the best
};

/// The names of a capability.
struct CapabilityRow {
  Capability capability = Capability::arrivals;
  std::string_view noun;  ///< noun phrase for messages, such as "intruders that keep coming"
  std::string_view key;   ///< option that turns the capability on; empty: the caller does
  bool (*asked)(const GuardScenario&) = nullptr;  ///< says if a scenario uses it; null: the caller does
};

/// Returns all capabilities, in the order of the enum.
const std::vector<CapabilityRow>& capabilities();

/// Two capabilities that do not combine.
struct Clash {
  Capability one = Capability::arrivals;
  Capability other = Capability::arrivals;
  std::string_view why;  ///< the reason, as a clause
};
/// Returns all pairs of capabilities that do not combine.
const std::vector<Clash>& clashes();

/// Returns the capabilities that a scenario uses, in the order of the enum, without those of its caller. Its
/// world must be loaded.
std::vector<Capability> requested_capabilities(const GuardScenario& scenario);

/// Checks that the capabilities combine. The fault describes the first pair that does not, at the key of its
/// second member.
Status check_capabilities(const std::vector<Capability>& asked);

}  // namespace outrider
