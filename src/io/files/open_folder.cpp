#include "outrider/io/files/open_folder.hpp"

#include <dirent.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <linux/openat2.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <system_error>

#include "files/open_file.hpp"

namespace outrider {
namespace {

constexpr std::size_t most_removed = 10'000;

int open_here(int folder, const std::string& path, int flags, unsigned mode = 0) {
  return open_resolved(folder, path, flags, RESOLVE_BENEATH | RESOLVE_NO_SYMLINKS, mode);
}

Fault no_folder(FaultCode code, int error, const std::string& path) {
  if (error == ENOENT) return {code, "its folder does not exist; make it first", path};
  return {code, fmt::format("its folder cannot be opened: {}", std::generic_category().message(error)), path};
}

FileStatus status_of(const struct stat& status) {
  constexpr std::int64_t ns = 1'000'000'000;
  return {S_ISDIR(status.st_mode),
          S_ISREG(status.st_mode),
          status.st_dev,
          status.st_ino,
          ns * status.st_mtim.tv_sec + status.st_mtim.tv_nsec,
          static_cast<std::uint64_t>(status.st_size)};
}

}  // namespace

OpenFolder::OpenFolder(int descriptor)
    : descriptor_(new int(descriptor), [](const int* opened) {
        ::close(*opened);
        delete opened;
      }) {}

Outcome<OpenFolder> OpenFolder::open(const std::string& path) {
  const int descriptor = ::open(path.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return tl::unexpected<Fault>(no_folder(FaultCode::bad_input, errno, path));
  return OpenFolder(descriptor);
}

Outcome<OpenFolder> OpenFolder::folder(const std::string& path) const {
  const int descriptor = open_here(*descriptor_, path.empty() ? "." : path, O_PATH | O_DIRECTORY);
  if (descriptor < 0) return tl::unexpected<Fault>(no_folder(FaultCode::bad_input, errno, path));
  return OpenFolder(descriptor);
}

Outcome<OpenFolder> OpenFolder::make_folder(const std::string& name) const {
  const bool made = ::mkdirat(*descriptor_, name.c_str(), 0777) == 0;  // less what the umask takes away
  const int why = errno;
  const int descriptor = open_here(*descriptor_, name, O_PATH | O_DIRECTORY);
  if (descriptor >= 0) return OpenFolder(descriptor);
  return tl::unexpected<Fault>(no_folder(FaultCode::cannot_write, made || why == EEXIST ? errno : why, name));
}

Outcome<int> OpenFolder::open_file(const std::string& path) const {
  return checked(open_here(*descriptor_, path, O_RDONLY | O_NONBLOCK), path, true);
}

int OpenFolder::create_file(const std::string& name) const {
  return open_here(*descriptor_, name, O_RDWR | O_CREAT | O_EXCL, 0600);
}

bool OpenFolder::rename(const std::string& from, const std::string& to) const {
  return ::renameat(*descriptor_, from.c_str(), *descriptor_, to.c_str()) == 0;
}

void OpenFolder::remove(const std::string& name) const {
  if (::unlinkat(*descriptor_, name.c_str(), 0) == 0) return;
  const auto inner = folder(name);
  if (!inner) return;
  for (const std::string& file : inner->names(most_removed)) ::unlinkat(*inner->descriptor_, file.c_str(), 0);
  ::unlinkat(*descriptor_, name.c_str(), AT_REMOVEDIR);
}

std::vector<std::string> OpenFolder::names(std::size_t most) const {
  std::vector<std::string> names;
  const int descriptor = open_here(*descriptor_, ".", O_RDONLY | O_DIRECTORY);
  DIR* const entries = descriptor < 0 ? nullptr : ::fdopendir(descriptor);
  if (entries == nullptr) return names;
  while (const dirent* entry = names.size() < most ? ::readdir(entries) : nullptr) {
    std::string name = static_cast<const char*>(entry->d_name);
    if (name != "." && name != "..") names.push_back(std::move(name));
  }
  ::closedir(entries);
  std::ranges::sort(names);
  return names;
}

std::optional<FileStatus> OpenFolder::status(const std::string& name) const {
  struct stat status{};
  if (::fstatat(*descriptor_, name.c_str(), &status, AT_SYMLINK_NOFOLLOW) != 0) return std::nullopt;
  return status_of(status);
}

FileStatus OpenFolder::status() const {
  struct stat status{};
  return ::fstat(*descriptor_, &status) == 0 ? status_of(status) : FileStatus{};
}

}  // namespace outrider
