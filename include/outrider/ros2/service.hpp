// RosService: answers requests of a service of ROS 2, as nodes on rmw_cyclonedds send them.
//
// In the payload, after the four bytes that name the encoding, 16 bytes name the client and the request (8
// for the client, 8 that count its requests), then comes the request; the response begins with the same 16.
// The requests of rmw_fastrtps name both outside of the payload, where the interface of Cyclone DDS does not
// show them: they are not answered. Thread rule: one thread.
#pragma once

#include "outrider/nodes/parameters.hpp"
#include "outrider/ros2/node.hpp"

namespace outrider {

class RosService {
 public:
  /// `name` is that of the node with its namespace. Faults: those of RosNode::reader().
  static Outcome<RosService> open(RosNode& network, const std::string& node, NodeService service);

  /// Answers the requests that have come, at most 10. Requests that are none are left without an answer, as
  /// are those whose answer the network refuses.
  void answer();

 private:
  RosService(RosReader requests, RosWriter responses, NodeService service)
      : requests_(std::move(requests)), responses_(std::move(responses)), service_(std::move(service)) {}

  RosReader requests_;
  RosWriter responses_;
  NodeService service_;
};

/// Returns the response to the bytes of a request as above; nothing for bytes that are no request.
std::optional<std::string> response_to(const std::string& request, const NodeService& service);

}  // namespace outrider
