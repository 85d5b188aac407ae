// NodeBus: joins nodes in one process, in simulated time, with messages that get lost or come late.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "outrider/nodes/messages/message_faults.hpp"
#include "outrider/nodes/node.hpp"

namespace outrider::testing {

class NodeBus {
 public:
  explicit NodeBus(const MessageFaults& faults = {}) : faults_(faults) {}

  /// Adds a node, or starts one of the same name anew. It gets the newest latched message of each topic.
  void start(std::unique_ptr<Node> node) {
    const std::string name = node->name();
    Member member{std::move(node), time_s_, {}};
    for (std::size_t i = 0; i < member.node->inputs().size(); ++i) {
      member.links.emplace_back(faults_, rng_.child(links_++));
      const NodeTopic& topic = member.node->inputs()[i];
      const auto latched = latched_.find(absolute(*member.node, topic.name));
      const bool wants = topic.delivery == Delivery::latched || topic.delivery == Delivery::fixed;
      if (wants && latched != latched_.end()) member.node->receive(i, latched->second, time_s_);
    }
    nodes_.insert_or_assign(name, std::move(member));
  }
  void kill(const std::string& name) { nodes_.erase(name); }
  [[nodiscard]] bool runs(const std::string& name) const { return nodes_.contains(name); }
  template <class Kind>
  const Kind& node(const std::string& name) const {
    return dynamic_cast<const Kind&>(*nodes_.at(name).node);
  }
  [[nodiscard]] const NodeStatus& status(const std::string& name) const {
    return nodes_.at(name).node->status();
  }
  [[nodiscard]] double time_s() const { return time_s_; }

  /// Sees every message that is sent: topic and bytes.
  std::function<void(const std::string&, const std::string&)> look;
  /// Says which topics nobody hears.
  std::function<bool(const std::string& topic)> drop;
  /// Sees every event.
  std::function<void(const std::string& node, const NodeEvent&)> hear;

  /// Prints every event, if OUTRIDER_TALK is in the environment.
  void talk() {
    if (std::getenv("OUTRIDER_TALK") == nullptr) return;
    hear = [this](const std::string& node, const NodeEvent& event) {
      std::printf("%8.2f %s: %s\n", time_s_, node.c_str(), event.sentence.c_str());
    };
  }

  /// Runs until a time, or until `done`. Returns true if that came.
  bool run(double until_s, const std::function<bool()>& done = {}) {
    constexpr double step_s = 0.01;
    while (time_s_ < until_s) {
      time_s_ = static_cast<double>(++steps_) * step_s;
      for (auto& [name, member] : nodes_) advance(member);
      if (done && done()) return true;
    }
    return false;
  }

 private:
  struct Member {
    std::unique_ptr<Node> node;
    double due_s = 0.0;
    std::vector<FaultyLink<std::string>> links;  ///< of the inputs
  };

  static std::string absolute(const Node& node, const std::string& name) {
    if (name.starts_with("~/")) return "/" + node.name() + name.substr(1);
    return name.starts_with('/') ? name : "/" + name;
  }

  void advance(Member& member) {
    Node& node = *member.node;
    for (std::size_t i = 0; i < member.links.size(); ++i) {
      while (const auto bytes = member.links[i].take(time_s_)) node.receive(i, *bytes, time_s_);
    }
    if (time_s_ + 1e-9 >= member.due_s) {
      node.tick(time_s_);
      member.due_s = time_s_ + node.period_s();
    }
    for (const NodeEvent& event : node.take_events()) {
      if (hear) hear(node.name(), event);
    }
    for (const NodeOutput& output : node.take_outputs()) {
      const NodeTopic& topic = node.outputs()[output.topic];
      deliver(absolute(node, topic.name), output.bytes, topic.delivery);
    }
  }

  void deliver(const std::string& topic, const std::string& bytes, Delivery delivery) {
    if (look) look(topic, bytes);
    if (drop && drop(topic)) return;
    if (delivery == Delivery::latched || delivery == Delivery::fixed) latched_[topic] = bytes;
    for (auto& [name, member] : nodes_) {
      for (std::size_t i = 0; i < member.links.size(); ++i) {
        if (absolute(*member.node, member.node->inputs()[i].name) != topic) continue;
        // A message that is sent once is not lost: DDS sends it again.
        const bool once = topic == "/tf_static" || topic == "/clock";
        once ? member.node->receive(i, bytes, time_s_) : member.links[i].push(time_s_, bytes);
      }
    }
  }

  MessageFaults faults_;
  Rng rng_{7};
  std::uint64_t links_ = 0;
  std::map<std::string, Member> nodes_;
  std::map<std::string, std::string> latched_;
  double time_s_ = 0.0;
  std::int64_t steps_ = 0;
};

}  // namespace outrider::testing
