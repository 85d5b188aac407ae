// Scenarios as the page shows, changes and saves them: questions of a path planner, and yards to guard.
//
// What is saved is made here of values that were read and checked, never of bytes that were sent, and stands
// beside the scenario under its name: ROOM.yaml, ROOM_map.yaml with ROOM_map.pgm or ROOM_map.txt,
// ROOM_targets.txt, ROOM_world.sdf. So a scenario that was saved stays as it is when the map that it was
// drawn on changes.
#pragma once

#include <string>
#include <vector>

#include "planning.hpp"
#include "reading.hpp"

namespace outrider::server {

/// Of the job plan: {"path", "job", "map": a packed map, "start", "goal", "planner", "options", "model",
/// "radius_m", "resolution_m"}; of the job guard: what shown_yard() says. For the process that reads
/// (reading.hpp). Faults: those of reading them; bad_input on other jobs, and on files outside the folder.
Outcome<Json> shown_scenario(const std::string& path, const Folder& folder);

/// The same for the page: its map is kept, and given as /maps does.
Outcome<Json> with_kept_map(Json shown, MapStore& maps);

/// The files of a scenario under that name, the scenario last: of {"plan": a question as answer_plan()
/// takes}, or of {"guard": what yard_files() takes}, which `read` reads. Writes nothing. Fault: bad_input on
/// a request that is wrong.
Outcome<std::vector<NamedContent>> scenario_files(const std::string& path, const Json& request,
                                                  const Folder& folder, PlanningMemory& memory,
                                                  const ReadFiles& read, const std::stop_token& stop);

}  // namespace outrider::server
