// The state of one file of an SDF world during its repair, and the repair of its parts.
#pragma once

#include <fmt/format.h>

#include <map>
#include <set>
#include <string>
#include <string_view>

#include "outrider/core/outcome.hpp"
#include "outrider/geometry/pose.hpp"
#include "sdf_elements.hpp"
#include "sdf_files.hpp"
#include "sdf_repair.hpp"
#include "unique_names.hpp"

namespace outrider {

inline constexpr double newest_sdf_version = 1.9;

/// The state shared by all files of a world.
struct SdfSession {
  SdfWarnings& warnings;
  std::set<std::string, std::less<>> referenced;  // frames that are named by attributes
  std::size_t includes = 0;
  std::size_t bytes = 0;
  std::size_t tags = 0;
};

/// One file of a world.
struct SdfFile {
  SdfSession& session;
  std::string name;
  SdfFolders folders;
  double version = newest_sdf_version;
  int depth = 0;

  [[nodiscard]] std::string where(const SdfElement& element) const {
    return fmt::format("{}:{}", name, element.GetLineNum());
  }
  void warn(const SdfElement& element, const std::string& sentence) const {
    session.warnings.add(where(element), sentence);
  }
  void warn_missing(const SdfElement& element, const std::string& sentence) const {
    session.warnings.add_missing(where(element), sentence);
  }
};

/// Repairs a pose: three numbers get a rotation of zero. Refuses everything else that is not a pose.
Status repair_pose(const SdfFile& file, SdfElement& pose);

/// Checks the times of a saved state and collects the world poses of its models and links.
Status read_state(const SdfFile& file, SdfElement& state, std::map<std::string, Pose3>& stated);

/// Removes all shapes of a collision but one, and finds the file of a mesh. Returns true if the collision is
/// kept. `path` names it in warnings.
bool repair_geometry(const SdfFile& file, SdfElement& collision, const std::string& path);

/// Makes the name of a frame or a collision unique among its siblings, without "::".
void repair_name(const SdfFile& file, SdfElement& element, UniqueNames& taken);

}  // namespace outrider
