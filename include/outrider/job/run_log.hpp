// RunLog: the log of a run, written to its folder while the run goes on.
//
// Until the run has ended the file is called running.mcap. It opens up to its last complete chunk at any
// moment, also after the program was killed. write_run() gives it its name, together with the other files of
// the run.
#pragma once

#include <cstdint>
#include <filesystem>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

#include "outrider/io/files/file_lock.hpp"
#include "outrider/log/mcap/mcap_sink.hpp"

namespace outrider {

class RunLog final : public LogSink {
 public:
  /// The folder is made with the first message. The log holds the text of the scenario.
  RunLog(std::string folder, std::string scenario)
      : folder_(std::move(folder)), scenario_(std::move(scenario)) {}
  /// Removes the file unless it was renamed, and the folders that it has made if they are empty.
  ~RunLog() override;

  void add_channel(const Channel& channel) override;
  void append(std::size_t channel, std::int64_t time_ns, std::string_view data) override;

  /// Completes the file, with the text of run.json in it, and returns its path; empty if there was no
  /// message. Fault: cannot_write, for instance because the disk is full.
  Outcome<std::string> finish(const std::string& result);
  /// Removes from another thread what the destructor would; the process must end then.
  void abandon();
  /// Leaves the file to others, once it has been renamed.
  void release() {
    path_.clear();
    made_.clear();
  }

 private:
  Status begin_file();
  void remove() const;
  /// Makes and locks a file that no other run writes to.
  Status lock_file();

  std::string folder_;
  std::string scenario_;
  std::mutex beginning_;  ///< for abandon(), which does not wait for anything longer
  std::string path_;
  FileLock lock_;
  std::filesystem::path made_;  ///< the topmost folder that it made
  Status status_;
  std::optional<McapSink> sink_;
};

}  // namespace outrider
