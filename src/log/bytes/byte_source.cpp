#include "bytes/byte_source.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <limits>
#include <system_error>

namespace outrider {
namespace {

std::string reason(int error) { return std::generic_category().message(error); }

class FileSource final : public ByteSource {
 public:
  FileSource(std::string path, std::uint64_t size, int descriptor)
      : ByteSource(std::move(path), size), descriptor_(descriptor) {}
  ~FileSource() override { ::close(descriptor_); }

 private:
  [[nodiscard]] Status read_into(std::uint64_t offset, std::string& bytes) const override {
    std::size_t done = 0;
    while (done < bytes.size()) {
      const ssize_t count =
          ::pread(descriptor_, bytes.data() + done, bytes.size() - done, static_cast<off_t>(offset + done));
      if (count < 0 && errno == EINTR) continue;
      if (count < 0) return bad_input(fmt::format("it cannot be read: {}", reason(errno)), name());
      if (count == 0) {
        return bad_input(fmt::format("it became shorter while it was read: byte {} is gone", offset + done),
                         name());
      }
      done += static_cast<std::size_t>(count);
    }
    return {};
  }

  int descriptor_;
};

class MemorySource final : public ByteSource {
 public:
  MemorySource(std::string_view bytes, std::string name)
      : ByteSource(std::move(name), bytes.size()), bytes_(bytes) {}

 private:
  [[nodiscard]] Status read_into(std::uint64_t offset, std::string& bytes) const override {
    bytes_.copy(bytes.data(), bytes.size(), static_cast<std::size_t>(offset));
    return {};
  }

  std::string_view bytes_;
};

}  // namespace

Outcome<std::string> ByteSource::read(std::uint64_t offset, std::uint64_t count) const {
  if (offset > size_ || count > size_ - offset) {
    return bad_input(fmt::format("{} bytes at byte {} reach past its end at byte {}", count, offset, size_),
                     name_);
  }
  std::string bytes(static_cast<std::size_t>(count), '\0');
  if (auto read = read_into(offset, bytes); !read) return pass_on(read);
  return bytes;
}

bool ByteSource::may_unpack(std::uint64_t bytes) const {
  constexpr std::uint64_t any = std::uint64_t{1} << 30U, most_times = 500;
  unpacked_ += std::min(bytes, std::numeric_limits<std::uint64_t>::max() - unpacked_);
  return unpacked_ <= any || (unpacked_ - any) / most_times <= size_;
}

Outcome<std::unique_ptr<ByteSource>> open_file_source(const std::string& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  if (descriptor < 0) {
    if (errno == ENOENT) return bad_input("there is no such file; check the path", path);
    return bad_input(fmt::format("it cannot be read: {}", reason(errno)), path);
  }
  return file_source(descriptor, path);
}

Outcome<std::unique_ptr<ByteSource>> file_source(int descriptor, const std::string& path) {
  struct stat status{};
  if (::fstat(descriptor, &status) != 0 || !S_ISREG(status.st_mode)) {
    ::close(descriptor);
    return bad_input("it is not a regular file; name another", path);
  }
  return std::make_unique<FileSource>(path, static_cast<std::uint64_t>(status.st_size), descriptor);
}

std::unique_ptr<ByteSource> memory_source(std::string_view bytes, std::string name) {
  return std::make_unique<MemorySource>(bytes, std::move(name));
}

tl::unexpected<Fault> damaged(const ByteSource& source, std::uint64_t offset, std::string_view complaint,
                              std::string_view remedy) {
  return bad_input(fmt::format("{}; {}", complaint, remedy),
                   fmt::format("{}, byte {}", source.name(), offset));
}

tl::unexpected<Fault> unpacks_too_much(const ByteSource& source, std::uint64_t offset) {
  return damaged(source, offset, "its chunks unpack to more than 500 times the size of the file",
                 "record it without compression");
}

}  // namespace outrider
