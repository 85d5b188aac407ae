#include "outrider/jobs/guard/job.hpp"

#include <gtest/gtest.h>

namespace outrider {
namespace {

/// A mission that came to no plan has no stops and no planned time, and its summary names none.
TEST(GuardSummary, NamesOnlyWhatThereIs) {
  Report report;
  report.world_name = "yard";
  report.metrics = {{"targets", 1.0},  {"reached", 0.0},    {"mission_s", 3.0},
                    {"driven_m", 0.0}, {"turned_rad", 0.0}, {"shots", 1.0}};
  report.tables = {
      {"targets",
       {"name", "status", "shots", "done_s", "x", "y", "pitch_rad", "speed_mps", "clearance_m", "reason"},
       {}}};
  const Job job = guard_job();
  const std::string text = job.summary(report);
  EXPECT_NE(text.find("fired 1 shot\n"), std::string::npos) << text;
  EXPECT_EQ(text.find("nan"), std::string::npos) << text;
  report.metrics.insert(report.metrics.end(), {{"stops", 1.0}, {"planned_s", 2.0}});
  EXPECT_NE(job.summary(report).find("fired 1 shot from 1 stop\n  planned 2"), std::string::npos)
      << job.summary(report);
}

}  // namespace
}  // namespace outrider
