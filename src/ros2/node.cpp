#include "outrider/ros2/node.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <iterator>
#include <string_view>
#include <vector>

#include "cdr_type.hpp"
#include "discovery_messages.hpp"
#include "outrider/core/text.hpp"
#include "outrider/log/encoding/codecs.hpp"
#include "outrider/ros2/names.hpp"

namespace outrider {
namespace {

constexpr std::int64_t last_domain = 232;  // of the port numbers of DDS
constexpr std::int32_t waiting = 10;       // messages, as in Nav2
constexpr std::int32_t waiting_fixed = 100;
constexpr std::string_view enclave = "enclave=/;";  // of every node of ROS 2 without its security

Status check_domain(std::int64_t domain, const std::string& where) {
  if (domain >= 0 && domain <= last_domain) return {};
  return bad_input(fmt::format("the domain is {}; take one from 0 to {}", domain, last_domain), where);
}

using Quality = std::unique_ptr<dds_qos_t, decltype(&dds_delete_qos)>;

Quality quality(Delivery qos) {
  Quality quality(dds_create_qos(), &dds_delete_qos);
  const bool sensor = qos == Delivery::sensor, fixed = qos == Delivery::fixed;
  const bool latched = qos == Delivery::latched || fixed;
  dds_qset_reliability(quality.get(), sensor ? DDS_RELIABILITY_BEST_EFFORT : DDS_RELIABILITY_RELIABLE,
                       DDS_MSECS(100));
  dds_qset_durability(quality.get(), latched ? DDS_DURABILITY_TRANSIENT_LOCAL : DDS_DURABILITY_VOLATILE);
  dds_qset_history(quality.get(), DDS_HISTORY_KEEP_LAST, fixed ? waiting_fixed : latched ? 1 : waiting);
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
  std::vector<dds_entity_t> readers = {}, writers = {};
  std::optional<RosWriter> announcements = {};
};

/// The end of a topic. The participant and the topic that it depends on are deleted after it.
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
      return bad_input(fmt::format("'{}' is no number; give one from 0 to {}", excerpt(word), last_domain),
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
    // A domain that this process has already is left as it is. Without multicast each process is sought at
    // the ports of the first 33, every second: one of Fast DDS that starts later does not seek us there.
    dds_create_domain(domain,
                      "<General><Interfaces><NetworkInterface name='lo' multicast='false'/></Interfaces>"
                      "</General><Discovery><ParticipantIndex>auto</ParticipantIndex>"
                      "<MaxAutoParticipantIndex>32</MaxAutoParticipantIndex><SPDPInterval>1s</SPDPInterval>"
                      "<Peers><Peer address='localhost'/></Peers></Discovery>"
                      "<Tracing><Verbosity>none</Verbosity></Tracing>");
  }
  Quality quality(dds_create_qos(), &dds_delete_qos);
  dds_qset_userdata(quality.get(), enclave.data(), enclave.size());
  const dds_entity_t entity = dds_create_participant(domain, quality.get(), nullptr);
  if (entity < 0) return refused(fmt::format("domain {}", options.domain), entity);
  return RosNode(std::shared_ptr<Participant>(new Participant{Entity(entity)}));
}

namespace {

/// Makes the topic and then, by `make`, what writes or reads it. Both names are those on the wire.
template <class Wire, class Make>
Outcome<std::shared_ptr<Wire>> end_of(dds_entity_t participant, std::shared_ptr<void> owner,
                                      const std::string& topic, const MessageType& type, Delivery qos,
                                      Make make) {
  const dds_entity_t on_wire = create_cdr_topic(participant, topic, type_on_wire(type.name));
  if (on_wire < 0) return refused(topic, on_wire);
  const dds_entity_t entity = make(participant, on_wire, quality(qos).get(), nullptr);
  if (entity < 0) {
    dds_delete(on_wire);
    return refused(topic, entity);
  }
  return std::shared_ptr<Wire>(new Wire{{std::move(owner), Entity(on_wire), Entity(entity), &type}});
}

}  // namespace

Outcome<RosWriter> RosNode::writer_on_wire(const std::string& topic, const MessageType& type, Delivery qos) {
  auto wire = end_of<RosWriter::Wire>(participant_->entity.handle(), participant_, topic, type, qos,
                                      dds_create_writer);
  if (!wire) return pass_on(wire);
  participant_->writers.push_back((*wire)->entity.handle());
  return RosWriter(std::move(*wire));
}

Outcome<RosReader> RosNode::reader_on_wire(const std::string& topic, const MessageType& type, Delivery qos) {
  auto wire = end_of<RosReader::Wire>(participant_->entity.handle(), participant_, topic, type, qos,
                                      dds_create_reader);
  if (!wire) return pass_on(wire);
  participant_->readers.push_back((*wire)->entity.handle());
  return RosReader(std::move(*wire));
}

Outcome<RosWriter> RosNode::writer(const std::string& topic, const MessageType& type, Delivery qos) {
  const auto name = resolve_topic(topic);
  if (!name) return pass_on(name);
  return writer_on_wire(topic_on_wire(*name), type, qos);
}

Outcome<RosReader> RosNode::reader(const std::string& topic, const MessageType& type, Delivery qos) {
  const auto name = resolve_topic(topic);
  if (!name) return pass_on(name);
  return reader_on_wire(topic_on_wire(*name), type, qos);
}

Outcome<RosReader> RosNode::request_reader(const std::string& service, const MessageType& request) {
  return reader_on_wire(request_on_wire(service), request, Delivery::reliable);
}
Outcome<RosWriter> RosNode::reply_writer(const std::string& service, const MessageType& response) {
  return writer_on_wire(reply_on_wire(service), response, Delivery::reliable);
}
Outcome<RosWriter> RosNode::request_writer(const std::string& service, const MessageType& request) {
  return writer_on_wire(request_on_wire(service), request, Delivery::reliable);
}
Outcome<RosReader> RosNode::reply_reader(const std::string& service, const MessageType& response) {
  return reader_on_wire(reply_on_wire(service), response, Delivery::reliable);
}

namespace {

template <std::size_t Bytes>
rmw_dds_common::Gid<Bytes> gid_of(dds_entity_t entity) {
  dds_guid_t guid{};
  dds_get_guid(entity, &guid);
  rmw_dds_common::Gid<Bytes> gid;
  std::copy(std::begin(guid.v), std::end(guid.v), gid.data.begin());
  return gid;
}

template <std::size_t Bytes>
std::string entities_info(dds_entity_t participant, const std::vector<dds_entity_t>& readers,
                          const std::vector<dds_entity_t>& writers, const RosNamespace& as) {
  rmw_dds_common::ParticipantEntitiesInfo<Bytes> info;
  info.gid = gid_of<Bytes>(participant);
  rmw_dds_common::NodeEntitiesInfo<Bytes> node{as.space, as.node, {}, {}};
  for (const dds_entity_t reader : readers) node.reader_gid_seq.push_back(gid_of<Bytes>(reader));
  for (const dds_entity_t writer : writers) node.writer_gid_seq.push_back(gid_of<Bytes>(writer));
  info.node_entities_info_seq.push_back(std::move(node));
  return encode(MessageEncoding::cdr, info);
}

}  // namespace

Status RosNode::announce(const RosNamespace& as) {
  Participant& self = *participant_;
  if (!self.announcements) {
    // The participant holds this writer, which therefore must not hold the participant.
    auto wire = end_of<RosWriter::Wire>(self.entity.handle(), nullptr, std::string(discovery_topic),
                                        message_type<rmw_dds_common::ParticipantEntitiesInfo<16>>(),
                                        Delivery::latched, dds_create_writer);
    if (!wire) return pass_on(wire);
    self.announcements = RosWriter(std::move(*wire));
  }
  const char* const distribution = std::getenv("ROS_DISTRO");
  const bool long_gids = distribution != nullptr && std::string_view(distribution) == "humble";
  const auto made = long_gids ? entities_info<24> : entities_info<16>;
  return self.announcements->send_bytes(made(self.entity.handle(), self.readers, self.writers, as));
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
