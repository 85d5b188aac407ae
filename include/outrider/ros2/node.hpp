// RosNode: sends and receives messages of ROS 2 without ROS, through Cyclone DDS.
//
//   auto node = RosNode::open(*ros_environment());
//   auto scans = node->reader("/scan", message_type<sensor_msgs::LaserScan>(), Delivery::sensor);
//   auto commands = node->writer("/cmd_vel", message_type<nav_msgs::Path>(), Delivery::reliable);
//
// Names, types and bytes on the wire are those of ROS 2 (names.hpp, codecs.hpp). Tried against Fast DDS, the
// usual implementation under ROS 2, in both directions (tests/ros2); not yet against a node of ROS 2. A
// message that somebody else sent is refused if its bytes do not fit its type. A reader or a writer keeps its
// node open. Thread rule: each of the three may be used by one thread at a time.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "outrider/core/outcome.hpp"
#include "outrider/log/encoding/message_type.hpp"
#include "outrider/nodes/messages/delivery.hpp"
#include "outrider/ros2/names.hpp"

namespace outrider {

struct RosNodeOptions {
  std::int64_t domain = 0;      ///< 0 to 232; only nodes of one domain see each other
  bool localhost_only = false;  ///< only nodes of this machine that are limited to it too, at most 33
};

/// Returns what ROS_DOMAIN_ID and ROS_LOCALHOST_ONLY say; 0 and false where they are not set. Faults:
/// bad_input for a domain that is none.
Outcome<RosNodeOptions> ros_environment();

class RosNode;

class RosWriter {
 public:
  /// Sends CDR bytes, which begin with the four that name the encoding. Faults: cannot_write.
  Status send_bytes(const std::string& bytes);
  /// Encodes the message of the writer's type and sends it.
  Status send(const void* message);
  /// Returns how many readers are known now.
  [[nodiscard]] std::size_t readers() const;

 private:
  friend class RosNode;
  struct Wire;
  explicit RosWriter(std::shared_ptr<Wire> wire) : wire_(std::move(wire)) {}
  std::shared_ptr<Wire> wire_;
};

class RosReader {
 public:
  /// Returns the bytes of the oldest message that was not taken yet; nothing if there is none.
  std::optional<std::string> take_bytes();
  /// Takes one into the message of the reader's type. Returns false if there is none. Faults: bad_input for
  /// bytes that are no such message; then it is taken all the same, and the content of `message` is
  /// unspecified.
  Outcome<bool> take(void* message);
  /// Returns how many writers are known now.
  [[nodiscard]] std::size_t writers() const;

 private:
  friend class RosNode;
  struct Wire;
  explicit RosReader(std::shared_ptr<Wire> wire) : wire_(std::move(wire)) {}
  std::shared_ptr<Wire> wire_;
};

class RosNode {
 public:
  /// Faults: bad_input for a domain that is none, or if the network cannot be used.
  static Outcome<RosNode> open(const RosNodeOptions& options);

  /// `topic` is absolute. Faults: bad_input for its name (resolve_topic()), or if the network refuses.
  Outcome<RosWriter> writer(const std::string& topic, const MessageType& type, Delivery qos);
  Outcome<RosReader> reader(const std::string& topic, const MessageType& type, Delivery qos);

  /// Return the ends of a service on the side of its server. `service` is absolute. Faults: as above.
  Outcome<RosReader> request_reader(const std::string& service, const MessageType& request);
  Outcome<RosWriter> reply_writer(const std::string& service, const MessageType& response);
  /// Return the ends on the side of a client.
  Outcome<RosWriter> request_writer(const std::string& service, const MessageType& request);
  Outcome<RosReader> reply_reader(const std::string& service, const MessageType& response);

  /// Says on the topic ros_discovery_info that this is the node of that name, and that its readers and
  /// writers so far are the node's: so `ros2 node list` and `ros2 node info` show it. Latched.
  Status announce(const RosNamespace& as);

 private:
  struct Participant;
  Outcome<RosWriter> writer_on_wire(const std::string& topic, const MessageType& type, Delivery qos);
  Outcome<RosReader> reader_on_wire(const std::string& topic, const MessageType& type, Delivery qos);
  explicit RosNode(std::shared_ptr<Participant> participant) : participant_(std::move(participant)) {}
  std::shared_ptr<Participant> participant_;
};

}  // namespace outrider
