// The report of a pursuit: its text and back, its picture and its page.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "outrider/report/json.hpp"

namespace outrider {
namespace {

PageReport sample() {
  PageReport report;
  report.job = "pursue";
  report.status = "done";
  report.world_name = "a <small> map";
  report.bounds = {{0.0, 0.0}, {3.0, 2.0}};
  ReportPursuit& pursuit = report.pursuit.emplace();
  pursuit.columns = 3;
  pursuit.rows = 2;
  pursuit.cost_runs = {1, 2, 7, 3, -1, 1};
  pursuit.target = {{2.5, 0.5}, {1.5, 0.5}};
  pursuit.robots = {{{0.5, 0.5}, {1.5, 0.5}}};
  pursuit.paid = {0, 1};
  pursuit.bounds = {{0, 10, std::numeric_limits<double>::quiet_NaN(), 1}, {0, 25, 1, 1}};
  return report;
}

TEST(PursuitReport, ReadsBackByteEqual) {
  const std::string text = to_json(sample());
  const auto report = report_from_json(text);
  ASSERT_TRUE(report) << to_string(report.error());
  EXPECT_EQ(to_json(*report), text);
  ASSERT_TRUE(report->pursuit);
  EXPECT_TRUE(std::isnan(report->pursuit->bounds[0].cost));
  EXPECT_EQ(report->pursuit->cost_runs, sample().pursuit->cost_runs);
}

TEST(PursuitReport, IsAbsentFromOtherJobs) {
  PageReport report = sample();
  report.pursuit.reset();
  const auto back = report_from_json(to_json(report));
  ASSERT_TRUE(back);
  EXPECT_FALSE(back->pursuit);
}

TEST(PursuitReport, FaultsNameThePlace) {
  std::string text = to_json(sample());
  text.replace(text.find("\"rows\""), 6, "\"rwos\"");
  const auto report = report_from_json(text);
  ASSERT_FALSE(report);
  EXPECT_EQ(report.error().where, "pursuit.rows");
}

}  // namespace
}  // namespace outrider
