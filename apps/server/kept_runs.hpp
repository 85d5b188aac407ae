// Runs on the disk: each has a folder below DIR/.outrider/runs, with its log, its result and state.json.
//
// state.json is written when a run is asked for and again when it has ended, through a temporary name. While
// the run is under way its folder is locked. So a server that starts can tell a run that was cut short, since
// its server died, from one that another server carries out now. Links on the way to the runs are not
// followed. If the folder cannot be written, runs are kept in a temporary folder until the server ends.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "fields.hpp"
#include "outrider/io/file_lock.hpp"
#include "temporary_folder.hpp"

namespace outrider::server {

/// What state.json holds of a run.
struct KeptRun {
  std::string id;
  std::string scenario;  ///< as the user named it
  std::string job;
  std::optional<std::int64_t> seed;
  std::string state;
  std::string error;
  std::string where;
  std::int64_t began_s = 0;      ///< Unix time at which it was asked for
  std::optional<double> took_s;  ///< from then until its end
  Json summary;                  ///< what the mission printed; null if nothing
};

/// Returns the state as JSON, and reads it. Fault: bad_input, if it is no state of a run.
Json state_json(const KeptRun& run);
Outcome<KeptRun> kept_run_from_json(const Json& state);

class RunsFolder {
 public:
  /// Chooses DIR/.outrider/runs, or a temporary folder if that cannot be written. Creates it. Fault:
  /// bad_input if neither can be made.
  static Outcome<RunsFolder> open(const std::filesystem::path& served);
  /// Returns the runs below DIR/.outrider/runs that no server carries out now, the oldest first. The state of
  /// one that was under way is `cut_short` then, in its file too.
  static std::vector<KeptRun> find(const std::filesystem::path& served);
  /// Locks a run's folder against other servers, by a file in it. The mission itself locks the folder while
  /// it renames its files. The lock is empty if another server carries the run out. Fault: cannot_write.
  static Outcome<FileLock> lock(const std::filesystem::path& run);

  /// Returns the folder of a run.
  [[nodiscard]] static std::filesystem::path place(const std::filesystem::path& served,
                                                   const std::string& id);
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  /// Returns why the runs are not kept, in one sentence; empty if they are.
  [[nodiscard]] const std::string& notice() const { return notice_; }

 private:
  std::filesystem::path path_;
  std::string notice_;
  std::optional<TemporaryFolder> temporary_;
};

/// Writes state.json of a run into its folder.
Status write_state(const std::filesystem::path& folder, const KeptRun& run);

}  // namespace outrider::server
