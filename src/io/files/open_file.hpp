// Opens files for reading. This is the only place that does so. confinement.hpp defines which files are
// allowed.
#pragma once

#include <cstdint>
#include <string>

#include "outrider/core/outcome.hpp"

namespace outrider {

/// Opens a file and returns its descriptor, which the caller closes. Refuses folders, missing files and files
/// without read permission; a confined process also refuses all but regular files beneath the root.
Outcome<int> open_file(const std::string& path);

/// Calls openat2 with these restrictions of the lookup; repeats it where folders were moved meanwhile.
/// Returns the descriptor; -1 and errno on failure.
int open_resolved(int root, const std::string& path, int flags, std::uint64_t resolve, unsigned mode = 0);

/// Returns the descriptor, or the fault if it is -1, with errno, or no readable file; it is closed then.
Outcome<int> checked(int descriptor, const std::string& path, bool regular_only);

/// Returns the content that supply_file() set for the path, or null.
const std::string* supplied_content(const std::string& path);

/// Notes that the file is read, for a ReadRecord.
void note_read(const std::string& path);

/// Returns true if confine_reading() was called.
bool reading_is_confined();

enum class FileKind { missing, forbidden, folder, other };

/// Returns the kind of file at a path; `forbidden` if it lies outside the confinement.
FileKind file_kind(const std::string& path);

}  // namespace outrider
