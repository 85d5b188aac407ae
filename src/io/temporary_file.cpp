#include "temporary_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <system_error>
#include <utility>

namespace outrider {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view prefix = ".outrider-";
constexpr std::string_view suffix = ".part";
constexpr int longest_wait_ms = 2000;  // for a lock on a folder; a writer holds it for some renamings

tl::unexpected<Fault> cannot_write(int error, const std::string& path) {
  return fault(FaultCode::cannot_write,
               fmt::format("it cannot be written: {}", std::generic_category().message(error)), path);
}

/// Resolves symbolic links, so that renaming replaces the file and not the link.
Outcome<std::string> destination(const std::string& path) {
  if (path.empty()) return bad_input("the file name is empty");
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) return path;
  if (fs::is_directory(status)) return bad_input("it is a folder; name a file to write", path);
  if (!fs::is_regular_file(status)) return bad_input("it is not a regular file; name another", path);
  const fs::path real = fs::canonical(path, error);
  return error ? path : real.string();
}

/// Locks a file. Returns false if another process has removed or locked it.
bool lock(int descriptor) {
  struct stat status{};
  return ::flock(descriptor, LOCK_EX | LOCK_NB) == 0 && ::fstat(descriptor, &status) == 0 &&
         status.st_nlink > 0;
}

/// Creates a new file and locks it.
Outcome<int> create(const std::string& final_name, const std::string& path, std::string& name) {
  constexpr int attempts = 1000;
  const fs::path folder = fs::path(final_name).parent_path();
  for (int i = 0; i < attempts; ++i) {
    name = folder / fmt::format("{}{}-{}{}", prefix, ::getpid(), i, suffix);
    const int descriptor = ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor >= 0 && lock(descriptor)) return descriptor;
    if (descriptor >= 0) {  // another writer removed it as abandoned between the two calls
      ::close(descriptor);
      continue;
    }
    if (errno == ENOENT) return bad_input("its folder does not exist; make it first", path);
    if (errno == EACCES || errno == EPERM || errno == EROFS) {
      return bad_input(
          fmt::format("its folder cannot be written to: {}", std::generic_category().message(errno)), path);
    }
    if (errno != EEXIST) return cannot_write(errno, path);
  }
  return cannot_write(EEXIST, path);
}

/// Writes everything and waits until it is on the disk. Returns 0, or errno.
int write_all(int descriptor, std::string_view content) {
  while (!content.empty()) {
    const ssize_t written = ::write(descriptor, content.data(), content.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return errno;
    content.remove_prefix(static_cast<std::size_t>(written));
  }
  return ::fsync(descriptor) == 0 ? 0 : errno;
}

void keep_mode(int descriptor, const std::string& old_file) {
  struct stat status{};
  if (::stat(old_file.c_str(), &status) == 0) (void)::fchmod(descriptor, status.st_mode & 07777U);
}

}  // namespace

Outcome<TemporaryFile> TemporaryFile::write(const std::string& path, std::string_view content) {
  auto final_name = destination(path);
  if (!final_name) return pass_on(final_name);
  TemporaryFile file;
  auto descriptor = create(*final_name, path, file.name_);
  if (!descriptor) {
    file.name_.clear();  // the file belongs to another process
    return pass_on(descriptor);
  }
  file.descriptor_ = *descriptor;
  file.path_ = path;
  file.final_name_ = std::move(*final_name);
  keep_mode(file.descriptor_, file.final_name_);
  if (const int error = write_all(file.descriptor_, content); error != 0) return cannot_write(error, path);
  return file;
}

Outcome<TemporaryFile> TemporaryFile::adopt(const std::string& path, const std::string& written) {
  auto final_name = destination(path);
  if (!final_name) return pass_on(final_name);
  TemporaryFile file;
  file.descriptor_ = ::open(written.c_str(), O_WRONLY | O_CLOEXEC);
  if (file.descriptor_ < 0) return cannot_write(errno, path);
  file.name_ = written;
  file.path_ = path;
  file.final_name_ = std::move(*final_name);
  keep_mode(file.descriptor_, file.final_name_);
  if (const int error = write_all(file.descriptor_, {}); error != 0) return cannot_write(error, path);
  return file;
}

TemporaryFile::TemporaryFile(TemporaryFile&& other) noexcept
    : path_(std::move(other.path_)),
      final_name_(std::move(other.final_name_)),
      name_(std::exchange(other.name_, {})),
      descriptor_(std::exchange(other.descriptor_, -1)) {}

TemporaryFile::~TemporaryFile() {
  if (!name_.empty()) ::unlink(name_.c_str());
  if (descriptor_ >= 0) ::close(descriptor_);
}

bool TemporaryFile::rename() const { return std::rename(name_.c_str(), final_name_.c_str()) == 0; }

Status TemporaryFile::finish(int error) {
  if (::access(name_.c_str(), F_OK) == 0) return cannot_write(error, path_);
  name_.clear();
  return {};
}

FolderLocks::FolderLocks(const std::set<fs::path>& folders) {
  for (const fs::path& folder : folders) {
    const int descriptor = ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor < 0) continue;
    for (int wait = 0; wait < longest_wait_ms && !lock(descriptor); ++wait) ::usleep(1000);
    descriptors_.push_back(descriptor);
  }
}

FolderLocks::~FolderLocks() {
  for (const int descriptor : descriptors_) ::close(descriptor);
}

void remove_abandoned_files(const fs::path& folder) {
  std::error_code error;
  fs::directory_iterator it(folder.empty() ? fs::path(".") : folder, error);
  for (const fs::directory_iterator end; !error && it != end; it.increment(error)) {
    const std::string name = it->path().filename().string();
    if (!name.starts_with(prefix) || !name.ends_with(suffix)) continue;
    const int descriptor = ::open(it->path().c_str(), O_RDONLY | O_NONBLOCK | O_NOFOLLOW | O_CLOEXEC);
    if (descriptor < 0) continue;
    if (lock(descriptor)) ::unlink(it->path().c_str());
    ::close(descriptor);
  }
}

}  // namespace outrider
