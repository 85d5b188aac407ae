#include <limits>
#include <optional>

#include "faults/spoil_parts.hpp"
#include "slam_log.hpp"

namespace outrider {
namespace {

/// A step of the log with its pose on the map of the log, if there is one.
struct PlacedStep {
  LaserLogStep step;
  std::optional<Pose2> reference;
};

std::vector<double> times_of(const std::vector<PlacedStep>& steps) {
  std::vector<double> recorded_s;
  for (const PlacedStep& placed : steps) recorded_s.push_back(placed.step.scan.time_s);
  return run_times(recorded_s);
}

class LaserSpoiler {
 public:
  LaserSpoiler(const LaserLog& log, const RecordingFaults& faults, const Rng& rng)
      : faults_(faults), outliers_(rng.child("outliers")), missed_(rng.child("missed")) {
    for (std::size_t i = 0; i < log.steps.size(); ++i) {
      const bool is_placed = i < log.reference.size();
      steps_.push_back({log.steps[i], is_placed ? std::optional(log.reference[i]) : std::nullopt});
    }
    out_.recording.robot_T_laser = log.robot_T_laser;
    out_.changes = cut_out(steps_, times_of(steps_), faults_,
                           [](PlacedStep& placed) -> double& { return placed.step.scan.time_s; });
    times_s_ = times_of(steps_);
  }

  Spoiled<LaserLog> run() {
    std::vector<std::vector<float>> measured;
    for (std::size_t i = 0; i < steps_.size(); ++i) measured.push_back(measure(i));
    std::size_t newest = 0, next = 0;  // scan that has arrived by then, and the first that was not recorded
    Pose2 motion;
    for (std::size_t i = 0; i < steps_.size(); ++i) {
      const Pose2 odometry = counted(steps_[i].step.motion, faults_, times_s_[i]);
      out_.changes += odometry != steps_[i].step.motion ? 1 : 0;
      motion = wrap_heading(compose(motion, odometry));
      while (newest < i && times_s_[newest + 1] <= times_s_[i] - faults_.latency_s) ++newest;
      const bool has_arrived = newest >= next && times_s_[newest] <= times_s_[i] - faults_.latency_s;
      const bool is_lost = missed_.uniform() < faults_.missed;
      out_.changes += !has_arrived || is_lost || newest != i ? 1 : 0;
      if (!has_arrived) continue;
      next = newest + 1;
      if (!is_lost) record(i, measured[newest], std::exchange(motion, {}));
    }
    return std::move(out_);
  }

 private:
  /// Returns the ranges that the laser measures at a step.
  std::vector<float> measure(std::size_t i) {
    const LaserScan& scan = steps_[i].step.scan;
    std::vector<float> ranges_m = scan.ranges_m;
    if (faults_.blind(times_s_[i])) {
      std::ranges::fill(ranges_m, std::numeric_limits<float>::quiet_NaN());
    } else if (times_s_[i] >= faults_.frozen_from_s && !last_m_.empty()) {
      ranges_m = last_m_;
    } else {
      spoil_ranges(ranges_m, scan);
    }
    out_.changes += ranges_m != scan.ranges_m ? 1 : 0;
    if (times_s_[i] < faults_.frozen_from_s || last_m_.empty()) last_m_ = ranges_m;
    return ranges_m;
  }

  void spoil_ranges(std::vector<float>& ranges_m, const LaserScan& scan) {
    const auto is_reading = [&](double range_m) { return range_m >= scan.least_m && range_m <= scan.most_m; };
    double farthest_m = scan.least_m;
    for (const float range_m : ranges_m) {
      if (is_reading(static_cast<double>(range_m)))
        farthest_m = std::max(farthest_m, static_cast<double>(range_m));
    }
    for (float& range_m : ranges_m) {
      if (is_reading(static_cast<double>(range_m)))
        range_m = static_cast<float>(biased(static_cast<double>(range_m), faults_));
      if (faults_.outliers > 0.0 && outliers_.uniform() < faults_.outliers)
        range_m = static_cast<float>(outliers_.uniform(scan.least_m, farthest_m));
    }
  }

  void record(std::size_t i, const std::vector<float>& ranges_m, const Pose2& motion) {
    LaserLogStep step = steps_[i].step;
    step.motion = motion;
    step.scan.ranges_m = ranges_m;
    out_.recording.steps.push_back(std::move(step));
    if (steps_[i].reference) out_.recording.reference.push_back(*steps_[i].reference);
  }

  RecordingFaults faults_;
  Rng outliers_;
  Rng missed_;
  std::vector<PlacedStep> steps_;
  std::vector<double> times_s_;  ///< since the first step
  std::vector<float> last_m_;    ///< ranges before the laser froze
  Spoiled<LaserLog> out_;
};

}  // namespace

Outcome<Spoiled<LaserLog>> spoiled(const LaserLog& log, const RecordingFaults& faults, const Rng& rng) {
  Spoiled<LaserLog> result = LaserSpoiler(log, faults, rng).run();
  if (result.recording.steps.empty()) return nothing_left();
  return result;
}

}  // namespace outrider
