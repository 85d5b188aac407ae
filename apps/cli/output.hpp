// What the commands share in speaking: faults, JSON, folders and exit statuses.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>
#include <vector>

#include "outrider/core/outcome.hpp"

namespace outrider::cli {

enum ExitStatus { job_done = 0, job_not_done = 1, refused = 2, not_written = 3 };

/// True when the fault is an answer to a request that was right ("no_path"): the job was not done.
bool is_answer(const Fault& fault);

/// What the tool ends with: 1 for an answer, 3 when the system failed to write, else 2.
ExitStatus exit_status(const Fault& fault);

/// {"status", "code", "reason", "where"}; status is "not_done", "refused" or "not_written", by exit_status().
nlohmann::ordered_json fault_json(const Fault& fault);

/// Says the fault on standard error, and with `json` as one object on standard output; returns the exit
/// status.
int print_fault(const Fault& fault, bool json);

/// Refuses `flag`, which asks for a page, where the tool was built without one.
Status check_page(std::string flag);

/// The object as text; each byte that is no UTF-8, as names of files may have, becomes U+FFFD.
std::string json_text(const nlohmann::ordered_json& object, int indent = -1);

/// Prints one JSON object on standard output.
void print(const nlohmann::ordered_json& object);

/// Refuses a folder that make_folder() would. Touches nothing.
Status check_folder(const std::string& folder);

/// Makes the folder with its parents.
Status make_folder(const std::string& folder);

/// A name and what is written under it.
using NamedText = std::pair<std::string, std::string>;

/// Makes the folder, then the files in it: all of them or none (files.hpp). The first takes its name last, so
/// put the report first: a report that is there has its pictures beside it.
Status write_files(const std::string& folder, const std::vector<NamedText>& files);

}  // namespace outrider::cli
