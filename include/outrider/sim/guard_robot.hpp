// A simulated robot with a water gun: kinematic, deterministic, on a virtual clock.
//
// Drives and turns follow trapezoidal profiles exactly, then end a little off: the errors of the
// problem, drawn from named streams of the seed. A shot leaves with the errors of the gun and flies
// exactly until its first contact. Everything that happens goes into a report.
#pragma once

#include "outrider/core/rng.hpp"
#include "outrider/execute/robot.hpp"
#include "outrider/guard/arrivals.hpp"
#include "outrider/guard/site.hpp"
#include "outrider/report/report.hpp"

namespace outrider {

class SimulatedGuard final : public Robot {
 public:
  /// The references must outlive the robot. Where intruders come, they are the targets, in the order of
  /// entering; `foreseen`: all are seen at the start.
  SimulatedGuard(const GuardProblem& problem, const Site& site, std::uint64_t seed,
                 std::vector<Intruder> intruders = {}, bool foreseen = false);

  Observation sense() override;
  void act(const Command& command) override;

  Report report;  ///< its track, paths, shots and events, so far
  double driven_m = 0.0;
  double turned_rad = 0.0;

 private:
  void follow(std::vector<Vec2> waypoints, bool until_news);
  void aim(const AimGun& command);
  void fire(const Fire& command);
  void wait(const Wait& command);
  void turn_to(double heading_rad);
  void drive_to(Vec2 goal);
  void sample();
  [[nodiscard]] bool news() const;
  void log(std::string kind, std::string text);

  const GuardProblem& problem_;
  const Site& site_;
  Rng arrival_rng_;
  Rng gun_rng_;
  double time_s_ = 0.0;
  Pose2 pose_;
  double gun_yaw_rad_ = 0.0;  // relative to the body
  double gun_pitch_rad_ = 0.0;
  std::optional<bool> hit_;
  std::vector<int> attempts_;  // by target
  std::vector<Intruder> intruders_;
  bool foreseen_ = false;
  std::size_t seen_ = 0;  // intruders that have been told of
};

}  // namespace outrider
