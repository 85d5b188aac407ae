// Converts the output of a mission into messages for viewers.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "child.hpp"
#include "fields.hpp"

namespace outrider::server {

/// Returns {"step", "steps", "name", "part"} from a progress line; nothing from any other line.
std::optional<Json> progress_of(const Json& line);

/// Returns {"type": "omitted", "what", "sentence"} from a line about a report that is too large to send live;
/// nothing from any other line.
std::optional<Json> omitted_of(const Json& line);

/// Converts a line of a growing report (report/growth.hpp) into messages of bounded size: the scene when it
/// begins, additions, the map, samples and events. Returns none for any other line.
std::vector<Json> messages_of(Json line);

/// Describes how a mission ended: done, not_done, refused, cancelled or failed; the reason; and the object
/// that it printed.
struct Conclusion {
  std::string state;
  Fault fault{FaultCode::bad_input, {}, {}};
  Json summary;
};
Conclusion conclusion_of(const ChildResult& child);

/// Returns the fault with file names relative to the root. Replaces `unsaved`, the name of an unsaved
/// scenario, by "scenario"; pass an empty name for others.
Fault plain_fault(Fault fault, const std::filesystem::path& root, const std::string& unsaved);

}  // namespace outrider::server
