#include "outrider/job/run_log.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <system_error>
#include <utility>

#include "outrider/io/files/files.hpp"

namespace outrider {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t chunk_bytes = std::size_t{128} << 10U;  ///< what a killed run loses at most

/// Returns the topmost folder of the path that does not exist; empty if all exist.
fs::path topmost_missing(const fs::path& folder) {
  std::error_code error;
  fs::path missing;
  for (fs::path one = fs::absolute(folder, error).lexically_normal(); !one.empty(); one = one.parent_path()) {
    if (fs::exists(one, error) || one == one.parent_path()) break;
    if (one.has_filename()) missing = one;
  }
  return missing;
}

/// Removes the folder and those in it, as far as they are empty.
void remove_empty(const fs::path& folder) {
  std::error_code error;
  for (fs::directory_iterator it(folder, error); !error && it != fs::directory_iterator();
       it.increment(error)) {
    if (it->is_directory(error)) remove_empty(it->path());
  }
  fs::remove(folder, error);  // fails if it is not empty
}

}  // namespace

RunLog::~RunLog() {
  sink_.reset();
  remove();
}

void RunLog::abandon() {
  const std::lock_guard lock(beginning_);
  remove();
}

void RunLog::remove() const {
  if (!path_.empty()) ::unlink(path_.c_str());
  if (!made_.empty()) remove_empty(made_);
}

Status RunLog::lock_file() {
  constexpr int most = 100;  // runs at a time in one folder
  for (int i = 1; i <= most; ++i) {
    const std::string path = folder_ + (i == 1 ? "/running.mcap" : fmt::format("/running-{}.mcap", i));
    auto lock = FileLock::take(path);
    if (!lock) return pass_on(lock);
    if (!lock->held()) continue;
    lock_ = std::move(*lock);
    path_ = path;
    return {};
  }
  return fault(FaultCode::cannot_write, "more than 100 runs write to this folder; name another", folder_);
}

Status RunLog::begin_file() {
  const std::lock_guard lock(beginning_);
  made_ = topmost_missing(folder_);
  if (auto ok = make_folder(folder_); !ok) return ok;
  if (auto ok = lock_file(); !ok) return ok;
  auto file = make_descriptor_sink(lock_.descriptor(), path_);  // not by its name, which may be a link by now
  if (!file) return pass_on(file);
  if (::ftruncate(lock_.descriptor(), 0) != 0)
    return fault(FaultCode::cannot_write, "its file cannot be emptied", path_);
  auto writer = McapWriter::begin(std::move(*file), {.chunk_bytes = chunk_bytes});
  if (!writer) return pass_on(writer);
  sink_.emplace(std::move(*writer));
  return sink_->writer().attach("scenario.yaml", "application/yaml", scenario_);
}

void RunLog::add_channel(const Channel& channel) {
  if (!sink_ && status_) status_ = begin_file();
  if (sink_) sink_->add_channel(channel);
}

void RunLog::append(std::size_t channel, std::int64_t time_ns, std::string_view data) {
  if (sink_) sink_->append(channel, time_ns, data);
}

Outcome<std::string> RunLog::finish(const std::string& result) {
  if (!status_) return pass_on(status_);
  if (!sink_) return std::string();
  if (auto ok = sink_->writer().attach("run.json", "application/json", result); !ok) return pass_on(ok);
  if (auto ok = sink_->finish(); !ok) return pass_on(ok);
  return path_;
}

}  // namespace outrider
