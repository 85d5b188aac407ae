// Coverage: the area that a disk or a bar passes over along a path, measured from the path alone.
//
// A point is covered if the disk was over it. It belongs to the overlap if the disk came, left and came back;
// standing, turning and the joint of two legs do not count again. Both are computed leg by leg from capsules,
// without the plan behind the path. For a path that consists of A and then B, which meet in a point,
//     covered(AB) = covered(A) + covered(B)
//     overlap(AB) = overlap(A) + overlap(B) + covered(A) x covered(B) outside the disk about the meeting
//     point,
// because a point in that disk is passed again only if A or B passes it more than once.
// The ends of capsules are chords that turn by 7.5 degrees, inside the true disk. So nothing counts as
// covered that is not, and the error is at most 0.3 % of the disk at each end of the path.
//
// A bar is a rectangle that is fixed to the robot, as a mower deck or a spray boom. The area that it covers
// depends on the headings, so its paths are poses. Between two poses of one heading the robot moves straight;
// between others it rotates about one centre by the difference of the headings, as in a turn in place or
// along an arc. Straight sweeps are exact. Sweeps of rotations consist of steps of 2 degrees, each inside the
// true sweep; so for a bar, too, nothing counts as covered that is not.
#pragma once

#include <stop_token>

#include "outrider/geometry/pose.hpp"
#include "outrider/jobs/cover/ground/region.hpp"

namespace outrider {

/// A rectangle that is fixed to the robot.
struct Bar {
  double width_m = 0.0;    ///< across the heading
  double length_m = 0.0;   ///< along the heading
  double forward_m = 0.0;  ///< from the robot's reference point ahead to the middle of the bar

  /// Returns the radius of the smallest disk about the reference point that contains the bar.
  [[nodiscard]] double reach_m() const;
};

/// The coverage of an area by a path.
struct Coverage {
  Region covered;  ///< part of the area that was covered
  Region missed;   ///< part of the area that was not covered
  Region overlap;  ///< part of the area that was covered more than once
  double covered_m2 = 0.0;
  double missed_m2 = 0.0;
  double overlap_m2 = 0.0;
  double fraction = 0.0;  ///< covered fraction of the area; 1 if the area is empty
};

/// Returns what a disk of the radius covers of `area` along the path through those points. O(n log^2 n) for
/// paths that cross themselves little. Ends soon after `stop` is requested; the result is then meaningless.
Coverage coverage_of(const std::vector<Vec2>& way, double radius_m, const Region& area,
                     const std::stop_token& stop = {});

/// The same of a bar. The headings of poses differ by the angle that the robot really turns: they are not
/// wrapped.
Coverage coverage_of(const std::vector<Pose2>& poses, const Bar& bar, const Region& area,
                     const std::stop_token& stop = {});

/// The areas that were covered until some time, m2.
struct CoverageSums {
  double covered_m2 = 0.0;
  double overlap_m2 = 0.0;
};

/// Measures the areas covered within an area while a path grows. The areas never shrink, and the last ones
/// are those of coverage_of() for the whole path, except for the ends of capsules. Thread rule: one at a
/// time.
class GrowingCoverage {
 public:
  /// A disk of the radius passes over `area`, which must outlive this object.
  GrowingCoverage(double radius_m, const Region& area) : radius_m_(radius_m), area_(area) {}
  /// A bar passes over `area`, which must outlive this object.
  GrowingCoverage(const Bar& bar, const Region& area) : bar_(bar), area_(area) {}

  /// Adds a section of at least one point of the way of a disk, which begins where the one before ends.
  /// Returns the areas covered until then. O(n log^2 n) if the section is near few others.
  CoverageSums add(const std::vector<Vec2>& way);
  /// Adds a section of at least one pose of a bar.
  CoverageSums add(const std::vector<Pose2>& poses);

 private:
  /// The region that one section covers by itself, and the part of it that was passed over more than once by
  /// then.
  struct Section {
    Region covered;
    Region overlap;
    Box2 box;
  };
  [[nodiscard]] Region known_of(const Region& region, const Box2& box, Region Section::* part) const;
  CoverageSums add(Region covered, std::vector<Region> overlap, const Region& joint);

  double radius_m_ = 0.0;
  Bar bar_;
  const Region& area_;
  std::vector<Section> before_;
  CoverageSums sums_;
};

}  // namespace outrider
