#include "outrider/sim/sensors/simulated_laser.hpp"

#include "times.hpp"

namespace outrider {
namespace {

LinkFaults late(LinkFaults link, double latency_s) {
  link.delay_s += latency_s;
  return link;
}

}  // namespace

SimulatedLaser::SimulatedLaser(const World& world, const RangeFinderModel& model, const Rng& rng,
                               const ExplorerFaults& faults, const LinkFaults& link)
    : finder_(world, model),
      faults_(faults),
      rng_(rng),
      fault_rng_(rng.child("faults")),
      under_way_(late(link, faults.latency_s), rng.child("link")) {}

void SimulatedLaser::spoil(LaserScan& scan, double time_s) {
  for (float& range : scan.ranges_m) {
    if (range >= scan.least_m && range <= scan.most_m) range += static_cast<float>(faults_.bias_m);
    if (faults_.outliers > 0.0 && fault_rng_.uniform() < faults_.outliers)
      range = static_cast<float>(fault_rng_.uniform(scan.least_m, scan.most_m));
  }
  if (time_s < faults_.frozen_from_s || frozen_.empty())
    frozen_ = scan.ranges_m;
  else
    scan.ranges_m = frozen_;
}

std::optional<LaserScan> SimulatedLaser::look(const Pose2& world_T_robot, double time_s,
                                              const WalkIns* walk_ins) {
  const double turns = (time_s + instant_s) * finder_.model().rate_hz;
  if (turns >= static_cast<double>(turns_)) {
    turns_ = static_cast<std::int64_t>(turns) + 1;
    const Pose2 world_T_laser = compose(world_T_robot, finder_.model().robot_T_laser);
    const bool alone = walk_ins == nullptr || walk_ins->disks().empty();
    LaserScan scan =
        alone ? finder_.look(world_T_laser, time_s, rng_)
              : finder_.look(world_T_laser, time_s, rng_, RangeFinder(walk_ins->disks(), finder_.model()));
    spoil(scan, time_s);
    if (!faults_.blind(time_s)) under_way_.send(time_s, scan);
  }
  return under_way_.take(time_s);
}

}  // namespace outrider
