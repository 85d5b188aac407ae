#include "temporary_folder.hpp"

#include <stdlib.h>  // mkdtemp

namespace outrider::server {

namespace fs = std::filesystem;

Outcome<TemporaryFolder> TemporaryFolder::make() {
  std::error_code error;
  std::string name = (fs::temp_directory_path(error) / "outrider-serve-XXXXXX").string();
  if (error || ::mkdtemp(name.data()) == nullptr) {
    return bad_input("there is no place for temporary files; set TMPDIR to a folder that can be written to",
                     "TMPDIR");
  }
  return TemporaryFolder(fs::canonical(name));
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  if (!path_.empty()) fs::remove_all(path_, ignored);
}

}  // namespace outrider::server
