// Instance: the tour problem as the solvers want it. Stops that cannot be reached or serve nothing are
// left out, tables are flat, angles wrapped, and a service is a node: (stop, goal, aim, duration).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "outrider/core/units.hpp"
#include "outrider/tour/problem.hpp"

namespace outrider::tour {

inline constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
inline constexpr double infinity = std::numeric_limits<double>::infinity();

struct TourNode {
  std::uint32_t stop = 0;
  std::uint32_t goal = 0;
  double yaw = 0.0;
  double pitch = 0.0;
  double duration = 0.0;
};

struct Instance {
  std::uint32_t goals = 0;
  std::uint32_t stops = 0;  // the start, stop 0, included
  double heading = 0.0;
  Limits turning;
  double yaw_rate = 1.0;
  double pitch_rate = 1.0;
  std::vector<double> time, depart, arrive;          // [from * stops + to]
  std::vector<double> time_to;                       // [to * stops + from]
  std::vector<TourNode> nodes;                       // by stop
  std::vector<std::uint32_t> first;                  // stop -> its first node; one more at the end
  std::vector<std::vector<std::uint32_t>> nodes_of;  // goal -> nodes, by stop
  std::vector<std::vector<std::uint32_t>> stops_of;  // goal -> the stops of those nodes
  std::vector<std::uint32_t> node_at;                // [stop * goals + goal], or none
  std::vector<std::size_t> stop_name;                // stop -> index in the problem

  [[nodiscard]] std::uint32_t node(std::uint32_t stop, std::uint32_t goal) const {
    return node_at[std::size_t{stop} * goals + goal];
  }
  [[nodiscard]] std::size_t arc(std::uint32_t from, std::uint32_t to) const {
    return std::size_t{from} * stops + to;
  }
};

/// The problem has passed check(). The stops of `kept` stay though they serve nothing, unless the start does
/// not reach them. Fault no_path when a goal cannot be served.
Outcome<Instance> compile(const TourProblem& problem, const std::vector<std::size_t>& kept = {});

/// Least angle between two directions that differ by less than 4 pi as numbers.
inline double angle_between(double a, double b) {
  double gap = std::abs(a - b);
  if (gap > 2.0 * pi) gap -= 2.0 * pi;
  return gap > pi ? 2.0 * pi - gap : gap;
}

inline double turn_time(const Instance& instance, double from, double to) {
  return duration(angle_between(from, to), instance.turning);
}

inline double aim_time(const Instance& instance, double yaw_a, double pitch_a, double yaw_b, double pitch_b) {
  return std::max(angle_between(yaw_a, yaw_b) / instance.yaw_rate,
                  std::abs(pitch_a - pitch_b) / instance.pitch_rate);
}

/// The stop and heading of the robot, and the direction of its gun.
struct State {
  std::uint32_t stop = 0;
  double heading = 0.0;
  double yaw = 0.0;  // of the gun relative to the body
  double pitch = 0.0;

  friend bool operator==(const State&, const State&) = default;
};

inline State start_of(const Instance& instance) { return {0, instance.heading, 0.0, 0.0}; }

/// Drives to the stop, if the robot is not at its place already; the time it takes.
inline double drive(const Instance& instance, State& state, std::uint32_t stop) {
  if (stop == state.stop) return 0.0;
  const std::size_t arc = instance.arc(state.stop, stop);
  state.stop = stop;
  if (instance.time[arc] == 0.0) return 0.0;
  const double turn = turn_time(instance, state.heading, instance.depart[arc]);
  state.heading = instance.arrive[arc];
  return turn + instance.time[arc];
}

/// Drives to the stop of the node and serves it; the time it takes.
inline double advance(const Instance& instance, State& state, const TourNode& node) {
  const double driving = drive(instance, state, node.stop);
  const double yaw = node.yaw - state.heading;
  const double aiming = aim_time(instance, state.yaw, state.pitch, yaw, node.pitch);
  state.yaw = yaw;
  state.pitch = node.pitch;
  return driving + aiming + node.duration;
}

}  // namespace outrider::tour
