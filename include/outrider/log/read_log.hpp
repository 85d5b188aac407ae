// Reading the log of a run back: every message of the types that a run leaves, in memory.
#pragma once

#include <string>

#include "outrider/core/outcome.hpp"
#include "outrider/log/log.hpp"

namespace outrider {

/// A log as it was read from a file.
struct StoredLog {
  Log log;
  std::string cut_short;  ///< a sentence if the end of the file is missing, else empty
};

/// Reads the log of a run with all its messages. Channels whose types a run never has are left out. Takes
/// O(file) time and memory. Fault: bad_input if the file is not a log, is damaged, has a schema or a message
/// that does not fit its type, a topic with two types, or more than 4 GiB of messages.
Outcome<StoredLog> read_log(const std::string& path);

}  // namespace outrider
