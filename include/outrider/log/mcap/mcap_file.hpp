// Reads the attachments that an MCAP file holds beside its messages. Thread rule: safe to call concurrently.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "outrider/core/outcome.hpp"

namespace outrider {

/// A file stored in a log, such as run.json.
struct LogAttachment {
  std::string name;
  std::string media_type;  ///< such as "application/json"
  std::string content;
  std::int64_t time_ns = 0;

  friend bool operator==(const LogAttachment&, const LogAttachment&) = default;
};

/// Reads all attachments of an MCAP file in the order of the file; of one whose end is missing, those that
/// are complete. Fault: bad_input with the path and the offset in bytes if the file is damaged, or the
/// contents have more than 256 MiB together.
Outcome<std::vector<LogAttachment>> read_attachments(const std::string& path);

}  // namespace outrider
