// Coverage: what a disk passes over on its way, measured from the way alone.
//
// A point is covered when the disk was over it, and covered twice when the disk came, left and came back:
// standing, turning and the joint of two legs count once. Both are computed leg by leg from capsules,
// without the plan that led to the way: for a way made of A and then B that meet in a point,
//     covered(AB) = covered(A) + covered(B)
//     twice(AB)   = twice(A) + twice(B) + covered(A) x covered(B) outside the disk about the meeting point,
// because a point in that disk is passed once more only if one of the two passes it twice by itself.
// The ends of capsules are chords that turn by 7.5 degrees, inside the true disk: nothing counts as
// covered that is not, and what is left out is at most 0.3 % of the disk at each end of the way.
#pragma once

#include <stop_token>

#include "outrider/jobs/cover/region.hpp"

namespace outrider {

struct Coverage {
  Region covered;  ///< within the area asked about, as the other two
  Region missed;
  Region overlap;
  double covered_m2 = 0.0;
  double missed_m2 = 0.0;
  double overlap_m2 = 0.0;
  double fraction = 0.0;  ///< covered part of the area asked about; 1 where that is empty
};

/// What a disk of the radius covers of `area` on the way through those points. O(n log^2 n) for ways that
/// cross themselves little. Once `stop` is raised it ends soon, and the answer is of no use.
Coverage coverage_of(const std::vector<Vec2>& way, double radius_m, const Region& area,
                     const std::stop_token& stop = {});

struct CoverageSums {
  double covered_m2 = 0.0;
  double overlap_m2 = 0.0;
};

/// The areas within `area` after each of the stretches, which go on where the one before ended and have a
/// point at least. They never shrink; the last are those of coverage_of() the whole way, but for the ends of
/// capsules. O(n log^2 n) where a stretch comes near few others. Once `stop` is raised it ends soon, and the
/// answer is of no use.
std::vector<CoverageSums> coverage_along(const std::vector<std::vector<Vec2>>& stretches, double radius_m,
                                         const Region& area, const std::stop_token& stop = {});

}  // namespace outrider
