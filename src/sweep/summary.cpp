#include "outrider/sweep/summary.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "outrider/sweep/columns.hpp"

namespace outrider {
namespace {

constexpr std::size_t numbers_at_a_time = 16'000'000;  // in memory
constexpr std::size_t most_reasons = 100;
constexpr std::array<double, 5> shares = {0.05, 0.25, 0.5, 0.75, 0.95};

/// A set of runs: those of a side, or of a point and side. Runs are numbered (sample, point, side).
struct Subset {
  std::uint64_t point = 0;
  std::uint64_t points = 1;  ///< 1: all points
  std::uint64_t side = 0;
};

/// Calls use(run) for each run of the set, in order.
template <class Use>
void for_each_run(const Sweep& sweep, const Subset& set, const Use& use) {
  for (std::uint64_t i = set.point; i < sweep.total / sweep.sides(); i += set.points) {
    use(i * sweep.sides() + set.side);
  }
}

std::vector<std::pair<std::string, std::string>> values_of(const Sweep& sweep, const Subset& set) {
  std::vector<std::pair<std::string, std::string>> values;
  const SweepRun run = run_of(sweep, set.point * sweep.sides() + set.side);
  const auto keys = keys_of(sweep);
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const bool compared = i >= sweep.varied.size();
    if (!compared && (set.points == 1 || sweep.varied[i].is_random())) continue;
    values.emplace_back(keys[i], run.values[i]);
  }
  return values;
}

Rate rate_of(std::uint64_t hits, std::uint64_t count) {
  return {hits, count, count > 0 ? wilson_interval(hits, count) : ConfidenceInterval{0.0, 1.0}};
}

RunsSummary runs_of(const Sweep& sweep, const Outcomes& outcomes, const Subset& set) {
  RunsSummary runs{.values = values_of(sweep, set)};
  std::vector<std::uint64_t> counts(outcomes.statuses.size());
  std::uint64_t all = 0;
  for_each_run(sweep, set, [&](std::uint64_t run) {
    ++counts[outcomes.status_of[run]];
    ++all;
  });
  for (std::size_t i = 0; i < counts.size(); ++i) {
    if (counts[i] > 0) runs.statuses.emplace_back(outcomes.statuses[i], counts[i]);
    if (outcomes.statuses[i] == "done") runs.done.hits = counts[i];
  }
  runs.done = rate_of(runs.done.hits, all);
  return runs;
}

/// Summarises values, which are sorted by it. The stream depends only on the column. Points of a grid are
/// not resampled, which would take long for many of them.
MetricSummary metric_of(const std::string& name, std::vector<double>& values, bool resample) {
  const Rng rng = Rng(1).child(name);
  MetricSummary metric{.name = name, .count = values.size()};
  if (values.empty()) return metric;
  std::ranges::sort(values);
  const auto n = static_cast<double>(values.size());
  metric.mean = mean_of(values);
  double squares = 0.0;
  for (const double value : values) squares += (value - metric.mean) * (value - metric.mean);
  metric.deviation =
      values.size() > 1 ? std::sqrt(squares / (n - 1.0)) : std::numeric_limits<double>::quiet_NaN();
  metric.mean_interval = resample ? mean_interval(values, rng) : normal_mean_interval(values);
  metric.low = values.front();
  metric.high = values.back();
  for (const double share : shares) {
    metric.quantiles.push_back({share, quantile(values, share), quantile_interval(values, share)});
  }
  return metric;
}

PairedSummary paired_of(const Sweep& sweep, const Column& column) {
  PairedSummary paired{.name = column.name};
  std::vector<double> differences;
  for (std::uint64_t run = 0; run + 1 < sweep.total; run += 2) {
    const double difference = column.values[run + 1] - column.values[run];
    if (!std::isfinite(difference)) continue;
    differences.push_back(difference);
    ++(difference < 0.0 ? paired.less : difference > 0.0 ? paired.more : paired.equal);
  }
  paired.pairs = differences.size();
  if (differences.empty()) return paired;
  std::ranges::sort(differences);
  paired.median_difference = quantile(differences, 0.5);
  paired.interval = median_interval(differences, Rng(2).child(column.name));
  paired.wilcoxon_p = wilcoxon_p(std::move(differences));
  return paired;
}

PairedDone paired_done_of(const Sweep& sweep, const Outcomes& outcomes) {
  PairedDone paired;
  const auto done = [&](std::uint64_t run) { return outcomes.statuses[outcomes.status_of[run]] == "done"; };
  for (std::uint64_t run = 0; run + 1 < sweep.total; run += 2) {
    const bool a = done(run), b = done(run + 1);
    ++(a && b ? paired.both : a ? paired.only_a : b ? paired.only_b : paired.neither);
  }
  paired.mcnemar_p = mcnemar_p(paired.only_a, paired.only_b);
  return paired;
}

/// Adds what the columns show to the sets and pairs.
void add_metrics(const Sweep& sweep, const std::vector<Subset>& sets, const std::vector<RunsSummary*>& runs,
                 const std::vector<Column>& columns, SweepSummary& summary) {
  std::vector<double> values;
  for (const Column& column : columns) {
    for (std::size_t i = 0; i < sets.size(); ++i) {
      values.clear();
      for_each_run(sweep, sets[i], [&](std::uint64_t run) {
        if (std::isfinite(column.values[run])) values.push_back(column.values[run]);
      });
      runs[i]->metrics.push_back(metric_of(column.name, values, sets[i].points == 1));
    }
    if (sweep.sides() == 2) summary.paired.push_back(paired_of(sweep, column));
  }
}

/// Counts reasons by kind, at most `most_reasons` of them.
class ReasonCounter {
 public:
  void add(std::uint64_t run, const std::string& status, const std::string& reason) {
    const auto key = std::pair(status, kind_of_reason(reason));
    const auto found = groups_.find(key);
    if (found != groups_.end()) {
      ++found->second.rate.hits;
    } else if (groups_.size() < most_reasons) {
      groups_[key] = {.status = status, .reason = key.second, .rate = {.hits = 1}, .example = run};
    } else {
      ++others_;
    }
  }
  /// Moves the groups into the summary, the most frequent first.
  void finish(SweepSummary& summary) {
    for (auto& [key, group] : groups_) {
      group.rate = rate_of(group.rate.hits, summary.runs);
      summary.reasons.push_back(std::move(group));
    }
    std::ranges::sort(summary.reasons, [](const ReasonSummary& a, const ReasonSummary& b) {
      return a.rate.hits != b.rate.hits ? a.rate.hits > b.rate.hits : a.example < b.example;
    });
    summary.other_reasons = others_;
  }

