#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <map>
#include <utility>
#include <vector>

#include "files/temporary_file.hpp"
#include "outrider/io/files/files.hpp"

namespace outrider {
namespace {

/// Renames all files in a separate process with its own session, which survives if this process is killed.
int rename_all_unharmed(const std::vector<TemporaryFile>& files, const OldFiles& old) {
  const pid_t child = ::fork();
  if (child < 0) return rename_all(files, old);  // no new process is possible
  if (child == 0) {
    ::setsid();
    ::_exit(rename_all(files, old) & 0x7f);
  }
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : EIO;
}

/// Returns the folder of each place once, in the order of their inodes.
std::vector<OpenFolder> folders_of(const std::vector<FilePlace>& places) {
  std::map<std::pair<std::uint64_t, std::uint64_t>, OpenFolder> sorted;
  for (const FilePlace& place : places) {
    const FileStatus status = place.folder.status();
    sorted.emplace(std::pair(status.device, status.inode), place.folder);
  }
  std::vector<OpenFolder> folders;
  for (auto& [inode, folder] : sorted) folders.push_back(std::move(folder));
  return folders;
}

/// Writes the files to their places; those of `complete` come first.
Status write_to(const std::vector<FilePlace>& places, const std::vector<NamedContent>& files,
                const std::vector<FileToRename>& complete) {
  const std::vector<OpenFolder> folders = folders_of(places);
  for (const OpenFolder& folder : folders) remove_abandoned_files(folder);
  std::vector<TemporaryFile> written;
  written.reserve(places.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    auto file = i < complete.size() ? TemporaryFile::adopt(places[i], complete[i].written_as)
                                    : TemporaryFile::write(places[i], files[i - complete.size()].content);
    if (!file) return pass_on(file);
    written.push_back(std::move(*file));
  }
  const FolderLocks locks(folders);
  OldFiles old;
  for (const TemporaryFile& file : written) {
    auto kept = TemporaryFile::keep_old(file);
    if (!kept) return pass_on(kept);
    old.push_back(std::move(*kept));
  }
  const int error = written.size() < 2 ? rename_all(written, old) : rename_all_unharmed(written, old);
  Status first;
  for (TemporaryFile& file : written) {
    if (auto ok = file.finish(error); !ok && first) first = ok;
  }
  return first;
}

}  // namespace

Status write_file(const std::string& path, std::string_view content) {
  auto place = place_of(path);
  if (!place) return pass_on(place);
  remove_abandoned_files(place->folder);
  auto file = TemporaryFile::write(std::move(*place), content);
  if (!file) return pass_on(file);
  return file->finish(file->rename() ? 0 : errno);
}

Status write_files(const std::vector<NamedContent>& files, const std::vector<FileToRename>& complete) {
  std::vector<std::string> paths;
  for (const FileToRename& file : complete) paths.push_back(file.path);
  for (const NamedContent& file : files) paths.push_back(file.path);
  std::vector<FilePlace> places;
  for (const std::string& path : paths) {
    auto place = place_of(path);
    if (!place) return pass_on(place);
    places.push_back(std::move(*place));
  }
  return write_to(places, files, complete);
}

Status OpenFolder::write(const std::vector<NamedContent>& files) const {
  std::vector<FilePlace> places;
  for (const NamedContent& file : files) places.push_back({*this, file.path, file.path});
  return write_to(places, files, {});
}

}  // namespace outrider
