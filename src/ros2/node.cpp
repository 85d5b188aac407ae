#include "outrider/ros2/node.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cstdlib>
#include <string_view>

#include "cdr_type.hpp"
#include "outrider/log/codecs.hpp"
#include "outrider/ros2/names.hpp"

namespace outrider {
namespace {

constexpr std::int64_t last_domain = 232;  // of the port numbers of DDS
constexpr std::int32_t waiting = 10;       // messages, as in Nav2

Status check_domain(std::int64_t domain, const std::string& where) {
  if (domain >= 0 && domain <= last_domain) return {};
  return bad_input(fmt::format("the domain is {}; take one from 0 to {}", domain, last_domain), where);
}

using Quality = std::unique_ptr<dds_qos_t, decltype(&dds_delete_qos)>;

Quality quality(RosQos qos) {
  Quality quality(dds_create_qos(), &dds_delete_qos);
  const bool sensor = qos == RosQos::sensor, latched = qos == RosQos::latched;
  dds_qset_reliability(quality.get(), sensor ? DDS_RELIABILITY_BEST_EFFORT : DDS_RELIABILITY_RELIABLE,
                       DDS_MSECS(100));
  dds_qset_durability(quality.get(), latched ? DDS_DURABILITY_TRANSIENT_LOCAL : DDS_DURABILITY_VOLATILE);
  dds_qset_history(quality.get(), DDS_HISTORY_KEEP_LAST, latched ? 1 : waiting);
  const dds_data_representation_id_t encoding = DDS_DATA_REPRESENTATION_XCDR1;
  dds_qset_data_representation(quality.get(), 1, &encoding);
  return quality;
}

tl::unexpected<Fault> refused(std::string_view what, dds_return_t code) {
  return bad_input(fmt::format("{} was refused by the network: {}", what, dds_strretcode(code)));
}

/// An entity of Cyclone DDS, which is deleted with all that it holds.
class Entity {
 public:
  explicit Entity(dds_entity_t handle) : handle_(handle) {}
  Entity(const Entity&) = delete;
  Entity& operator=(const Entity&) = delete;
  ~Entity() {
    if (handle_ > 0) dds_delete(handle_);
  }
  [[nodiscard]] dds_entity_t handle() const { return handle_; }

 private:
  dds_entity_t handle_;
};

}  // namespace

struct RosNode::Participant {
  Entity entity;
};

/// The end of a topic. What it stands on is deleted after it.
struct RosEnd {
  std::shared_ptr<void> participant;
  Entity topic;
  Entity entity;
  const MessageType* type;
};

struct RosWriter::Wire : RosEnd {};
struct RosReader::Wire : RosEnd {};

Outcome<RosNodeOptions> ros_environment() {
  RosNodeOptions options;
  if (const char* const text = std::getenv("ROS_DOMAIN_ID"); text != nullptr && *text != '\0') {
    const std::string_view word(text);
    const auto read = std::from_chars(word.data(), word.data() + word.size(), options.domain);
    if (read.ec != std::errc() || read.ptr != word.data() + word.size())
      return bad_input(fmt::format("'{}' is no number; give one from 0 to {}", word, last_domain),
                       "ROS_DOMAIN_ID");
    if (auto ok = check_domain(options.domain, "ROS_DOMAIN_ID"); !ok) return pass_on(ok);
  }
  const char* const local = std::getenv("ROS_LOCALHOST_ONLY");
  options.localhost_only = local != nullptr && std::string_view(local) == "1";
  return options;
}

Outcome<RosNode> RosNode::open(const RosNodeOptions& options) {
  if (auto ok = check_domain(options.domain, "domain"); !ok) return pass_on(ok);
  const auto domain = static_cast<dds_domainid_t>(options.domain);
  if (options.localhost_only) {
    // A domain that this process has already is left as it is.
    dds_create_domain(domain,
                      "<General><Interfaces><NetworkInterface name='lo' multicast='false'/></Interfaces>"
                      "</General><Discovery><ParticipantIndex>auto</ParticipantIndex>"
                      "<Peers><Peer address='localhost'/></Peers></Discovery>"
                      "<Tracing><Verbosity>none</Verbosity></Tracing>");
  }
  const dds_entity_t entity = dds_create_participant(domain, nullptr, nullptr);
  if (entity < 0) return refused(fmt::format("domain {}", options.domain), entity);
  return RosNode(std::shared_ptr<Participant>(new Participant{Entity(entity)}));
}

namespace {

/// Makes the topic and then, by `make`, what writes or reads it.
template <class Wire, class Make>
Outcome<std::shared_ptr<Wire>> end_of(dds_entity_t participant, std::shared_ptr<void> owner,
                                      const std::string& topic, const MessageType& type, RosQos qos,
                                      Make make) {
  const auto name = resolve_topic(topic);
  if (!name) return tl::unexpected<Fault>(name.error());
  const dds_entity_t on_wire = create_cdr_topic(participant, topic_on_wire(*name), type_on_wire(type.name));
  if (on_wire < 0) return refused(*name, on_wire);
  const dds_entity_t entity = make(participant, on_wire, quality(qos).get(), nullptr);
  if (entity < 0) {
    dds_delete(on_wire);
    return refused(*name, entity);
  }
  return std::shared_ptr<Wire>(new Wire{{std::move(owner), Entity(on_wire), Entity(entity), &type}});
}

}  // namespace

Outcome<RosWriter> RosNode::writer(const std::string& topic, const MessageType& type, RosQos qos) {
  auto wire = end_of<RosWriter::Wire>(participant_->entity.handle(), participant_, topic, type, qos,
                                      dds_create_writer);
  if (!wire) return pass_on(wire);
  return RosWriter(std::move(*wire));
}

Outcome<RosReader> RosNode::reader(const std::string& topic, const MessageType& type, RosQos qos) {
  auto wire = end_of<RosReader::Wire>(participant_->entity.handle(), participant_, topic, type, qos,
                                      dds_create_reader);
  if (!wire) return pass_on(wire);
  return RosReader(std::move(*wire));
}

Status RosWriter::send_bytes(const std::string& bytes) {
  const dds_return_t code = dds_write(wire_->entity.handle(), &bytes);
  if (code == DDS_RETCODE_OK) return {};
  return fault(FaultCode::cannot_write, fmt::format("a message was not sent: {}", dds_strretcode(code)));
}

Status RosWriter::send(const void* message) {
  return send_bytes(encode(MessageEncoding::cdr, *wire_->type, message));
}

std::size_t RosWriter::readers() const {
  dds_publication_matched_status_t status{};
  dds_get_publication_matched_status(wire_->entity.handle(), &status);
  return status.current_count;
}

std::optional<std::string> RosReader::take_bytes() {
  std::string bytes;
  void* sample = &bytes;
  dds_sample_info_t info{};
  while (dds_take(wire_->entity.handle(), &sample, &info, 1, 1) > 0) {
    if (info.valid_data) return bytes;  // else a writer has left
  }
  return std::nullopt;
}

Outcome<bool> RosReader::take(void* message) {
  const auto bytes = take_bytes();
  if (!bytes) return false;
  if (auto decoded = decode(MessageEncoding::cdr, *wire_->type, *bytes, message); !decoded)
    return pass_on(decoded);
  return true;
}

std::size_t RosReader::writers() const {
  dds_subscription_matched_status_t status{};
  dds_get_subscription_matched_status(wire_->entity.handle(), &status);
  return status.current_count;
}

}  // namespace outrider
