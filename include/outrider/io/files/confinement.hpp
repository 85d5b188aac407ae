// Confinement: limits the files that this process can read to one folder.
//
// A scenario names a world, the world includes models, and a model names meshes. A program that runs
// untrusted scenarios cannot tell beforehand which files that will open. It therefore confines itself before
// it reads the first one. The kernel then authorises every file when it is opened (openat2 with
// RESOLVE_BENEATH: no "..", no absolute path and no link can lead outside). All of Outrider reads through
// read_file() (files.hpp); tests/architecture checks that.
//
// confine_reading() and supply_file() change the whole process and cannot be undone. Thread rule: call them
// before the first file is read and before other threads start. open_folder.hpp confines what is written.
#pragma once

#include <string>

#include "outrider/core/outcome.hpp"

namespace outrider {

/// Limits reading to regular files beneath `root`, and makes `root` the working directory. Relative paths
/// start there; absolute paths must begin with `root` as given, or with the working directory if that is a
/// relative path. From then on files are written without following a link of their name. Device files and
/// pipes are refused, so that no call can block. Faults: bad_input if `root` is not a folder, if the process
/// is already confined, or if the system has no openat2 (Linux before 5.6).
Status confine_reading(const std::string& root);

/// Makes read_file(path) return `content` from now on, whether or not the file exists. `path` is compared as
/// text.
void supply_file(const std::string& path, std::string content);

}  // namespace outrider
