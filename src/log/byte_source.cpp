#include "byte_source.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <system_error>

namespace outrider {
namespace {

class FileBytes : public ByteSource {
 public:
  FileBytes(int descriptor, std::string name, std::uint64_t size)
      : ByteSource(std::move(name), size), descriptor_(descriptor) {}
  FileBytes(const FileBytes&) = delete;
  FileBytes& operator=(const FileBytes&) = delete;
  ~FileBytes() override { ::close(descriptor_); }

 private:
  bool fill(std::uint64_t offset, std::string& bytes) const override {
    std::size_t done = 0;
    while (done < bytes.size()) {
      const ssize_t got =
          ::pread(descriptor_, bytes.data() + done, bytes.size() - done, static_cast<off_t>(offset + done));
      if (got < 0 && errno == EINTR) continue;
      if (got <= 0) return false;
      done += static_cast<std::size_t>(got);
    }
    return true;
  }

  int descriptor_;
};

class MemoryBytes : public ByteSource {
 public:
  MemoryBytes(std::string name, std::string_view bytes)
      : ByteSource(std::move(name), bytes.size()), bytes_(bytes) {}

 private:
  bool fill(std::uint64_t offset, std::string& bytes) const override {
    bytes = bytes_.substr(offset, bytes.size());
    return true;
  }

  std::string_view bytes_;
};

std::string system_says(int error) {
  return fmt::format("it cannot be read: {}", std::generic_category().message(error));
}

}  // namespace

Outcome<std::string> ByteSource::read(std::uint64_t offset, std::uint64_t length) const {
  if (offset > size_ || length > size_ - offset) {
    return damaged(*this, offset, fmt::format("{} bytes are expected here, but the file ends first", length));
  }
  std::string bytes(length, '\0');
  if (!fill(offset, bytes)) return damaged(*this, offset, "the system fails to read the file here");
  return bytes;
}

Outcome<std::shared_ptr<ByteSource>> open_bytes(const std::string& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (descriptor < 0) {
    if (errno == ENOENT) return bad_input("there is no such file; check the path", path);
    return bad_input(system_says(errno), path);
  }
  struct stat status{};
  if (::fstat(descriptor, &status) != 0 || !S_ISREG(status.st_mode)) {
    ::close(descriptor);
    return bad_input("it is not a regular file; name another", path);
  }
  return std::make_shared<FileBytes>(descriptor, path, static_cast<std::uint64_t>(status.st_size));
}

std::shared_ptr<ByteSource> bytes_in_memory(std::string name, std::string_view bytes) {
  return std::make_shared<MemoryBytes>(std::move(name), bytes);
}

tl::unexpected<Fault> damaged(const ByteSource& source, std::uint64_t offset, std::string sentence) {
  return bad_input(std::move(sentence), fmt::format("{}, byte {}", source.name(), offset));
}

}  // namespace outrider
