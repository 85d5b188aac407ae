// Scenarios that the page shows, changes and saves: path planning questions, and yards to guard.
//
// Saved files are generated here from checked values, never copied from received bytes. They lie beside the
// scenario under its name: ROOM.yaml, ROOM_map.yaml with ROOM_map.pgm or ROOM_map.txt, ROOM_targets.txt,
// ROOM_world.sdf. So a saved scenario does not change when the map that it was drawn on changes.
#pragma once

#include <string>
#include <vector>

#include "files/reading.hpp"
#include "planning/planning.hpp"

namespace outrider::server {

/// Returns a scenario for the page. For the job plan: {"path", "job", "map": a packed map, "start", "goal",
/// "planner", "options", "model", "radius_m", "resolution_m"}; for the job guard: see shown_yard(). Call it
/// in the reader process (reading.hpp). Faults: those of reading the scenario; bad_input on other jobs, and
/// on files outside the folder.
Outcome<Json> shown_scenario(const std::string& path);

/// Keeps the packed map of a shown scenario and replaces it by what /maps returns.
Outcome<Json> with_kept_map(Json shown, MapStore& maps);

/// Returns the files of a scenario under that name, the scenario last, from {"plan": a question of
/// answer_plan()} or {"guard": a request of yard_files()}, which `read` reads. Writes nothing. Fault:
/// bad_input on an invalid request.
Outcome<std::vector<NamedContent>> scenario_files(const std::string& path, const Json& request,
                                                  const Folder& folder, PlanningMemory& memory,
                                                  const ReadFiles& read, const std::stop_token& stop);

}  // namespace outrider::server
