// Reads the messages that a mission prints: its progress and its end.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "fields.hpp"
#include "runs/child.hpp"

namespace outrider::server {

/// Returns {"step", "steps", "name", "part"} from a progress line; nothing from any other line.
std::optional<Json> progress_of(const Json& line);

/// Describes how a mission ended: done, not_done, refused, cancelled or failed; the reason; and the object
/// that it printed.
struct Conclusion {
  std::string state;
  Fault fault{FaultCode::bad_input, {}, {}};
  Json summary;
};
Conclusion conclusion_of(const ChildResult& child);

/// Returns the fault with the name of an unsaved scenario, `unsaved`, replaced by "scenario"; pass an empty
/// name for others.
Fault plain_fault(Fault fault, const std::string& unsaved);

}  // namespace outrider::server
