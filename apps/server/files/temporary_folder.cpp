#include "files/temporary_folder.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <stdlib.h>  // mkdtemp
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace outrider::server {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view prefix = "outrider-serve-";

}  // namespace

std::optional<FolderLock> FolderLock::take(const fs::path& folder) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  struct stat status{};
  if (descriptor >= 0 && ::fstat(descriptor, &status) == 0 && status.st_uid == ::geteuid() &&
      ::flock(descriptor, LOCK_EX | LOCK_NB) == 0 && fs::is_directory(folder)) {
    return FolderLock(descriptor);
  }
  if (descriptor >= 0) ::close(descriptor);
  return std::nullopt;
}

FolderLock::~FolderLock() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

Outcome<TemporaryFolder> TemporaryFolder::make() {
  constexpr int attempts = 10;  // another server may remove it before it is locked
  for (int i = 0; i < attempts; ++i) {
    std::error_code error;
    std::string name = (fs::temp_directory_path(error) / fmt::format("{}XXXXXX", prefix)).string();
    if (error || ::mkdtemp(name.data()) == nullptr) break;
    auto lock = FolderLock::take(name);
    if (!lock) continue;
    const fs::path inside = fs::canonical(name) / "files";
    if (fs::create_directory(inside, error)) return TemporaryFolder(inside, std::move(*lock));
  }
  return bad_input("there is no place for temporary files; set TMPDIR to a folder that can be written to",
                   "TMPDIR");
}

void TemporaryFolder::remove_abandoned() {
  std::error_code error;
  fs::directory_iterator it(fs::temp_directory_path(error), error);
  for (const fs::directory_iterator end; !error && it != end; it.increment(error)) {
    if (!it->path().filename().string().starts_with(prefix)) continue;
    const auto lock = FolderLock::take(it->path());
    std::error_code ignored;
    if (lock) fs::remove_all(it->path(), ignored);
  }
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  if (!path_.empty()) fs::remove_all(path_.parent_path(), ignored);
}

}  // namespace outrider::server
