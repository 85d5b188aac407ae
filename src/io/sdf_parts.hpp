// One file of an SDF world while it is repaired, and the repair of its single parts.
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

/// What all files of one world share.
struct SdfSession {
  SdfWarnings& warnings;
  std::set<std::string, std::less<>> referenced;  // frames named by an attribute anywhere
  std::size_t includes = 0;
  std::size_t bytes = 0;
  std::size_t tags = 0;
};

/// One file of it.
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
};

/// Refuses what is no pose; three numbers get a rotation of zero.
Status repair_pose(const SdfFile& file, SdfElement& pose);

/// Checks the times of a saved state and collects the world poses of its models and links.
Status read_state(const SdfFile& file, SdfElement& state, std::map<std::string, Pose3>& stated);

/// Leaves one shape in a collision, and finds the file of a mesh. True when the collision stays; `path`
/// names it in warnings.
bool repair_geometry(const SdfFile& file, SdfElement& collision, const std::string& path);

/// Makes the name of a frame or a collision unique among its siblings, and free of "::".
void repair_name(const SdfFile& file, SdfElement& element, UniqueNames& taken);

}  // namespace outrider
