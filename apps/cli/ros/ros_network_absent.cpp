#include "ros/ros_network.hpp"

namespace outrider::cli {

Status check_ros() {
  return bad_input(
      "this outrider was built without ROS 2; install cyclonedds-dev and build it with "
      "-DOUTRIDER_WITH_ROS2=ON");
}

Status run_on_ros(Node&, const RosRequest&, const std::stop_token&) { return check_ros(); }

}  // namespace outrider::cli
