#include "outrider/log/log.hpp"

#include <gtest/gtest.h>

#include "outrider/core/rng.hpp"
#include "outrider/log/append.hpp"
#include "outrider/log/messages/conversions.hpp"
#include "outrider/log/messages/ros_messages.hpp"
#include "outrider/log/messages/scene_messages.hpp"
#include "outrider/log/topics.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

outrider_msgs::Point2 at(double x) { return {x, 0.0}; }

/// Keeps what it receives.
class Keeper final : public LogSink {
 public:
  struct Received {
    std::string topic;
    std::int64_t time_ns = 0;
    double x = 0.0;
    std::size_t channels = 0;  ///< that were known by then
    friend bool operator==(const Received&, const Received&) = default;
  };
  void begin(const Log& log) override { began_with = log.channels().size(); }
  void add_channel(const Channel& channel) override { channels.push_back(channel); }
  void append(std::size_t channel, std::int64_t time_ns, std::string_view data) override {
    const auto point = decode<outrider_msgs::Point2>(MessageEncoding::cdr, data);
    ASSERT_TRUE(point);
    received.push_back({channels.at(channel).topic, time_ns, point->x, channels.size()});
  }
  std::size_t began_with = 0;
  std::vector<Channel> channels;
  std::vector<Received> received;
};

TEST(Log, TheTimesOfAChannelNeverDecrease) {
  Log log;
  log.append("/a", 2.0, at(1));
  log.append("/a", 1.0, at(2));
  log.append("/b", 1.0, at(3));
  log.append("/a", 3.0, at(4));
  const auto& all = log.messages<outrider_msgs::Point2>("/a");
  ASSERT_EQ(all.size(), 3U);
  EXPECT_EQ(all[0].time_s(), 2.0);
  EXPECT_EQ(all[1].time_s(), 2.0) << "a time before the newest counts as that";
  EXPECT_EQ(all[2].time_s(), 3.0);
  EXPECT_EQ(log.messages<outrider_msgs::Point2>("/b")[0].time_s(), 1.0) << "each channel has its own";
  EXPECT_EQ(log.end_s(), 3.0);
}

TEST(Log, TimesComeBackAsTheyWere) {
  Rng rng(5);
  for (int i = 0; i < testing::cases(20'000); ++i) {
    const auto time_ns = static_cast<std::int64_t>(rng.below(std::uint64_t{1} << (1 + rng.below(50))));
    const double time_s = seconds(time_ns);
    ASSERT_EQ(nanoseconds(time_s), time_ns);
    ASSERT_EQ(logged_time(time_s), time_s);
    ASSERT_EQ(nanoseconds_of(stamp_of(time_s)), time_ns);
  }
  // It is the nearest double: that of the decimal number.
  EXPECT_EQ(seconds(300'000'000), 0.3);
  EXPECT_EQ(seconds(1'700'000'001), 1.700000001);
  EXPECT_EQ(seconds(1'600'000'000'250'000'000), 1600000000.25);
}

TEST(Log, AMessageOfAFollowingMissionIsStampedWithItsTime) {
  Log log;
  log.begin_at(84.29999999999);
  for (int i = 0; i < 1000; ++i) log_event(log, 0.1234567890123 * i, "step", "");
  for (const auto& [time_ns, event] : log.messages<rcl_interfaces::Log>(topic::events))
    ASSERT_EQ(nanoseconds_of(event.stamp), time_ns);
}

TEST(Log, AMissionMayFollowAnotherOne) {
  Log log;
  log.append("/a", 4.0, at(1));
  log.begin_at(10.5);
  log.append("/a", 0.25, at(2));
  log.append("/b", 0.0, at(3));
  EXPECT_EQ(log.messages<outrider_msgs::Point2>("/a")[1].time_s(), 10.75);
  EXPECT_EQ(log.messages<outrider_msgs::Point2>("/b")[0].time_s(), 10.5);
  EXPECT_EQ(log.end_s(), 10.75);
}

TEST(Log, WhatIsNotThereIsNone) {
  Log log;
  EXPECT_EQ(log.end_s(), 0.0);
  EXPECT_TRUE(log.messages<outrider_msgs::Point2>("/a").empty());
  EXPECT_EQ(log.latest<outrider_msgs::Point2>("/a"), nullptr);
  log.append("/a", 0.0, at(1));
  log.append("/a", 1.0, at(2));
  ASSERT_NE(log.latest<outrider_msgs::Point2>("/a"), nullptr);
  EXPECT_EQ(log.latest<outrider_msgs::Point2>("/a")->x, 2.0);
  EXPECT_TRUE(log.messages<std_msgs::Header>("/a").empty()) << "of another type";
  EXPECT_EQ(log.latest<std_msgs::Header>("/a"), nullptr);
}

TEST(Log, ChannelsStandInTheOrderOfTheirFirstMessages) {
  Log log;
  log.append("/b", 5.0, at(1));
  log.append("/a", 0.0, at(2));
  log.append("/b", 6.0, at(3));
  ASSERT_EQ(log.channels().size(), 2U);
  EXPECT_EQ(log.channels()[0], channel_of<outrider_msgs::Point2>("/b"));
  EXPECT_EQ(log.channels()[1].topic, "/a");
}

TEST(Log, ASinkReceivesEverythingOnceWheneverItComes) {
  Log log;
  Keeper early, late, gone;
  log.add_sink(early);
  log.add_sink(gone);
  log.append("/b", 5.0, at(1));
  log.append("/a", 0.5, at(2));
  log.append("/b", 4.0, at(3));
  log.remove_sink(gone);
  log.add_sink(late);
  log.append("/c", 1.0, at(4));
  log.append("/a", 7.0, at(5));
  const std::vector<Keeper::Received> all = {{"/b", 5'000'000'000, 1, 1},
                                             {"/a", 500'000'000, 2, 2},
                                             {"/b", 5'000'000'000, 3, 2},
                                             {"/c", 1'000'000'000, 4, 3},
                                             {"/a", 7'000'000'000, 5, 3}};
  EXPECT_EQ(early.received, all);
  EXPECT_EQ(late.received, all);
  EXPECT_EQ(gone.received, std::vector(all.begin(), all.begin() + 3));
  EXPECT_EQ(early.channels, log.channels());
  EXPECT_EQ(late.channels, log.channels());
  EXPECT_EQ(early.began_with, 0U);
  EXPECT_EQ(late.began_with, 2U) << "it may look at the log before anything else";
}

TEST(Log, KeepsOnlyTheNewestIfItIsToldTo) {
  Log log;
  Keeper all, late;
  log.add_sink(all);
  log.append("/a", 0.0, at(0));
  log.keep_newest(10);
  for (int i = 1; i < 1000; ++i) {
    log.append("/a", i, at(i));
    if (i % 100 == 0) log.append("/b", i, at(i));
    const auto& kept = log.messages<outrider_msgs::Point2>("/a");
    ASSERT_FALSE(kept.empty());
    ASSERT_LT(kept.size(), 20U);
    ASSERT_EQ(kept.back().message.x, i);
    ASSERT_EQ(kept[kept.size() - std::min<std::size_t>(kept.size(), 10)].message.x, std::max(i - 9, 0));
  }
  EXPECT_EQ(all.received.size(), 1009U);
  EXPECT_EQ(log.messages<outrider_msgs::Point2>("/b").size(), 9U);
  log.add_sink(late);
  log.append("/b", 2000.0, at(7));
  EXPECT_EQ(late.channels, log.channels());
  ASSERT_EQ(late.received.size(), 1U);
}

}  // namespace
}  // namespace outrider
