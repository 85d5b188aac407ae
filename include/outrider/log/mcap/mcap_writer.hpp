// McapWriter: writes a log as an MCAP file while the messages come.
//
//   auto log = McapWriter::create("run.mcap");
//   const std::size_t scan = log->add_channel({"/scan", "sensor_msgs/msg/LaserScan", "cdr", "ros2msg",
//   schema}); log->write(scan, time_ns, bytes); log->finish();
//
// The file is chunked and indexed, and carries every checksum that the format knows. The same calls write the
// same bytes. A process that is killed leaves a log that opens up to its last complete chunk; flush()
// completes the current one. Messages may come in any order of time; readers sort them.
//
// Memory: one chunk, and what the index at the end needs: some hundred bytes a chunk.
// Errors: cannot_write with the path; after the first fault every call returns it again. Thread rule: one
// writer, one thread. Source: https://mcap.dev/spec, version 0 of the format.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>

#include "outrider/log/bytes/byte_sink.hpp"
#include "outrider/log/bytes/codec.hpp"
#include "outrider/log/log_reader.hpp"

namespace outrider {

struct McapOptions {
  Codec compression = Codec::zstd;  ///< none, lz4 or zstd
  std::size_t chunk_bytes = std::size_t{1}
                            << 20U;  ///< uncompressed size at which a chunk is closed; at most 64 MiB
  std::string profile = "ros2";      ///< says how messages are encoded
  std::string library = "outrider";  ///< says who wrote the file
};

class McapWriter {
 public:
  /// Begins a log in a file, which is made or emptied.
  static Outcome<McapWriter> create(const std::string& path, const McapOptions& options = {});

  /// Begins a log in a sink.
  static Outcome<McapWriter> begin(std::unique_ptr<ByteSink> sink, const McapOptions& options = {});

  McapWriter(McapWriter&&) noexcept;
  McapWriter& operator=(McapWriter&&) noexcept;
  /// Does not finish: a log that was not finished reads as one that was cut.
  ~McapWriter();

  /// Adds a channel at any time and returns its index, counted from 0. Equal schemas are stored once. With
  /// more than 65535 channels or schemas the next call of write() is refused.
  std::size_t add_channel(const Channel& channel);

  /// Appends a message. Fault: bad_input if the time is negative, there is no such channel, or the data are
  /// longer than 255 MiB; cannot_write.
  Status write(std::size_t channel, std::int64_t time_ns, std::string_view data);

  /// Stores a file in the log. Fault: bad_input if the time is negative or the content longer than 255 MiB;
  /// cannot_write.
  Status attach(const std::string& name, const std::string& media_type, std::string_view content,
                std::int64_t time_ns = 0);

  /// Stores named texts in the log.
  Status add_metadata(const std::string& name, const std::map<std::string, std::string>& metadata);

  /// Completes the current chunk: all messages so far can be read, even if the process is killed.
  Status flush();

  /// Writes the summary and closes the sink. Nothing can be written afterwards.
  Status finish();

 private:
  struct State;
  explicit McapWriter(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace outrider
