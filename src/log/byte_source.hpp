// ByteSource: bytes that can be read at any offset, of a file or of memory.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "outrider/core/outcome.hpp"

namespace outrider {

class ByteSource {
 public:
  virtual ~ByteSource() = default;
  ByteSource(const ByteSource&) = delete;
  ByteSource& operator=(const ByteSource&) = delete;

  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] std::uint64_t size() const { return size_; }

  /// Returns all of the bytes asked for. Fault: bad_input, if they reach beyond the end or the system fails.
  [[nodiscard]] Outcome<std::string> read(std::uint64_t offset, std::uint64_t length) const;

 protected:
  ByteSource(std::string name, std::uint64_t size) : name_(std::move(name)), size_(size) {}

 private:
  /// Fills `bytes` from the offset; the range lies within the source. Returns false if the system fails.
  virtual bool fill(std::uint64_t offset, std::string& bytes) const = 0;

  std::string name_;
  std::uint64_t size_;
};

/// Opens a regular file. Fault: bad_input if there is none, or if it may not be read.
Outcome<std::shared_ptr<ByteSource>> open_bytes(const std::string& path);

/// The bytes have to outlive the source.
std::shared_ptr<ByteSource> bytes_in_memory(std::string name, std::string_view bytes);

/// bad_input with the file and the offset in bytes.
tl::unexpected<Fault> damaged(const ByteSource& source, std::uint64_t offset, std::string sentence);

}  // namespace outrider
