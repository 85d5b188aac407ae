#include "motion/sampled_motion.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "outrider/core/rng.hpp"

namespace outrider {
namespace {

constexpr double step_s = 0.05;          // of a prediction
constexpr std::size_t steps_a_knot = 4;  // for which a command holds
constexpr std::size_t most_knots = 50;
constexpr std::size_t noises = 1024;   // sequences drawn once
constexpr std::size_t fallbacks = 12;  // sampled motions that are tried if the mean cannot brake
constexpr double temperature_s = 0.1;
constexpr double touch_s = 1000.0;          // cost of touching something
constexpr double no_way_s = 500.0;          // cost of an end from which no way is known
constexpr double backwards_weight = 1.0;    // seconds that a second at full speed backwards costs
constexpr double speed_noise = 0.35;        // standard deviation, parts of full speed
constexpr double turn_noise = 0.6;          // the same of the turn rate
constexpr double kept_noise = 0.6;          // part of the noise that the next knot keeps
constexpr double moving_wide_m = 0.5;       // beside what moves, beyond which more room is worth nothing
constexpr double moving_drift_mps = 0.1;    // by which what moves may come nearer than predicted
constexpr double moving_weight = 3.0;       // seconds that a second without that room costs
constexpr double moving_touch_weight = 50;  // the same where it would be touched, at full speed
constexpr double change_weight = 0.02;      // seconds that it costs to change the command by the whole range

/// The commands of a motion, one for each knot.
struct Commands {
  std::array<Twist2, most_knots> at{};
};

/// A point of a turn by which the heading is kept as a direction: rotates by an angle with an error of its
/// third power, without sines.
Vec2 turned(Vec2 along, double angle_rad) {
  const double half = 0.5 * angle_rad, scale = 1.0 / (1.0 + half * half);
  const double c = (1.0 - half * half) * scale, s = 2.0 * half * scale;
  return {c * along.x - s * along.y, s * along.x + c * along.y};
}

class SampledMotion final : public LocalMotion {
 public:
  explicit SampledMotion(const LocalMotionOptions& options)
      : options_(options),
        knots_(std::clamp<std::size_t>(
            static_cast<std::size_t>(std::lround(options.horizon_s / (step_s * steps_a_knot))), 1,
            most_knots)) {
    Rng rng(1);
    noise_.resize(noises);
    for (Commands& one : noise_) {
      Twist2 last;
      for (std::size_t k = 0; k < knots_; ++k) {
        const double fresh = std::sqrt(1.0 - kept_noise * kept_noise);
        last = {kept_noise * last.ahead_mps + fresh * rng.normal(), 0.0,
                kept_noise * last.turn_radps + fresh * rng.normal()};
        one.at[k] = last;
      }
    }
  }

  Twist2 choose(const MotionState& state) override {
    shift(state.period_s);
    least_ahead_ = state.may_back ? -0.5 : 0.0;
    for (Twist2& twist : plan_.at) twist = within_limits(twist, state.robot);
    const double gap_m = state.near.gap(state.footprint, state.pose, options_.wide_m);
    least_m_ = std::min(options_.margin_m, gap_m - 1e-3);
    MotionState close = state;
    keep_close(state);
    close.moving = &close_;
    for (std::int64_t round = 0; round < options_.rounds; ++round) improve(close, round == 0);
    return passing(close);
  }

 private:
  struct Sample {
    Commands commands;
    double cost_s = 0.0;
  };

  /// Keeps of what moves that which may come near within the horizon, or until the robot has braked.
  void keep_close(const MotionState& state) {
    close_.clear();
    if (state.moving == nullptr) return;
    const RobotModel& robot = state.robot;
    const double fastest_mps = std::max(robot.speed_mps, std::abs(state.twist.ahead_mps));
    const double until_s = step_s * static_cast<double>(knots_ * steps_a_knot) + state.period_s +
                           fastest_mps / robot.acceleration_mps2;
    for (const MovingThing& thing : *state.moving) {
      const double meets_m = (fastest_mps + norm(thing.velocity) + moving_drift_mps) * until_s;
      const double reach_m = meets_m + moving_wide_m + thing.radius_m + state.footprint.outer_m();
      if (distance(thing.place, state.pose.position) <= reach_m) close_.push_back(thing);
    }
  }

  /// The plan of the last period goes on from its next moment.
  void shift(double period_s) {
    elapsed_s_ += period_s;
    for (; elapsed_s_ >= step_s * steps_a_knot; elapsed_s_ -= step_s * steps_a_knot) {
      for (std::size_t k = 0; k + 1 < knots_; ++k) plan_.at[k] = plan_.at[k + 1];
    }
  }

