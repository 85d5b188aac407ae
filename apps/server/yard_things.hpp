// What of a yard's world the page can put elsewhere or take away.
#pragma once

#include <string>
#include <vector>

#include "fields.hpp"
#include "outrider/io/world_changes.hpp"
#include "outrider/jobs/guard/problem.hpp"

namespace outrider::server {

inline constexpr double most_turn_rad = 7.0;  ///< that a request may ask for

struct YardThings {
  WorldChanges changes;               ///< as the scenario has them
  std::vector<MovableThing> movable;  ///< none of which a change names a part only
};

/// Of a problem whose world is as its file has it. Faults: those of changed().
Outcome<YardThings> yard_things(const GuardProblem& yard, WorldChanges changes);

/// Polygons in the way of the robot: of each thing, where the world has it; and of all that stays.
Json things_json(const GuardProblem& yard, const YardThings& things);
Json fixed_json(const GuardProblem& yard, const YardThings& things);

/// The changes that a request asks for in place of those of the same things. Faults: bad_input, as a
/// scenario with these changes would be refused.
Outcome<WorldChanges> changes_of(const Json& moved, const Json& removed, const GuardProblem& yard,
                                 const YardThings& things);

}  // namespace outrider::server
