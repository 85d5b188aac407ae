// LogReader: the messages of a log file in the order of time, whatever the format of the file.
//
//   auto log = open_log("run.mcap", {.topics = {"/scan"}});
//   while (true) {
//     auto message = (*log)->next();
//     if (!message) return pass_on(message);   // the file is damaged
//     if (!*message) break;                    // the end
//     decode((*log)->channels()[(*message)->channel], (*message)->data);
//   }
//
// A reader holds a part of the file only: memory does not grow with the length of the log. A file whose end
// is missing is read up to where it ends, and cut_short() says so. Thread rule: one reader, one thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "outrider/core/outcome.hpp"

namespace outrider {

/// A named sequence of messages of one type.
struct Channel {
  std::string topic;            ///< such as "/scan"
  std::string type;             ///< ROS 2 name of the type: "sensor_msgs/msg/LaserScan"
  std::string encoding;         ///< of the messages: "cdr", "ros1" or "json"
  std::string schema_encoding;  ///< "ros2msg", "ros1msg" or "jsonschema"; empty if there is no schema
  std::string schema;           ///< text of the schema
  std::map<std::string, std::string> metadata = {};

  friend bool operator==(const Channel&, const Channel&) = default;
};

/// An encoded message.
struct LogMessage {
  std::size_t channel = 0;   ///< index in LogReader::channels()
  std::int64_t time_ns = 0;  ///< when it was recorded
  std::string_view data;     ///< valid until the next call of next()
};

/// The part of a log that is read. The default is all of it.
struct LogSelection {
  std::vector<std::string> topics = {};                             ///< empty: all topics
  std::int64_t from_ns = std::numeric_limits<std::int64_t>::min();  ///< messages at this time or later
  std::int64_t to_ns = std::numeric_limits<std::int64_t>::max();    ///< messages at this time or earlier
};

class LogReader {
 public:
  virtual ~LogReader() = default;
  LogReader(const LogReader&) = delete;
  LogReader& operator=(const LogReader&) = delete;

  /// Returns all channels of the file, selected or not.
  [[nodiscard]] virtual const std::vector<Channel>& channels() const = 0;

  /// Returns the next selected message, or nothing at the end. Times never decrease; messages of equal time
  /// come in the order of the file. Fault: bad_input with the file and the offset in bytes, if the file is
  /// damaged.
  virtual Outcome<std::optional<LogMessage>> next() = 0;

  /// Returns the part of the file that has been read, 0 to 1; 0 if it is not known.
  [[nodiscard]] virtual double progress() const { return 0.0; }

  /// Returns a sentence if the end of the file is missing, else an empty text.
  [[nodiscard]] virtual std::string cut_short() const { return {}; }

 protected:
  LogReader() = default;
};

/// Returns true if a file that starts with these bytes (16 are enough) is MCAP, a ROS 1 bag or an SQLite
/// database.
bool starts_as_log(std::string_view start);

/// Opens a log. The content decides the format, not the name: MCAP, ROS 1 bag 2.0, or ROS 2 db3. Fault:
/// bad_input if the file cannot be opened or is none of these.
Outcome<std::unique_ptr<LogReader>> open_log(const std::string& path, const LogSelection& selection = {});

/// Opens a log in a file that is open for reading, and closes that in the end; faults name it `path`. Only
/// MCAP and ROS 1 bags: the other formats have to open further files.
Outcome<std::unique_ptr<LogReader>> open_log(int descriptor, const std::string& path,
                                             const LogSelection& selection = {});

}  // namespace outrider
