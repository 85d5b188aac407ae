#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "outrider/core/units.hpp"
#include "research/guard/temporal.hpp"

namespace outrider {
namespace {

constexpr double store_rounding = 1e-6;  // of a full store

/// The robot of the model; each action is taken or refused with a sentence.
class Follower {
 public:
  Follower(const TemporalProblem& problem, double tolerance_s)
      : problem_(problem),
        tolerance_(tolerance_s),
        water_(problem.supplies.water),
        charge_(problem.supplies.charge),
        hit_(problem.supplies.table.goals, 0) {}

  std::string take(const TemporalAction& action) {
    if (action.start_s < free_at_ - tolerance_) {
      return fmt::format("it begins at {:.6f} s, but the action before lasts until {:.6f} s", action.start_s,
                         free_at_);
    }
    if (action.verb != TemporalVerb::rest && action.pose != pose_) {
      return "it begins at another pose than the one where the robot is then";
    }
    free_at_ = action.start_s + action.duration_s;
    switch (action.verb) {
      case TemporalVerb::drive: return drive(action);
      case TemporalVerb::shoot: return shoot(action);
      case TemporalVerb::rest: return rest(action);
      default: return fill(action);
    }
  }
  [[nodiscard]] const std::vector<char>& hit() const { return hit_; }

 private:
  [[nodiscard]] std::string exactly(double due, const TemporalAction& action) const {
    if (std::abs(action.duration_s - due) <= tolerance_) return {};
    return fmt::format("it lasts {:.6f} s, but takes {:.6f} s", action.duration_s, due);
  }
  [[nodiscard]] std::string at_least(double due, const TemporalAction& action) const {
    if (action.duration_s >= due - tolerance_) return {};
    return fmt::format("it lasts {:.6f} s, but takes at least {:.6f} s that way round", action.duration_s,
                       due);
  }
  /// Takes charge; says so when less than `left` remains.
  std::string use(double charge, double left, std::string_view what) {
    charge_ -= charge;
    if (!(charge_ < left - store_rounding * problem_.supplies.charge)) return {};
    return fmt::format("the charge is {:.3f} J after it, but {} {:.3f} J", charge_, what, left);
  }
  [[nodiscard]] double per_second(const TemporalAction& action) const {
    return problem_.supplies.charge_per_second * action.duration_s;
  }
  [[nodiscard]] double aim_s(double yaw, double pitch, WayRound way) const {
    const TourProblem& table = problem_.supplies.table;
    return std::max(std::abs(yaw + turn_of(way) - yaw_) / table.yaw_rate_radps,
                    std::abs(pitch - pitch_) / table.pitch_rate_radps);
  }
  void point(double yaw, double pitch, bool rested) {
    yaw_ = yaw;
    pitch_ = pitch;
    rested_ = rested;
  }

  std::string drive(const TemporalAction& action) {
    if (!problem_.leads(pose_, action.object)) return "no drive leads from the first pose to the second";
    if (auto wrong = exactly(problem_.drive_s(pose_, action.object), action); !wrong.empty()) return wrong;
    const double charge = problem_.drive_charge(pose_, action.object);
    pose_ = action.object;
    return use(charge, 0.0, "must not fall below");
  }
  std::string shoot(const TemporalAction& action) {
    const auto goal = static_cast<std::uint32_t>(action.object);
    const Service* service = problem_.service(pose_, goal);
    if (service == nullptr) return "there is no shot at the target from that pose";
    if (hit_[goal] != 0) return "the target was hit before";
    const double yaw = problem_.shot_yaw(pose_, *service);
    const double due = aim_s(yaw, service->pitch_rad, action.way) + service->duration_s;
    if (auto wrong = at_least(due, action); !wrong.empty()) return wrong;
    point(yaw, service->pitch_rad, false);
    hit_[goal] = 1;
    water_ -= problem_.supplies.water_per_shot;
    if (water_ < -store_rounding * problem_.supplies.water) return "the tank is empty before";
    return use(problem_.supplies.charge_per_shot + per_second(action), problem_.homeward_charge(pose_),
               "the way to a charger takes");
  }
  std::string rest(const TemporalAction& action) {
    if (auto wrong = at_least(aim_s(0.0, 0.0, action.way), action); !wrong.empty()) return wrong;
    point(0.0, 0.0, true);
    return use(per_second(action), 0.0, "must not fall below");
  }
  std::string fill(const TemporalAction& action) {
    const TourStation& station = problem_.supplies.stations[action.object];
    if (station.stop != problem_.poses[pose_].stop) return "there is no such station at that pose";
    if (!rested_) return "the gun is not at rest";
    const bool is_water = station.store == Store::water;
    double& level = is_water ? water_ : charge_;
    const double full = is_water ? problem_.supplies.water : problem_.supplies.charge;
    const double missing = full - level;
    level = full;
    return exactly(station.fixed_s + station.per_unit_s * missing, action);
  }

  const TemporalProblem& problem_;
  double tolerance_;
  double free_at_ = 0.0;
  std::size_t pose_ = 0;
  double yaw_ = 0.0;  // of the gun, relative to the body
  double pitch_ = 0.0;
  bool rested_ = true;
  double water_;
  double charge_;
  std::vector<char> hit_;
};

}  // namespace

TemporalVerdict judge(const TemporalProblem& problem, const std::vector<TemporalAction>& actions,
                      double tolerance_s) {
  TemporalVerdict verdict;
  std::vector<std::size_t> order(actions.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, [&](std::size_t i) { return std::pair{actions[i].start_s, i}; });
  for (const TemporalAction& action : actions) {
    verdict.makespan_s = std::max(verdict.makespan_s, action.start_s + action.duration_s);
  }
  Follower robot(problem, tolerance_s);
  for (const std::size_t i : order) {
    verdict.reason = robot.take(actions[i]);
    if (verdict.valid()) continue;
    verdict.broken = i;
    return verdict;
  }
  const auto missed = std::ranges::find(robot.hit(), 0);
  if (missed != robot.hit().end()) {
    verdict.reason = fmt::format("target t{} is never hit", missed - robot.hit().begin());
  }
  return verdict;
}

}  // namespace outrider
