// RecordingFaults: what spoils a recording before it is mapped, without the mapping being told.
//
// Times count from the beginning of the recording. A log without times has 0.1 s for each step. What a
// recording of one kind cannot have is refused by check().
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "outrider/core/options.hpp"

namespace outrider {

/// The kind of the recorded data: scans of a laser, sightings of landmarks, or the edges of a pose graph.
enum class RecordingKind { laser, landmarks, graph };

struct RecordingFaults {
  double blind_from_s = 1e9;      ///< from then on no beam has a reading, or no landmark is sighted
  double blind_for_s = 1e9;       ///< for how long
  double missed = 0.0;            ///< fraction of the scans or sightings that are lost
  double bias_m = 0.0;            ///< added to every range
  double range_scale = 1.0;       ///< times which every range is measured, before the bias
  double outliers = 0.0;          ///< fraction of the beams, sightings or edges that measure anything
  double latency_s = 0.0;         ///< a scan or sighting is recorded so long after it was measured
  double frozen_from_s = 1e9;     ///< from then on the last scan, or the last sightings, are repeated
  double slip = 0.0;              ///< fraction of the motion counted by odometry that did not happen
  double stuck_from_s = 1e9;      ///< from then on odometry counts no motion
  double stuck_for_s = 1e9;       ///< for how long
  double kidnapped_at_s = 1e9;    ///< from then on a part of the recording is cut out
  double kidnapped_for_s = 10.0;  ///< length of that part
  double wrong_ids = 0.0;         ///< fraction of the sightings that have the id of another landmark

  /// Returns true if any fault was asked for.
  [[nodiscard]] bool any() const;
  [[nodiscard]] bool changes_ranges() const { return bias_m != 0.0 || range_scale != 1.0; }
  [[nodiscard]] bool blind(double time_s) const {
    return time_s >= blind_from_s && time_s < blind_from_s + blind_for_s;
  }
  [[nodiscard]] bool stuck(double time_s) const {
    return time_s >= stuck_from_s && time_s < stuck_from_s + stuck_for_s;
  }
  [[nodiscard]] bool cut(double time_s) const {
    return time_s >= kidnapped_at_s && time_s < kidnapped_at_s + kidnapped_for_s;
  }
};

std::vector<Option> describe(RecordingFaults& faults);

/// Refuses a fault that a recording of that kind cannot have. Fault: bad_input, with the key.
Status check(const RecordingFaults& faults, RecordingKind kind);

}  // namespace outrider
