// Copies a log of any format into an MCAP file.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "outrider/log/log_reader.hpp"
#include "outrider/log/mcap/mcap_writer.hpp"

namespace outrider {

struct LogCopy {
  std::size_t messages = 0;
  std::vector<std::string> kept_ros1;  ///< topics that stayed in ROS 1 bytes, because they have no schema
};

/// Copies all messages that are left in `from`, in the order of time. Messages of ROS 1 become CDR with the
/// schema of ROS 2, by the schema that they carry; all others stay as they are. `progress(part)` returns
/// false to stop. Memory does not grow with the log. Faults: those of both; bad_input with the topic, if a
/// message does not agree with its schema; cancelled.
Outcome<LogCopy> copy_log(LogReader& from, McapWriter& to,
                          const std::function<bool(double)>& progress = nullptr);

}  // namespace outrider
