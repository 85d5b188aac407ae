// One mission of Runs. Only runs.cpp and run_files.cpp include this file.
#pragma once

#include <cstdint>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "runs/kept_runs.hpp"
#include "runs/runs.hpp"

namespace outrider::server {

struct Runs::Run {
  std::string id;
  std::string scenario;                 // as the user named it
  std::string text;                     // the scenario to run
  bool unsaved = false;                 // the text came with the request
  std::optional<OpenFolder> home = {};  // the folder of its folder
  std::optional<OpenFolder> out = {};   // nothing if it has none any more
  std::string job;
  std::optional<std::int64_t> seed;
  std::int64_t began_s = 0;  // Unix time at which it was asked for
  std::chrono::steady_clock::time_point asked;
  std::optional<double> took_s;
  std::string state = "queued";
  Fault fault{FaultCode::bad_input, {}, {}};
  Json progress;
  Json summary;
  bool has_log = false;
  bool has_result = false;
  std::stop_source stop;
  std::vector<std::shared_ptr<const std::string>>
      messages;                                // the first has number 1; null: replaced by a newer one
  std::optional<std::size_t> newest_progress;  // its index in `messages`
  std::shared_ptr<GrowingLog> live_log;
  bool live_log_gone = false;
  FileLock lock;  // of `out`, until the run has ended

  [[nodiscard]] bool ended() const { return state != "queued" && state != "running"; }
  [[nodiscard]] Json json() const {
    return {{"id", id},
            {"state", state},
            {"scenario", scenario},
            {"job", job},
            {"seed", seed ? Json(*seed) : Json()},
            {"began_s", began_s},
            {"took_s", took_s ? Json(*took_s) : Json()},
            {"progress", progress},
            {"seq", messages.size()},
            {"error", fault.sentence},
            {"where", fault.where},
            {"has_log", has_log},
            {"has_result", has_result},
            {"summary", summary}};
  }
  /// Returns what state.json holds of a run with that state.
  [[nodiscard]] KeptRun kept(const std::string& now) const {
    return {id, scenario, job, seed, now, fault.sentence, fault.where, began_s, took_s, summary};
  }
};

/// Returns the refusal of a request about a run that does not exist.
inline Response no_such_run(const std::string& id) {
  return not_found("there is no such run; the server keeps the newest 32", id.substr(0, 64));
}

}  // namespace outrider::server
