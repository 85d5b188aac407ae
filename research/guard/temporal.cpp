#include "research/guard/temporal.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "outrider/core/units.hpp"

namespace outrider {
namespace {

constexpr double gaps = 1e-7;  // of the time of a plan

/// Returns true if the robot can do anything at the stop except leave it.
bool is_useful(const SupplyProblem& problem, std::size_t stop) {
  return !problem.table.services[stop].empty() ||
         std::ranges::count(problem.stations, stop, &TourStation::stop) > 0;
}

/// The index of the pose, which joins the others when it is new.
std::size_t pose_index(std::vector<TemporalPose>& poses, const TemporalPose& pose) {
  for (std::size_t p = 0; p < poses.size(); ++p) {
    if (poses[p].stop == pose.stop && poses[p].heading_rad == pose.heading_rad) return p;
  }
  poses.push_back(pose);
  return poses.size() - 1;
}

/// Turns steps into actions; their starts are set at the end.
class Writer {
 public:
  explicit Writer(const TemporalProblem& problem)
      : problem_(problem), water_(problem.supplies.water), charge_(problem.supplies.charge) {}

  void take(const SupplyStep& step) {
    if (problem_.poses[pose_].stop != step.stop) drive(step.stop);
    for (const std::uint32_t goal : step.goals) shoot(goal);
    if (step.station) fill(*step.station);
  }
  std::vector<TemporalAction> timed() && {
    double total = 0.0;
    for (const TemporalAction& action : actions_) total += action.duration_s;
    const double gap = actions_.empty() ? 0.0 : gaps * total / static_cast<double>(actions_.size());
    double time = 0.0;
    for (TemporalAction& action : actions_) {
      action.start_s = time;
      time += action.duration_s + gap;
    }
    return std::move(actions_);
  }

 private:
  void add(TemporalVerb verb, double duration, std::size_t object, WayRound way = WayRound::direct) {
    actions_.push_back({0.0, duration, verb, pose_, object, way});
    if (verb != TemporalVerb::fill) charge_ -= problem_.supplies.charge_per_second * duration;
  }
  void drive(std::size_t stop) {
    const std::size_t to = problem_.after[pose_ * problem_.stops() + stop];
    const double seconds = problem_.drive_s(pose_, to);
    const double beside = problem_.drive_charge(pose_, to) - problem_.supplies.charge_per_second * seconds;
    add(TemporalVerb::drive, seconds, to);
    charge_ -= beside;
    pose_ = to;
  }
  /// The nearer way round, and the time until both axes are there.
  std::pair<WayRound, double> aim(double yaw, double pitch) {
    const TourProblem& table = problem_.supplies.table;
    std::pair<WayRound, double> best{WayRound::direct, std::numeric_limits<double>::infinity()};
    for (const WayRound way : {WayRound::direct, WayRound::plus, WayRound::minus}) {
      const double turn = std::abs(yaw + turn_of(way) - yaw_) / table.yaw_rate_radps;
      if (turn < best.second) best = {way, turn};
    }
    best.second = std::max(best.second, std::abs(pitch - pitch_) / table.pitch_rate_radps);
    yaw_ = yaw;
    pitch_ = pitch;
    return best;
  }
  void shoot(std::uint32_t goal) {
    const Service& service = *problem_.service(pose_, goal);
    const auto [way, seconds] = aim(problem_.shot_yaw(pose_, service), service.pitch_rad);
    add(TemporalVerb::shoot, seconds + service.duration_s, goal, way);
    water_ -= problem_.supplies.water_per_shot;
    charge_ -= problem_.supplies.charge_per_shot;
  }
  void fill(std::size_t index) {
    if (yaw_ != 0.0 || pitch_ != 0.0) {
      const auto [way, seconds] = aim(0.0, 0.0);
      add(TemporalVerb::rest, seconds, 0, way);
    }
    const TourStation& station = problem_.supplies.stations[index];
    const bool is_water = station.store == Store::water;
    double& level = is_water ? water_ : charge_;
    const double full = is_water ? problem_.supplies.water : problem_.supplies.charge;
    add(TemporalVerb::fill, station.fixed_s + station.per_unit_s * (full - level), index);
    level = full;
  }

