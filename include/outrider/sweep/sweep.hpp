// Sweep: many runs of one scenario, as a value: which options vary, and what each run is given.
//
//   const auto sweep = prepare_sweep(jobs(), {.scenario = "yard.yaml", .runs = 200, .seed = 7,
//                                             .vary = {"start.x=uniform(0,5)", "planner=a,b"}});
//   const SweepRun run = run_of(*sweep, 17);
//
// A sample is one draw of the seed and of all random options. Each sample is run at every point of the grid,
// and on both sides of a comparison, so that differences between them are paired. Sample j has the child
// stream Rng(seed).child(j); its seed, which the runs get as the option `seed`, is the first number below
// 10^15 of that stream, and a random option is drawn from the child of that stream that has its key as name.
// Run number i belongs to sample i / (points x sides): without grid and comparison, run i is sample i.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "outrider/job/run_job.hpp"
#include "outrider/sweep/distribution.hpp"

namespace outrider {

/// The sweep that a user asks for.
struct SweepRequest {
  std::string scenario = {};
  std::uint64_t runs = 1;  ///< number of samples: runs of each point of the grid
  std::uint64_t seed = 0;
  std::vector<std::string> vary = {};     ///< KEY=VALUES, see distribution.hpp
  std::vector<std::string> compare = {};  ///< KEY=A,B: side a has all values A, side b all values B
  std::uint64_t chunk_runs = 1000;        ///< runs in a chunk
};

inline constexpr std::uint64_t most_sweep_runs = 10'000'000;
inline constexpr std::uint64_t most_chunk_runs = 100'000;
inline constexpr std::uint64_t most_seed = 1'000'000'000'000'000;  ///< as options named `seed` take

struct Sweep {
  SweepRequest request;
  Job job;
  std::vector<Varied> varied = {};    ///< in the order of the request
  std::vector<Varied> compared = {};  ///< each with a grid of two values
  bool has_seed = false;              ///< the job has an option `seed`
  std::uint64_t points = 1;           ///< of the grid
  std::uint64_t total = 0;            ///< number of runs

  [[nodiscard]] std::uint64_t sides() const { return compared.empty() ? 1 : 2; }
  [[nodiscard]] std::uint64_t chunks() const { return (total + request.chunk_runs - 1) / request.chunk_runs; }
  /// Returns the first run of a chunk; of the chunk after the last one, `total`.
  [[nodiscard]] std::uint64_t begin_of(std::uint64_t chunk) const {
    return std::min(total, chunk * request.chunk_runs);
  }
};

/// One run of a sweep.
struct SweepRun {
  std::uint64_t number = 0;
  std::uint64_t sample = 0;
  std::uint64_t point = 0;  ///< of the grid; the values of the last key change fastest
  std::uint64_t side = 0;   ///< 0 or 1
  std::uint64_t seed = 0;
  std::vector<std::string> values = {};  ///< of Sweep::varied, then of Sweep::compared
};

/// Reads the request and checks that the options take the values: those of grids, the ends of ranges, each
/// word. Reads the scenario, but none of the files that it names. Faults: bad_input with the key, the value
/// and what would be right.
Outcome<Sweep> prepare_sweep(const std::vector<Job>& jobs, const SweepRequest& request);

/// Returns what run `number` is given. A pure function. O(keys).
SweepRun run_of(const Sweep& sweep, std::uint64_t number);

/// Returns the changes that a run makes to the scenario.
Changes changes_of(const Sweep& sweep, const SweepRun& run);

/// Returns the keys of the values of a run, in their order.
std::vector<std::string> keys_of(const Sweep& sweep);

}  // namespace outrider
