// Which other files a scenario, a map or a world names.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "outrider/core/outcome.hpp"

namespace outrider::server {

struct NamedFile {
  std::string text;             ///< as it stands in the file
  std::filesystem::path place;  ///< from the folder of the file that names it
};

/// Of YAML (.yaml, .yml): each text that has a slash or is the path of something that exists. Of SDF (.sdf,
/// .world): each uri, with a model or package taken from every folder in which one is looked for. Nothing
/// of other files. Fault: bad_input on YAML that cannot be read, or with more than 100,000 values.
Outcome<std::vector<NamedFile>> files_named_in(const std::filesystem::path& file);

}  // namespace outrider::server
