#include "outrider/jobs/cover/bounds/time_bound.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "outrider/core/units.hpp"

namespace outrider {
namespace {

/// The report's robot: no ramps, just speeds.
Pace report_pace() {
  Pace pace;
  pace.speed_mps = 0.15;
  pace.slowest_speed_mps = 0.09;
  pace.turn_rate_radps = 2.449;
  pace.slowest_turn_rate_radps = 0.7347;
  pace.acceleration_mps2 = std::numeric_limits<double>::infinity();
  pace.turn_acceleration_radps2 = std::numeric_limits<double>::infinity();
  pace.pause_s = 1.0;
  return pace;
}

/// Squares one in the other, each begun with a quarter turn and reached by legs along its own sides.
CoverTrack squares(double edge_m, double stride_m, int count) {
  CoverTrack track;
  for (int i = 0; i < count; ++i) {
    const double low = i * stride_m, high = edge_m - low;
    const Vec2 corners[] = {{low, low}, {high, low}, {high, high}, {low, high}, {low, low}};
    for (int k = 0; k < 4; ++k) track.pieces.push_back({corners[k], corners[k + 1], {}, 0.0});
  }
  return track;
}

TEST(TimeBound, LengthOfSquaresIsTheSumOfTheirEdges) {
  for (int count = 1; count < 6; ++count) {
    double sum = 0.0;
    for (int i = 0; i < count; ++i) sum += 4.0 * (1.5 - 2.0 * i * 0.1);
    EXPECT_NEAR(squares_length_m(1.5, 0.1, count), sum, 1e-12);
    EXPECT_NEAR(sums_of(0.0, squares(1.5, 0.1, count).pieces, report_pace()).length_m, sum, 1e-12);
  }
}

/// The report's example with the factor of 4 that its formula drops: an edge of 1.5 m, strips of 0.2 m that
/// cover 110 %, so a stride of 0.2 / 1.1 m and four squares.
TEST(TimeBound, TheReportsExample) {
  const double stride = 0.2 / 1.1;
  const int count = 4;
  EXPECT_GT(1.5 - 2.0 * (count - 1) * stride, 2.0 * stride);  // of the fourth there is more than a strip
  const double length = squares_length_m(1.5, stride, count);
  EXPECT_NEAR(length, 15.2727, 1e-4);
  const CoverTrack track = squares(1.5, stride, count);
  const TrackSums sums = sums_of(0.0, track.pieces, report_pace());
  EXPECT_EQ(sums.stops, 15U);  // sixteen corners, of which the first needs no turn
  EXPECT_NEAR(sums.turned_rad, 15.0 * 0.5 * pi, 1e-12);
  const TimeBound bound = time_bound(track, report_pace(), 0.0, 2.0);
  EXPECT_NEAR(bound.least_s, length / 0.15 + 7.5 * pi / 2.449 + 15.0, 1e-9);
  EXPECT_NEAR(bound.most_s, 2.0 * (length / 0.09 + 7.5 * pi / 0.7347) + 15.0, 1e-9);
  EXPECT_NEAR(bound.least_s, 126.44, 0.01);
  EXPECT_NEAR(bound.most_s, 418.53, 0.01);
}

TEST(TimeBound, GrowsWithTheTrackingError) {
  const CoverTrack track = squares(1.5, 0.18, 4);
  const Pace pace;
  TimeBound before = time_bound(track, pace, 0.0, 1.0);
  EXPECT_NEAR(before.least_s, sums_of(0.0, track.pieces, pace).time_s, 1e-9);
  EXPECT_NEAR(before.most_s, sums_of(0.0, track.pieces, pace.slow()).time_s, 1e-9);
  for (const double tracking_error_m : {0.001, 0.01, 0.1, 1.0}) {
    const TimeBound bound = time_bound(track, pace, tracking_error_m, 1.0);
    EXPECT_LT(bound.least_s, before.least_s);
    EXPECT_GT(bound.most_s, before.most_s);
    before = bound;
  }
  EXPECT_GE(before.least_s, 15.0 * pace.pause_s);
}

TEST(TimeBound, ArcsAreDrivenNoFasterThanTheBodyTurns) {
  Pace pace = report_pace();
  pace.turn_rate_radps = 0.5;
  const PathPiece arc{{0.1, 0.0}, {0.0, 0.1}, {0.0, 0.0}, 0.5 * pi};
  EXPECT_NEAR(sums_of(0.5 * pi, {arc}, pace).time_s, pi, 1e-9);
  EXPECT_EQ(sums_of(0.5 * pi, {arc}, pace).stops, 0U);
  EXPECT_NEAR(heading_out(arc), pi, 1e-12);
  EXPECT_NEAR(heading_in(reversed(arc)), 0.0, 1e-12);
}

}  // namespace
}  // namespace outrider
