// A chunk: consecutive runs of a sweep as a table in CSV (RFC 4180), one line for each run, and a last line
// that shows that it is whole and of which sweep it is.
//
//   run,seed,robot.radius,status,reason,length_m
//   0,412,0.25,done,,8.25
//   1,977,0.31,not_done,"there is no path, ...",
//   # 2 runs, manifest 3fdba35f..., sha256 9f86d081...
//
// The columns: run, seed, side (a or b; of comparisons only), the keys that vary, status, reason, and the
// metrics in the order in which the runs first have them. A metric that a run lacks is empty. The status is
// that of the report, or `refused` if the run was refused, or `bug` if it ended by an exception. All texts
// are printable, so a line is a run.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "outrider/sweep/sweep.hpp"

namespace outrider {

/// The inputs of a run, and its result.
struct SweepResult {
  SweepRun run = {};
  std::string status = {};
  std::string reason = {};
  std::vector<std::pair<std::string, double>> metrics = {};
};

/// The rows of a chunk, or of a merged table, as text.
struct SweepTable {
  std::vector<std::string> metrics;            ///< names of the last columns
  std::vector<std::vector<std::string>> rows;  ///< each has all columns
};

/// Returns the names of the columns before the metrics.
std::vector<std::string> fixed_columns(const Sweep& sweep);

/// Returns the text of the chunk with these runs; `origin` is the hash of its manifest. O(text).
std::string chunk_text(const Sweep& sweep, const std::vector<SweepResult>& results, std::string_view origin);

/// Returns the path of a chunk in the folder of its sweep.
std::string chunk_path(const std::string& folder, std::uint64_t chunk);

/// Refuses a chunk that was computed by another manifest. Fault: bad_input with `name`, and the first thing
/// in which its first run differs from that of the sweep.
Status check_origin(const Sweep& sweep, std::uint64_t chunk, std::string_view origin, std::string_view text,
                    const std::string& name);

/// Checks by the hash in its last line that the text is whole, and its origin. Fault: bad_input with `name`.
/// O(text).
Status check_chunk(const Sweep& sweep, std::uint64_t chunk, std::string_view origin, std::string_view text,
                   const std::string& name);

/// The text of a chunk in parts.
struct ChunkText {
  std::vector<std::string> metrics;  ///< names of the last columns
  std::string_view lines;            ///< those of its runs, within the text
};

/// Splits a text that was checked. Fault: bad_input with `name` if it is not the given chunk of the sweep.
Outcome<ChunkText> split_chunk(const Sweep& sweep, std::uint64_t chunk, std::string_view text,
                               const std::string& name);

/// Reads the rows of a chunk. Fault: bad_input with `name` if they are not those of the given chunk.
Outcome<SweepTable> read_rows(const Sweep& sweep, std::uint64_t chunk, const ChunkText& text,
                              const std::string& name);

/// Appends the names to the columns of `into` that it lacks, in order.
void add_columns(std::vector<std::string>& into, const std::vector<std::string>& names);

/// Returns a line of CSV with its end.
std::string csv_line(const std::vector<std::string>& fields);

/// Splits a line of CSV. Returns no fields if a quote is not closed.
std::vector<std::string> csv_fields(std::string_view line);

}  // namespace outrider
