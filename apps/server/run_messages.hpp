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
std::optional<Json> progress_of(const std::string& line);

/// How a mission ended: done, not_done, refused, cancelled or failed; why; and the object that it printed.
struct Conclusion {
  std::string state;
  Fault fault{FaultCode::bad_input, {}, {}};
  Json summary;
};
Conclusion conclusion_of(const ChildResult& child);

/// The fault with files named from the root; a scenario that was not saved is "scenario".
Fault plain_fault(Fault fault, const std::filesystem::path& root, const std::filesystem::path& scenario);

/// The events and samples of a report as messages of bounded size; none when it is no report.
std::vector<Json> messages_of_report(const std::string& report);

}  // namespace outrider::server
