// A node on another implementation of DDS, which knows the types from their ROS 2 definitions and nothing of
// Outrider.
//
//   fastdds_peer DOMAIN [local]
//
// It answers every geometry_msgs/msg/Twist on /asked by one of twice its numbers on /answered. For each
// nav_msgs/msg/OccupancyGrid on /map, latched, it sends a Twist on /map_seen: width, height, resolution, the
// x of the origin, the length of the frame's name, and the sum of the cells. For each announcement of a node
// on ros_discovery_info it sends a Twist on /node_seen: number of nodes, length of the name and of the
// namespace of the first, number of its readers and writers, and 1 if all their names of 16 bytes begin as
// that of the participant. For each TwistStamped on /cmd_vel it sends its speed and turn rate on
// /command_seen. It sends a PoseStamped with x = 2.5 on /goal_pose again and again. What comes on
// /echo/nN/asked, of the type N of `echoed`, it sends back to the byte on /echo/nN/answered.
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>
#include <memory>
#include <numeric>
#include <string>
#include <vector>

#include "fastdds_type.hpp"

namespace {

namespace fast = eprosima::fastdds::dds;
using eprosima::fastcdr::Cdr;

struct Twist {
  double linear_x = 0, linear_y = 0, linear_z = 0, angular_x = 0, angular_y = 0, angular_z = 0;

  static constexpr const char* type = "geometry_msgs::msg::dds_::Twist_";
  [[nodiscard]] std::uint32_t most_bytes() const { return 4 + 6 * 8; }
  template <class Visit>
  void visit(Visit visit) {
    visit(linear_x), visit(linear_y), visit(linear_z), visit(angular_x), visit(angular_y), visit(angular_z);
  }
};

struct OccupancyGrid {
  std::int32_t stamp_sec = 0;
  std::uint32_t stamp_nanosec = 0;
  std::string frame_id;
  std::int32_t loaded_sec = 0;
  std::uint32_t loaded_nanosec = 0;
  float resolution = 0;
  std::uint32_t width = 0, height = 0;
  double x = 0, y = 0, z = 0, qx = 0, qy = 0, qz = 0, qw = 1;
  std::vector<std::int8_t> data;

  static constexpr const char* type = "nav_msgs::msg::dds_::OccupancyGrid_";
  [[nodiscard]] std::uint32_t most_bytes() const {
    return 200 + static_cast<std::uint32_t>(frame_id.size() + data.size());
  }
  template <class Visit>
  void visit(Visit visit) {
    visit(stamp_sec), visit(stamp_nanosec), visit(frame_id), visit(loaded_sec), visit(loaded_nanosec);
    visit(resolution), visit(width), visit(height);
    visit(x), visit(y), visit(z), visit(qx), visit(qy), visit(qz), visit(qw), visit(data);
  }
};

struct TwistStamped {
  std::int32_t stamp_sec = 0;
  std::uint32_t stamp_nanosec = 0;
  std::string frame_id;
  double linear_x = 0, linear_y = 0, linear_z = 0, angular_x = 0, angular_y = 0, angular_z = 0;

  static constexpr const char* type = "geometry_msgs::msg::dds_::TwistStamped_";
  [[nodiscard]] std::uint32_t most_bytes() const { return 200 + static_cast<std::uint32_t>(frame_id.size()); }
  template <class Visit>
  void visit(Visit visit) {
    visit(stamp_sec), visit(stamp_nanosec), visit(frame_id);
    visit(linear_x), visit(linear_y), visit(linear_z), visit(angular_x), visit(angular_y), visit(angular_z);
  }
};

struct PoseStamped {
  std::int32_t stamp_sec = 0;
  std::uint32_t stamp_nanosec = 0;
  std::string frame_id;
  double x = 0, y = 0, z = 0, qx = 0, qy = 0, qz = 0, qw = 1;

