#include "files/open_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <linux/openat2.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <map>
#include <system_error>

#include "outrider/core/text.hpp"
#include "outrider/io/files/confinement.hpp"

namespace outrider {
namespace {

struct Access {
  int root = -1;  ///< descriptor of the folder; -1: all files may be read
  std::string root_path;
  std::map<std::string, std::string> supplied;
};

/// Returns the access rule of the process. It is only written before other threads start.
Access& access_rule() {
  static Access rule;
  return rule;
}

int open2(int root, const std::string& path, int flags) {
  return open_resolved(root, path, flags, RESOLVE_BENEATH | RESOLVE_NO_MAGICLINKS);
}

/// Calls open(), or openat2() in a confined process. Returns -1 and sets errno on failure.
int open_allowed(const std::string& path, int flags) {
  const Access& rule = access_rule();
  if (rule.root < 0) return ::open(path.c_str(), flags | O_CLOEXEC);
  std::string relative = path;
  if (relative.starts_with(rule.root_path + "/")) relative.erase(0, rule.root_path.size() + 1);
  return open2(rule.root, relative, flags);
}

bool leads_out(int error) { return error == EXDEV; }

Fault why_not(int error, const std::string& path) {
  if (error == ENOENT) return {FaultCode::bad_input, "there is no such file; check the path", path};
  if (leads_out(error)) {
    return {FaultCode::bad_input,
            "it lies outside the folder whose files may be read; move it there and name it without ..", path};
  }
  return {FaultCode::bad_input, fmt::format("it cannot be read: {}", std::generic_category().message(error)),
          error == ENAMETOOLONG ? excerpt(path) : path};
}

}  // namespace

int open_resolved(int root, const std::string& path, int flags, std::uint64_t resolve, unsigned mode) {
  open_how how{};
  how.flags = static_cast<std::uint64_t>(flags | O_CLOEXEC);
  how.mode = mode;
  how.resolve = resolve;
  constexpr int attempts = 100;
  long descriptor = -1;
  for (int i = 0; i < attempts; ++i) {
    descriptor = ::syscall(SYS_openat2, root, path.c_str(), &how, sizeof how);
    if (descriptor >= 0 || errno != EAGAIN) break;
  }
  return static_cast<int>(descriptor);
}

Outcome<int> checked(int descriptor, const std::string& path, bool regular_only) {
  if (descriptor < 0) return tl::unexpected<Fault>(why_not(errno, path));
  struct stat status{};
  const bool known = ::fstat(descriptor, &status) == 0;
  if (known && !S_ISDIR(status.st_mode) && (S_ISREG(status.st_mode) || !regular_only)) return descriptor;
  ::close(descriptor);
  if (known && S_ISDIR(status.st_mode)) return bad_input("it is a folder; name a file in it", path);
  return bad_input("it is not a regular file; name another", path);
}

Status confine_reading(const std::string& root) {
  Access& rule = access_rule();
  if (rule.root >= 0) return bad_input("reading is confined already", root);
  const int descriptor = ::open(root.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0 || ::fchdir(descriptor) != 0) {
    return bad_input("it is no folder that files can be read from; name another", root);
  }
  const int probe = open2(descriptor, ".", O_PATH);
  if (probe < 0) {
    ::close(descriptor);
    return bad_input(
        "this system cannot confine a program to a folder (openat2 is missing); use Linux 5.6 "
        "or newer",
        root);
  }
  ::close(probe);
  rule.root = descriptor;
  std::error_code error;
  const std::filesystem::path given = root;
  rule.root_path = given.is_absolute() ? root : std::filesystem::current_path(error).string();
  return {};
}

void supply_file(const std::string& path, std::string content) {
  access_rule().supplied[path] = std::move(content);
}

const std::string* supplied_content(const std::string& path) {
  const auto& supplied = access_rule().supplied;
  const auto found = supplied.find(path);
  if (found != supplied.end()) note_read(path);
  return found == supplied.end() ? nullptr : &found->second;
}

Outcome<int> open_file(const std::string& path) {
  if (path.empty()) return bad_input("the file name is empty");
  note_read(path);
  const bool confined = access_rule().root >= 0;
  // Without O_NONBLOCK, opening a pipe would wait for a writer.
  const int descriptor = open_allowed(path, O_RDONLY | (confined ? O_NONBLOCK : 0));
  return checked(descriptor, path, confined);
}

bool reading_is_confined() { return access_rule().root >= 0; }

FileKind file_kind(const std::string& path) {
  if (supplied_content(path) != nullptr) return FileKind::other;
  const int descriptor = open_allowed(path, O_PATH);
  if (descriptor < 0) return leads_out(errno) ? FileKind::forbidden : FileKind::missing;
  struct stat status{};
  const bool folder = ::fstat(descriptor, &status) == 0 && S_ISDIR(status.st_mode);
  ::close(descriptor);
  return folder ? FileKind::folder : FileKind::other;
}

}  // namespace outrider
