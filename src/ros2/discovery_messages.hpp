// The messages of ros_discovery_info, by which nodes of ROS 2 tell which node each reader and writer belongs
// to. Humble has names of entities with 24 bytes, of which DDS fills 16; later distributions have 16.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "outrider/log/encoding/message_fields.hpp"

namespace outrider {

inline constexpr std::string_view discovery_topic = "ros_discovery_info";  ///< on the wire

namespace rmw_dds_common {

template <std::size_t Bytes>
struct Gid {
  std::array<std::uint8_t, Bytes> data{};

  OUTRIDER_MESSAGE(Gid, "rmw_dds_common/msg/Gid", data)
};

template <std::size_t Bytes>
struct NodeEntitiesInfo {
  std::string node_namespace;
  std::string node_name;
  std::vector<Gid<Bytes>> reader_gid_seq;
  std::vector<Gid<Bytes>> writer_gid_seq;

  OUTRIDER_MESSAGE(NodeEntitiesInfo, "rmw_dds_common/msg/NodeEntitiesInfo", node_namespace, node_name,
                   reader_gid_seq, writer_gid_seq)
};

template <std::size_t Bytes>
struct ParticipantEntitiesInfo {
  Gid<Bytes> gid;
  std::vector<NodeEntitiesInfo<Bytes>> node_entities_info_seq;

  OUTRIDER_MESSAGE(ParticipantEntitiesInfo, "rmw_dds_common/msg/ParticipantEntitiesInfo", gid,
                   node_entities_info_seq)
};

}  // namespace rmw_dds_common

}  // namespace outrider
