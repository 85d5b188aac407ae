#include "outrider/log/log_queue.hpp"

#include <gtest/gtest.h>

#include "outrider/log/messages/scene_messages.hpp"

namespace outrider {
namespace {

TEST(LogQueue, LogsWhatIsDueInTheOrderOfTime) {
  Log log;
  LogQueue queue;
  queue.note(3.0, "/a", outrider_msgs::Point2{3.0, 0.0});
  queue.note(1.0, "/a", outrider_msgs::Point2{1.0, 0.0});
  queue.note_event(1.0, "hit", "the first at this time");
  queue.note_event(1.0, "status", "the second at this time");
  queue.flush(log, 0.5);
  EXPECT_TRUE(log.channels().empty()) << "nothing is due";
  queue.flush(log, 1.0);
  const auto& points = log.messages<outrider_msgs::Point2>("/a");
  ASSERT_EQ(points.size(), 1U);
  EXPECT_EQ(points[0].message.x, 1.0);
  ASSERT_EQ(events_of(log).size(), 2U);
  EXPECT_EQ(events_of(log)[0].message.name, "hit");
  EXPECT_EQ(events_of(log)[1].message.name, "status");
  queue.note(2.0, "/a", outrider_msgs::Point2{2.0, 0.0});
  queue.flush(log, 9.0);
  queue.flush(log, 10.0);
  ASSERT_EQ(points.size(), 3U) << "each once";
  EXPECT_EQ(points[1].time_s(), 2.0);
  EXPECT_EQ(points[2].time_s(), 3.0);
}

}  // namespace
}  // namespace outrider
