// Index files: keep the index of a path planner between runs.
//
//   auto loaded = load_index_file("london.index", planner, ground, workspace);
//   ... planner.plan(problem, budget, workspace) ...
//   if (loaded && !*loaded) auto saved = save_index_file("london.index", planner, ground, budget, workspace);
//
// The file is mapped into memory, so that only what queries look at is read twice. stored_index.hpp says what
// the bytes are checked for. Faults: bad_input with the file in `where` and the remedy; cannot_write. A
// process whose reading is confined (confinement.hpp) neither reads nor writes index files.
#pragma once

#include <memory>
#include <string>

#include "outrider/path/catalog.hpp"

namespace outrider {

/// Puts the index in the file into the workspace. Returns false if there is no such file.
Outcome<bool> load_index_file(const std::string& path, const ConfiguredPlanner& planner,
                              const IndexedGround& ground, Workspace& workspace);

/// Writes the index of the ground to the file, under a temporary name until it is whole; builds it if the
/// workspace has none.
Status save_index_file(const std::string& path, const ConfiguredPlanner& planner, const IndexedGround& ground,
                       const Budget& budget, Workspace& workspace);

}  // namespace outrider
