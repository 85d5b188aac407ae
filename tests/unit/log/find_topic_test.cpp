#include "outrider/log/find_topic.hpp"

#include <gtest/gtest.h>

namespace outrider {
namespace {

constexpr const char* scan = "sensor_msgs/msg/LaserScan";

Channel channel(const std::string& topic, const std::string& type) { return {topic, type, "cdr", "", ""}; }

const std::vector<Channel> one = {channel("/odom", "nav_msgs/msg/Odometry"), channel("/scan", scan)};
const std::vector<Channel> two = {channel("/front", scan), channel("/odom", "nav_msgs/msg/Odometry"),
                                  channel("/rear", "sensor_msgs/LaserScan")};

std::string topic_fault(const std::vector<Channel>& channels, const std::string& topic) {
  const auto found = find_topic(channels, {{scan}, topic, "--scan"});
  return found ? "it was found" : to_string(found.error());
}

TEST(FindTopic, WithoutANameTheOnlyOneOfTheTypeIsFound) {
  EXPECT_EQ(find_topic(one, {{scan}, "", "--scan"}), std::vector<std::size_t>{1});
  EXPECT_EQ(topic_fault(two, ""),
            "--scan: the log has several topics of the type sensor_msgs/msg/LaserScan: /front, /rear; name "
            "one of them");
  EXPECT_EQ(topic_fault({one[0]}, ""),
            "--scan: the log has no topic of the type sensor_msgs/msg/LaserScan; it has /odom");
  EXPECT_EQ(topic_fault({}, ""),
            "--scan: the log has no topic of the type sensor_msgs/msg/LaserScan; it has no topic at all");
}

TEST(FindTopic, ANamedTopicExistsAndHasTheType) {
  EXPECT_EQ(find_topic(two, {{scan}, "/rear", "--scan"}), std::vector<std::size_t>{2});
  EXPECT_EQ(topic_fault(two, "/odom"),
            "--scan: the messages of /odom are nav_msgs/msg/Odometry, and not sensor_msgs/msg/LaserScan; "
            "name another "
            "topic");
  EXPECT_EQ(topic_fault(two, "/left"),
            "--scan: the log has no topic '/left'; sensor_msgs/msg/LaserScan has /front, /rear");
}

TEST(FindTopic, AnyOfSeveralTypesWillDo) {
  const TopicWish wish{{"a/msg/B", scan}, "", "--topic"};
  EXPECT_EQ(find_topic(one, wish), std::vector<std::size_t>{1});
  const auto none = find_topic({one[0]}, wish);
  ASSERT_FALSE(none);
  EXPECT_NE(none.error().sentence.find("a/msg/B or sensor_msgs/msg/LaserScan"), std::string::npos);
}

TEST(FindTopic, ATopicOfSeveralSendersIsOne) {
  EXPECT_EQ(find_topic({one[1], one[0], one[1]}, {{scan}, "", "--scan"}), (std::vector<std::size_t>{0, 2}));
}

TEST(FindTopic, NamesAreShownSafelyAndNotAllOfThem) {
  std::vector<Channel> many;
  for (int i = 0; i < 20; ++i) many.push_back(channel("/\x1b" + std::to_string(i), scan));
  const std::string fault = topic_fault(many, "");
  EXPECT_NE(fault.find("/?0, /?1"), std::string::npos) << fault;
  EXPECT_NE(fault.find("and 12 more"), std::string::npos) << fault;
}

}  // namespace
}  // namespace outrider
