// The things in a yard's world that the page can move or remove.
#pragma once

#include <string>
#include <vector>

#include "fields.hpp"
#include "outrider/io/scenario/world_changes.hpp"
#include "outrider/jobs/guard/problem.hpp"

namespace outrider::server {

inline constexpr double most_turn_rad = 7.0;  ///< largest turn in a request

struct YardThings {
  WorldChanges changes;               ///< changes in the scenario
  std::vector<MovableThing> movable;  ///< without things of which a change names only a part
};

/// Returns the things of a problem whose world is as in its file. Faults: those of changed().
Outcome<YardThings> yard_things(const GuardProblem& yard, WorldChanges changes);

/// things_json() returns the movable things, each with the polygons that block the robot as in the world
/// file. fixed_json() returns the polygons of everything else.
Json things_json(const GuardProblem& yard, const YardThings& things);
Json fixed_json(const GuardProblem& yard, const YardThings& things);

/// Returns the changes of the scenario, with those of the same things replaced by the request. Faults:
/// bad_input, if a scenario with these changes would be refused.
Outcome<WorldChanges> changes_of(const Json& moved, const Json& removed, const GuardProblem& yard,
                                 const YardThings& things);

}  // namespace outrider::server
