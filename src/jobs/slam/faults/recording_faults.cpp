#include "outrider/jobs/slam/faults/recording_faults.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace outrider {
namespace {

/// A fault by its key, and what it needs.
struct AskedFault {
  std::string_view key;
  bool is_asked = false;
  bool needs_time = false;      ///< no pose graph has it
  bool needs_landmark = false;  ///< no scan has it
};

std::array<AskedFault, 11> asked(const RecordingFaults& faults) {
  const RecordingFaults none;
  return {AskedFault{"blind_from", faults.blind_from_s != none.blind_from_s, true},
          AskedFault{"missed", faults.missed != none.missed, true},
          AskedFault{"bias", faults.bias_m != none.bias_m},
          AskedFault{"range_scale", faults.range_scale != none.range_scale},
          AskedFault{"outliers", faults.outliers != none.outliers},
          AskedFault{"latency", faults.latency_s != none.latency_s, true},
          AskedFault{"frozen_from", faults.frozen_from_s != none.frozen_from_s, true},
          AskedFault{"slip", faults.slip != none.slip},
          AskedFault{"stuck_from", faults.stuck_from_s != none.stuck_from_s, true},
          AskedFault{"kidnapped_at", faults.kidnapped_at_s != none.kidnapped_at_s, true},
          AskedFault{"wrong_ids", faults.wrong_ids != none.wrong_ids, false, true}};
}

}  // namespace

bool RecordingFaults::any() const {
  const auto all = asked(*this);
  return std::ranges::any_of(all, &AskedFault::is_asked);
}

std::vector<Option> describe(RecordingFaults& faults) {
  return {
      {"blind_from", "s", 0.0, 1e9, "from then on no beam has a reading, or no landmark is sighted",
       &faults.blind_from_s},
      {"blind_for", "s", 0.0, 1e9, "for how long", &faults.blind_for_s},
      {"missed", "", 0.0, 1.0, "part of the scans or sightings that are lost", &faults.missed},
      {"bias", "m", -1.0, 1.0, "added to every range", &faults.bias_m},
      {"range_scale", "", 0.5, 2.0, "ranges are so many times as long", &faults.range_scale},
      {"outliers", "", 0.0, 1.0,
       "part of the beams, sightings or edges but odometry that measure anything up to the farthest",
       &faults.outliers},
      {"latency", "s", 0.0, 10.0, "a scan or sighting is recorded so long after it was measured",
       &faults.latency_s},
      {"frozen_from", "s", 0.0, 1e9, "from then on the last scan, or the last sightings, are repeated",
       &faults.frozen_from_s},
      {"slip", "", 0.0, 0.9, "part of the motion that odometry counts and that did not happen", &faults.slip},
      {"stuck_from", "s", 0.0, 1e9, "from then on odometry counts no motion", &faults.stuck_from_s},
      {"stuck_for", "s", 0.0, 1e9, "for how long", &faults.stuck_for_s},
      {"kidnapped_at", "s", 0.0, 1e9,
       "from then on a part of the recording is cut out, as if the robot had been carried in no time",
       &faults.kidnapped_at_s},
      {"kidnapped_for", "s", 0.0, 1e9, "length of that part", &faults.kidnapped_for_s},
      {"wrong_ids", "", 0.0, 1.0, "part of the sightings that have the id of another landmark",
       &faults.wrong_ids},
  };
}

Status check(const RecordingFaults& faults, RecordingKind kind) {
  for (const AskedFault& fault : asked(faults)) {
    if (!fault.is_asked) continue;
    if (kind == RecordingKind::graph && fault.needs_time) {
      return bad_input(
          "a pose graph has no times and no scans; leave it out, or take bias, outliers, slip or wrong_ids",
          fmt::format("faults.{}", fault.key));
    }
    if (kind == RecordingKind::laser && fault.needs_landmark) {
      return bad_input("the scans of a laser log have no ids; leave it out, or take another fault",
                       fmt::format("faults.{}", fault.key));
    }
  }
  return {};
}

}  // namespace outrider
