#include <Eigen/Geometry>
#include <optional>
#include <set>

#include "faults/spoil_parts.hpp"
#include "outrider/core/units.hpp"
#include "slam_log.hpp"

namespace outrider {
namespace {

using Sightings = std::vector<LandmarkSighting>;

std::vector<double> times_of(const LandmarkLog& log) {
  std::vector<double> recorded_s;
  for (const LogStep& step : log.steps) recorded_s.push_back(log.timed ? step.time_s : 0.0);
  return run_times(recorded_s);
}

/// Returns the sighting at another range and bearing, with the same errors along and across.
LandmarkSighting sighted_at(const LandmarkSighting& sighting, double range_m, double bearing_rad) {
  const double turn_rad = bearing_rad - heading_of(sighting.position);
  const Eigen::Matrix2d turn = Eigen::Rotation2Dd(turn_rad).toRotationMatrix();
  LandmarkSighting moved{sighting.id, range_m * direction(bearing_rad),
                         turn * sighting.covariance * turn.transpose()};
  moved.covariance(1, 0) = moved.covariance(0, 1);
  return moved;
}

/// Returns the covariance of the motion of the step that moves least: that of odometry which counts nothing.
Eigen::Matrix3d covariance_at_rest(const std::vector<LogStep>& steps) {
  const auto least =
      std::ranges::min_element(steps, {}, [](const LogStep& step) { return step.covariance.trace(); });
  return least == steps.end() ? Eigen::Matrix3d::Zero().eval() : least->covariance;
}

class LandmarkSpoiler {
 public:
  LandmarkSpoiler(const LandmarkLog& log, const RecordingFaults& faults, const Rng& rng)
      : faults_(faults),
        outliers_(rng.child("outliers")),
        missed_(rng.child("missed")),
        ids_(rng.child("ids")),
        at_rest_(covariance_at_rest(log.steps)) {
    out_.recording = log;
    out_.changes = cut_out(out_.recording.steps, times_of(log), faults_,
                           [](LogStep& step) -> double& { return step.time_s; });
    times_s_ = times_of(out_.recording);
    for (const LogStep& step : out_.recording.steps) {
      for (const LandmarkSighting& sighting : step.sightings) {
        farthest_m_ = std::max(farthest_m_, norm(sighting.position));
        if (sighting.id) known_.insert(*sighting.id);
      }
    }
  }

  [[nodiscard]] std::size_t landmarks() const { return known_.size(); }

  Spoiled<LandmarkLog> run() {
    std::vector<LogStep>& steps = out_.recording.steps;
    std::vector<Sightings> measured;
    for (std::size_t i = 0; i < steps.size(); ++i) measured.push_back(measure(i));
    std::size_t next = 0;  // first step whose sightings have not arrived
    for (std::size_t i = 0; i < steps.size(); ++i) {
      Sightings arrived;
      for (; next <= i && times_s_[next] <= times_s_[i] - faults_.latency_s; ++next)
        arrived.insert(arrived.end(), measured[next].begin(), measured[next].end());
      const Pose2 odometry = counted(steps[i].odometry, faults_, times_s_[i]);
      if (faults_.stuck(times_s_[i])) steps[i].covariance = at_rest_;
      out_.changes += odometry != steps[i].odometry || arrived != steps[i].sightings ? 1 : 0;
      steps[i].odometry = odometry;
      steps[i].sightings = std::move(arrived);
    }
    return std::move(out_);
  }

 private:
  /// Returns what the sensor sights at a step.
  Sightings measure(std::size_t i) {
    if (faults_.blind(times_s_[i])) return {};
    if (times_s_[i] >= faults_.frozen_from_s) return last_;
    Sightings sightings;
    for (const LandmarkSighting& sighting : out_.recording.steps[i].sightings) {
      if (faults_.missed > 0.0 && missed_.uniform() < faults_.missed) continue;
      sightings.push_back(spoil(sighting));
    }
    if (!sightings.empty()) last_ = sightings;
    return sightings;
  }

  LandmarkSighting spoil(LandmarkSighting sighting) {
    const double range_m = norm(sighting.position);
    if (faults_.changes_ranges() && range_m > 0.0)
      sighting.position = biased(range_m, faults_) / range_m * sighting.position;
    if (faults_.outliers > 0.0 && outliers_.uniform() < faults_.outliers) {
      const double bearing_rad = outliers_.uniform(-pi, pi);
      sighting = sighted_at(sighting, biased(outliers_.uniform(0.0, farthest_m_), faults_), bearing_rad);
    }
    if (sighting.id && faults_.wrong_ids > 0.0 && ids_.uniform() < faults_.wrong_ids)
      sighting.id = other(*sighting.id);
    return sighting;
  }

  std::int64_t other(std::int64_t id) {
    const auto own = static_cast<std::uint64_t>(std::distance(known_.begin(), known_.find(id)));
    const std::uint64_t drawn = ids_.below(known_.size() - 1);
    return *std::next(known_.begin(), static_cast<std::ptrdiff_t>(drawn + (drawn >= own ? 1 : 0)));
  }

  RecordingFaults faults_;
  Rng outliers_;
  Rng missed_;
  Rng ids_;
  Eigen::Matrix3d at_rest_;
  std::vector<double> times_s_;
  std::set<std::int64_t> known_;  ///< ids of the recording
  double farthest_m_ = 0.0;
  Sightings last_;  ///< before the sensor froze
  Spoiled<LandmarkLog> out_;
};

}  // namespace

Outcome<Spoiled<LandmarkLog>> spoiled(const LandmarkLog& log, const RecordingFaults& faults, const Rng& rng) {
  LandmarkSpoiler spoiler(log, faults, rng);
  if (faults.wrong_ids > 0.0 && spoiler.landmarks() < 2) {
    return bad_input(
        fmt::format("the recording has {} landmarks with ids, and two are needed to take one for another; "
                    "leave it out",
                    spoiler.landmarks()),
        "faults.wrong_ids");
  }
  Spoiled<LandmarkLog> result = spoiler.run();
  if (result.recording.steps.empty()) return nothing_left();
  return result;
}

}  // namespace outrider
