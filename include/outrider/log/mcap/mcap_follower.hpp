// McapFollower: reads an MCAP file while it is still being written, from its beginning up to where it is
// complete.
//
//   McapFollower log("run.mcap");
//   for (;;) {
//     auto bytes = log.next();
//     if (!bytes) return pass_on(bytes);       // the file is damaged
//     if (*bytes == 0) { wait(); continue; }   // there is nothing more by now
//     if (auto ok = log.read([&](const LogMessage& message) { ... }); !ok) return ok;
//   }
//
// The file is read in parts: a chunk with its messages, or a record outside of the chunks. Messages come in
// the order of the file. Memory: one part while it is read, and the channels with their schemas. Thread rule:
// one follower, one thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "outrider/core/outcome.hpp"
#include "outrider/log/log_reader.hpp"

namespace outrider {

class McapFollower {
 public:
  /// Starts at the beginning of a file, which must exist when next() is called.
  explicit McapFollower(std::string path);
  McapFollower(McapFollower&&) noexcept;
  McapFollower& operator=(McapFollower&&) noexcept;
  ~McapFollower();

  /// Finds the next part. Returns its size in bytes; 0 if no further part is complete. Fault: bad_input with
  /// the path if the file cannot be read or is no MCAP.
  Outcome<std::uint64_t> next();

  /// Reads the part that next() found, and calls `on_message` for each of its messages: the channel is an
  /// index in channels(), the data are valid during the call. Fault: bad_input with the path and the offset
  /// if the part is damaged.
  Status read(const std::function<void(const LogMessage&)>& on_message);

  /// Returns the channels so far, in the order of the file.
  [[nodiscard]] const std::vector<Channel>& channels() const;
  /// Returns the offset in the file from which next() searches. Followers of one file that have called next()
  /// are at the same offset if they go on with the same part.
  [[nodiscard]] std::uint64_t position() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace outrider
