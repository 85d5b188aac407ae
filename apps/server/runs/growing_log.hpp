// GrowingLog: the log of a mission as it comes, kept in a file that viewers read from any offset on.
//
// The bytes are one MCAP file that grows. A viewer holds an offset and nothing else, so a slow viewer costs
// no memory and holds up nobody. Thread rule: one thread appends and ends; any thread may call the const
// functions.
#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>
#include <string>
#include <string_view>

#include "byte_budget.hpp"
#include "outrider/core/outcome.hpp"
#include "outrider/io/files/open_folder.hpp"

namespace outrider::server {

class GrowingLog {
 public:
  /// Makes the file `name` in a folder. It has at most `most_bytes` bytes, and all logs together what is left
  /// in `shared`, which must outlive it. A file that cannot be made is a log that has stopped.
  GrowingLog(OpenFolder folder, std::string name, std::uint64_t most_bytes, ByteBudget& shared);
  ~GrowingLog();  ///< removes the file, unless it has another name by now
  GrowingLog(const GrowingLog&) = delete;
  GrowingLog& operator=(const GrowingLog&) = delete;

  /// Appends bytes, unless the log has stopped. Stops it if it would exceed its own limit, or the disk fails.
  /// Returns false if the shared budget has too few bytes left; then nothing is appended.
  bool append(std::string_view bytes);
  /// Takes no more bytes, for the reason given in a sentence.
  void stop(std::string sentence);
  /// Says that the mission has written all it will write.
  void end() { ended_ = true; }

  /// Returns how many bytes there are so far.
  [[nodiscard]] std::uint64_t bytes() const { return bytes_; }
  /// Returns at most `most` bytes from `offset` on; fewer at the end.
  [[nodiscard]] std::string part(std::uint64_t offset, std::size_t most) const;
  [[nodiscard]] bool ended() const { return ended_; }
  /// Returns why the log stopped before its mission ended; empty if it did not.
  [[nodiscard]] std::string stopped() const;
  /// Returns a path that leads to the file in this process, whatever its name is by now.
  [[nodiscard]] std::string path() const;

 private:
  OpenFolder folder_;
  std::string name_;
  std::uint64_t most_bytes_;
  ByteBudget& shared_;
  int descriptor_;
  std::atomic<std::uint64_t> bytes_{0};
  std::atomic<bool> ended_{false};
  ByteBudget::Lease lease_;
  mutable std::mutex mutex_;  // guards the sentence
  std::string stopped_;
};

}  // namespace outrider::server
