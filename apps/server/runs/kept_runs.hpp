// Runs on the disk: each has a folder below DIR/.outrider/runs, with its log, its result and state.json.
//
// state.json is written when a run is asked for and again when it has ended, through a temporary name. While
// the run is under way its folder is locked. So a server that starts can tell a run that was cut short, since
// its server died, from one that another server carries out now. All files are reached through open folders
// (open_folder.hpp), and no link is followed. If the folder cannot be written, runs are kept in a temporary
// folder until the server ends.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "fields.hpp"
#include "files/reading.hpp"
#include "files/temporary_folder.hpp"
#include "outrider/io/files/file_lock.hpp"
#include "outrider/io/files/open_folder.hpp"

namespace outrider::server {

/// The content of state.json of a run.
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

/// Returns state.json of the run with that id, or null if there is none that is as a server writes it. Call
/// it in the reader process (reading.hpp).
Json kept_state(const std::string& id, const Folder& served);

class RunsFolder {
 public:
  /// Chooses DIR/.outrider/runs, or a temporary folder if that cannot be written. Creates it. Fault:
  /// bad_input if neither can be made.
  static Outcome<RunsFolder> open(const OpenFolder& served);
  /// Returns the runs below DIR/.outrider/runs that no server carries out now, the oldest first, at most the
  /// newest 200. The state of one that was under way is `cut_short` then, in its file too.
  static std::vector<KeptRun> find(const Folder& served, const ReadFiles& read);
  /// Opens DIR/.outrider/runs. Fault: bad_input if there is no such folder.
  static Outcome<OpenFolder> below(const OpenFolder& served) { return served.folder(".outrider/runs"); }
  /// Locks a run's folder against other servers, by a file in it. The mission itself locks the folder while
  /// it renames its files. The lock is empty if another server carries the run out. Fault: cannot_write.
  static Outcome<FileLock> lock(const OpenFolder& run) { return FileLock::take(".lock", run.descriptor()); }

  [[nodiscard]] const OpenFolder& gate() const { return gate_; }
  /// Returns why the runs are not kept, in one sentence; empty if they are.
  [[nodiscard]] const std::string& notice() const { return notice_; }

 private:
  RunsFolder(OpenFolder gate, std::string notice) : gate_(std::move(gate)), notice_(std::move(notice)) {}
  OpenFolder gate_;
  std::string notice_;
  std::optional<TemporaryFolder> temporary_;
};

/// Writes state.json of a run into its folder.
Status write_state(const OpenFolder& folder, const KeptRun& run);

}  // namespace outrider::server