  static constexpr const char* type = "geometry_msgs::msg::dds_::PoseStamped_";
  [[nodiscard]] std::uint32_t most_bytes() const { return 200 + static_cast<std::uint32_t>(frame_id.size()); }
  template <class Visit>
  void visit(Visit visit) {
    visit(stamp_sec), visit(stamp_nanosec), visit(frame_id);
    visit(x), visit(y), visit(z), visit(qx), visit(qy), visit(qz), visit(qw);
  }
};

/// Only of one node; nothing is read behind it.
struct EntitiesInfo {
  std::array<std::uint8_t, 16> participant{};
  std::uint32_t nodes = 0;
  std::string space, name;
  std::vector<std::array<std::uint8_t, 16>> readers, writers;

  static constexpr const char* type = "rmw_dds_common::msg::dds_::ParticipantEntitiesInfo_";
  [[nodiscard]] std::uint32_t most_bytes() const { return 0; }
  template <class Visit>
  void visit(Visit visit) {
    visit(participant), visit(nodes), visit(space), visit(name), visit(readers), visit(writers);
  }
};

template <class Message>
class MessageType final : public WireType {
 public:
  MessageType() : WireType(Message::type, 20'000'000) {}
  std::uint32_t write(const void* message, Payload& payload) override {
    eprosima::fastcdr::FastBuffer buffer(reinterpret_cast<char*>(payload.data), payload.max_size);
    Cdr out(buffer, Cdr::LITTLE_ENDIANNESS, CdrVersion::DDS_CDR);
    out.serialize_encapsulation();
    Message copy = *static_cast<const Message*>(message);
    copy.visit([&](auto& field) { out << field; });
    return bytes_in(out);
  }
  void read(const Payload& payload, void* message) override {
    eprosima::fastcdr::FastBuffer buffer(reinterpret_cast<char*>(payload.data), payload.length);
    Cdr in(buffer, Cdr::DEFAULT_ENDIAN, CdrVersion::DDS_CDR);
    in.read_encapsulation();
    static_cast<Message*>(message)->visit([&](auto& field) { in >> field; });
  }
  std::uint32_t most_bytes(const void* message) const override {
    return static_cast<const Message*>(message)->most_bytes();
  }
  void* make() override { return new Message; }
  void remove(void* message) override { delete static_cast<Message*>(message); }
};

template <class Message>
fast::Topic* topic_on_wire(fast::DomainParticipant& participant, const std::string& name) {
  fast::TypeSupport support(new MessageType<Message>);
  support.register_type(&participant);
  return participant.create_topic(name, Message::type, fast::TOPIC_QOS_DEFAULT);
}

/// A topic of ROS 2 in that domain.
template <class Message>
fast::Topic* topic(fast::DomainParticipant& participant, const std::string& name) {
  return topic_on_wire<Message>(participant, "rt" + name);
}

/// Sends a Twist made of each message.
template <class Message>
class Answer final : public fast::DataReaderListener {
 public:
  Answer(fast::DataWriter* to, Twist (*made_of)(Message&)) : to_(to), made_of_(made_of) {}
  void on_data_available(fast::DataReader* reader) override {
    Message message;
    fast::SampleInfo info;
    while (reader->take_next_sample(&message, &info) == taken) {
      if (!info.valid_data) continue;
      Twist answer = made_of_(message);
      to_->write(&answer);
    }
  }

 private:
  fast::DataWriter* to_;
  Twist (*made_of_)(Message&);
};

using Bytes = std::vector<std::uint8_t>;

/// A type of that name whose messages are not looked into.
class BytesType final : public WireType {
 public:
  explicit BytesType(const std::string& name) : WireType(name, 1'000'000) {}
  std::uint32_t write(const void* message, Payload& payload) override {
    const auto& bytes = *static_cast<const Bytes*>(message);
    if (bytes.size() > payload.max_size) return 0;
    std::copy(bytes.begin(), bytes.end(), payload.data);
    return static_cast<std::uint32_t>(bytes.size());
  }
  void read(const Payload& payload, void* message) override {
    static_cast<Bytes*>(message)->assign(payload.data, payload.data + payload.length);
  }
  std::uint32_t most_bytes(const void* message) const override {
    return static_cast<std::uint32_t>(static_cast<const Bytes*>(message)->size());
  }
  void* make() override { return new Bytes; }
  void remove(void* message) override { delete static_cast<Bytes*>(message); }
};

/// Sends back what comes.
class Echo final : public fast::DataReaderListener {
 public:
  explicit Echo(fast::DataWriter* to) : to_(to) {}
  void on_data_available(fast::DataReader* reader) override {
    Bytes message;
    fast::SampleInfo info;
    while (reader->take_next_sample(&message, &info) == taken) {
      if (info.valid_data) to_->write(&message);
    }
  }

