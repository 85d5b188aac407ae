// The list of the files under the served folder, with what they are.
//
// The server itself only looks at names and sizes; the reader process looks into files (file_kinds.hpp). Its
// answers are kept, and asked for again once the inode, the time of change or the size of a file differs.
// Thread rule: any thread may call.
#pragma once

#include <map>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "files/reading.hpp"

namespace outrider::server {

inline constexpr std::size_t most_listed_files = 5000;
inline constexpr int deepest_folder = 8;

class FileList {
 public:
  /// `folder` must outlive it.
  FileList(const Folder& folder, ReadFiles read) : folder_(folder), read_(std::move(read)) {}

  /// Returns {"folder", "files": [{"path", "kind", "job", "description", "bytes"}], "truncated"}, sorted by
  /// path: see file_kind(). A file that the reader cannot read within its limits is `other`. Fault: cancelled
  /// if `stop` is raised, or if too many others wait for the reader.
  Outcome<Json> list(const std::stop_token& stop);

 private:
  struct Found {
    std::string path;
    FileStatus status;
  };
  struct Known {
    FileStatus status;
    Json kind;
  };
  std::vector<Found> found(bool& truncated, const std::stop_token& stop) const;  // sorted by path
  Json kind_of(const Found& file);                                               // null if it is not known
  Status learn_changed(const std::vector<Found>& files, const std::stop_token& stop);
  Status learn(const std::vector<Found>& files, const std::stop_token& stop);
  void keep(const Found& file, Json kind);

  const Folder& folder_;
  ReadFiles read_;
  std::mutex mutex_;
  std::map<std::string, Known> known_;  // by path
};

}  // namespace outrider::server
