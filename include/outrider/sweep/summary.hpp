// SweepSummary: what a sweep shows: rates, metrics and reasons with their intervals, and paired comparisons.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "outrider/sweep/chunk_reader.hpp"
#include "outrider/sweep/statistics.hpp"

namespace outrider {

/// The share of the runs of a set that are of one kind.
struct Rate {
  std::uint64_t hits = 0;
  std::uint64_t count = 0;
  ConfidenceInterval interval = {};  ///< Wilson
};

struct QuantileSummary {
  double share = 0.5;
  double value = 0.0;
  ConfidenceInterval interval = {};
};

/// A metric over the runs that have it.
struct MetricSummary {
  std::string name;
  std::uint64_t count = 0;  ///< runs that have it
  double mean = 0.0;
  ConfidenceInterval mean_interval = {};
  double deviation = 0.0;                       ///< standard deviation; NaN for one value
  double low = 0.0, high = 0.0;                 ///< smallest and largest value
  std::vector<QuantileSummary> quantiles = {};  ///< of 5, 25, 50, 75 and 95 %
};

/// The runs of one point of the grid, or of all; in a comparison, of one side.
struct RunsSummary {
  std::vector<std::pair<std::string, std::string>> values = {};  ///< of the grid and of the side
  Rate done = {};
  std::vector<std::pair<std::string, std::uint64_t>> statuses = {};
  std::vector<MetricSummary> metrics = {};
};

/// Runs that failed for the same reason: the same sentence but for its numbers and what it quotes.
struct ReasonSummary {
  std::string status;
  std::string reason;  ///< with # for numbers and '...' for what is quoted
  Rate rate = {};
  std::uint64_t example = 0;  ///< number of the first such run
};

/// A metric on both sides of a comparison, over the pairs of runs of one seed that both have it.
struct PairedSummary {
  std::string name;
  std::uint64_t pairs = 0;
  std::uint64_t less = 0, equal = 0, more = 0;  ///< pairs in which side b has less, the same, more
  double median_difference = 0.0;               ///< of b - a
  ConfidenceInterval interval = {};             ///< of that median
  double wilcoxon_p = 1.0;
};

/// The numbers of pairs in which both sides, one side or neither is done.
struct PairedDone {
  std::uint64_t both = 0, only_a = 0, only_b = 0, neither = 0;
  double mcnemar_p = 1.0;
};

struct SweepSummary {
  std::string job;
  std::uint64_t runs = 0;
  std::vector<bool> done = {};           ///< of each run, whether its status is done
  std::vector<RunsSummary> sides;        ///< one for all runs, or one for each side of a comparison
  std::vector<RunsSummary> points = {};  ///< of each point of the grid and side, if there is a grid
  std::vector<ReasonSummary> reasons = {};
  std::uint64_t other_reasons = 0;  ///< runs with reasons beyond the 100 that are listed
  PairedDone paired_done = {};
  std::vector<PairedSummary> paired = {};
};

inline constexpr std::size_t most_points_summarised = 1000;

/// Summarises the chunks of a complete sweep. All quantiles are exact. Reads the chunks as often as the
/// columns need, 16 million numbers at a time: 128 MiB. Faults: those of ChunkReader.
Outcome<SweepSummary> summarise(ChunkReader& chunks);

/// Returns the reason with # for numbers and '...' for what is quoted.
std::string kind_of_reason(std::string_view reason);

/// Returns the summary as text for a person, and as JSON.
std::string summary_text(const Sweep& sweep, const SweepSummary& summary);
std::string summary_json(const Sweep& sweep, const SweepSummary& summary);

}  // namespace outrider
