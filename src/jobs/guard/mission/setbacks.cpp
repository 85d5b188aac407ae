#include "outrider/jobs/guard/mission/setbacks.hpp"

#include <fmt/format.h>

#include "outrider/jobs/guard/mission/task_board.hpp"

namespace outrider {
namespace {

constexpr double held_up_s = 10.0;  ///< for which a robot waits that does not get away
constexpr double same_place_m = 0.1;
constexpr double around_m = 1.0;            ///< in which a robot that gives up drives stays
constexpr std::int64_t drives_in_vain = 4;  ///< given up there, after which it stays
constexpr double stays_s = 60.0;
constexpr double off_m = 0.1;        ///< beyond twice the largest error of a drive
constexpr double obstacle_m = 0.25;  ///< radius of what is taken to stand in the way
constexpr double beyond_m = 0.01;
constexpr std::int64_t drives_around = 2;  ///< from that many drives that ended at one place on
constexpr std::int64_t waits = 3;
constexpr std::int64_t most_here = 4;
constexpr std::int64_t most_in_place = 12;
constexpr std::int64_t most_of_all = 200;

constexpr int enough_shots = 6;
constexpr std::size_t enough_targets = 2;
constexpr double enough_s = 30.0;

}  // namespace

/// The shots that the drive did not come to are not fired. `again`: they are planned for the next drive;
/// whether those of the last moments were fired is not known.
void TaskBoard::take_back_unfired(double time_s, bool again) {
  constexpr double unsure_s = 1.5;
  std::erase_if(flying_, [&](FlyingBall& ball) {
    if (!ball.in_passing) return false;
    const bool unfired = ball.leaves_s > time_s;
    ball.unsure = ball.leaves_s > time_s - unsure_s;
    if (unfired) --records_[ball.target].shots;
    if (unfired && again) queue_.front().passing.push_back(ball.target);
    return unfired;
  });
}

void TaskBoard::interrupt_drive(double time_s) {
  arrived_ = false;
  take_back_unfired(time_s, false);
}

bool TaskBoard::is_elsewhere(const Observation& seen) const {
  return distance(seen.odometry.position, last_place_) > 2.0 * problem_->errors.position_m + off_m;
}

/// Counts a drive that ended elsewhere, and those before it that ended there, too.
void TaskBoard::count_cut(const Observation& seen) {
  CutDrives& cut = cut_;
  const Vec2 here = seen.odometry.position;
  const double place_m = seen.gave_up ? around_m : same_place_m;
  const bool same_place = cut.in_place > 0 && distance(here, cut.place) <= place_m;
  cut.here = same_place ? cut.here + 1 : 1;
  cut.in_place = same_place ? cut.in_place + 1 : 1;
  cut.place = here;
  ++cut.all;
  if (seen.gave_up && cut.in_place >= drives_in_vain) cut.stays_until_s = seen.time_s + stays_s;
}

/// Takes something to stand right ahead.
void TaskBoard::take_for_obstacle(const Pose2& here) {
  const double ahead_m = obstacle_gap_m(*problem_) + beyond_m;
  cut_.obstacles.push_back(here.position + ahead_m * direction(here.heading_rad));
}

/// Lets the targets that no drive has hit be shot at from the stop.
void TaskBoard::stop_for_passed() {
  StopTask& task = queue_.front();
  task.targets.insert(task.targets.end(), task.passing.begin(), task.passing.end());
  task.passing.clear();
}

/// Returns true if the robot does the present task from where it is, since its drives are in vain.
bool TaskBoard::stays_here(const Observation& seen) {
  if (seen.time_s >= cut_.stays_until_s) return false;
  stop_for_passed();
  arrived_ = true;
  last_place_ = seen.odometry.position;
  return true;
}

/// Waits for the planner to have a budget again; nothing: it has waited for long enough, and gives up.
std::optional<Command> TaskBoard::wait_for_planner(double time_s, const Fault& fault) {
  constexpr double patience_s = 30.0, again_s = 1.0;
  const double since_s = planless_s_.value_or(time_s);
  planless_s_ = since_s;
  if (time_s - since_s < patience_s) return Wait{time_s + again_s};
  given_up_ = fmt::format("no way can be planned since {:.1f} s: {}", since_s, fault.sentence);
  fail_waiting(given_up_, time_s);
  return std::nullopt;
}

void TaskBoard::begin_drive(Vec2 place) {
  last_place_ = place;
  cut_.driving = true;
}

std::optional<Command> TaskBoard::drive_again(Vec2 place, const Observation& seen) {
  if (seen.time_s < cut_.stays_until_s) return std::nullopt;
  auto way = way_between(seen.odometry, place);
  if (!way) return wait_for_planner(seen.time_s, way.error());
  planless_s_.reset();
  begin_drive(place);
  return FollowWaypoints{std::move(*way)};
}

/// Looks where the last drive has ended. Returns true if that is elsewhere; its shots that were not fired are
/// taken back, `again` as there.
bool TaskBoard::ended_elsewhere(const Observation& seen, bool again) {
  cut_.driving = false;
  if (is_elsewhere(seen)) {
    take_back_unfired(seen.time_s, again);
    return true;
  }
  cut_.here = cut_.in_place = 0;
  return false;
}

void TaskBoard::note_drive(const Observation& seen) {
  CutDrives& cut = cut_;
  if (!cut.driving || !ended_elsewhere(seen, false)) return;
  if (seen.targets && !seen.targets->arrivals.empty()) return;  // it may have ended for them
  count_cut(seen);
  if (cut.in_place > most_in_place) cut.stays_until_s = seen.time_s + stays_s;
  if (cut.here == drives_around) take_for_obstacle(seen.odometry);
  arrived_ = false;
}

AfterDrive TaskBoard::after_drive(const Observation& seen) {
  CutDrives& cut = cut_;
  if (!ended_elsewhere(seen, true)) return AfterDrive::go_on;
  count_cut(seen);
  if (cut.all > most_of_all || cut.here == most_here || cut.in_place > most_in_place || seen.gave_up) {
    cut.here = 0;
    stop_for_passed();
    return AfterDrive::go_on;
  }
  if (cut.here == drives_around) take_for_obstacle(seen.odometry);
  return cut.here == waits ? AfterDrive::wait : AfterDrive::drive_again;
}

/// Looks where the drive to the present task has ended. Returns a command if the robot is held up.
std::optional<Command> TaskBoard::wait_if_held_up(const Observation& seen) {
  if (!cut_.driving || queue_.empty()) return std::nullopt;
  const AfterDrive next = after_drive(seen);
  arrived_ = next == AfterDrive::go_on;
  if (next == AfterDrive::wait) return Wait{seen.time_s + held_up_s};
  return std::nullopt;
}

double obstacle_gap_m(const GuardProblem& problem) { return problem.robot.radius_m + obstacle_m; }

std::string why_held_up(const CutDrives& cut) {
  if (cut.all == 0) return {};
  return fmt::format(
      "; {} drive{} ended elsewhere than planned: was the robot moved, is something in its way, or do its "
      "wheels stick?",
      cut.all, cut.all == 1 ? "" : "s");
}

void GunSilence::note(std::size_t target, bool has_result, double time_s) {
  if (has_result) {
    *this = {};
    return;
  }
  if (shots++ == 0) since_s = time_s;
  targets.insert(target);
}

std::string GunSilence::verdict(double time_s) const {
  if (shots < enough_shots || targets.size() < enough_targets || time_s - since_s < enough_s) return {};
  return fmt::format("the gun gives no result: nothing came of {} shots in a row at {} targets", shots,
                     targets.size());
}

}  // namespace outrider
