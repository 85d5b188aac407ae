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

/// Returns the last part of a path or an address.
std::string_view last_part(std::string_view uri);

/// Returns the SDF text of a model that every simulator has: a floor, or a light, which is nothing. Empty for
/// any other name.
std::string_view built_in_model(std::string_view uri);

/// Returns the parts of a list that are separated by ':', without empty ones.
std::vector<std::string> parts_of_path(std::string_view list);

/// Returns the folders of such a list, then those of GZ_SIM_RESOURCE_PATH and GAZEBO_MODEL_PATH.
std::vector<std::string> model_folders(std::string_view model_path);

/// Returns the SDF file of an <include>: the file itself, or the one named by model.config in a model folder.
std::optional<std::string> find_model(std::string_view uri, const SdfFolders& folders);

}  // namespace outrider
