#include "plan/relaxed.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "outrider/ballistics/stance.hpp"
#include "outrider/core/parallel.hpp"

namespace outrider {
namespace {

constexpr std::size_t usual_chosen = 8;
constexpr std::size_t most_chosen = 13;

/// Least time in which a ball of at most this speed gets to some point at a distance and a height within
/// these limits, all from the muzzle: the first time at which the falling ball of reach holds such a point.
double least_time(double distance, double low, double high, double speed, double gravity) {
  const double fall = 0.5 * gravity * (distance / speed) * (distance / speed);
  const double height = std::clamp(-fall, low, high);
  // The smaller root T = t^2 of (g^2 / 4) T^2 - b T + way^2 = 0.
  const double squared_way = distance * distance + height * height;
  const double b = speed * speed - gravity * height;
  const double root = b * b - gravity * gravity * squared_way;
  if (b <= 0.0 || root < 0.0) return distance / speed;
  return std::sqrt(2.0 * squared_way / (b + std::sqrt(root)));
}

/// From below, the time of flight from a place to a target.
double least_flight(const ShotRules& rules, const Target& target, Vec2 place) {
  const GunModel& gun = rules.gun;
  const Vec2 away = place - xy(target.base);
  const Vec2 ahead = direction(target.yaw_rad);
  const double gap = std::hypot(std::max(0.0, std::abs(dot(ahead, away)) - 0.5 * target.size.x),
                                std::max(0.0, std::abs(cross(ahead, away)) - 0.5 * target.size.y));
  const double tip = std::hypot(gun.tip_forward_m, gun.tip_up_m);
  const Stance stance = stance_at(rules, place);
  // On a slope the joint is not above the place.
  const double lean = gun.pivot_height_m * norm(stance.up - Vec3{0.0, 0.0, 1.0});
  const double near = tip + gun.ball_radius_m + lean;
  // In air the velocity over the ground is always between that at the muzzle and the slower wind.
  if (!rules.air.none()) return std::max(0.0, gap - near) / gun.muzzle_speed_mps;
  const double low = target.base.z - stance.ground_z_m - gun.pivot_height_m - near;
  return least_time(std::max(0.0, gap - near), low, low + target.size.z + 2.0 * near, gun.muzzle_speed_mps,
                    rules.gravity_mps2);
}

std::uint16_t sum(std::uint32_t a, std::uint32_t b) {
  return static_cast<std::uint16_t>(std::min<std::uint32_t>(endless, a + b));
}

std::size_t without(std::size_t set, std::size_t bit) { return set & ~(std::size_t{1} << bit); }

/// The cell whose centre is nearest to a place, and its distance.
std::pair<std::size_t, double> nearest_cell(const GridFrame& frame, Vec2 place) {
  std::pair<std::size_t, double> nearest{0, std::numeric_limits<double>::infinity()};
  for (std::size_t c = 0; c < frame.size(); ++c) {
    const double way = distance(frame.centre(frame.cell(c)), place);
    if (way < nearest.second) nearest = {c, way};
  }
  return nearest;
}

}  // namespace

Relaxed::Relaxed(const GuardProblem& problem, const FiringMap& firing_map,
                 const std::vector<std::size_t>& targets, bool on_the_move)
    : frame_(firing_map.frame),
      lattice_(firing_map.frame, firing_map.clearance_m, problem.robot.radius_m),
      straight_(problem.robot.straight()),
      on_the_move_(on_the_move),
      flight_(targets.size(), GridPart<std::uint16_t>(endless)),
      least_(targets.size(), endless),
      value_(1, Field(firing_map.frame.size(), 0)) {
  unit_s_ = lattice_.unit_m() / straight_.speed;
  if (on_the_move_) aside_s_ = std::numbers::sqrt2 * firing_map.frame.resolution_m / straight_.speed;
  overhead_ = static_cast<std::uint32_t>(
      std::min<double>(endless, straight_.speed / straight_.acceleration / unit_s_));
  const auto [home, nearest] = nearest_cell(frame_, problem.start.position);
  home_ = home;
  to_home_s_ = 2.0 * nearest / straight_.speed;
  parallel_for(targets.size(), [&](std::size_t i) {
    const std::size_t t = targets[i];
    flight_[i] = firing_map.regions[t].pitch.mapped(endless, [&](std::size_t c, std::uint8_t pitch) {
      if (pitch == FiringRegion::no_shot) return endless;
      const double units =
          on_the_move_ ? 0.0
                       : least_flight(firing_map.rules, problem.targets[t], firing_map.place(c)) / unit_s_;
      const auto flight = static_cast<std::uint16_t>(std::min<double>(endless - 1, units));
      least_[i] = std::min(least_[i], flight);
      return flight;
    });
  });
}

/// Returns for each cell the time to hit a set when one of it is hit from here first.
Field Relaxed::arrived(std::size_t set) const {
  Field value(value_[0].size(), endless);
  for (std::size_t bit = 0; bit < chosen_.size(); ++bit) {
    if ((set >> bit & 1U) == 0) continue;
    const Field& then = value_[without(set, bit)];
    flight_[chosen_[bit]].each(
        [&](std::size_t c, std::uint16_t flight) { value[c] = std::min(value[c], sum(flight, then[c])); });
  }
  return value;
}

/// Adds the choice of driving first. A drive of length d takes, with speed v and acceleration a, no less
/// than the lesser of 2 d / v, the chord of the true time up to v^2 / a, and d / v + v / a, the time beyond.
/// On the move, no less than d / v.
void Relaxed::drive(Field& value) const {
  if (on_the_move_) {
    lattice_.lower(value, 1);
    return;
  }
  Field driven = value;
  lattice_.lower(driven, 1);
  for (std::size_t c = 0; c < value.size(); ++c) driven[c] = std::min(value[c], sum(driven[c], overhead_));
  lattice_.lower(value, 2, &driven);
  for (std::size_t c = 0; c < value.size(); ++c) value[c] = std::min(value[c], driven[c]);
}

bool Relaxed::choose(std::size_t index, BudgetMeter& meter, const std::stop_token& stop) {
  const std::size_t half = value_.size();
  for (std::size_t i = 0; i < half; ++i) {
    if (!meter.spend()) return false;
  }
  chosen_.push_back(index);
  value_.resize(2 * half);
  std::vector<std::vector<std::size_t>> by_size(chosen_.size() + 1);
  for (std::size_t set = half; set < 2 * half; ++set) {
    by_size[static_cast<std::size_t>(std::popcount(set))].push_back(set);
  }
  for (const auto& sets : by_size) {
    const bool done = parallel_for(sets.size(), stop, [&](std::size_t i) {
      value_[sets[i]] = arrived(sets[i]);
      drive(value_[sets[i]]);
    });
    if (done) continue;
    chosen_.pop_back();
    value_.resize(half);
    return false;
  }
  return true;
}

/// From below, the time to hit a set from the start. On the move, the robot shoots anywhere in a cell rather
/// than at its centre.
double Relaxed::value_s(std::size_t set, std::size_t home, double to_home_s) const {
  const double time = value_[set][home] * unit_s_ - to_home_s;
  return on_the_move_ ? on_the_move_s(time - std::popcount(set) * aside_s_) : time;
}

std::vector<double> Relaxed::values_from(Vec2 start) const {
  const auto [home, nearest] = nearest_cell(frame_, start);
  std::vector<double> values;
  values.reserve(value_.size());
  for (std::size_t set = 0; set < value_.size(); ++set)
    values.push_back(std::max(0.0, value_s(set, home, 2.0 * nearest / straight_.speed)));
  values.front() = 0.0;
  return values;
}

/// The time of a drive that takes `driven_s` at full speed, and speeds up once.
double Relaxed::on_the_move_s(double driven_s) const {
  const double way = std::max(0.0, driven_s) * straight_.speed;
  const double speed_up_m = 0.5 * straight_.speed * straight_.speed / straight_.acceleration;
  return way < speed_up_m ? std::sqrt(2.0 * way / straight_.acceleration)
                          : (way + speed_up_m) / straight_.speed;
}

/// The best of the sets: its value, and the least flights of all other targets.
double Relaxed::bound_s() const {
  std::uint64_t all = 0;
  for (const std::uint16_t flight : least_) all += flight;
  double best = static_cast<double>(all) * unit_s_;
  for (std::size_t set = 1; set < value_.size(); ++set) {
    std::uint64_t others = all;
    for (std::size_t bit = 0; bit < chosen_.size(); ++bit) {
      if ((set >> bit & 1U) != 0) others -= least_[chosen_[bit]];
    }
    best = std::max(best, static_cast<double>(others) * unit_s_ + value_s(set));
  }
  return best;
}

/// The cells where a best relaxed mission over all chosen targets stops, its first cell included.
std::vector<std::size_t> Relaxed::stops() const {
  std::vector<std::size_t> cells{home_};
  for (std::size_t set = value_.size() - 1; set != 0;) {
    Field way(value_[0].size(), endless);
    way[cells.back()] = 0;
    drive(way);
    const Field after = arrived(set);
    std::size_t next = cells.back();
    for (std::size_t c = 0; c < after.size(); ++c) {
      if (sum(way[c], after[c]) < sum(way[next], after[next])) next = c;
    }
    if (next != cells.back()) cells.push_back(next);
    std::size_t hit = 0;
    while ((set >> hit & 1U) == 0 ||
           sum(flight_[chosen_[hit]][next], value_[without(set, hit)][next]) != after[next]) {
      ++hit;
    }
    set = without(set, hit);
  }
  return cells;
}

std::optional<std::size_t> Relaxed::hardest() const {
  Field way(value_[0].size(), endless);
  for (const std::size_t cell : stops()) way[cell] = 0;
  drive(way);
  std::optional<std::size_t> index;
  std::uint16_t most = 0;
  for (std::size_t i = 0; i < flight_.size(); ++i) {
    if (is_chosen(i)) continue;
    std::uint16_t least = endless;
    flight_[i].each(
        [&](std::size_t c, std::uint16_t flight) { least = std::min(least, sum(way[c], flight)); });
    const auto more = static_cast<std::uint16_t>(least - least_[i]);
    if (more > most) {
      most = more;
      index = i;
    }
  }
  return index;
}

double bound_memory_bytes(const GuardOptions& options) {
  return (options.prove ? 0.5 : 0.25) * static_cast<double>(options.memory_mib) * 1048576.0;
}

Relaxed relaxed_mission(const GuardProblem& problem, const FiringMap& firing_map,
                        const std::vector<std::size_t>& targets, const GuardOptions& options,
                        const Budget& budget) {
  const std::size_t most = options.prove ? most_chosen : usual_chosen;
  const double field = sizeof(std::uint16_t) * static_cast<double>(firing_map.frame.size());
  BudgetMeter meter(budget);
  Relaxed relaxed(problem, firing_map, targets, options.shoot_on_the_move);
  while (relaxed.chosen().size() < most &&
         std::ldexp(field, static_cast<int>(relaxed.chosen().size()) + 1) <= bound_memory_bytes(options)) {
    const auto next = relaxed.hardest();
    if (!next || !relaxed.choose(*next, meter, budget.stop)) break;
  }
  return relaxed;
}

}  // namespace outrider
