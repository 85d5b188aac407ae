#include "bag/bag_contents.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "bag/bag_chunk.hpp"
#include "bytes/byte_reader.hpp"
#include "formats.hpp"

namespace outrider {
namespace {

constexpr std::size_t most_connections = 10000;
constexpr std::string_view reindex = "\"rosbag reindex\" makes a new index";

struct BagHeader {
  std::uint64_t index_position = 0;  ///< 0: there is no index
  std::uint32_t connections = 0;
  std::uint32_t chunks = 0;
  std::uint64_t end = 0;  ///< where the first chunk may start
};

Outcome<BagHeader> read_bag_header(const ByteSource& source) {
  auto magic = source.read(0, bag_magic.size());
  if (!magic || *magic != bag_magic) return bad_input("it is not a ROS bag of version 2.0", source.name());
  auto record = read_bag_record(source, bag_magic.size());
  if (!record) return pass_on(record);
  const BagFields& fields = record->fields();
  const auto index = u64_field(fields, "index_pos");
  const auto connections = u32_field(fields, "conn_count");
  const auto chunks = u32_field(fields, "chunk_count");
  if (record->op != BagOp::bag_header || !index || !connections || !chunks) {
    return damaged(source, record->position, "the header of the bag is damaged");
  }
  const std::string_view encryptor = text_field(fields, "encryptor");
  if (!encryptor.empty() && encryptor != "rosbag/NoEncryptor") {
    return bad_input(
        fmt::format("it is encrypted by {}; decrypt it with \"rosbag decrypt\" first", encryptor),
        source.name());
  }
  return BagHeader{*index, *connections, *chunks, record->end};
}

/// Adds a connection; those with equal channels share one. Returns what is wrong, or an empty text.
std::string add_connection(BagContents& contents, const BagFields& fields, std::string_view data) {
  const auto connection = read_bag_connection(fields, data);
  if (!connection) return "a connection has no number, topic or type";
  auto& channels = contents.channels;
  const auto at = static_cast<std::size_t>(std::find(channels.begin(), channels.end(), connection->channel) -
                                           channels.begin());
  const auto [known, added] = contents.channel_of.emplace(connection->id, at);
  if (!added && known->second == at) return {};
  if (!added) return fmt::format("connection {} is defined twice, in different ways", connection->id);
  if (contents.channel_of.size() > most_connections) {
    return fmt::format("it has more than {} connections, the most that are read", most_connections);
  }
  if (at < channels.size()) return {};
  contents.channel_bytes += text_bytes(connection->channel);
  if (contents.channel_bytes > most_channel_bytes) {
    return fmt::format("the definitions of its connections have more than {} bytes, the most that are read",
                       most_channel_bytes);
  }
  channels.push_back(connection->channel);
  return {};
}

/// Reads a record of the index about a chunk. Returns what is wrong, or an empty text.
std::string add_chunk_info(BagContents& contents, const BagFields& fields, std::string_view data) {
  const auto position = u64_field(fields, "chunk_pos");
  const auto first = time_field(fields, "start_time");
  const auto last = time_field(fields, "end_time");
  const auto count = u32_field(fields, "count");
  if (u32_field(fields, "ver") != 1U || !position || !first || !last || !count || *last < *first) {
    return "the index describes a chunk in fields that are damaged";
  }
  if (data.size() != std::uint64_t{*count} * 8) return "the index counts the connections of a chunk wrongly";
  BagChunkInfo info{*position, *first, *last, {}};
  ByteReader reader(data);
  while (!reader.at_end()) {
    const std::uint32_t connection = reader.number<std::uint32_t>();
    if (reader.number<std::uint32_t>() > 0) info.connections.push_back(connection);
  }
  if (!info.connections.empty()) contents.chunks.push_back(std::move(info));
  return {};
}

struct IndexRead {
  BagContents contents;
  bool complete = false;  ///< false: the file ends within the index
};

Outcome<IndexRead> read_index(const ByteSource& source, const BagHeader& header) {
  IndexRead index;
  std::uint32_t connections = 0;
  std::uint32_t chunks = 0;
  std::uint64_t at = header.index_position;
  while (at < source.size()) {
    auto record = read_bag_record(source, at);
    if (!record) break;
    auto data = source.read(record->data_position, record->data_length);
    if (!data) return pass_on(data);
    std::string wrong = "the index holds a record of another kind";
    if (record->op == BagOp::connection) {
      wrong = add_connection(index.contents, record->fields(), *data);
      ++connections;
    } else if (record->op == BagOp::chunk_info) {
      wrong = add_chunk_info(index.contents, record->fields(), *data);
      ++chunks;
    }
    if (!wrong.empty()) return damaged(source, at, wrong, reindex);
    at = record->end;
  }
  index.complete = at == source.size() && connections == header.connections && chunks == header.chunks;
  std::stable_sort(index.contents.chunks.begin(), index.contents.chunks.end(),
                   [](const auto& a, const auto& b) { return a.position < b.position; });
  return index;
}

/// Learns the connections of a chunk and the span of its times. Returns what is wrong, or an empty text.
std::string scan_chunk(BagContents& contents, std::uint64_t position, std::string_view chunk) {
  BagChunkInfo info{position, std::numeric_limits<std::int64_t>::max(), 0, {}};
  std::set<std::uint32_t> seen;
  std::string wrong = for_each_in_chunk(chunk, [&](const BagChunkRecord& record) -> std::string {
    if (record.op == BagOp::connection) return add_connection(contents, record.fields, record.data);
    if (record.op != BagOp::message) return "it does not belong into a chunk";
    const auto time = time_field(record.fields, "time");
    const auto connection = u32_field(record.fields, "conn");
    if (!time || !connection || !contents.channel_of.contains(*connection)) {
      return "a message has no time or an unknown connection";
    }
    info.first_ns = std::min(info.first_ns, *time);
    info.last_ns = std::max(info.last_ns, *time);
    if (seen.insert(*connection).second) info.connections.push_back(*connection);
    return {};
  });
  if (wrong.empty() && !info.connections.empty()) contents.chunks.push_back(std::move(info));
  return wrong;
}

/// Reads the chunks from the beginning of the file up to the first that is incomplete or damaged.
BagContents scan_bag(const ByteSource& source, const BagHeader& header) {
  BagContents contents;
  std::string why;
  std::uint64_t at = header.end;
  while (at < source.size()) {
    auto record = read_bag_record(source, at);
    if (!record) {
      why = record.error().sentence;
      break;
    }
    if (record->op == BagOp::chunk) {
      if (record->data_length == 0) {
        why = "its recorder was stopped while it wrote a chunk";
        break;
      }
      auto chunk = unpack_bag_chunk(source, *record);
      why = chunk ? scan_chunk(contents, at, *chunk) : chunk.error().sentence;
      if (!why.empty()) break;
    } else if (record->op == BagOp::message) {
      why = "a message lies outside of the chunks";
      break;
    }
    at = record->end;
  }
  if (why.empty()) why = "its index is missing or incomplete";
  contents.cut_short = fmt::format("The end of {} is missing: it was read up to byte {} of {} ({}).",
                                   source.name(), at, source.size(), why);
  return contents;
}

Status check_connections(const ByteSource& source, const BagContents& contents) {
  for (const BagChunkInfo& chunk : contents.chunks) {
    for (const std::uint32_t connection : chunk.connections) {
      if (!contents.channel_of.contains(connection)) {
        return damaged(
            source, chunk.position,
            fmt::format("the index states messages of connection {} here, which it does not describe",
                        connection),
            reindex);
      }
    }
  }
  return {};
}

}  // namespace

Outcome<BagContents> read_bag_contents(const ByteSource& source) {
  auto header = read_bag_header(source);
  if (!header) return pass_on(header);
  if (header->index_position >= header->end && header->index_position <= source.size()) {
    auto index = read_index(source, *header);
    if (!index) return pass_on(index);
    if (index->complete) {
      if (auto known = check_connections(source, index->contents); !known) return pass_on(known);
      return std::move(index->contents);
    }
  }
  return scan_bag(source, *header);
}

}  // namespace outrider
