// Finds the points that do not lie on the line of the others.
//
// A robust line (Theil and Sen: the median of the slopes of all pairs) starts the search. Then each point is
// compared with the least-squares line of the points that fit, without itself: its distance from it in
// standard deviations of the prediction follows Student's t, and does not fit beyond the quantile that one in
// a million normal points exceeds. This is repeated until nothing changes. Fewer than 8 points tell too
// little: all of them fit. O(n^2) per round. Sources: Theil (1950); Sen, Estimates of the regression
// coefficient based on Kendall's tau (1968); Cook and Weisberg, Residuals and influence in regression (1982),
// section 2.2.2.
#pragma once

#include <vector>

#include "outrider/geometry/vec.hpp"

namespace outrider {

/// The verdict on a point.
struct LineFit {
  bool fits = true;
  double off = 0.0;  ///< y minus that of the line of the others
};

/// Returns the verdict on each point (x, y). Differences in y below `exact` never count.
std::vector<LineFit> fit_to_line(const std::vector<Vec2>& points, double exact);

}  // namespace outrider