 private:
  fast::DataWriter* to_;
};

const std::vector<std::string> echoed = {"sensor_msgs::msg::dds_::LaserScan_",
                                         "nav_msgs::msg::dds_::Odometry_",
                                         "tf2_msgs::msg::dds_::TFMessage_",
                                         "sensor_msgs::msg::dds_::CameraInfo_",
                                         "sensor_msgs::msg::dds_::Image_",
                                         "apriltag_msgs::msg::dds_::AprilTagDetectionArray_",
                                         "geometry_msgs::msg::dds_::PoseStamped_",
                                         "geometry_msgs::msg::dds_::PoseWithCovarianceStamped_",
                                         "nav_msgs::msg::dds_::OccupancyGrid_",
                                         "nav_msgs::msg::dds_::Path_",
                                         "geometry_msgs::msg::dds_::PolygonStamped_",
                                         "visualization_msgs::msg::dds_::MarkerArray_",
                                         "diagnostic_msgs::msg::dds_::DiagnosticStatus_",
                                         "rosgraph_msgs::msg::dds_::Clock_",
                                         "rcl_interfaces::msg::dds_::Log_",
                                         "sensor_msgs::msg::dds_::JointState_",
                                         "std_msgs::msg::dds_::Float64_",
                                         "std_msgs::msg::dds_::String_"};

Twist doubled(Twist& asked) {
  asked.visit([](double& number) { number *= 2.0; });
  return asked;
}

Twist described(EntitiesInfo& info) {
  const auto of_it = [&](const auto& gid) {
    return std::equal(gid.begin(), gid.begin() + 12, info.participant.begin());
  };
  const bool all = std::all_of(info.readers.begin(), info.readers.end(), of_it) &&
                   std::all_of(info.writers.begin(), info.writers.end(), of_it);
  const auto number = [](auto count) { return static_cast<double>(count); };
  return {number(info.nodes),          number(info.name.size()),    number(info.space.size()),
          number(info.readers.size()), number(info.writers.size()), all ? 1.0 : 0.0};
}

Twist of_command(TwistStamped& command) { return {command.linear_x, 0, 0, 0, 0, command.angular_z}; }

Twist summed(OccupancyGrid& map) {
  return {static_cast<double>(map.width),           static_cast<double>(map.height),
          static_cast<double>(map.resolution),      map.x,
          static_cast<double>(map.frame_id.size()), std::accumulate(map.data.begin(), map.data.end(), 0.0)};
}

}  // namespace

/// With ROS_LOCALHOST_ONLY=1 nodes on Fast DDS use the loopback interface alone.
fast::DomainParticipantQos on_this_machine() {
  fast::DomainParticipantQos qos = fast::PARTICIPANT_QOS_DEFAULT;
  auto transport = std::make_shared<eprosima::fastdds::rtps::UDPv4TransportDescriptor>();
  transport->interfaceWhiteList = {"127.0.0.1"};
  qos.transport().use_builtin_transports = false;
  qos.transport().user_transports = {transport};
  return qos;
}

