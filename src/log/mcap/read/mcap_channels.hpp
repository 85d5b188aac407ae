// The channels and schemas of an MCAP file by their ids. A definition may be repeated, but not changed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mcap/mcap_records.hpp"
#include "outrider/log/log_reader.hpp"

namespace outrider::mcap {

class ChannelTable {
 public:
  /// Adds the content of a schema or channel record. Returns a complaint, or an empty text.
  [[nodiscard]] std::string add(Op op, std::string_view content);

  /// Like add(), but complains of what is not in the table.
  [[nodiscard]] std::string find(Op op, std::string_view content) const;

  /// Returns a complaint if a channel names a schema that does not exist, else an empty text.
  [[nodiscard]] std::string check() const;

  /// Returns the channel of a record, with its schema if that is in the table.
  [[nodiscard]] Channel channel(const ChannelRecord& record) const;

  /// Returns all channels in the order of their ids.
  [[nodiscard]] std::vector<Channel> channels() const;

  [[nodiscard]] bool empty() const { return channels_.empty(); }
  [[nodiscard]] const std::map<std::uint16_t, ChannelRecord>& by_id() const { return channels_; }

 private:
  std::map<std::uint16_t, SchemaRecord> schemas_;
  std::map<std::uint16_t, ChannelRecord> channels_;
};

}  // namespace outrider::mcap
