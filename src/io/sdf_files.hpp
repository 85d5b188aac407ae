// Finds the files that a world names.
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

/// Resolves file://, model://, package:// or a plain path. Returns nothing if there is no such file or
/// folder.
std::optional<std::string> find_uri(std::string_view uri, const SdfFolders& folders);

/// Returns the SDF file of an <include>: the file itself, or the one named by model.config in a model folder.
std::optional<std::string> find_model(std::string_view uri, const SdfFolders& folders);

}  // namespace outrider
