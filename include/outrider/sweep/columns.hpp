// The columns of a sweep as numbers: metrics, and keys that vary at random, read from its chunks.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "outrider/sweep/chunk_reader.hpp"

namespace outrider {

/// A column with a number for each run; NaN where it has none.
struct Column {
  std::string name;
  std::vector<double> values;
};

/// The results of the runs, without their metrics.
struct Outcomes {
  std::vector<std::string> metrics;     ///< names of all
  std::vector<std::string> statuses;    ///< names, in the order in which runs have them
  std::vector<std::uint8_t> status_of;  ///< of each run, its number in `statuses`
};

/// Reads the outcomes; `each` receives the status and reason of each run that is not done.
Outcome<Outcomes> read_outcomes(
    ChunkReader& chunks,
    const std::function<void(std::uint64_t run, const std::string& status, const std::string& reason)>& each);

/// Reads these columns at once: metrics, or keys that vary. Memory: 8 bytes for each run and name.
Outcome<std::vector<Column>> read_columns(ChunkReader& chunks, const std::vector<std::string>& names);

}  // namespace outrider
