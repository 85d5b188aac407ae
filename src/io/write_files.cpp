#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <set>
#include <vector>

#include "outrider/io/files.hpp"
#include "temporary_file.hpp"

namespace outrider {
namespace {

/// Renames all files in order and stops at the first failure. Returns 0, or errno. It makes only calls that
/// are safe between fork() and _exit().
int rename_all(const std::vector<TemporaryFile>& files) {
  const auto failed = std::ranges::find_if_not(files, &TemporaryFile::rename);
  return failed == files.end() ? 0 : errno;
}

/// Renames all files in a separate process with its own session, which survives if this process is killed.
int rename_all_unharmed(const std::vector<TemporaryFile>& files) {
  const pid_t child = ::fork();
  if (child < 0) return rename_all(files);  // no new process is possible
  if (child == 0) {
    ::setsid();
    ::_exit(rename_all(files) & 0x7f);
  }
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : EIO;
}

}  // namespace

Status write_file(const std::string& path, std::string_view content) {
  remove_abandoned_files(std::filesystem::path(path).parent_path());
  auto file = TemporaryFile::write(path, content);
  if (!file) return pass_on(file);
  return file->finish(file->rename() ? 0 : errno);
}

Status write_files(const std::vector<NamedContent>& files, const std::vector<FileToRename>& complete) {
  std::set<std::filesystem::path> folders;
  for (const NamedContent& file : files) folders.insert(std::filesystem::path(file.path).parent_path());
  for (const FileToRename& file : complete) folders.insert(std::filesystem::path(file.path).parent_path());
  for (const auto& folder : folders) remove_abandoned_files(folder);
  std::vector<TemporaryFile> written;
  written.reserve(files.size() + complete.size());
  for (const auto& [path, written_as] : complete) {
    auto file = TemporaryFile::adopt(path, written_as);
    if (!file) return pass_on(file);
    written.push_back(std::move(*file));
  }
  for (const auto& [path, content] : files) {
    auto file = TemporaryFile::write(path, content);
    if (!file) return pass_on(file);
    written.push_back(std::move(*file));
  }
  const FolderLocks locks(folders);
  const int error = written.size() < 2 ? rename_all(written) : rename_all_unharmed(written);
  Status first;
  for (TemporaryFile& file : written) {
    if (auto ok = file.finish(error); !ok && first) first = ok;
  }
  return first;
}

}  // namespace outrider
