// Coverage: the area that a disk passes over along a path, measured from the path alone.
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
#pragma once

#include <stop_token>

#include "outrider/jobs/cover/region.hpp"

namespace outrider {

/// What a path covers of an area.
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

  /// Adds a section of at least one point, which begins where the one before ends. Returns the areas covered
  /// until then. O(n log^2 n) if the section is near few others.
  CoverageSums add(const std::vector<Vec2>& way);

 private:
  /// What one section covers by itself, and which part of that was passed over more than once by then.
  struct Section {
    Region covered;
    Region overlap;
    Box2 box;
  };
  [[nodiscard]] Region known_of(const Region& region, const Box2& box, Region Section::* part) const;

  double radius_m_;
  const Region& area_;
  std::vector<Section> before_;
  CoverageSums sums_;
};

}  // namespace outrider
