// LaserSource: the scans of a laser and the motion between them, one after the other. A log that is in memory
// and one that is read while it is mapped look the same.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "outrider/io/log/carmen_log.hpp"

namespace outrider {

class LaserSource {
 public:
  virtual ~LaserSource() = default;
  LaserSource(const LaserSource&) = delete;
  LaserSource& operator=(const LaserSource&) = delete;

  /// Returns the next scan with the motion since the one before, or nothing at the end. Fault: bad_input, if
  /// the log is damaged from here on.
  virtual Outcome<std::optional<LaserLogStep>> next() = 0;
  /// Returns the part that has been read, 0 to 1.
  [[nodiscard]] virtual double progress() const = 0;
  /// Returns the pose of the laser on the robot; nothing if the log does not say it.
  [[nodiscard]] virtual std::optional<Pose2> robot_T_laser() const = 0;
  /// Returns what was left out so far, a sentence each.
  [[nodiscard]] virtual std::vector<std::string> warnings() const { return {}; }

 protected:
  LaserSource() = default;
};

/// Gives the steps of a log, which must outlive it.
class LoadedLaserSource final : public LaserSource {
 public:
  explicit LoadedLaserSource(const LaserLog& log) : log_(log) {}
  Outcome<std::optional<LaserLogStep>> next() override {
    return next_ < log_.steps.size() ? std::optional(log_.steps[next_++]) : std::nullopt;
  }
  [[nodiscard]] double progress() const override {
    return log_.steps.empty() ? 1.0 : static_cast<double>(next_) / static_cast<double>(log_.steps.size());
  }

  [[nodiscard]] std::optional<Pose2> robot_T_laser() const override { return log_.robot_T_laser; }

 private:
  const LaserLog& log_;
  std::size_t next_ = 0;
};

}  // namespace outrider
