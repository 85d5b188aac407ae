// ChunkReader: the chunks in the folder of a sweep, read in order, as often as one likes.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "outrider/sweep/chunk.hpp"

namespace outrider {

/// Reads one chunk at a time. Its hash and that of its manifest, which lies beside `chunks`, are checked when
/// it is read for the first time. The sweep has to
/// outlive the reader. Thread rule: one thread at a time.
class ChunkReader {
 public:
  ChunkReader(const Sweep& sweep, std::string folder)
      : sweep_(&sweep), folder_(std::move(folder)), checked_(sweep.chunks(), false) {}

  [[nodiscard]] const Sweep& sweep() const { return *sweep_; }
  [[nodiscard]] const std::string& folder() const { return folder_; }

  /// Calls use() with each chunk, until it returns a fault. Fault: bad_input if a chunk is missing, damaged
  /// or of another sweep.
  Status for_each_text(
      const std::function<Status(std::uint64_t chunk, const ChunkText& text, const std::string& path)>& use);

  /// Calls use() with the rows of each chunk. Fault: as above.
  Status for_each_table(const std::function<void(const SweepTable&)>& use);

 private:
  const Sweep* sweep_;
  std::string folder_;
  std::vector<bool> checked_;
};

}  // namespace outrider
