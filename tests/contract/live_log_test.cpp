// A mission logs as it goes on: whoever watches the log can stop the run in the middle of it.
#include <gtest/gtest.h>

#include <algorithm>
#include <stop_token>

#include "outrider/job/run_job.hpp"
#include "outrider/jobs/catalog.hpp"
#include "outrider/log/topics.hpp"

namespace outrider {
namespace {

/// Stops a run once a pose of the robot at that time, or a later one, is logged.
class StopAtPose final : public LogSink {
 public:
  StopAtPose(std::stop_source& stop, double time_s) : stop_(stop), time_ns_(nanoseconds(time_s)) {}
  void add_channel(const Channel& channel) override { topics_.push_back(channel.topic); }
  void append(std::size_t channel, std::int64_t time_ns, std::string_view /*data*/) override {
    if (topics_[channel] == topic::pose && time_ns >= time_ns_) stop_.request_stop();
  }

 private:
  std::stop_source& stop_;
  std::int64_t time_ns_;
  std::vector<std::string> topics_;
};

/// Keeps the times of all messages in the order in which they were appended. Targets apart: what became of a
/// ball that nobody waited for is known after the drive in which it landed.
class Times final : public LogSink {
 public:
  void add_channel(const Channel& channel) override { topics_.push_back(channel.topic); }
  void append(std::size_t channel, std::int64_t time_ns, std::string_view /*data*/) override {
    (topics_[channel] == topic::targets ? targets_ns : all_ns).push_back(time_ns);
  }
  std::vector<std::int64_t> all_ns;
  std::vector<std::int64_t> targets_ns;

 private:
  std::vector<std::string> topics_;
};

struct MissionScenario {
  std::string name;
  std::string path;
  Changes changes = {};
  friend void PrintTo(const MissionScenario& row, std::ostream* out) { *out << row.name; }
};

class LiveLog : public testing::TestWithParam<MissionScenario> {
 protected:
  static Outcome<outrider::Run> run(const RunWatch& watch) {
    return run_job(jobs(), OUTRIDER_SOURCE_DIR "/scenarios/" + GetParam().path, GetParam().changes, watch);
  }
};

TEST_P(LiveLog, IsAppendedInTheOrderOfTimeWhileTheMissionGoesOn) {
  Times times;
  const auto whole = run({.sinks = {&times}});
  ASSERT_TRUE(whole) << whole.error().sentence;
  EXPECT_TRUE(std::ranges::is_sorted(times.all_ns));
  EXPECT_TRUE(std::ranges::is_sorted(times.targets_ns));
  const double end_s = whole->log.end_s();
  ASSERT_GT(end_s, 1.0);

  std::stop_source stop;
  StopAtPose watcher(stop, 0.4 * end_s);
  const auto part = run({.stop = stop.get_token(), .sinks = {&watcher}});
  ASSERT_TRUE(part) << part.error().sentence;
  EXPECT_EQ(part->report.status, "cancelled");
  EXPECT_GE(part->log.end_s(), 0.4 * end_s);
  EXPECT_LT(part->log.end_s(), 0.8 * end_s);
}

INSTANTIATE_TEST_SUITE_P(
    Missions, LiveLog,
    testing::Values(MissionScenario{"pursue", "pursuit/park.yaml"},
                    MissionScenario{"cover", "cover/cover_room.yaml"},
                    MissionScenario{
                        "guard", "yard/yard.yaml", {{"plan.resolution", "0.4"}, {"plan.iterations", "20"}}},
                    MissionScenario{"drive", "waypoints/closed_loop.yaml", {{"sight", "modelled"}}}),
    [](const auto& row) { return row.param.name; });

}  // namespace
}  // namespace outrider
