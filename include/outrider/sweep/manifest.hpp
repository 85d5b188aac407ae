// Manifest: what a sweep is made of, so that a worker or a resumption that would compute something else is
// refused.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "outrider/sweep/sweep.hpp"

namespace outrider {

struct Manifest {
  SweepRequest request;
  std::string job;
  std::string version;        ///< of the program
  std::string build;          ///< its build ID, which the linker gave it; empty if there is none
  std::string scenario_hash;  ///< SHA-256 of the file
  /// Files that the runs read, by their path from the folder of the scenario, and their SHA-256.
  std::vector<std::pair<std::string, std::string>> inputs = {};
  std::vector<std::pair<std::string, std::string>> mathematics = {};  ///< see canary.hpp
};

/// Describes the sweep as this process would compute it. Loads the first run, and one for each value of an
/// option that names a file, to know what they read. Faults: those of loading.
Outcome<Manifest> make_manifest(const Sweep& sweep, const std::string& version);

/// Returns it as JSON, with its end of line.
std::string manifest_text(const Manifest& manifest);

/// Reads the text. Fault: bad_input with `name`.
Outcome<Manifest> read_manifest(const std::string& text, const std::string& name);

/// Reads `manifest.json` in the folder of a sweep. Fault: bad_input with its path.
Outcome<Manifest> manifest_in(const std::string& folder);

/// Returns the path of the manifest in the folder of a sweep.
std::string manifest_path(const std::string& folder);

/// Returns the SHA-256 of the manifest without the path of the scenario, which each machine may have
/// elsewhere. Every chunk holds it.
std::string manifest_hash(Manifest manifest);

/// Refuses to continue `begun`, a sweep in the folder `where`, with what this process would compute. The
/// sentence names the first thing that differs.
Status check_same(const Manifest& begun, const Manifest& here, const std::string& where);

}  // namespace outrider
