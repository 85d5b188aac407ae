// The kinds of files, told by their names and their content.
//
// All but is_parsed() parse what strangers wrote: call them in the reader process (reading.hpp).
#pragma once

#include <string>
#include <vector>

#include "fields.hpp"
#include "files/folder.hpp"
#include "outrider/job/job.hpp"

namespace outrider::server {

/// Returns true for a file that file_kind() parses whole.
bool is_parsed(const std::string& path);

/// Returns {"kind": scenario, log, result, map or other}, and of a scenario or a result its "job", of a
/// scenario with a head comment its "description".
Json file_kind(const std::string& path, const Folder& folder);

/// Returns {"job": its name, "seed": the value of that key, or null} of the text of a scenario. Fault:
/// bad_input that names `name`, if it has no job of these.
Outcome<Json> scenario_head(const std::string& text, const std::string& name, const std::vector<Job>& jobs);

}  // namespace outrider::server