  [[nodiscard]] Twist2 within_limits(const Twist2& twist, const RobotModel& robot) const {
    return {std::clamp(twist.ahead_mps, least_ahead_ * robot.speed_mps, robot.speed_mps), 0.0,
            std::clamp(twist.turn_radps, -robot.turn_rate_radps, robot.turn_rate_radps)};
  }

  /// Adds motions with one command throughout: to stand, to turn, and arcs.
  void add_arcs(const RobotModel& robot) {
    for (const double ahead : {0.0, 0.3, 0.65, 1.0, -0.25}) {
      if (ahead < least_ahead_) continue;
      for (const double turn : {-1.0, -0.4, 0.0, 0.4, 1.0}) {
        Sample& sample = samples_.emplace_back();
        sample.commands.at.fill({ahead * robot.speed_mps, 0.0, turn * robot.turn_rate_radps});
      }
    }
  }

  void improve(const MotionState& state, bool first) {
    const RobotModel& robot = state.robot;
    samples_.clear();
    samples_.push_back({plan_});
    if (first) add_arcs(robot);
    for (std::int64_t i = 0; i < options_.samples; ++i) {
      const Commands& noise = noise_[next_noise_++ % noises];
      Sample& sample = samples_.emplace_back();
      for (std::size_t k = 0; k < knots_; ++k) {
        const Twist2& mean = plan_.at[k];
        sample.commands.at[k] =
            within_limits({mean.ahead_mps + speed_noise * robot.speed_mps * noise.at[k].ahead_mps, 0.0,
                           mean.turn_radps + turn_noise * robot.turn_rate_radps * noise.at[k].turn_radps},
                          robot);
      }
    }
    for (Sample& sample : samples_) sample.cost_s = cost_of(state, sample.commands);
    take_mean(state);
  }

  /// Sets the plan to the mean of the samples, weighted by how good they are; to the best if that is better.
  void take_mean(const MotionState& state) {
    const Sample& best = *std::ranges::min_element(samples_, {}, &Sample::cost_s);
    Commands mean;
    double sum = 0.0;
    for (const Sample& sample : samples_) {
      const double weight = std::exp((best.cost_s - sample.cost_s) / temperature_s);
      if (weight < 1e-6) continue;
      sum += weight;
      for (std::size_t k = 0; k < knots_; ++k) mean.at[k] = mean.at[k] + weight * sample.commands.at[k];
    }
    for (std::size_t k = 0; k < knots_; ++k) mean.at[k] = (1.0 / sum) * mean.at[k];
    const double mean_cost_s = cost_of(state, mean);
    const bool takes_mean = mean_cost_s <= best.cost_s + temperature_s;
    plan_ = takes_mean ? mean : best.commands;
    plan_cost_s_ = takes_mean ? mean_cost_s : best.cost_s;
  }

