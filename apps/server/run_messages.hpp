// What a mission prints and writes, turned into what viewers are told.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "child.hpp"
#include "fields.hpp"

namespace outrider::server {

/// {"step", "steps", "name", "part"} from a line of progress; nothing from a line that is something else.
std::optional<Json> progress_of(const Json& line);

/// {"type": "omitted", "what", "sentence"} from a line that says that a report is too large to be told live;
/// nothing from a line that is something else.
std::optional<Json> omitted_of(const Json& line);

/// What viewers are told of a line of a report that grows (report/growth.hpp), in messages of bounded size:
/// the scene where it begins, what has been added, the map, samples and events. None from a line that is
/// something else.
std::vector<Json> messages_of(Json line);

/// How a mission ended: done, not_done, refused, cancelled or failed; why; and the object that it printed.
struct Conclusion {
  std::string state;
  Fault fault{FaultCode::bad_input, {}, {}};
  Json summary;
};
Conclusion conclusion_of(const ChildResult& child);

/// The fault with files named from the root. `unsaved` is the name of a scenario that was not saved, which
/// becomes "scenario"; empty for others.
Fault plain_fault(Fault fault, const std::filesystem::path& root, const std::string& unsaved);

}  // namespace outrider::server
