// Run-length lists of a report from outside: what does not fill its map is refused before it is spread out.
#include <gtest/gtest.h>

#include <limits>
#include <regex>

#include "outrider/report/json.hpp"
#include "sample_explore.hpp"

namespace outrider {
namespace {

PageReport pursuit_of(int columns, int rows, std::vector<double> runs) {
  PageReport report;
  report.job = "pursue";
  report.status = "done";
  report.bounds = {{0.0, 0.0}, {3.0, 2.0}};
  ReportPursuit& pursuit = report.pursuit.emplace();
  pursuit.columns = columns;
  pursuit.rows = rows;
  pursuit.cost_runs = std::move(runs);
  return report;
}

std::string with_runs(const std::string& key, const std::string& list) {
  const std::string text = to_json(test::sample_explore());
  return std::regex_replace(text, std::regex("\"" + key + "\":\\[[^\\]]*\\]"), "\"" + key + "\":" + list);
}

void expect_refused(const std::string& text, const std::string& where, const std::string& part) {
  const auto report = report_from_json(text);
  ASSERT_FALSE(report) << part;
  EXPECT_EQ(report.error().where, where);
  EXPECT_NE(report.error().sentence.find(part), std::string::npos) << report.error().sentence;
}

TEST(Runs, CostsThatDoNotFillTheMapAreRefused) {
  const std::vector<std::pair<std::vector<double>, std::string>> cases = {
      {{1, 2, 7, 3}, "add up to 5 cells, but the map has 3 x 2"},
      {{1, 2, 7, 5}, "entry 3 is 5"},
      {{1, -2, 7, 8}, "entry 1 is -2"},
      {{1, 2.5, 7, 3.5}, "entry 1 is 2.5"},
      {{1, 6, 7}, "3 entries"},
      {{1, 1e300}, "entry 1 is 1e+300"},
      {{1, 9007199254740994.0}, "entry 1 is 9007199254740994"},
      {{}, "add up to 0 cells"}};
  for (const auto& [runs, part] : cases) {
    expect_refused(to_json(pursuit_of(3, 2, runs)), "pursuit.cost_runs", part);
  }
  expect_refused(to_json(pursuit_of(3, 2, {1, std::numeric_limits<double>::quiet_NaN()})),
                 "pursuit.cost_runs[1]", "null");
  EXPECT_TRUE(report_from_json(to_json(pursuit_of(3, 2, {1, 2, 7, 4}))));
  EXPECT_TRUE(report_from_json(to_json(pursuit_of(0, 0, {}))));
}

TEST(Runs, MapsOfMoreCellsThanAreDrawnAreRefused) {
  expect_refused(to_json(pursuit_of(1'000'000'000, 1'000'000'000, {1, 1e18})), "pursuit.cost_runs",
                 "1000000000 x 1000000000 cells");
  expect_refused(to_json(pursuit_of(4'000'001, 1, {1, 4'000'001})), "pursuit.cost_runs", "4000000 at most");
  EXPECT_TRUE(report_from_json(to_json(pursuit_of(4'000'000, 1, {1, 4'000'000}))));
}

TEST(Runs, DiscoveredMapsAreCheckedAlike) {
  ASSERT_TRUE(report_from_json(to_json(test::sample_explore())));
  for (const std::string key : {"state_runs", "known_runs"}) {
    const std::string where = "explore.map." + key;
    expect_refused(with_runs(key, "[]"), where, "add up to 0 cells");
    expect_refused(with_runs(key, "[0]"), where, "1 entries");
    expect_refused(with_runs(key, "[0,1000000000]"), where, "entry 1 is 1000000000");
    expect_refused(with_runs(key, "[0,-1]"), where + "[1]", "whole number");
    expect_refused(with_runs(key, "[0,1.5]"), where + "[1]", "whole number");
  }
}

}  // namespace
}  // namespace outrider
