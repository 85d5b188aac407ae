#include "outrider/jobs/guard/scout_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "guard_report.hpp"
#include "outrider/core/rng.hpp"

namespace outrider {
namespace {

constexpr double coarse_m = 1.0;  // of the true map, which serves the simulation alone

/// Sees targets while the robot explores.
class TargetDetector {
 public:
  TargetDetector(const std::vector<Target>& targets, const ScoutOptions& options, std::uint64_t seed)
      : seen(targets.size()), targets_(targets), options_(options), rng_(Rng(seed).child("lookout")) {}

  void look(const ExploreMission& mission, const SimulatedRobot& robot) {
    const Pose2 truth = robot.pose();
    for (std::size_t i = 0; i < targets_.size(); ++i) {
      const Vec2 place = xy(targets_[i].base);
      if (distance(truth.position, place) > options_.sight_m) continue;
      if (!robot.devices().laser->finder().sees(truth.position, place)) continue;
      const Vec2 ahead = truth.to_local(place);
      const Vec2 error = options_.sight_error_m * Vec2{rng_.normal(), rng_.normal()};
      const Vec2 believed = mission.pose * ahead + error;
      if (!seen[i]) seen[i].emplace();
      seen[i]->add(believed, mission.time_s);
    }
  }

  std::vector<std::optional<SeenTarget>> seen;

 private:
  const std::vector<Target>& targets_;
  const ScoutOptions& options_;
  Rng rng_;
};

/// The true yard, with the targets that were found first, in their order there.
GuardProblem true_yard(const GuardProblem& truth, const FoundYard& found, const Pose2& start) {
  GuardProblem yard = truth;
  yard.start = start;
  yard.supplies.stations = found.problem.supplies.stations;
  yard.targets.clear();
  for (const std::size_t i : found.targets) yard.targets.push_back(truth.targets[i]);
  return yard;
}

/// How often a straight of the track touches what stands there.
double contacts(const Report& report, const CollisionMap& ground, double radius_m) {
  double count = 0.0;
  bool touching = false;
  for (std::size_t i = 1; i < report.track.size(); ++i) {
    const bool touches =
        !ground.segment_free({report.track[i - 1].pose.position, report.track[i].pose.position}, radius_m);
    if (touches && !touching) ++count;
    touching = touches;
  }
  return count;
}

ReportTarget never_shot_at(const Target& target, bool seen, double end_s) {
  ReportTarget entry;
  entry.name = target.name;
  entry.status = "failed";
  entry.reason = seen ? "seen where the map has something" : "not seen while exploring";
  entry.centre = target.centre();
  entry.size = target.size;
  entry.yaw_rad = target.yaw_rad;
  entry.done_s = end_s;
  return entry;
}

/// All targets in the order of the yard; the report has those that were found.
void add_other_targets(Report& report, const GuardProblem& truth, const ScoutedYard& yard, double end_s) {
  std::vector<ReportTarget> all;
  for (std::size_t i = 0; i < truth.targets.size(); ++i) {
    const auto at = std::ranges::find(yard.found.targets, i);
    if (at == yard.found.targets.end()) {
      all.push_back(never_shot_at(truth.targets[i], yard.seen[i].has_value(), end_s));
    } else {
      all.push_back(report.targets[static_cast<std::size_t>(at - yard.found.targets.begin())]);
    }
  }
  report.targets = std::move(all);
}

template <class Entries>
void append(Entries& to, const Entries& from) {
  to.insert(to.end(), from.begin(), from.end());
}

/// Lets the times begin with the end of the exploring.
void delay(Report& report, double by_s) {
  for (ReportTarget& target : report.targets) target.done_s += by_s;
  for (ReportPath& path : report.paths) {
    path.start_s += by_s;
    path.end_s += by_s;
  }
  for (ReportShot& shot : report.shots) shot.time_s += by_s;
  for (ReportEvent& event : report.events) event.time_s += by_s;
  for (TrackSample& sample : report.track) sample.time_s += by_s;
  if (!report.supplies) return;
  for (ReportLevel& level : report.supplies->levels) level.time_s += by_s;
  report.supplies->levels.insert(report.supplies->levels.begin(),
                                 {0.0, report.supplies->tank, report.supplies->battery_j});
}

std::vector<ReportEvent> sightings(const GuardProblem& truth, const ScoutedYard& yard) {
  std::vector<ReportEvent> events;
  for (std::size_t i = 0; i < yard.seen.size(); ++i) {
    if (!yard.seen[i]) continue;
    const SeenTarget& seen = *yard.seen[i];
    events.push_back({seen.first_s, "seen",
                      fmt::format("{} comes into sight; {} looks put it at ({:.2f}, {:.2f}), {:.0f} mm off",
                                  truth.targets[i].name, seen.looks, seen.mean.x, seen.mean.y,
                                  1e3 * distance(seen.mean, xy(truth.targets[i].base)))});
  }
  return events;
}

/// Puts the exploring before the guarding.
void prepend(Report& report, Report explored, std::vector<ReportEvent> seen) {
  for (TrackSample& sample : explored.track) sample.gun_yaw_rad = sample.pose.heading_rad;
  append(explored.track, report.track);
  append(explored.events, seen);
  append(explored.events, report.events);
  std::ranges::stable_sort(explored.events, {}, &ReportEvent::time_s);
  report.track = std::move(explored.track);
  report.events = std::move(explored.events);
  report.explore = std::move(explored.explore);
  report.start = explored.start;
}

void set(Report& report, std::string_view name, double value) {
  for (auto& [key, held] : report.metrics) {
    if (key == name) held = value;
  }
}

double count(const Report& report, std::string_view status) {
  return static_cast<double>(std::ranges::count(report.targets, status, &ReportTarget::status));
}

/// Status and totals of the whole mission.
void conclude(Report& report, const Report& explored, double touches, std::size_t seen) {
  const double failed = count(report, "failed"), reached = count(report, "reached");
  const auto targets = static_cast<double>(report.targets.size());
  set(report, "targets", targets);
  set(report, "failed", failed);
  set(report, "mission_s", report.track.back().time_s);
  set(report, "driven_m", metric(report, "driven_m") + metric(explored, "distance_m"));
  set(report, "turned_rad", metric(report, "turned_rad") + metric(explored, "turned_rad"));
  report.metrics.emplace_back("seen", static_cast<double>(seen));
  report.metrics.emplace_back("explored_fraction", metric(explored, "explored_fraction"));
  report.metrics.emplace_back("map_error_m", metric(explored, "map_error_m"));
  report.metrics.emplace_back("explore_s", metric(explored, "time_s"));
  report.metrics.emplace_back("contacts", touches);
  const std::string dry = ran_dry(report);
  report.status = failed == 0.0 && touches == 0.0 && dry.empty() ? "done" : "not_done";
  report.reason = dry;
  if (!dry.empty()) return;
  if (reached < targets) {
    report.reason =
        fmt::format("{} of {} targets seen, {} reached, {} failed, {} proven to be out of reach on the map",
                    seen, targets, reached, failed, targets - reached - failed) +
        why_stranded(report);
  } else if (touches > 0.0) {
    report.reason = "something was touched";
  }
}

/// What the exploring leaves in the stores: no shot was fired, but time and way took charge.
StoreLevels levels_after(const Report& explored, const Supplies& supplies) {
  const double used_j = supplies.charge_of(metric(explored, "time_s"), metric(explored, "distance_m"));
  return {supplies.full(Store::water), supplies.full(Store::charge) - used_j};
}

/// Shows the guarding with the exploring before it.
class WholeMission final : public RunObserver {
 public:
  WholeMission(const Report& explored, double explore_s, RunObserver* inner)
      : explored_(explored), explore_s_(explore_s), inner_(inner) {}

