#include "files/file_list.hpp"

#include <algorithm>

#include "files/file_kinds.hpp"

namespace outrider::server {
namespace {

constexpr std::size_t most_entries = 100'000;  // of a folder
constexpr std::size_t most_asked = 500;        // files of a question

}  // namespace

std::vector<FileList::Found> FileList::found(bool& truncated, const std::stop_token& stop) const {
  std::vector<Found> files;
  std::vector<std::pair<std::string, int>> folders = {{"", 0}};  // path and depth
  while (!folders.empty() && !truncated && !stop.stop_requested()) {
    const auto [above, depth] = folders.back();
    folders.pop_back();
    const auto folder = folder_.gate().folder(above);
    if (!folder) continue;
    for (const std::string& name : folder->names(most_entries)) {
      const auto status = good_name(name) ? folder->status(name) : std::nullopt;
      if (!status) continue;
      if (status->is_folder && depth + 1 < deepest_folder)
        folders.emplace_back(above + name + "/", depth + 1);
      if (!status->is_file) continue;
      truncated = files.size() == most_listed_files;
      if (truncated) break;
      files.push_back({above + name, *status});
    }
  }
  std::ranges::sort(files, {}, &Found::path);
  return files;
}

void FileList::keep(const Found& file, Json kind) {
  const std::lock_guard lock(mutex_);
  known_.insert_or_assign(file.path, Known{file.status, std::move(kind)});
}

/// Has the reader look into files. Together they are as large as one may be; if they are too much for it, it
/// looks into each on its own, so that the others are known.
Status FileList::learn(const std::vector<Found>& files, const std::stop_token& stop) {
  Json paths = Json::array();
  for (const Found& file : files) paths.push_back(file.path);
  auto answer = read_(folder_, {{"kinds", std::move(paths)}}, stop);
  if (!answer && answer.error().code == FaultCode::cancelled) return pass_on(answer);
  for (std::size_t i = 0; i < files.size(); ++i) {
    if (answer) {
      keep(files[i], answer->at("kinds").at(i));
    } else if (files.size() == 1) {
      keep(files[i], {{"kind", "other"}});
    } else if (auto ok = learn({files[i]}, stop); !ok) {
      return ok;
    }
  }
  return {};
}

/// Has the reader look into the files that are new or have changed.
Status FileList::learn_changed(const std::vector<Found>& files, const std::stop_token& stop) {
  std::vector<Found> together;
  std::uint64_t bytes = 0;
  for (const Found& file : files) {
    if (!kind_of(file).is_null()) continue;
    const std::uint64_t more = is_parsed(file.path) ? file.status.bytes : 0;
    if (!together.empty() && (bytes + more > largest_saved_bytes || together.size() == most_asked)) {
      if (auto ok = learn(std::exchange(together, {}), stop); !ok) return ok;
      bytes = 0;
    }
    together.push_back(file);
    bytes += more;
  }
  return together.empty() ? Status() : learn(together, stop);
}

Json FileList::kind_of(const Found& file) {
  const std::lock_guard lock(mutex_);
  const auto row = known_.find(file.path);
  return row != known_.end() && row->second.status == file.status ? row->second.kind : Json();
}

Outcome<Json> FileList::list(const std::stop_token& stop) {
  bool truncated = false;
  const std::vector<Found> files = found(truncated, stop);
  if (auto ok = learn_changed(files, stop); !ok) return pass_on(ok);
  Json list = Json::array();
  std::map<std::string, Known> known;
  for (const Found& file : files) {
    Json row = {{"path", file.path}};
    row.update(kind_of(file));
    known.emplace(file.path, Known{file.status, kind_of(file)});
    row["bytes"] = file.status.bytes;
    list.push_back(std::move(row));
  }
  const std::lock_guard lock(mutex_);
  known_ = std::move(known);  // without those that are gone
  return Json{{"folder", folder_.name()}, {"files", std::move(list)}, {"truncated", truncated}};
}

}  // namespace outrider::server
