#include "files/temporary_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <limits>
#include <system_error>
#include <utility>

#include "files/open_file.hpp"

namespace outrider {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view prefix = ".outrider-";
constexpr std::string_view suffix = ".part";
constexpr int attempts = 1000;         // to find a name that no other file has
constexpr int longest_wait_ms = 2000;  // for a lock on a folder; a writer holds it for some renamings

tl::unexpected<Fault> cannot_write(int error, const std::string& path) {
  return fault(FaultCode::cannot_write,
               fmt::format("it cannot be written: {}", std::generic_category().message(error)), path);
}

/// Locks a file. Returns false if another process has removed or locked it.
bool lock(int descriptor) {
  struct stat status{};
  return ::flock(descriptor, LOCK_EX | LOCK_NB) == 0 && ::fstat(descriptor, &status) == 0 &&
         status.st_nlink > 0;
}

std::string temporary_name(int number) {
  return fmt::format("{}{}-{}{}", prefix, ::getpid(), number, suffix);
}

/// Creates a new file in the folder and locks it.
Outcome<int> create(const OpenFolder& folder, const std::string& path, std::string& name) {
  for (int i = 0; i < attempts; ++i) {
    name = temporary_name(i);
    const int descriptor =
        ::openat(folder.descriptor(), name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor >= 0 && lock(descriptor)) return descriptor;
    if (descriptor >= 0) {  // another writer removed it as abandoned between the two calls
      ::close(descriptor);
      continue;
    }
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

/// Gives the file the mode of the one that it will replace.
void keep_mode(int descriptor, const FilePlace& place) {
  struct stat status{};
  const bool there =
      ::fstatat(place.folder.descriptor(), place.name.c_str(), &status, AT_SYMLINK_NOFOLLOW) == 0;
  if (there && S_ISREG(status.st_mode)) (void)::fchmod(descriptor, status.st_mode & 07777U);
}

}  // namespace

Outcome<FilePlace> place_of(const std::string& path) {
  if (path.empty()) return bad_input("the file name is empty");
  std::error_code error;
  fs::path real = path;
  if (!reading_is_confined() && fs::is_symlink(path, error) && fs::exists(path, error))
    real = fs::canonical(path, error);
  auto folder = OpenFolder::open(real.has_parent_path() ? real.parent_path().string() : ".");
  if (!folder) return bad_input(folder.error().sentence, path);
  const auto there = folder->status(real.filename().string());
  if (there && there->is_folder) return bad_input("it is a folder; name a file to write", path);
  if (there && !there->is_file && !fs::is_symlink(real, error))
    return bad_input("it is not a regular file; name another", path);
  return FilePlace{std::move(*folder), real.filename().string(), path};
}

Outcome<TemporaryFile> TemporaryFile::write(FilePlace place, std::string_view content) {
  OpenFolder folder = place.folder;
  TemporaryFile file(std::move(place), std::move(folder));
  const std::string& path = file.place_.path;
  std::string name;
  auto descriptor = create(file.from_, path, name);
  if (!descriptor) return pass_on(descriptor);
  file.name_ = std::move(name);
  file.descriptor_ = *descriptor;
  keep_mode(file.descriptor_, file.place_);
  if (const int error = write_all(file.descriptor_, content); error != 0) return cannot_write(error, path);
  return file;
}

Outcome<TemporaryFile> TemporaryFile::adopt(FilePlace place, const std::string& written) {
  auto from = place_of(written);
  if (!from) return pass_on(from);
  TemporaryFile file(std::move(place), std::move(from->folder));
  const std::string& path = file.place_.path;
  file.descriptor_ = ::openat(file.from_.descriptor(), from->name.c_str(), O_WRONLY | O_NOFOLLOW | O_CLOEXEC);
  if (file.descriptor_ < 0) return cannot_write(errno, path);
  file.name_ = std::move(from->name);
  keep_mode(file.descriptor_, file.place_);
  if (const int error = write_all(file.descriptor_, {}); error != 0) return cannot_write(error, path);
  return file;
}

Outcome<std::optional<TemporaryFile>> TemporaryFile::keep_old(const TemporaryFile& file) {
  const FilePlace& place = file.place_;
  const int folder = place.folder.descriptor();
  TemporaryFile old(place, place.folder);
  old.descriptor_ = ::openat(folder, place.name.c_str(), O_RDONLY | O_NONBLOCK | O_NOFOLLOW | O_CLOEXEC);
  if (old.descriptor_ >= 0) lock(old.descriptor_);  // so that no other writer takes it for abandoned
  for (int i = 0; i < attempts; ++i) {
    old.name_ = temporary_name(i);
    if (::linkat(folder, place.name.c_str(), folder, old.name_.c_str(), 0) == 0) break;
    old.name_.clear();
    if (errno == ENOENT) return std::optional<TemporaryFile>();
    if (errno == ENOSPC || errno == EDQUOT || errno == EIO) return cannot_write(errno, place.path);
    if (errno != EEXIST) break;
  }
  return std::optional<TemporaryFile>(std::move(old));
}

TemporaryFile::TemporaryFile(TemporaryFile&& other) noexcept
    : place_(std::move(other.place_)),
      from_(std::move(other.from_)),
      name_(std::exchange(other.name_, {})),
      descriptor_(std::exchange(other.descriptor_, -1)) {}

TemporaryFile::~TemporaryFile() {
  if (!name_.empty()) ::unlinkat(from_.descriptor(), name_.c_str(), 0);
  if (descriptor_ >= 0) ::close(descriptor_);
}

bool TemporaryFile::rename() const {
  return ::renameat(from_.descriptor(), name_.c_str(), place_.folder.descriptor(), place_.name.c_str()) == 0;
}

void TemporaryFile::remove_final() const { ::unlinkat(place_.folder.descriptor(), place_.name.c_str(), 0); }

int rename_all(const std::vector<TemporaryFile>& files, const OldFiles& old) {
  for (std::size_t i = 0; i < files.size(); ++i) {
    if (files[i].rename()) continue;
    const int error = errno;
    while (i-- > 0) old[i] ? void(old[i]->rename()) : files[i].remove_final();
    return error;
  }
  return 0;
}

Status TemporaryFile::finish(int error) {
  if (from_.status(name_)) return cannot_write(error, place_.path);
  name_.clear();
  return {};
}

FolderLocks::FolderLocks(const std::vector<OpenFolder>& folders) {
  for (const OpenFolder& folder : folders) {
    const int descriptor = ::openat(folder.descriptor(), ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor < 0) continue;
    for (int wait = 0; wait < longest_wait_ms && !lock(descriptor); ++wait) ::usleep(1000);
    descriptors_.push_back(descriptor);
  }
}

FolderLocks::~FolderLocks() {
  for (const int descriptor : descriptors_) ::close(descriptor);
}

void remove_abandoned_files(const OpenFolder& folder) {
  for (const std::string& name : folder.names(std::numeric_limits<std::size_t>::max())) {
    if (!name.starts_with(prefix) || !name.ends_with(suffix)) continue;
    const int descriptor =
        ::openat(folder.descriptor(), name.c_str(), O_RDONLY | O_NONBLOCK | O_NOFOLLOW | O_CLOEXEC);
    if (descriptor < 0) continue;
    if (lock(descriptor)) ::unlinkat(folder.descriptor(), name.c_str(), 0);
    ::close(descriptor);
  }
}

}  // namespace outrider
