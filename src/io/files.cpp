#include "outrider/io/files.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <memory>
#include <system_error>
#include <utility>

namespace outrider {
namespace {

namespace fs = std::filesystem;

std::string reason(int error) { return std::generic_category().message(error); }

struct CloseGz {
  void operator()(gzFile file) const { gzclose(file); }
};
using GzFile = std::unique_ptr<gzFile_s, CloseGz>;

Outcome<GzFile> open_for_reading(const std::string& path) {
  if (path.empty()) return bad_input("the file name is empty");
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0 && errno == ENOENT) return bad_input("there is no such file; check the path", path);
  if (descriptor < 0) return bad_input(fmt::format("it cannot be read: {}", reason(errno)), path);
  struct stat status{};
  if (::fstat(descriptor, &status) == 0 && S_ISDIR(status.st_mode)) {
    ::close(descriptor);
    return bad_input("it is a folder; name a file in it", path);
  }
  GzFile file(gzdopen(descriptor, "rb"));
  if (!file) {
    ::close(descriptor);
    return bad_input("there is no memory left to read it", path);
  }
  return file;
}

/// The file behind a symbolic link, so that the link itself survives the renaming.
Outcome<fs::path> destination(const std::string& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) return fs::path(path);
  if (fs::is_directory(status)) return bad_input("it is a folder; name a file to write", path);
  if (!fs::is_regular_file(status)) return bad_input("it is not a regular file; name another", path);
  const fs::path real = fs::canonical(path, error);
  return error ? fs::path(path) : real;
}

Status write_all(int descriptor, std::string_view content, const std::string& path) {
  while (!content.empty()) {
    const ssize_t written = ::write(descriptor, content.data(), content.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return bad_input(fmt::format("it cannot be written: {}", reason(errno)), path);
    content.remove_prefix(static_cast<std::size_t>(written));
  }
  if (::fsync(descriptor) != 0)
    return bad_input(fmt::format("it cannot be written: {}", reason(errno)), path);
  return {};
}

/// A file that did not exist before, for this process alone.
Outcome<int> create_temporary(const fs::path& final_name, fs::path& name) {
  constexpr int attempts = 1000;
  for (int i = 0; i < attempts; ++i) {
    name = final_name.parent_path() / fmt::format(".{}.{}.part", ::getpid(), i);
    const int descriptor = ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor >= 0) return descriptor;
    if (errno == ENOENT) return bad_input("its folder does not exist; make it first", final_name.string());
    if (errno != EEXIST) break;
  }
  return bad_input(fmt::format("its folder cannot be written to: {}", reason(errno)), final_name.string());
}

/// A whole file under a temporary name, which is gone with the object unless it took its own.
class WaitingFile {
 public:
  static Outcome<WaitingFile> make(const std::string& path, std::string_view content) {
    if (path.empty()) return bad_input("the file name is empty");
    auto final_name = destination(path);
    if (!final_name) return pass_on(final_name);
    WaitingFile file;
    auto descriptor = create_temporary(*final_name, file.temporary_);
    if (!descriptor) return pass_on(descriptor);
    file.path_ = path;
    file.final_name_ = std::move(*final_name);
    Status status = write_all(*descriptor, content, path);
    if (::close(*descriptor) != 0 && status) status = cannot_write(path);
    if (!status) return pass_on(status);
    return file;
  }

  WaitingFile(WaitingFile&& other) noexcept
      : path_(std::move(other.path_)),
        temporary_(std::exchange(other.temporary_, {})),
        final_name_(std::move(other.final_name_)) {}
  WaitingFile& operator=(WaitingFile&&) = delete;
  ~WaitingFile() {
    if (!temporary_.empty()) ::unlink(temporary_.c_str());
  }

  Status take_its_name() {
    if (std::rename(temporary_.c_str(), final_name_.c_str()) != 0) return cannot_write(path_);
    temporary_.clear();
    return {};
  }

 private:
  WaitingFile() = default;
  static Status cannot_write(const std::string& path) {
    return bad_input(fmt::format("it cannot be written: {}", reason(errno)), path);
  }

  std::string path_;
  fs::path temporary_;
  fs::path final_name_;
};

}  // namespace

Outcome<std::string> read_file(const std::string& path, std::size_t limit_bytes) {
  auto file = open_for_reading(path);
  if (!file) return pass_on(file);
  std::string content;
  constexpr std::size_t chunk = std::size_t{1} << 18;
  for (;;) {
    const std::size_t before = content.size();
    content.resize(before + std::min(chunk, limit_bytes - before + 1));
    const int got =
        gzread(file->get(), content.data() + before, static_cast<unsigned>(content.size() - before));
    content.resize(before + static_cast<std::size_t>(std::max(got, 0)));
    int error = Z_OK;
    const std::string_view message = gzerror(file->get(), &error);
    if (got < 0 || error == Z_BUF_ERROR) {
      const std::string_view what =
          error == Z_ERRNO ? "it cannot be read" : "its gzip data is damaged or cut short";
      return bad_input(fmt::format("{} ({})", what, message), path);
    }
    if (content.size() > limit_bytes) {
      return bad_input(fmt::format("it holds more than {} bytes, the most that is read", limit_bytes), path);
    }
    if (got == 0) return content;
  }
}

Status write_file(const std::string& path, std::string_view content) {
  auto waiting = WaitingFile::make(path, content);
  return waiting ? waiting->take_its_name() : pass_on(waiting);
}

Status write_files(const std::vector<NamedContent>& files) {
  std::vector<WaitingFile> waiting;
  for (const auto& [path, content] : files) {
    auto one = WaitingFile::make(path, content);
    if (!one) return pass_on(one);
    waiting.push_back(std::move(*one));
  }
  for (WaitingFile& one : waiting) {
    if (auto ok = one.take_its_name(); !ok) return ok;
  }
  return {};
}

}  // namespace outrider
