#include "bag/bag_records.hpp"

#include <fmt/format.h>

#include "bytes/byte_reader.hpp"
#include "outrider/log/encoding/channel_decoder.hpp"

namespace outrider {
namespace {

template <class Number>
std::optional<Number> number_field(const BagFields& fields, std::string_view name) {
  const auto found = fields.find(name);
  if (found == fields.end() || found->second.size() != sizeof(Number)) return std::nullopt;
  return ByteReader(found->second).number<Number>();
}

}  // namespace

std::optional<BagFields> split_bag_fields(std::string_view bytes) {
  BagFields fields;
  ByteReader reader(bytes);
  while (!reader.at_end()) {
    const std::string_view field = reader.text();
    const std::size_t equals = field.find('=');
    if (!reader.ok() || equals == std::string_view::npos || equals == 0) return std::nullopt;
    fields.insert_or_assign(field.substr(0, equals), field.substr(equals + 1));
  }
  return fields;
}

std::optional<std::uint32_t> u32_field(const BagFields& fields, std::string_view name) {
  return number_field<std::uint32_t>(fields, name);
}

std::optional<std::uint64_t> u64_field(const BagFields& fields, std::string_view name) {
  return number_field<std::uint64_t>(fields, name);
}

std::string_view text_field(const BagFields& fields, std::string_view name) {
  const auto found = fields.find(name);
  return found == fields.end() ? std::string_view{} : found->second;
}

std::optional<std::int64_t> time_field(const BagFields& fields, std::string_view name) {
  const auto stamp = u64_field(fields, name);
  if (!stamp) return std::nullopt;
  constexpr std::int64_t second_ns = 1'000'000'000;
  const auto seconds = static_cast<std::int64_t>(*stamp & 0xffffffffU);
  const auto nanoseconds = static_cast<std::int64_t>(*stamp >> 32U);
  if (nanoseconds >= second_ns) return std::nullopt;
  return seconds * second_ns + nanoseconds;
}

std::optional<BagOp> bag_op(const BagFields& fields) {
  const std::string_view op = text_field(fields, "op");
  if (op.size() != 1 || op[0] < 2 || op[0] > 7) return std::nullopt;
  return static_cast<BagOp>(op[0]);
}

Outcome<BagRecord> read_bag_record(const ByteSource& source, std::uint64_t position) {
  BagRecord record;
  record.position = position;
  auto header_length = source.read(position, 4);
  if (!header_length) return pass_on(header_length);
  const std::uint32_t length = ByteReader(*header_length).number<std::uint32_t>();
  if (length > largest_bag_header) {
    return damaged(
        source, position,
        fmt::format("a record states {} bytes of fields; {} are the most", length, largest_bag_header));
  }
  auto header = source.read(position + 4, std::uint64_t{length} + 4);
  if (!header) return pass_on(header);
  ByteReader reader(*header);
  reader.take(length);
  record.data_length = reader.number<std::uint32_t>();
  header->resize(length);
  record.header_ = std::make_unique<const std::string>(std::move(*header));
  auto fields = split_bag_fields(*record.header_);
  const auto op = fields ? bag_op(*fields) : std::nullopt;
  if (!op) return damaged(source, position, "the fields of a record are damaged");
  record.op = *op;
  record.fields_ = std::move(*fields);
  record.data_position = position + 8 + length;
  record.end = record.data_position + record.data_length;
  if (record.end > source.size())
    return damaged(source, position, "a record reaches beyond the end of the file");
  if (record.data_length > largest_bag_data) {
    return damaged(source, position,
                   fmt::format("a record states {} bytes of data; {} are the most", record.data_length,
                               largest_bag_data));
  }
  return record;
}

std::optional<BagConnection> read_bag_connection(const BagFields& fields, std::string_view data) {
  const auto id = u32_field(fields, "conn");
  const auto sent = split_bag_fields(data);
  if (!id || !sent) return std::nullopt;
  BagConnection connection;
  connection.id = *id;
  Channel& channel = connection.channel;
  channel.topic = text_field(fields, "topic");
  channel.type = ros2_type_name(text_field(*sent, "type"));
  channel.encoding = "ros1";
  channel.schema = text_field(*sent, "message_definition");
  if (!channel.schema.empty()) channel.schema_encoding = "ros1msg";
  if (channel.topic.empty() || channel.type.empty()) return std::nullopt;
  if (const auto md5sum = text_field(*sent, "md5sum"); !md5sum.empty()) channel.metadata["md5sum"] = md5sum;
  return connection;
}

}  // namespace outrider
