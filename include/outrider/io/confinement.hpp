// What this process may read: everything, or only the files beneath one folder.
//
// A scenario names a world, the world includes models, a model names meshes. A program that runs scenarios
// of strangers cannot tell beforehand which files that will open, so it does not try: it confines itself
// before it reads the first one, and every file is then authorised by the kernel when it is opened
// (openat2 with RESOLVE_BENEATH: no "..", no absolute path and no link leads out, whatever names them).
// All of Outrider reads through read_file() (files.hpp); tests/architecture holds the rest to it.
//
// confine_reading() and supply_file() change the whole process and cannot be undone. Thread rule: call them
// before the first file is read and before other threads start; open_beneath() at any time.
#pragma once

#include <string>

#include "outrider/core/outcome.hpp"

namespace outrider {

/// From now on only regular files beneath `root` can be read, and the process works in `root`. A relative
/// path starts there, an absolute one must begin with `root` as it was given. Device files and pipes are
/// refused, so that nothing can block. Faults: bad_input when `root` is no folder, when the process is
/// confined already, or when the system has no openat2 (Linux before 5.6).
Status confine_reading(const std::string& root);

/// A descriptor of the regular file at `path` beneath the open folder `folder`, wherever names and links
/// lead; the caller closes it. Never blocks. Faults: as those of read_file(), and bad_input for a path that
/// leads out.
Outcome<int> open_beneath(int folder, const std::string& path);

/// From now on read_file(path) gives `content`, whatever lies there; `path` must be spelled the same.
void supply_file(const std::string& path, std::string content);

}  // namespace outrider
