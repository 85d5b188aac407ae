// LaserRecords: the observations of the robot that recorded a laser log.
#pragma once

#include <optional>
#include <utility>

#include "outrider/io/log/laser_source.hpp"
#include "outrider/robot/observation.hpp"

namespace outrider {

/// Reads a source, which must outlive it. A fault of the source ends the observations.
class LaserRecords {
 public:
  explicit LaserRecords(LaserSource& source) : source_(source) {}

  std::optional<Observation> next() {
    auto step = source_.next();
    if (!step) fault_ = std::move(step.error());
    if (fault_ || !*step) return std::nullopt;
    LaserLogStep& read = **step;
    seen_.time_s = read.scan.time_s;
    seen_.odometry = compose(seen_.odometry, read.motion);
    seen_.motion = read.motion;
    seen_.scan = std::move(read.scan);
    return seen_;
  }

  [[nodiscard]] const std::optional<Fault>& fault() const { return fault_; }

 private:
  LaserSource& source_;
  Observation seen_;
  std::optional<Fault> fault_;
};

}  // namespace outrider
