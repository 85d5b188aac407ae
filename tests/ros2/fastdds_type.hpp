// A type on the wire of Fast DDS 2 and 3, which name the same things otherwise.
#pragma once

#include <fastcdr/Cdr.h>

#include <cstdint>
#include <fastdds/dds/topic/TopicDataType.hpp>
#include <functional>
#include <string>

#if __has_include(<fastdds/rtps/transport/UDPv4TransportDescriptor.hpp>)
#define OUTRIDER_FASTDDS_3
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.hpp>
#else
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#endif

#ifdef OUTRIDER_FASTDDS_3
namespace rtps = eprosima::fastdds::rtps;
using CdrVersion = eprosima::fastcdr::CdrVersion;
inline const auto taken = eprosima::fastdds::dds::RETCODE_OK;
inline std::uint32_t bytes_in(const eprosima::fastcdr::Cdr& cdr) {
  return static_cast<std::uint32_t>(cdr.get_serialized_data_length());
}
#else
namespace rtps = eprosima::fastrtps::rtps;
using CdrVersion = eprosima::fastcdr::Cdr;
inline const auto taken = eprosima::fastrtps::types::ReturnCode_t::RETCODE_OK;
inline std::uint32_t bytes_in(const eprosima::fastcdr::Cdr& cdr) {
  return static_cast<std::uint32_t>(cdr.getSerializedDataLength());
}
#endif

/// A type of that name, whose messages write themselves to bytes and read themselves from bytes, each with
/// the four bytes of its encapsulation.
class WireType : public eprosima::fastdds::dds::TopicDataType {
 public:
  using Payload = rtps::SerializedPayload_t;

  /// Writes a message to payload.data, at most payload.max_size bytes, and returns how many; 0 where they do
  /// not fit.
  [[nodiscard]] virtual std::uint32_t write(const void* message, Payload& payload) = 0;
  virtual void read(const Payload& payload, void* message) = 0;
  [[nodiscard]] virtual std::uint32_t most_bytes(const void* message) const = 0;
  [[nodiscard]] virtual void* make() = 0;
  virtual void remove(void* message) = 0;

#ifdef OUTRIDER_FASTDDS_3
  WireType(const std::string& name, std::uint32_t most) {
    set_name(name);
    max_serialized_type_size = most;
  }
  using Representation = eprosima::fastdds::dds::DataRepresentationId_t;
  bool serialize(const void* message, Payload& payload, Representation) final {
    return written(message, payload);
  }
  bool deserialize(Payload& payload, void* message) final { return read(payload, message), true; }
  std::uint32_t calculate_serialized_size(const void* message, Representation) final {
    return most_bytes(message);
  }
  void* create_data() final { return make(); }
  void delete_data(void* message) final { remove(message); }
  bool compute_key(Payload&, rtps::InstanceHandle_t&, bool) final { return false; }
  bool compute_key(const void*, rtps::InstanceHandle_t&, bool) final { return false; }
#else
  WireType(const std::string& name, std::uint32_t most) {
    setName(name.c_str());
    m_typeSize = most;
    m_isGetKeyDefined = false;
  }
  bool serialize(void* message, Payload* payload) final { return written(message, *payload); }
  bool deserialize(Payload* payload, void* message) final { return read(*payload, message), true; }
  std::function<std::uint32_t()> getSerializedSizeProvider(void* message) final {
    return [this, message] { return most_bytes(message); };
  }
  void* createData() final { return make(); }
  void deleteData(void* message) final { remove(message); }
  bool getKey(void*, rtps::InstanceHandle_t*, bool) final { return false; }
#endif

 private:
  bool written(const void* message, Payload& payload) {
    payload.encapsulation = CDR_LE;
    payload.length = write(message, payload);
    return payload.length > 0;
  }
};