/// Sends all types back, as a participant of its own: those above know some of them otherwise.
std::vector<std::unique_ptr<Echo>> echo_all(std::uint32_t domain, bool local) {
  auto* participant = fast::DomainParticipantFactory::get_instance()->create_participant(
      domain, local ? on_this_machine() : fast::PARTICIPANT_QOS_DEFAULT);
  if (participant == nullptr) return {};
  auto* publisher = participant->create_publisher(fast::PUBLISHER_QOS_DEFAULT);
  auto* subscriber = participant->create_subscriber(fast::SUBSCRIBER_QOS_DEFAULT);
  fast::DataWriterQos writes = fast::DATAWRITER_QOS_DEFAULT;
  writes.reliability().kind = fast::RELIABLE_RELIABILITY_QOS;
  writes.durability().kind = fast::TRANSIENT_LOCAL_DURABILITY_QOS;
  fast::DataReaderQos reads = fast::DATAREADER_QOS_DEFAULT;
  reads.reliability().kind = fast::RELIABLE_RELIABILITY_QOS;
  std::vector<std::unique_ptr<Echo>> echoes;
  for (std::size_t i = 0; i < echoed.size(); ++i) {
    fast::TypeSupport(new BytesType(echoed[i])).register_type(participant);
    const auto topic_of = [&](const char* what) {
      return participant->create_topic("rt/echo/n" + std::to_string(i) + what, echoed[i],
                                       fast::TOPIC_QOS_DEFAULT);
    };
    echoes.push_back(std::make_unique<Echo>(publisher->create_datawriter(topic_of("/answered"), writes)));
    subscriber->create_datareader(topic_of("/asked"), reads, echoes.back().get());
  }
  return echoes;
}

int main(int count, char** words) {
  if (count != 2 && count != 3) return 2;
  const auto domain = static_cast<std::uint32_t>(std::atoi(words[1]));
  auto* participant = fast::DomainParticipantFactory::get_instance()->create_participant(
      domain, count == 3 ? on_this_machine() : fast::PARTICIPANT_QOS_DEFAULT);
  if (participant == nullptr) return 1;
  auto* publisher = participant->create_publisher(fast::PUBLISHER_QOS_DEFAULT);
  auto* subscriber = participant->create_subscriber(fast::SUBSCRIBER_QOS_DEFAULT);

  fast::DataWriterQos reliable = fast::DATAWRITER_QOS_DEFAULT;
  reliable.reliability().kind = fast::RELIABLE_RELIABILITY_QOS;
  reliable.durability().kind = fast::TRANSIENT_LOCAL_DURABILITY_QOS;
  auto* answers = publisher->create_datawriter(topic<Twist>(*participant, "/answered"), reliable);
  auto* seen = publisher->create_datawriter(topic<Twist>(*participant, "/map_seen"), reliable);
  Answer<Twist> answer(answers, doubled);
  Answer<OccupancyGrid> look(seen, summed);

  auto* nodes = publisher->create_datawriter(topic<Twist>(*participant, "/node_seen"), reliable);
  auto* commands = publisher->create_datawriter(topic<Twist>(*participant, "/command_seen"), reliable);
  auto* goals = publisher->create_datawriter(topic<PoseStamped>(*participant, "/goal_pose"), reliable);
  Answer<EntitiesInfo> describe(nodes, described);
  Answer<TwistStamped> obey(commands, of_command);
  PoseStamped goal;
  goal.frame_id = "map";
  goal.x = 2.5;

  fast::DataReaderQos usual = fast::DATAREADER_QOS_DEFAULT;
  usual.reliability().kind = fast::RELIABLE_RELIABILITY_QOS;
  subscriber->create_datareader(topic<Twist>(*participant, "/asked"), usual, &answer);
  subscriber->create_datareader(topic<TwistStamped>(*participant, "/cmd_vel"), usual, &obey);
  usual.durability().kind = fast::TRANSIENT_LOCAL_DURABILITY_QOS;
  subscriber->create_datareader(topic<OccupancyGrid>(*participant, "/map"), usual, &look);
  subscriber->create_datareader(topic_on_wire<EntitiesInfo>(*participant, "ros_discovery_info"), usual,
                                &describe);
  const auto echoes = echo_all(domain, count == 3);
  for (;; usleep(200'000)) goals->write(&goal);  // until it is ended
}
