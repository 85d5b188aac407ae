// The readers of single formats; open_log() chooses among them.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "bytes/byte_source.hpp"
#include "outrider/log/log_reader.hpp"

namespace outrider {

using LogOpened = Outcome<std::unique_ptr<LogReader>>;

/// Bytes of the texts of all channels of a log together, each with its schema.
inline constexpr std::size_t most_channel_bytes = std::size_t{32} << 20U;
std::size_t text_bytes(const Channel& channel);

/// Returns true if a file that starts with these bytes (8 are enough) is MCAP.
bool is_mcap(std::string_view start);
LogOpened open_mcap(std::unique_ptr<ByteSource> source, const LogSelection& selection = {});

/// ROS 1 bags of version 2.0, unpacked or with chunks compressed by bz2 or lz4. Besides what their index
/// needs, it holds the chunks whose times overlap, at most 512 MiB of them. A bag without an index is read
/// twice.
LogOpened open_bag(std::unique_ptr<ByteSource> source, const LogSelection& selection = {});

/// ROS 2 bags as rosbag2 stores them with SQLite. Messages are read one at a time.
LogOpened open_db3(const std::string& path, const LogSelection& selection = {});
/// The same from memory, of which it keeps a copy.
LogOpened open_db3_bytes(const std::string& name, std::string_view bytes, const LogSelection& selection = {});

/// A folder that rosbag2 wrote: metadata.yaml and one or several logs, read as one.
LogOpened open_log_folder(const std::string& path, const LogSelection& selection = {});

}  // namespace outrider
