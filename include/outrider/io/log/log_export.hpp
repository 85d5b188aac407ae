// Logs in the formats of other tools: a line of JSON for each message, and arrays of numpy.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "outrider/log/log_reader.hpp"

namespace outrider {

struct LogExport {
  std::size_t messages = 0;
  std::vector<std::string> left_out;  ///< topics of unknown types, with their types: "/a (b/msg/C)"
};

/// Returns false to stop; its argument is the part that is done, 0 to 1.
using ExportProgress = std::function<bool(double)>;

/// Creates or replaces a file with a JSON object in each line, in the order of time:
/// {"topic":"/odom","time_ns":0,"type":"nav_msgs/msg/Odometry","message":{...}}. Memory does not grow with
/// the log. Faults: that of the reader; bad_input with the topic of a message that cannot be decoded;
/// cancelled; cannot_write.
Outcome<LogExport> write_json_lines(LogReader& log, const std::string& path,
                                    const ExportProgress& progress = nullptr);

/// Creates or replaces a .npz file, which numpy.load() opens, with the arrays of NumpyArrays. Memory: twice
/// the size of the file, of at most 4 GiB. Faults as above; bad_input if it would be larger.
Outcome<LogExport> write_numpy(LogReader& log, const std::string& path,
                               const ExportProgress& progress = nullptr);

}  // namespace outrider
