// Published: what nodes on a bus have sent, to be compared with the log of a run.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "outrider/log/log.hpp"
#include "outrider/nodes/missions/mission_node.hpp"
#include "support/node_bus.hpp"

namespace outrider::testing {

/// Topics have the messages of the log, in the same order and with the same bytes; a node keeps only the
/// newest messages of each channel in its log.
class Published {
 public:
  explicit Published(NodeBus& bus) {
    bus.look = [this](const std::string& topic, const std::string& bytes) {
      messages_[topic].push_back(bytes);
    };
  }
  template <class Message>
  void expect_same(const Log& log, std::string_view topic) const {
    const auto& logged = log.messages<Message>(topic);
    const auto found = messages_.find(std::string(topic));
    ASSERT_NE(found, messages_.end()) << topic;
    ASSERT_GE(found->second.size(), logged.size()) << topic;
    ASSERT_FALSE(logged.empty());
    const std::size_t dropped = found->second.size() - logged.size();
    ASSERT_TRUE(dropped == 0 || logged.size() >= MissionNode::kept) << topic;
    ASSERT_LT(logged.size(), 2 * MissionNode::kept) << topic;
    for (std::size_t i = 0; i < logged.size(); ++i)
      ASSERT_EQ(found->second[dropped + i], encode(MessageEncoding::cdr, logged[i].message)) << topic;
  }
  /// The same, but others may stand between them.
  template <class Message>
  void expect_all(const Log& log, std::string_view topic) const {
    const auto& logged = log.messages<Message>(topic);
    const auto found = messages_.find(std::string(topic));
    ASSERT_NE(found, messages_.end()) << topic;
    ASSERT_FALSE(logged.empty());
    auto next = found->second.begin();
    for (const auto& one : logged) {
      next = std::find(next, found->second.end(), encode(MessageEncoding::cdr, one.message));
      ASSERT_NE(next, found->second.end()) << topic << " at " << one.time_s();
      ++next;
    }
  }
  /// Every channel of the log but those, and /rosout where nodes speak, is on a topic.
  void expect_channels(const Log& log, const std::set<std::string>& left_out) const {
    for (const Channel& channel : log.channels()) {
      if (channel.topic == "/rosout") continue;
      EXPECT_NE(messages_.contains(channel.topic), left_out.contains(channel.topic)) << channel.topic;
    }
  }
  [[nodiscard]] std::size_t count(const std::string& topic) const {
    const auto found = messages_.find(topic);
    return found == messages_.end() ? 0 : found->second.size();
  }
  [[nodiscard]] const std::map<std::string, std::vector<std::string>>& all() const { return messages_; }

 private:
  std::map<std::string, std::vector<std::string>> messages_;
};

}  // namespace outrider::testing
