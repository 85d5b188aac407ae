// Node: a part of a robot that takes messages in and gives messages out, as nodes of ROS 2 do.
//
//   MapperNode mapper({});
//   mapper.receive(input, bytes, time_s);     // what came on the topic inputs()[input]
//   mapper.tick(time_s);                      // at least every period_s()
//   for (const NodeOutput& sent : mapper.take_outputs()) ...
//
// A node knows no network and no clock: the caller gives it encoded messages (CDR) and the time. The same
// messages at the same times give the same outputs. A message that is refused becomes an event, a sentence
// that names the topic, and has no other effect. Every node sends its events as rcl_interfaces/Log on
// "/rosout", and what it does as diagnostic_msgs/DiagnosticStatus on its topic of status: again every second,
// since messages get lost. Thread rule: one at a time.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "outrider/core/outcome.hpp"
#include "outrider/log/encoding/codecs.hpp"
#include "outrider/log/encoding/message_type.hpp"
#include "outrider/nodes/messages/delivery.hpp"
#include "outrider/nodes/messages/node_messages.hpp"

namespace outrider {

struct NodeTopic {
  std::string name;  ///< relative to the namespace unless it begins with '/'; "~/..." is relative to the node
  const MessageType* type = nullptr;
  Delivery delivery = Delivery::reliable;
};

/// An encoded message, and the index of its topic in Node::outputs().
struct NodeOutput {
  std::size_t topic = 0;
  std::string bytes;
};

enum class NodeLevel : std::uint8_t { info = 20, warning = 30, error = 40 };

/// Something that a node has to tell people.
struct NodeEvent {
  double time_s = 0.0;
  NodeLevel level = NodeLevel::info;
  std::string sentence;
};

/// The activity of a node: a word for programs and a sentence for people.
struct NodeStatus {
  NodeLevel level = NodeLevel::info;
  std::string state;
  std::string sentence;
  friend bool operator==(const NodeStatus&, const NodeStatus&) = default;
};

class RobotFrames;

class Node {
 public:
  virtual ~Node() = default;
  Node(const Node&) = delete;
  Node& operator=(const Node&) = delete;

  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] double period_s() const { return period_s_; }
  [[nodiscard]] const std::vector<NodeTopic>& inputs() const { return inputs_; }
  [[nodiscard]] const std::vector<NodeTopic>& outputs() const { return outputs_; }
  [[nodiscard]] const NodeStatus& status() const { return status_; }

  /// Returns true once it has nothing to do any more.
  [[nodiscard]] virtual bool is_over() const { return false; }

  /// Takes a message of the topic inputs()[input].
  void receive(std::size_t input, std::string_view cdr, double time_s);
  /// Acts at a time.
  void tick(double time_s);

  /// Return what was sent and what happened since the last call.
  std::vector<NodeOutput> take_outputs() { return std::exchange(sent_, {}); }
  std::vector<NodeEvent> take_events() { return std::exchange(events_, {}); }

 protected:
  /// `status_topic` is the topic of its status.
  Node(std::string name, double period_s, std::string status_topic = "~/status");

  /// Listens to a topic. `handle` returns a fault for a message that it refuses.
  template <class Message>
  void listen(std::string topic, Delivery delivery, std::function<Status(const Message&)> handle) {
    inputs_.push_back({std::move(topic), &message_type<Message>(), delivery});
    handlers_.push_back([handle = std::move(handle)](std::string_view cdr) -> Status {
      const auto message = decode<Message>(MessageEncoding::cdr, cdr);
      if (!message) return pass_on(message);
      return handle(*message);
    });
  }
  /// Listens to /tf and /tf_static for `frames`, which must live as long as the node.
  void listen_to_transforms(RobotFrames& frames);
  /// Adds a topic to the outputs, also later, and returns its index.
  template <class Message>
  std::size_t add_output(std::string topic, Delivery delivery) {
    return add_output(std::move(topic), message_type<Message>(), delivery);
  }
  /// The same for a type that is chosen at run time.
  std::size_t add_output(std::string topic, const MessageType& type, Delivery delivery) {
    outputs_.push_back({std::move(topic), &type, delivery});
    return outputs_.size() - 1;
  }
  template <class Message>
  void send(std::size_t output, const Message& message) {
    sent_.push_back({output, encode(MessageEncoding::cdr, message)});
  }

  /// Sends what is encoded already.
  void send_bytes(NodeOutput output) { sent_.push_back(std::move(output)); }

  virtual void act() = 0;

  [[nodiscard]] double now_s() const { return now_s_; }
  /// Returns why a message is missing that came last at that time: it has not come yet, or not for `most_s`.
  /// Empty if it is not missing.
  [[nodiscard]] std::string why_missing(std::string_view what, const std::optional<double>& came_s,
                                        double most_s) const;
  /// Tells people; the same sentence at most once in 5 s.
  void tell(NodeLevel level, std::string sentence);
  /// Says what it does. A change is told to people too.
  void set_status(NodeLevel level, std::string state, std::string sentence);

 private:
  void send_status();

  std::string name_;
  double period_s_;
  std::vector<NodeTopic> inputs_;
  std::vector<std::function<Status(std::string_view)>> handlers_;
  std::vector<NodeTopic> outputs_;
  std::vector<NodeOutput> sent_;
  std::vector<NodeEvent> events_;
  std::map<std::string, double> told_;  ///< time of each sentence
  NodeStatus status_;
  double status_sent_s_ = -std::numeric_limits<double>::infinity();
  double now_s_ = 0.0;
};

}  // namespace outrider
