// AprilTags: maps of tags, and sightings by a camera.
//
// Frame of a tag: the origin is its centre; for a reader of the tag, x points right, y down and z into the
// wall. The corners are those of the measured square, whose side is the size of the tag (tag_family.hpp says
// which square that is; the black one of tag36h11), in the order of libapriltag: lower left, lower right,
// upper right, upper left.
// Source: Olson, AprilTag: A robust and flexible visual fiducial system (ICRA 2011); Wang and Olson,
// AprilTag 2 (IROS 2016).
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "outrider/core/outcome.hpp"
#include "outrider/estimate/tag_family.hpp"
#include "outrider/geometry/pose.hpp"

namespace outrider {

inline constexpr double default_tag_size_m = 0.166;

struct Tag {
  int id = 0;
  double size_m = default_tag_size_m;  ///< side of the measured square
  Pose3 world_T_tag;
};

/// The tags in the world, all of one family; each id occurs once.
struct TagMap {
  std::vector<Tag> tags;
  TagFamily family = TagFamily::tag36h11;

  [[nodiscard]] const Tag* find(int id) const;
};

/// Checks a map. Faults: duplicate ids, ids outside the family, and sizes that are not positive.
Status check_tags(const TagMap& map);

/// Makes an upright tag with its centre at `position` (m). `facing_rad` is the heading from the wall to the
/// reader.
Tag upright_tag(int id, Vec3 position, double facing_rad, double size_m = default_tag_size_m);

/// Returns the corners in the frame of the tag, m.
std::array<Vec3, 4> tag_corners(double size_m);

/// A possible pose of a tag: a local minimum of the reprojection error of its corners.
struct TagPose {
  Pose3 camera_T_tag;
  double error_px = 0.0;  ///< root mean square over the corners, after refinement
  /// Covariance of the translation (m) and the rotation vector (rad), both in the camera frame.
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();
  double probability = 1.0;  ///< that this is the true one of the poses of the tag
};

/// A detection of one tag in an image.
struct TagSighting {
  int id = 0;
  std::array<Vec2, 4> corners_px;  ///< in the image (see Camera), in the order of tag_corners()
  int corrected_bits = 0;          ///< number of corrected bits
  double margin = 0.0;             ///< mean difference of a bit to the decision threshold, grey levels
  std::vector<TagPose> poses;      ///< one or two, the smallest error first; see planar_pnp.hpp
  TagFamily family = TagFamily::tag36h11;
};

}  // namespace outrider
