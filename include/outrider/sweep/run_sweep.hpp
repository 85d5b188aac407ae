// Functions that compute a sweep into a folder, chunk by chunk.
//
//   FOLDER/manifest.json      what the sweep is made of (manifest.hpp)
//   FOLDER/chunks/000000.csv  its chunks (chunk.hpp), each written under another name and renamed
//   FOLDER/table.csv          all of them, in order (merge_chunks.hpp)
//   FOLDER/failures/17        with keep_failures: the log of run 17
//
// A chunk is a pure function of the manifest: any process may compute any chunk, in any order, with any
// number of threads, and again. Several processes may compute one sweep in one folder: each takes the chunks
// that are missing and that no other process has locked. Chunks that a killed process had not finished are
// missing.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "outrider/job/plan_cache.hpp"
#include "outrider/sweep/chunk.hpp"
#include "outrider/sweep/manifest.hpp"

namespace outrider {

/// The chunks to compute, and the folder that they are written to.
struct SweepWork {
  std::string folder;
  std::uint64_t first_chunk = 0;
  std::uint64_t end_chunk = 0;  ///< the one after the last
  bool keep_failures = false;   ///< write the runs whose status is not `done` as `outrider run --out` does
};

/// The progress of this process. Its times are read from clocks and enter no result.
struct SweepProgress {
  std::uint64_t done = 0;    ///< runs of this process
  std::uint64_t left = 0;    ///< runs in chunks that are missing, at most
  double elapsed_s = 0.0;    ///< since it began
  double run_s = 0.0;        ///< time within runs, summed over threads
  double run_squares = 0.0;  ///< sum of the squares of the times of runs, s2
};

struct SweepWatch {
  std::stop_token stop = {};
  std::function<void(const SweepProgress&)> progress = {};  ///< called from any thread, one at a time
};

/// The time that is left, as an interval.
struct TimeLeft {
  double low_s = 0.0;
  double high_s = 0.0;
};

/// Estimates the time left from the runs so far, as if those left were drawn as they were: twice the standard
/// error of their sum to both sides. Nothing before 8 runs.
std::optional<TimeLeft> time_left(const SweepProgress& progress);

/// Writes the manifest, or compares it with that in the folder. Faults: bad_input if another sweep is there,
/// or other files; cannot_write.
Status begin_sweep(const Manifest& manifest, const std::string& folder);

/// Runs one run. A run that is refused is a result too; exceptions become the status `bug`. Plans are shared
/// with other runs through `plans`, which changes no result. Fault: the log of a failure cannot be written.
Outcome<SweepResult> run_one(const Sweep& sweep, std::uint64_t number, const SweepWork& work,
                             const std::stop_token& stop = {}, PlanCache* plans = nullptr);

/// Computes the chunks of the work that are missing. Returns the numbers of those that other processes are
/// computing. Faults: cancelled; cannot_write; bad_input, before any run, if a chunk of the work is there and
/// belongs to another manifest than that in the folder.
Outcome<std::vector<std::uint64_t>> compute_chunks(const Sweep& sweep, const SweepWork& work,
                                                   const SweepWatch& watch = {});

/// Returns the chunks that are not in the folder.
std::vector<std::uint64_t> missing_chunks(const Sweep& sweep, const std::string& folder);

}  // namespace outrider
