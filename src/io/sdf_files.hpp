// Where the files that a world names are found.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace outrider {

struct SdfFolders {
  std::string beside;               ///< the folder of the naming file; may be empty
  std::vector<std::string> models;  ///< more folders for model://, in order
};

/// file://, model://, package:// or a plain path; nothing when there is no such file or folder.
std::optional<std::string> find_uri(std::string_view uri, const SdfFolders& folders);

/// The SDF file of an <include>: the file itself, or the one that a model folder's model.config names.
std::optional<std::string> find_model(std::string_view uri, const SdfFolders& folders);

}  // namespace outrider
