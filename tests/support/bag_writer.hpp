// Writes small ROS 1 bags of format 2.0, whole or with any part wrong.
#pragma once

#include <bzlib.h>
#include <lz4frame.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace outrider::test {

struct BagMessage {
  std::uint32_t connection = 0;
  std::int64_t time_ns = 0;
  std::string data;
};

inline std::string little(std::uint64_t value, std::size_t length) {
  std::string bytes;
  for (std::size_t i = 0; i < length; ++i) bytes += static_cast<char>(value >> (8 * i) & 0xffU);
  return bytes;
}
inline std::string bag_time(std::int64_t ns) {
  const auto time = static_cast<std::uint64_t>(ns);
  return little(time / 1'000'000'000, 4) + little(time % 1'000'000'000, 4);
}
inline std::string with_length(const std::string& bytes) { return little(bytes.size(), 4) + bytes; }
inline std::string bag_fields(const std::vector<std::pair<std::string, std::string>>& fields) {
  std::string bytes;
  for (const auto& [name, value] : fields) bytes += with_length(name + "=" + value);
  return bytes;
}
inline std::string bag_record(std::uint8_t op, std::vector<std::pair<std::string, std::string>> fields,
                              const std::string& data) {
  fields.emplace_back("op", little(op, 1));
  return with_length(bag_fields(fields)) + with_length(data);
}
inline std::string pack_bz2(std::string bytes) {
  std::string packed(bytes.size() + bytes.size() / 50 + 1000, '\0');
  auto length = static_cast<unsigned>(packed.size());
  BZ2_bzBuffToBuffCompress(packed.data(), &length, bytes.data(), static_cast<unsigned>(bytes.size()), 9, 0,
                           0);
  packed.resize(length);
  return packed;
}
inline std::string pack_lz4(std::string_view bytes) {
  std::string packed(LZ4F_compressFrameBound(bytes.size(), nullptr), '\0');
  packed.resize(LZ4F_compressFrame(packed.data(), packed.size(), bytes.data(), bytes.size(), nullptr));
  return packed;
}

class BagWriter {
 public:
  std::string compression = "none";
  std::vector<std::pair<std::string, std::string>> header_extra = {};

  /// Connections are numbered from 0.
  void add_connection(const std::string& topic, const std::string& type) {
    add_connection(topic, type, "# " + type + "\nfloat64 x\n");
  }
  void add_connection(const std::string& topic, const std::string& type, const std::string& definition) {
    connections_.push_back(bag_record(7, {{"conn", little(connections_.size(), 4)}, {"topic", topic}},
                                      bag_fields({{"topic", topic},
                                                  {"type", type},
                                                  {"md5sum", "0123456789abcdef0123456789abcdef"},
                                                  {"message_definition", definition}})));
  }

  /// Every chunk repeats the connections, as readers have to accept.
  void add_chunk(const std::vector<BagMessage>& messages) {
    std::string plain;
    for (const std::string& connection : connections_) plain += connection;
    for (const BagMessage& message : messages) {
      plain += bag_record(2, {{"conn", little(message.connection, 4)}, {"time", bag_time(message.time_ns)}},
                          message.data);
    }
    add_packed(pack(plain), plain.size(), messages);
  }

  /// A chunk with data of any kind.
  void add_packed(const std::string& packed, std::size_t stated_size,
                  const std::vector<BagMessage>& messages) {
    const std::size_t position = first_chunk + chunks_.size();
    chunks_ += bag_record(5, {{"compression", compression}, {"size", little(stated_size, 4)}}, packed);
    std::int64_t first = messages.empty() ? 0 : messages[0].time_ns;
    std::int64_t last = first;
    std::string counts;
    for (std::uint32_t id = 0; id < connections_.size(); ++id) {
      const auto here = std::count_if(messages.begin(), messages.end(),
                                      [&](const BagMessage& message) { return message.connection == id; });
      if (here > 0) counts += little(id, 4) + little(static_cast<std::uint64_t>(here), 4);
    }
    for (const BagMessage& message : messages) {
      first = std::min(first, message.time_ns);
      last = std::max(last, message.time_ns);
    }
    chunks_ += bag_record(4, {{"ver", little(1, 4)}, {"conn", little(0, 4)}, {"count", little(0, 4)}}, "");
    infos_ += bag_record(6,
                         {{"ver", little(1, 4)},
                          {"chunk_pos", little(position, 8)},
                          {"start_time", bag_time(first)},
                          {"end_time", bag_time(last)},
                          {"count", little(counts.size() / 8, 4)}},
                         counts);
    ++chunk_count_;
  }

  [[nodiscard]] std::string bytes(bool with_index = true) const {
    const std::size_t index = with_index ? first_chunk + chunks_.size() : 0;
    std::vector<std::pair<std::string, std::string>> fields = {
        {"index_pos", little(index, 8)},
        {"conn_count", little(with_index ? connections_.size() : 0, 4)},
        {"chunk_count", little(with_index ? chunk_count_ : 0, 4)}};
    fields.insert(fields.end(), header_extra.begin(), header_extra.end());
    std::string bag = "#ROSBAG V2.0\n" + bag_record(3, fields, "");
    const std::size_t padding = first_chunk - bag.size();
    bag = "#ROSBAG V2.0\n" + bag_record(3, fields, std::string(padding, ' ')) + chunks_;
    if (!with_index) return bag;
    for (const std::string& connection : connections_) bag += connection;
    return bag + infos_;
  }

  static constexpr std::size_t first_chunk = 256;  ///< recorders pad to 4096

 private:
  [[nodiscard]] std::string pack(const std::string& plain) const {
    if (compression == "bz2") return pack_bz2(plain);
    return compression == "lz4" ? pack_lz4(plain) : plain;
  }

  std::vector<std::string> connections_;
  std::string chunks_;
  std::string infos_;
  std::size_t chunk_count_ = 0;
};

}  // namespace outrider::test
