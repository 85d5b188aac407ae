// Messages: any bytes are a message or a refusal with a sentence, in each encoding. A message that was read
// is written and read again as the same. The first byte of an input chooses the encoding, the second the
// type, unless FUZZ_MESSAGE in the environment is its number: so each type is fuzzed for as long as wanted.
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "fuzz_entry.hpp"
#include "outrider/log/encoding/codecs.hpp"
#include "outrider/log/messages/ros_sensor_messages.hpp"
#include "outrider/nodes/messages/node_messages.hpp"
#include "outrider/nodes/messages/parameter_messages.hpp"
#include "outrider/nodes/messages/tag_messages.hpp"
#include "read_fuzzed_log.hpp"

namespace {

using outrider::MessageEncoding;

template <class Message>
void read(MessageEncoding encoding, std::string_view bytes) {
  const auto message = outrider::decode<Message>(encoding, bytes);
  if (!message) return require(!message.error().sentence.empty());
  const std::string written = outrider::encode(encoding, *message);
  const auto again = outrider::decode<Message>(encoding, written);
  require(again.has_value());
  require(outrider::encode(encoding, *again) == written);
}

constexpr std::array readers = {read<outrider::sensor_msgs::LaserScan>,
                                read<outrider::nav_msgs::Odometry>,
                                read<outrider::tf2_msgs::TFMessage>,
                                read<outrider::sensor_msgs::CameraInfo>,
                                read<outrider::sensor_msgs::JointState>,
                                read<outrider::nav_msgs::OccupancyGrid>,
                                read<outrider::nav_msgs::Path>,
                                read<outrider::geometry_msgs::PoseStamped>,
                                read<outrider::geometry_msgs::Twist>,
                                read<outrider::geometry_msgs::TwistStamped>,
                                read<outrider::geometry_msgs::PolygonStamped>,
                                read<outrider::rosgraph_msgs::Clock>,
                                read<outrider::diagnostic_msgs::DiagnosticStatus>,
                                read<outrider::sensor_msgs::Image>,
                                read<outrider::apriltag_msgs::AprilTagDetectionArray>,
                                read<outrider::rcl_interfaces::ListParametersRequest>,
                                read<outrider::rcl_interfaces::GetParametersRequest>,
                                read<outrider::rcl_interfaces::SetParametersRequest>,
                                read<outrider::rcl_interfaces::DescribeParametersResponse>,
                                read<outrider::std_msgs::Float64>,
                                read<outrider::std_msgs::String>};

/// Returns the number that FUZZ_MESSAGE gives, or else that of the input.
std::size_t type_of(std::uint8_t chosen) {
  static const char* const fixed = std::getenv("FUZZ_MESSAGE");
  return (fixed == nullptr ? chosen : std::strtoul(fixed, nullptr, 10)) % readers.size();
}

}  // namespace

extern "C" int FUZZ_ENTRY(cdr)(const std::uint8_t* data, std::size_t size) {
  if (size < 2) return 0;
  constexpr std::array encodings = {MessageEncoding::cdr, MessageEncoding::ros1, MessageEncoding::json};
  const std::string_view bytes(reinterpret_cast<const char*>(data) + 2, size - 2);
  readers[type_of(data[1])](encodings[data[0] % encodings.size()], bytes);
  return 0;
}
