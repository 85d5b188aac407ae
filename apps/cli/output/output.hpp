// Output shared by the commands: faults, JSON, folders and exit statuses.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>
#include <vector>

#include "outrider/core/outcome.hpp"
#include "outrider/io/files/files.hpp"

namespace outrider::cli {

enum ExitStatus { job_done = 0, job_not_done = 1, refused = 2, not_written = 3 };

/// Returns the exit status of the tool: 1 for an answer, 3 if the system failed to write, else 2.
ExitStatus exit_status(const Fault& fault);

/// Returns {"status", "code", "reason", "where"}; status is "not_done", "refused" or "not_written", by
/// exit_status().
nlohmann::ordered_json fault_json(const Fault& fault);

/// Prints the fault on standard error, and with `json` as one object on standard output. Returns the exit
/// status.
int print_fault(const Fault& fault, bool json);

/// Refuses `flag`, which asks for a page, if the tool was built without one.
Status check_page(std::string flag);

/// Returns the object as text. Replaces each byte that is not valid UTF-8, as file names may have, by U+FFFD.
std::string json_text(const nlohmann::ordered_json& object, int indent = -1);

/// Prints one JSON object on standard output.
void print(const nlohmann::ordered_json& object);

/// Names the flag --out in a fault that names nothing.
Status of_flag_out(Status status);

/// Pairs a file name with its content.
using NamedText = std::pair<std::string, std::string>;

/// Creates the folder, then the files in it: all of them or none (files.hpp). The first file gets its name
/// last, so put the report first: if the report exists, so do its pictures.
Status write_files(const std::string& folder, const std::vector<NamedText>& files);

}  // namespace outrider::cli