  /// Returns the cost of a motion, s: the time that it leaves to the goal, and what it costs on the way.
  double cost_of(const MotionState& state, const Commands& commands) const {
    const RobotModel& robot = state.robot;
    Vec2 place = state.pose.position, along = direction(state.pose.heading_rad);
    Twist2 twist = state.twist;
    double cost_s = 0.0;
    double gap_m = std::numeric_limits<double>::infinity();  // unknown
    const std::size_t steps = knots_ * steps_a_knot;
    const auto passed = static_cast<std::size_t>(elapsed_s_ / step_s);  // of the first knot
    for (std::size_t step = 0; step < steps; ++step) {
      const std::size_t knot = std::min((step + passed) / steps_a_knot, knots_ - 1);
      const Twist2 next = twist_after(twist, commands.at[knot], robot, step_s);
      const double way_m = 0.5 * (twist.ahead_mps + next.ahead_mps) * step_s;
      const double turn_rad = 0.5 * (twist.turn_radps + next.turn_radps) * step_s;
      const Vec2 middle = turned(along, 0.5 * turn_rad);
      place = place + way_m * middle;
      along = turned(along, turn_rad);
      twist = next;

      const double room_m = state.near.clearance(place);
      const double outer_m = state.footprint.outer_m();
      const double before_m = gap_m;
      gap_m = room_m - outer_m;
      if (gap_m < least_m_ + 0.01)  // the disk around the robot touches: ask the footprint
        gap_m = room_m < state.footprint.inner_m() - 0.01
                    ? -1.0
                    : state.near.gap(state.footprint, {place, heading_of(along)}, options_.wide_m);
      const double moved_m = std::abs(way_m) + outer_m * std::abs(turn_rad);
      if (gap_m < least_m_ || std::min(before_m, 1.0) + gap_m < moved_m)
        return touch_s + cost_s + step_s * static_cast<double>(steps - step) * 10.0;

      const double beside_m = room_m - state.footprint.inner_m();
      const double narrow =
          std::max(0.0, 1.0 - beside_m / (options_.wide_m + outer_m - state.footprint.inner_m()));
      const double speed = std::abs(next.ahead_mps) / robot.speed_mps;
      cost_s += step_s * (options_.room_weight * narrow * narrow * (0.1 + speed) +
                          (next.ahead_mps < 0.0 ? backwards_weight * speed : 0.0));
      if (state.moving != nullptr && !state.moving->empty()) {
        const double after_s = step_s * static_cast<double>(step + 1);
        const double sure_m = state.moving_gap({place, heading_of(along)}, after_s, moving_wide_m, false) -
                              moving_drift_mps * after_s;
        if (sure_m < 0.0) cost_s += step_s * moving_touch_weight * (0.1 + speed);
        const double tight = std::clamp(1.0 - sure_m / moving_wide_m, 0.0, 1.0);
        cost_s += step_s * moving_weight * tight * tight;
      }
      if (distance(place, state.goal) < state.within_m)
        return cost_s - step_s * static_cast<double>(steps - step);
    }
    return cost_s + changes(state, commands) + time_left(state, place, along);
  }

  [[nodiscard]] double changes(const MotionState& state, const Commands& commands) const {
    double sum = 0.0;
    Twist2 last = state.twist;
    for (std::size_t k = 0; k < knots_; ++k) {
      const double ahead = (commands.at[k].ahead_mps - last.ahead_mps) / state.robot.speed_mps;
      const double turn = (commands.at[k].turn_radps - last.turn_radps) / state.robot.turn_rate_radps;
      sum += ahead * ahead + turn * turn;
      last = commands.at[k];
    }
    return change_weight * sum;
  }

  /// Returns the time from a place to the goal, with a turn in place as far as the way begins behind.
  [[nodiscard]] static double time_left(const MotionState& state, Vec2 place, Vec2 along) {
    const auto left_s = state.field.time_s(place);
    if (!left_s) return no_way_s + distance(place, state.goal) / state.robot.speed_mps;
    const auto down = state.field.downhill(place);
    if (!down) return *left_s;
    const double off_rad = std::abs(std::atan2(cross(along, *down), dot(along, *down)));
    return *left_s + off_rad / state.robot.turn_rate_radps * std::min(1.0, off_rad);
  }

  /// Returns the plan if the robot can brake after its first command, else the best sample of that kind.
  Twist2 passing(const MotionState& state) {
    if (plan_cost_s_ < touch_s && can_brake(state, plan_.at[0], options_.margin_m)) return plan_.at[0];
    const std::size_t count = std::min(fallbacks, samples_.size());
    std::ranges::partial_sort(samples_, samples_.begin() + static_cast<std::ptrdiff_t>(count), {},
                              &Sample::cost_s);
    for (std::size_t i = 0; i < count; ++i) {
      if (samples_[i].cost_s >= touch_s || !can_brake(state, samples_[i].commands.at[0], options_.margin_m))
        continue;
      plan_ = samples_[i].commands;
      return plan_.at[0];
    }
    for (const double part : {0.6, 0.3, 0.0}) {
      const Twist2 slower{part * plan_.at[0].ahead_mps, 0.0, plan_.at[0].turn_radps};
      if (can_brake(state, slower, options_.margin_m)) return slower;
    }
    plan_ = {};
    return {};
  }

  LocalMotionOptions options_;
  std::size_t knots_;
  std::vector<Commands> noise_;
  std::size_t next_noise_ = 0;
  Commands plan_;
  double plan_cost_s_ = 0.0;
  double elapsed_s_ = 0.0;    // of the first knot of the plan
  double least_m_ = 0.0;      // gap that a motion keeps now
  double least_ahead_ = 0.0;  // least speed, part of full speed
  std::vector<Sample> samples_;
  std::vector<MovingThing> close_;  // that may come near
};

}  // namespace

std::unique_ptr<LocalMotion> make_sampled_motion(const LocalMotionOptions& options) {
  return std::make_unique<SampledMotion>(options);
}

}  // namespace outrider
