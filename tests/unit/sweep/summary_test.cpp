// The oracle reads the table, as a user would, and computes by definition.
#include "outrider/sweep/summary.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "outrider/io/files/text.hpp"
#include "sweep_job.hpp"

namespace outrider {
namespace {

using Summary = testing::SweepFolder;

using Rows = std::vector<std::map<std::string, std::string>>;

Rows rows_of(std::string_view text) {
  const auto columns = csv_fields(take_line(text));
  Rows rows;
  while (!text.empty()) {
    const auto fields = csv_fields(take_line(text));
    auto& row = rows.emplace_back();
    for (std::size_t i = 0; i < columns.size(); ++i) row[columns[i]] = fields[i];
  }
  return rows;
}

void expect_same(const RunsSummary& found, Rows rows) {
  std::erase_if(rows, [&](const auto& row) {
    return std::ranges::any_of(found.values,
                               [&](const auto& value) { return row.at(value.first) != value.second; });
  });
  std::vector<double> values;
  std::map<std::string, std::uint64_t> statuses;
  for (const auto& row : rows) {
    ++statuses[row.at("status")];
    if (!row.at("y").empty()) values.push_back(std::stod(row.at("y")));
  }
  EXPECT_EQ(found.done.count, rows.size());
  EXPECT_EQ(found.done.hits, statuses["done"]);
  for (const auto& [status, count] : found.statuses) EXPECT_EQ(count, statuses[status]);
  ASSERT_FALSE(found.metrics.empty());
  const MetricSummary& metric = found.metrics[0];
  EXPECT_EQ(metric.name, "y");
  ASSERT_EQ(metric.count, values.size());
  std::ranges::sort(values);
  double sum = 0.0, squares = 0.0;
  for (double value : values) sum += value;
  const double mean = sum / static_cast<double>(values.size());
  for (double value : values) squares += std::pow(value - mean, 2);
  EXPECT_NEAR(metric.mean, mean, 1e-12);
  EXPECT_NEAR(metric.deviation, std::sqrt(squares / static_cast<double>(values.size() - 1)), 1e-12);
  EXPECT_EQ(metric.low, values.front());
  EXPECT_EQ(metric.high, values.back());
  EXPECT_EQ(metric.quantiles[2].value, quantile(values, 0.5));
  EXPECT_LT(metric.mean_interval.low, mean);
  EXPECT_GT(metric.mean_interval.high, mean);
}

TEST_F(Summary, RatesAndMetricsAreThoseOfTheTable) {
  const Sweep all = sweep({.runs = 100, .seed = 2, .vary = {"x=uniform(0,9)", "mode=a,b"}, .chunk_runs = 64});
  const Rows rows = rows_of(table(all, "out"));
  ChunkReader chunks(all, path("out"));
  const auto summary = summarise(chunks);
  ASSERT_TRUE(summary) << to_string(summary.error());
  ASSERT_EQ(summary->sides.size(), 1U);
  ASSERT_EQ(summary->points.size(), 2U);
  expect_same(summary->sides[0], rows);
  for (const RunsSummary& point : summary->points) expect_same(point, rows);
  EXPECT_EQ(summary->points[1].values, (std::vector<std::pair<std::string, std::string>>{{"mode", "b"}}));
  ASSERT_EQ(summary->reasons.size(), 2U);
  std::uint64_t failed = 0;
  for (const ReasonSummary& reason : summary->reasons) failed += reason.rate.hits;
  EXPECT_EQ(failed, 200U - summary->sides[0].done.hits);
  std::vector<std::string> kinds = {summary->reasons[0].reason, summary->reasons[1].reason};
  std::ranges::sort(kinds);
  EXPECT_EQ(kinds, (std::vector<std::string>{"x: x '...' is too small", "y is #, above #"}));
}

TEST_F(Summary, ComparisonsPairTheRunsOfOneSeed) {
  const Sweep all = sweep({.runs = 50, .seed = 2, .vary = {"mode=uniform(0,1)"}, .compare = {"x=7,7.5"}});
  const Rows rows = rows_of(table(all, "out"));
  ChunkReader chunks(all, path("out"));
  const auto summary = summarise(chunks);
  ASSERT_TRUE(summary);
  ASSERT_EQ(summary->sides.size(), 2U);
  for (const RunsSummary& side : summary->sides) expect_same(side, rows);
  ASSERT_EQ(summary->paired.size(), 1U);
  const PairedSummary& paired = summary->paired[0];
  EXPECT_EQ(paired.pairs, 50U);
  EXPECT_EQ(paired.more, 50U);
  EXPECT_NEAR(paired.median_difference, 1.0, 1e-12) << "the seeds are the same, so is what is random";
  EXPECT_NEAR(paired.interval.low, 1.0, 1e-12);
  PairedDone done;
  for (std::size_t i = 0; i < rows.size(); i += 2) {
    EXPECT_EQ(rows[i].at("seed"), rows[i + 1].at("seed"));
    const bool a = rows[i].at("status") == "done", b = rows[i + 1].at("status") == "done";
    ++(a && b ? done.both : a ? done.only_a : b ? done.only_b : done.neither);
  }
  EXPECT_EQ(summary->paired_done.both, done.both);
  EXPECT_EQ(summary->paired_done.only_a, done.only_a);
  EXPECT_EQ(summary->paired_done.only_b, done.only_b);
  EXPECT_EQ(summary->paired_done.neither, done.neither);
}

TEST(Reasons, NumbersAndQuotesAreLeftOut) {
  EXPECT_EQ(kind_of_reason("to 3.5,-2: the goal (3.5, -2) is blocked"), "to #,#: the goal (#, #) is blocked");
  EXPECT_EQ(kind_of_reason("it ends at 5."), "it ends at #.");
  EXPECT_EQ(kind_of_reason("'fox 1' and 'hare' don't - move"), "'...' and '...' don't - move");
  EXPECT_EQ(kind_of_reason(""), "");
}

}  // namespace
}  // namespace outrider
