#include "outrider/io/files/file_lock.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

namespace outrider {
namespace {

/// Returns true if the path leads to the open file: another process may have renamed it.
bool is_file_of(int descriptor, int folder, const std::string& path) {
  struct stat open_file{}, named{};
  return ::fstat(descriptor, &open_file) == 0 && ::fstatat(folder, path.c_str(), &named, 0) == 0 &&
         open_file.st_ino == named.st_ino && open_file.st_dev == named.st_dev;
}

}  // namespace

Outcome<FileLock> FileLock::take(const std::string& path, std::optional<int> folder) {
  const int start = folder.value_or(AT_FDCWD);
  constexpr mode_t everybody_may_read = 0666;  // less what the umask takes away
  while (true) {
    const int descriptor =
        ::openat(start, path.c_str(), O_WRONLY | O_CREAT | O_NOFOLLOW | O_CLOEXEC, everybody_may_read);
    if (descriptor < 0) {
      return fault(FaultCode::cannot_write,
                   fmt::format("it cannot be written: {}", std::generic_category().message(errno)), path);
    }
    FileLock lock(descriptor);
    if (::flock(descriptor, LOCK_EX | LOCK_NB) != 0) return FileLock();
    if (is_file_of(descriptor, start, path)) return lock;
  }
}

FileLock::~FileLock() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

}  // namespace outrider
