// The records of ROS 1 bags, format 2.0 (wiki.ros.org/Bags/Format/2.0).
//
// A record is a header, which is a list of named fields, and data. Both are preceded by their lengths.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "bytes/byte_source.hpp"
#include "outrider/log/log_reader.hpp"

namespace outrider {

inline constexpr std::string_view bag_magic = "#ROSBAG V2.0\n";
inline constexpr std::uint32_t largest_bag_header = 1U << 20;  ///< bytes of the fields of a record
inline constexpr std::uint32_t largest_bag_data = 256U << 20;  ///< bytes of the data, and of a chunk unpacked

enum class BagOp : std::uint8_t {
  message = 2,
  bag_header = 3,
  index_data = 4,
  chunk = 5,
  chunk_info = 6,
  connection = 7,
};

using BagFields = std::map<std::string_view, std::string_view>;

/// Splits "length name=value length name=value ...". Nothing, if the lengths do not fit or a field has no
/// name.
std::optional<BagFields> split_bag_fields(std::string_view bytes);

/// Returns a field as a number; nothing, if it is missing or has another length.
std::optional<std::uint32_t> u32_field(const BagFields& fields, std::string_view name);
std::optional<std::uint64_t> u64_field(const BagFields& fields, std::string_view name);
/// A missing field is an empty text.
std::string_view text_field(const BagFields& fields, std::string_view name);
/// Returns a field of seconds and nanoseconds as nanoseconds.
std::optional<std::int64_t> time_field(const BagFields& fields, std::string_view name);
std::optional<BagOp> bag_op(const BagFields& fields);

/// A record of a file whose header has been read and whose data has not.
class BagRecord {
 public:
  BagOp op = BagOp::message;
  std::uint64_t position = 0;  ///< of the record
  std::uint64_t data_position = 0;
  std::uint32_t data_length = 0;
  std::uint64_t end = 0;  ///< of the record; within the file

  [[nodiscard]] const BagFields& fields() const { return fields_; }

 private:
  friend Outcome<BagRecord> read_bag_record(const ByteSource& source, std::uint64_t position);
  std::unique_ptr<const std::string> header_;  ///< what the fields are views of
  BagFields fields_;
};

/// Reads the header of the record at a position. Fault: bad_input, if it is damaged or reaches beyond the
/// end.
Outcome<BagRecord> read_bag_record(const ByteSource& source, std::uint64_t position);

/// A connection: who sends messages of which channel. Several connections may feed one channel.
struct BagConnection {
  std::uint32_t id = 0;
  Channel channel;
};

/// Reads a connection record. Nothing, if a field is missing.
std::optional<BagConnection> read_bag_connection(const BagFields& fields, std::string_view data);

}  // namespace outrider