 private:
  std::map<std::pair<std::string, std::string>, ReasonSummary> groups_;
  std::uint64_t others_ = 0;
};

}  // namespace

std::string kind_of_reason(std::string_view reason) {
  std::string kind;
  const auto digit = [&](std::size_t i) { return i < reason.size() && reason[i] >= '0' && reason[i] <= '9'; };
  for (std::size_t i = 0; i < reason.size();) {
    const std::size_t close = reason[i] == '\'' ? reason.find('\'', i + 1) : std::string_view::npos;
    if (close != std::string_view::npos) {
      kind += "'...'";
      i = close + 1;
    } else if (digit(i) || (reason[i] == '-' && digit(i + 1))) {
      kind += '#';
      for (++i; digit(i) || (i < reason.size() && reason[i] == '.' && digit(i + 1)); ++i) {
      }
    } else {
      kind += reason[i++];
    }
  }
  return kind;
}

Outcome<SweepSummary> summarise(ChunkReader& chunks) {
  const Sweep& sweep = chunks.sweep();
  SweepSummary summary{.job = std::string(sweep.job.name),
                       .runs = sweep.total,
                       .done = std::vector<bool>(sweep.total, true),
                       .sides = {}};
  ReasonCounter reasons;
  const auto outcomes =
      read_outcomes(chunks, [&](std::uint64_t run, const std::string& status, const std::string& reason) {
        summary.done[run] = false;
        reasons.add(run, status, reason);
      });
  if (!outcomes) return pass_on(outcomes);
  reasons.finish(summary);
  std::vector<Subset> sets;
  for (std::uint64_t side = 0; side < sweep.sides(); ++side) {
    sets.push_back({.side = side});
    summary.sides.push_back(runs_of(sweep, *outcomes, sets.back()));
  }
  if (sweep.points > 1 && sweep.points <= most_points_summarised) {
    for (std::uint64_t i = 0; i < sweep.points * sweep.sides(); ++i) {
      sets.push_back({i / sweep.sides(), sweep.points, i % sweep.sides()});
      summary.points.push_back(runs_of(sweep, *outcomes, sets.back()));
    }
  }
  std::vector<RunsSummary*> runs;
  for (RunsSummary& one : summary.sides) runs.push_back(&one);
  for (RunsSummary& one : summary.points) runs.push_back(&one);
  const std::size_t at_once = std::max<std::size_t>(1, numbers_at_a_time / sweep.total);
  for (std::size_t begin = 0; begin < outcomes->metrics.size(); begin += at_once) {
    const std::size_t end = std::min(begin + at_once, outcomes->metrics.size());
    const auto columns = read_columns(chunks, {outcomes->metrics.begin() + static_cast<std::ptrdiff_t>(begin),
                                               outcomes->metrics.begin() + static_cast<std::ptrdiff_t>(end)});
    if (!columns) return pass_on(columns);
    add_metrics(sweep, sets, runs, *columns, summary);
  }
  if (sweep.sides() == 2) summary.paired_done = paired_done_of(sweep, *outcomes);
  return summary;
}

}  // namespace outrider
