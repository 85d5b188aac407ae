// The one place where files are opened for reading. confinement.hpp says which may be.
#pragma once

#include <string>

#include "outrider/core/outcome.hpp"

namespace outrider {

/// A descriptor of a file that can be read; the caller closes it. Refuses folders, files that are missing
/// or may not be read, and in a confined process whatever is not a regular file beneath the root.
Outcome<int> open_file(const std::string& path);

/// The content that supply_file() set for the path, or null.
const std::string* supplied_content(const std::string& path);

enum class FileKind { missing, forbidden, folder, other };

/// What lies at a path. `forbidden`: the confinement does not let us look.
FileKind file_kind(const std::string& path);

}  // namespace outrider
