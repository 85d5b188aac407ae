// One mission of Runs. Only runs.cpp and run_files.cpp include this file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "runs.hpp"

namespace outrider::server {

struct Runs::Run {
  std::string id;
  std::string scenario;  // as the user named it
  std::string text;      // the scenario to run
  bool unsaved = false;  // the text came with the request
  std::filesystem::path out;
  std::string job;
  std::optional<std::int64_t> seed;
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

  [[nodiscard]] bool ended() const { return state != "queued" && state != "running"; }
  [[nodiscard]] Json json() const {
    return {{"id", id},
            {"state", state},
            {"scenario", scenario},
            {"job", job},
            {"seed", seed ? Json(*seed) : Json()},
            {"progress", progress},
            {"seq", messages.size()},
            {"error", fault.sentence},
            {"where", fault.where},
            {"has_log", has_log},
            {"has_result", has_result},
            {"summary", summary}};
  }
};

/// Returns the refusal of a request about a run that does not exist.
inline Response no_such_run(const std::string& id) {
  return not_found("there is no such run; the server keeps the newest 32", id.substr(0, 64));
}

}  // namespace outrider::server