  const TemporalProblem& problem_;
  std::vector<TemporalAction> actions_;
  std::size_t pose_ = 0;
  double yaw_ = 0.0;  // of the gun, relative to the body
  double pitch_ = 0.0;
  double water_;
  double charge_;
};

}  // namespace

double turn_of(WayRound way) {
  return way == WayRound::direct ? 0.0 : way == WayRound::plus ? 2.0 * pi : -2.0 * pi;
}

bool TemporalProblem::leads(std::size_t from, std::size_t to) const {
  return after[from * stops() + poses[to].stop] == to;
}

double TemporalProblem::drive_s(std::size_t from, std::size_t to) const {
  const Drive& drive = supplies.table.drives[poses[from].stop * stops() + poses[to].stop];
  if (drive.time_s == 0.0) return 0.0;
  const double turn = std::abs(wrap_angle(drive.departure_rad - poses[from].heading_rad));
  return duration(turn, supplies.table.turning) + drive.time_s;
}

double TemporalProblem::drive_charge(std::size_t from, std::size_t to) const {
  const double seconds = drive_s(from, to);
  const double length = supplies.lengths_m[poses[from].stop * stops() + poses[to].stop];
  if (seconds == 0.0) return 0.0;
  return supplies.charge_per_second * seconds + supplies.charge_per_metre * length;
}

double TemporalProblem::homeward_charge(std::size_t pose) const {
  double least = std::numeric_limits<double>::infinity();
  for (const TourStation& station : supplies.stations) {
    if (station.store != Store::charge) continue;
    if (station.stop == poses[pose].stop) return 0.0;
    const std::size_t to = after[pose * stops() + station.stop];
    if (to != none) least = std::min(least, drive_charge(pose, to));
  }
  return std::isfinite(least) ? least : 0.0;
}

const Service* TemporalProblem::service(std::size_t pose, std::uint32_t goal) const {
  const auto& here = supplies.table.services[poses[pose].stop];
  const auto found = std::ranges::find(here, goal, &Service::goal);
  return found == here.end() ? nullptr : &*found;
}

double TemporalProblem::shot_yaw(std::size_t pose, const Service& service) const {
  const double yaw = wrap_angle(service.yaw_rad - poses[pose].heading_rad);
  return yaw < 0.0 ? yaw + 2.0 * pi : yaw;
}

Outcome<TemporalProblem> temporal_problem(SupplyProblem supplies, std::size_t most_ways) {
  if (auto ok = check(supplies); !ok) return pass_on(ok);
  TemporalProblem problem{std::move(supplies), {}, {}};
  const TourProblem& table = problem.supplies.table;
  const std::size_t stops = problem.stops();
  problem.poses.push_back({0, table.heading_rad});
  for (std::size_t from = 0; from < problem.poses.size(); ++from) {
    const TemporalPose here = problem.poses[from];
    for (std::size_t stop = 0; stop < stops; ++stop) {
      const Drive& drive = table.drives[here.stop * stops + stop];
      const bool is_way =
          stop != here.stop && std::isfinite(drive.time_s) && is_useful(problem.supplies, stop);
      const double heading = drive.time_s > 0.0 ? drive.arrival_rad : here.heading_rad;
      problem.after.push_back(is_way ? pose_index(problem.poses, {stop, heading}) : TemporalProblem::none);
    }
    if (problem.after.size() > most_ways) {
      return bad_input(fmt::format("{} stops make more than {} drives between poses; offer fewer stops",
                                   stops, most_ways));
    }
  }
  return problem;
}

Outcome<std::vector<TemporalAction>> temporal_actions(const TemporalProblem& problem,
                                                      const std::vector<SupplyStep>& steps) {
  if (auto after = levels(problem.supplies, steps); !after) return pass_on(after);
  Writer writer(problem);
  for (const SupplyStep& step : steps) writer.take(step);
  return std::move(writer).timed();
}

}  // namespace outrider