  bool wants() override { return inner_->wants(); }
  void see(const Report& guarding) override {
    Report so_far = guarding;
    delay(so_far, explore_s_);
    prepend(so_far, explored_, {});
    inner_->see(so_far);
  }

 private:
  const Report& explored_;
  double explore_s_;
  RunObserver* inner_;
};

}  // namespace

Outcome<ScoutedYard> scout(const GuardProblem& truth, const ScoutTask& task, std::uint64_t seed,
                           const RunWatch& watch) {
  ExploreTask explore = task.explore;
  explore.start = truth.start;
  explore.robot = truth.robot;
  TargetDetector detector(truth.targets, task.options, seed);
  std::vector<Vec2> stood;
  auto run = run_explore(truth.world, explore, task.sensors, seed, watch,
                         [&](const ExploreMission& mission, const SimulatedRobot& robot) {
                           detector.look(mission, robot);
                           stood.push_back(mission.pose.position);
                         });
  if (!run) return pass_on(run);
  if (run->report.status == "cancelled") return ScoutedYard{std::move(*run), std::move(detector.seen), {}};
  if (run->stop_reason == "lost" || run->stop_reason == "blind") {
    return fault(FaultCode::no_path, fmt::format("the yard could not be explored: {}", run->report.reason),
                 "scout.unknown");
  }
  auto found = found_yard(truth, task.options, run->map, stood, detector.seen, run->true_pose);
  if (!found) return pass_on(found);
  return ScoutedYard{std::move(*run), std::move(detector.seen), std::move(*found)};
}

Outcome<Report> run_guard_on_map(const GuardProblem& truth, ScoutedYard yard, const FiringMap& firing_map,
                                 const GuardPlan& plan, const GuardOptions& options, std::uint64_t seed,
                                 const RunWatch& watch) {
  const GuardProblem& found = yard.found.problem;
  const GuardProblem really = true_yard(truth, yard.found, found.start);
  GuardOptions coarse = options;
  coarse.resolution_m = coarse_m;
  const auto true_map = build_firing_map(really, coarse, watch.budget(), RegionSearch::none);
  if (!true_map) return tl::unexpected<Fault>(true_map.error());
  const double explore_s = metric(yard.run.report, "time_s");
  WholeMission whole(yard.run.report, explore_s, watch.observer);
  RunWatch guarding = watch;
  if (watch.observer != nullptr) guarding.observer = &whole;
  auto guarded =
      run_guard({.problem = found,
                 .firing_map = firing_map,
                 .plan = plan,
                 .options = options,
                 .seed = seed,
                 .truth = TrueYard{really, *true_map, levels_after(yard.run.report, truth.supplies)}},
                guarding);
  if (!guarded) return guarded;
  Report report = std::move(*guarded);
  const double touches =
      metric(yard.run.report, "contacts") + contacts(report, true_map->ground, truth.robot.radius_m);
  const bool cancelled = report.status == "cancelled";
  delay(report, explore_s);
  add_other_targets(report, truth, yard, explore_s);
  const auto seen = static_cast<std::size_t>(
      std::ranges::count_if(yard.seen, [](const auto& target) { return target.has_value(); }));
  const auto events = sightings(truth, yard);
  conclude(report, yard.run.report, touches, seen);
  prepend(report, std::move(yard.run.report), events);
  if (cancelled) mark_cancelled(report, report.track.back().time_s);
  return report;
}

}  // namespace outrider
