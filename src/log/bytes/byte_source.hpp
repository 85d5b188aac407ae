// Bytes that are read at any offset: a file, or memory. Thread rule: one source, one thread.
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

  /// Returns the name that faults carry, for instance the path of the file.
  [[nodiscard]] const std::string& name() const { return name_; }

  /// Returns the number of bytes when the source was opened.
  [[nodiscard]] std::uint64_t size() const { return size_; }

  /// Returns exactly `count` bytes. Fault: bad_input if they reach past the end, or the system cannot read
  /// them.
  [[nodiscard]] Outcome<std::string> read(std::uint64_t offset, std::uint64_t count) const;

  /// Counts bytes that a part of the source is unpacked to, again and again if it is. Returns false once they
  /// are more than any log of its size needs: 1 GiB and 500 times its size.
  [[nodiscard]] bool may_unpack(std::uint64_t bytes) const;

 protected:
  ByteSource(std::string name, std::uint64_t size) : name_(std::move(name)), size_(size) {}

 private:
  [[nodiscard]] virtual Status read_into(std::uint64_t offset, std::string& bytes) const = 0;

  std::string name_;
  std::uint64_t size_ = 0;
  mutable std::uint64_t unpacked_ = 0;
};

/// Opens a regular file. Fault: bad_input if there is none, or it cannot be read.
Outcome<std::unique_ptr<ByteSource>> open_file_source(const std::string& path);
/// Reads from a file that is open, and closes it in the end, also if this fails.
Outcome<std::unique_ptr<ByteSource>> file_source(int descriptor, const std::string& path);

/// Reads from memory that outlives the source.
std::unique_ptr<ByteSource> memory_source(std::string_view bytes, std::string name);

/// Returns the fault of a file that is wrong at a byte: bad_input with "<complaint>; <remedy>", and the name
/// of the source and the offset in bytes as its place.
tl::unexpected<Fault> damaged(const ByteSource& source, std::uint64_t offset, std::string_view complaint,
                              std::string_view remedy = "copy the file again, or record it anew");

/// Returns the fault of a chunk for which may_unpack() returned false.
tl::unexpected<Fault> unpacks_too_much(const ByteSource& source, std::uint64_t offset);

}  // namespace outrider
