#include "laser/laser_verdict.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "outrider/log/append.hpp"

namespace outrider {
namespace {

constexpr double least_matched = 0.9;  // share of the scans

/// Collects what speaks against a map.
class Doubts {
 public:
  Doubts(const std::vector<Pose2>& poses, const std::vector<double>& times_s)
      : poses_(poses), times_s_(times_s) {}

  /// Adds a place by the number of its pose.
  void add(const std::string& what, std::size_t pose, double share) {
    const Pose2& at = poses_[pose];
    table_.rows.push_back({what, time_s(pose), at.position.x, at.position.y, share});
  }
  void add_reason(const std::string& sentence) { reason_ += (reason_.empty() ? "" : "; ") + sentence; }

  /// Returns the time of a pose. The first pose is that before all scans.
  [[nodiscard]] double time_s(std::size_t pose) const { return times_s_[pose == 0 ? 0 : pose - 1]; }
  [[nodiscard]] const std::string& reason() const { return reason_; }
  [[nodiscard]] const Table& table() const { return table_; }

 private:
  const std::vector<Pose2>& poses_;
  const std::vector<double>& times_s_;
  Table table_{"doubts", {"what", "time_s", "x", "y", "share"}, {}};
  std::string reason_;
};

void doubt_matches(Doubts& doubts, const LaserRun& run) {
  const std::size_t to_match = run.steps - 1;  // the first scan has nothing to match
  if (static_cast<double>(run.matched) >= least_matched * static_cast<double>(to_match)) return;
  doubts.add_reason(fmt::format("only {} of {} scans matched the map", run.matched, to_match));
}

void doubt_gaps(Doubts& doubts, const std::vector<std::size_t>& gaps) {
  if (gaps.empty()) return;
  for (const std::size_t pose : gaps) doubts.add("gap", pose, std::numeric_limits<double>::quiet_NaN());
  doubts.add_reason(fmt::format(
      "{} scan{} matched nothing, the first at {:.1f} s, and odometry alone joins the map before and after",
      gaps.size(), gaps.size() == 1 ? "" : "s", doubts.time_s(gaps.front())));
}

void doubt_contradictions(Doubts& doubts, const MapCheck& check) {
  if (check.contradictions.empty()) return;
  for (const Contradiction& one : check.contradictions) doubts.add("contradiction", one.later, one.share);
  const Contradiction& first = check.contradictions.front();
  doubts.add_reason(fmt::format(
      "{} of {} scans contradict others, the first at {:.1f} s: where it hit something, the scan of {:.1f} s "
      "looked through, or the reverse",
      check.contradicted, check.scans, doubts.time_s(first.later), doubts.time_s(first.earlier)));
}

/// Forgets jumps that a pause alone makes, if the clock is wrong or the scans are always far apart.
void forget_usual_pauses(std::vector<Jump>& jumps, const LaserRun& run) {
  constexpr double unusual = 20.0;  // times the mean
  const double mean_s = run.log_s.value_or(0.0) / static_cast<double>(run.steps);
  std::erase_if(jumps, [&](const Jump& jump) {
    return jump.pause_s > 0.0 && (!run.log_s || jump.pause_s < unusual * mean_s);
  });
}

std::string motion_text(const Pose2& motion) {
  return fmt::format("{:.2f} m and {:.0f} degrees", norm(motion.position), degrees(motion.heading_rad));
}

void doubt_jumps(Doubts& doubts, const std::vector<Jump>& jumps) {
  if (jumps.empty()) return;
  for (const Jump& one : jumps) doubts.add("jump", one.after, one.shared);
  const Jump& first = jumps.front();
  std::string why;
  if (first.pause_s > 0.0) {
    why = fmt::format("after {:.0f} s without a scan ", first.pause_s);
  } else if (first.odometry_sd_m > 0.0) {
    why = fmt::format("on a way that odometry alone measures, to {:.2f} m, ", first.odometry_sd_m);
  }
  doubts.add_reason(fmt::format(
      "the path jumps {} at {:.1f} s: {}it moves by {}, odometry counted {}, and the scans before and "
      "after show only {:.0f} % of their surfaces in common",
      jumps.size() == 1 ? "once," : fmt::format("{} times, first", jumps.size()), doubts.time_s(first.after),
      why, motion_text(first.by_map), motion_text(first.by_odometry), 100.0 * first.shared));
}

void doubt_laser(Doubts& doubts, const LaserRun& run, const RangeCheck& ranges,
                 const OdometryRatio& odometry) {
  constexpr std::size_t most_repeated = 2;
  if (run.repeated > most_repeated) {
    doubts.add_reason(
        fmt::format("{} scans repeat the ranges of the one before exactly although the wheels moved; is the "
                    "laser frozen?",
                    run.repeated));
  }
  if (const std::string why = why_not_believed(ranges); !why.empty()) doubts.add_reason(why);
  if (const std::string why = why_not_believed(odometry); !why.empty()) doubts.add_reason(why);
}

void doubt_crossings(Doubts& doubts, const std::vector<std::size_t>& crossings) {
  if (crossings.empty()) return;
  for (const std::size_t pose : crossings)
    doubts.add("crossing", pose, std::numeric_limits<double>::quiet_NaN());
  doubts.add_reason(
      fmt::format("at {:.1f} s the path leads through what the map shows as occupied, {} of its steps in all",
                  doubts.time_s(crossings.front()), crossings.size()));
}

void log_doubts(Log& log, const Table& table, double end_s) {
  for (const auto& row : table.rows) {
    const TableRow doubt{table, row};
    log_event(log, end_s, "doubt",
              fmt::format("{} at {:.1f} s, x {:.2f} m, y {:.2f} m", doubt.text("what"),
                          doubt.number("time_s"), doubt.number("x"), doubt.number("y")));
  }
}

}  // namespace

void judge_mapping(Report& report, Log& log, const LaserRun& run, const std::vector<double>& times_s) {
  if (run.trusts_odometry || run.stopped) return;
  MapCheck check = run.slam.check();
  const RangeCheck ranges = run.slam.check_range_finder();
  const OdometryRatio odometry = run.slam.odometry_ratio();
  forget_usual_pauses(check.jumps, run);
  const std::vector<std::size_t> gaps = run.slam.gaps();
  const std::vector<Pose2> poses = run.slam.trajectory();
  Doubts doubts(poses, times_s);
  doubt_matches(doubts, run);
  doubt_gaps(doubts, gaps);
  doubt_contradictions(doubts, check);
  doubt_jumps(doubts, check.jumps);
  doubt_crossings(doubts, check.crossings);
  doubt_laser(doubts, run, ranges, odometry);
  report.metrics.emplace_back("gaps", static_cast<double>(gaps.size()));
  report.metrics.emplace_back("jumps", static_cast<double>(check.jumps.size()));
  report.metrics.emplace_back("walls_crossed", static_cast<double>(check.crossings.size()));
  report.metrics.emplace_back("loops_refused", static_cast<double>(run.slam.loops_refused()));
  report.metrics.emplace_back("loops_undone", static_cast<double>(run.slam.loops_undone()));
  report.metrics.emplace_back("scans_checked", static_cast<double>(check.scans));
  report.metrics.emplace_back("scans_contradicted", static_cast<double>(check.contradicted));
  report.metrics.emplace_back("range_bias_m", ranges.bias_m);
  report.metrics.emplace_back("way_ratio", odometry.ways.value);
  report.metrics.emplace_back("turn_ratio", odometry.turns.value);
  report.metrics.emplace_back("stray_share", ranges.stray_share());
  if (doubts.reason().empty()) return;
  report.status = "doubtful";
  report.reason = "the map may be wrong: " + doubts.reason();
  report.tables.push_back(doubts.table());
  log_doubts(log, doubts.table(), times_s.back());
}

}  // namespace outrider
