#include "outrider/log/bytes/byte_sink.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

namespace outrider {
namespace {

tl::unexpected<Fault> not_written(int error, const std::string& path) {
  return fault(FaultCode::cannot_write,
               fmt::format("it cannot be written: {}", std::generic_category().message(error)), path);
}

class FileSink final : public ByteSink {
 public:
  FileSink(std::string path, int descriptor) : path_(std::move(path)), descriptor_(descriptor) {}
  ~FileSink() override {
    if (descriptor_ >= 0) ::close(descriptor_);
  }

  Status write(std::string_view bytes) override {
    while (!bytes.empty()) {
      const ssize_t count = ::write(descriptor_, bytes.data(), bytes.size());
      if (count < 0 && errno == EINTR) continue;
      if (count < 0) return not_written(errno, path_);
      bytes.remove_prefix(static_cast<std::size_t>(count));
    }
    return {};
  }

  Status close() override {
    if (const int descriptor = std::exchange(descriptor_, -1); descriptor >= 0 && ::close(descriptor) != 0) {
      return not_written(errno, path_);
    }
    return {};
  }

 private:
  std::string path_;
  int descriptor_;
};

class StringSink final : public ByteSink {
 public:
  explicit StringSink(std::string& bytes) : bytes_(bytes) {}
  Status write(std::string_view bytes) override {
    bytes_.append(bytes);
    return {};
  }

 private:
  std::string& bytes_;
};

}  // namespace

Outcome<std::unique_ptr<ByteSink>> make_file_sink(const std::string& path) {
  constexpr mode_t everybody_may_read = 0666;  // less what the umask takes away
  const int descriptor = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, everybody_may_read);
  if (descriptor < 0) return not_written(errno, path);
  return std::make_unique<FileSink>(path, descriptor);
}

Outcome<std::unique_ptr<ByteSink>> make_descriptor_sink(int descriptor, const std::string& path) {
  const int duplicate = ::fcntl(descriptor, F_DUPFD_CLOEXEC, 0);
  if (duplicate < 0) return not_written(errno, path);
  return std::make_unique<FileSink>(path, duplicate);
}

std::unique_ptr<ByteSink> make_string_sink(std::string& bytes) { return std::make_unique<StringSink>(bytes); }

}  // namespace outrider
