// What the commands share in speaking: faults, JSON, folders and exit statuses.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "outrider/core/outcome.hpp"

namespace outrider::cli {

enum ExitStatus { job_done = 0, job_not_done = 1, refused = 2 };

/// Where the results of a command go.
struct Output {
  bool json = false;   ///< exactly one JSON object on standard output
  std::string folder;  ///< --out; empty: no files
};

/// Says the fault on standard error, and as JSON on standard output when asked; returns the exit status:
/// not done for an answer ("no_path"), refused for a request that was wrong.
int say(const Fault& fault, const Output& output);

/// Prints one JSON object on standard output.
void print(const nlohmann::ordered_json& object);

/// Makes the folder with its parents.
Status make_folder(const std::string& folder);

/// "1 min 21 s", "42.0 s", "0.31 s".
std::string duration_text(double seconds);

}  // namespace outrider::cli
