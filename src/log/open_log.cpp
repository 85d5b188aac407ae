#include <algorithm>
#include <filesystem>
#include <utility>

#include "bag/bag_records.hpp"
#include "bytes/byte_source.hpp"
#include "formats.hpp"
#include "outrider/log/log_reader.hpp"

namespace outrider {

namespace {

constexpr std::string_view sqlite_magic{"SQLite format 3\0", 16};

Outcome<std::string> start_of(const ByteSource& source) {
  return source.read(0, std::min(source.size(), std::uint64_t{sqlite_magic.size()}));
}

/// Opens MCAP and bags.
LogOpened open_source(std::unique_ptr<ByteSource> source, std::string_view start,
                      const LogSelection& selection) {
  if (is_mcap(start)) return open_mcap(std::move(source), selection);
  if (start.starts_with(bag_magic)) return open_bag(std::move(source), selection);
  if (start.starts_with("#ROSBAG V1")) {
    return bad_input("it is a ROS bag of version 1; \"rosbag migrate\" of ROS 1 writes one of version 2.0",
                     source->name());
  }
  return bad_input("it is not a log: neither MCAP, nor a ROS 1 bag, nor a ROS 2 db3", source->name());
}

}  // namespace

std::size_t text_bytes(const Channel& channel) {
  std::size_t bytes =
      channel.topic.size() + channel.type.size() + channel.encoding.size() + channel.schema.size();
  for (const auto& [key, value] : channel.metadata) bytes += key.size() + value.size();
  return bytes;
}

bool starts_as_log(std::string_view start) {
  return is_mcap(start) || start.starts_with("#ROSBAG V") || start.starts_with(sqlite_magic);
}

LogOpened open_log(const std::string& path, const LogSelection& selection) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) return open_log_folder(path, selection);
  auto source = open_file_source(path);
  if (!source) return pass_on(source);
  auto start = start_of(**source);
  if (!start) return pass_on(start);
  if (*start == sqlite_magic) return open_db3(path, selection);
  return open_source(std::move(*source), *start, selection);
}

LogOpened open_log(int descriptor, const std::string& path, const LogSelection& selection) {
  auto source = file_source(descriptor, path);
  if (!source) return pass_on(source);
  auto start = start_of(**source);
  if (!start) return pass_on(start);
  return open_source(std::move(*source), *start, selection);
}

}  // namespace outrider
