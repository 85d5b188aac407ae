// ByteSink: the destination of a log while it grows: a file, a pipe, or a string. Thread rule: one sink, one
// thread.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "outrider/core/outcome.hpp"

namespace outrider {

class ByteSink {
 public:
  virtual ~ByteSink() = default;
  ByteSink(const ByteSink&) = delete;
  ByteSink& operator=(const ByteSink&) = delete;

  /// Appends the bytes. Fault: cannot_write with the path, for instance on a full disk.
  virtual Status write(std::string_view bytes) = 0;

  /// Ends the output. Fault: cannot_write, if the system reports a failure only now.
  virtual Status close() { return {}; }

 protected:
  ByteSink() = default;
};

/// Makes or empties a file. Written bytes are handed to the operating system at once, so they survive when
/// the process is killed. Fault: cannot_write with the path.
Outcome<std::unique_ptr<ByteSink>> make_file_sink(const std::string& path);

/// Writes to an open descriptor, such as a pipe, and waits while the pipe is full. The sink has a duplicate
/// of the descriptor, which itself stays open. Faults name `path`: cannot_write if no such descriptor is
/// open. A process that does not ignore SIGPIPE ends when it writes to a pipe that nobody reads.
Outcome<std::unique_ptr<ByteSink>> make_descriptor_sink(int descriptor, const std::string& path);

/// Appends to a string, which outlives the sink.
std::unique_ptr<ByteSink> make_string_sink(std::string& bytes);

}  // namespace outrider
