// Compares the followers of drives on random courses.
#pragma once

#include <vector>

#include "outrider/jobs/drive/scenario.hpp"
#include "rows.hpp"

namespace outrider::bench {

/// The courses with one follower.
struct FollowerRow {
  std::string follower;
  int runs = 0, done = 0, doubtful = 0, lost = 0, touched = 0, missed = 0;
  int stops = 0, reached = 0;
  int false_reached = 0;              ///< stops called reached that were off by more than the tolerance
  std::vector<double> times;          ///< over the ideal time, of the courses that every follower finished
  std::vector<double> stop_errors_m;  ///< at stops called reached
  std::vector<double> deviations_m;  ///< of each course: largest distance of the robot from the straight legs
  std::vector<double> margins;       ///< of each course: least clearance less radius, over that of the legs
};

/// Drives `courses` random courses with each follower: three to six waypoints between posts in a walled
/// square with tags, a third of them passed by; mecanum, omnidirectional and differential robots in turn.
/// Faults, link and the options are those of `setup`.
std::vector<FollowerRow> compare_followers(const DriveSetup& setup, const std::vector<std::string>& followers,
                                           std::int64_t courses, const BenchObserver& observer);

nlohmann::ordered_json row_json(const FollowerRow& row);
std::string table_text(const std::vector<FollowerRow>& rows);

}  // namespace outrider::bench
