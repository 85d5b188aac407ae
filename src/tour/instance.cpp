#include "instance.hpp"

#include <fmt/format.h>

namespace outrider::tour {
namespace {

void keep_useful_stops(const TourProblem& problem, const std::vector<std::size_t>& kept, Instance& instance) {
  for (std::size_t s = 0; s < problem.services.size(); ++s) {
    const bool wanted = !problem.services[s].empty() || std::ranges::find(kept, s) != kept.end();
    const bool useful = std::isfinite(problem.drives[s].time_s) && wanted;
    if (s == 0 || useful) instance.stop_name.push_back(s);
  }
  instance.stops = static_cast<std::uint32_t>(instance.stop_name.size());
}

void fill_drives(const TourProblem& problem, Instance& instance) {
  const std::size_t all = problem.services.size();
  const std::size_t size = std::size_t{instance.stops} * instance.stops;
  instance.time.assign(size, infinity);
  instance.time_to.assign(size, infinity);
  instance.depart.assign(size, 0.0);
  instance.arrive.assign(size, 0.0);
  for (std::uint32_t i = 0; i < instance.stops; ++i) {
    for (std::uint32_t j = 0; j < instance.stops; ++j) {
      const Drive& drive = problem.drives[instance.stop_name[i] * all + instance.stop_name[j]];
      if (i == j || !std::isfinite(drive.time_s)) continue;
      instance.time[instance.arc(i, j)] = drive.time_s;
      instance.time_to[instance.arc(j, i)] = drive.time_s;
      instance.depart[instance.arc(i, j)] = wrap_angle(drive.departure_rad);
      instance.arrive[instance.arc(i, j)] = wrap_angle(drive.arrival_rad);
    }
  }
}

void fill_nodes(const TourProblem& problem, Instance& instance) {
  instance.node_at.assign(std::size_t{instance.stops} * instance.goals, none);
  instance.nodes_of.resize(instance.goals);
  instance.stops_of.resize(instance.goals);
  for (std::uint32_t s = 0; s < instance.stops; ++s) {
    instance.first.push_back(static_cast<std::uint32_t>(instance.nodes.size()));
    for (const Service& service : problem.services[instance.stop_name[s]]) {
      const auto node = static_cast<std::uint32_t>(instance.nodes.size());
      instance.node_at[std::size_t{s} * instance.goals + service.goal] = node;
      instance.nodes_of[service.goal].push_back(node);
      instance.stops_of[service.goal].push_back(s);
      instance.nodes.push_back(
          {s, service.goal, wrap_angle(service.yaw_rad), service.pitch_rad, service.duration_s});
    }
  }
  instance.first.push_back(static_cast<std::uint32_t>(instance.nodes.size()));
}

}  // namespace

Outcome<Instance> compile(const TourProblem& problem, const std::vector<std::size_t>& kept) {
  Instance instance;
  instance.goals = static_cast<std::uint32_t>(problem.goals);
  instance.heading = wrap_angle(problem.heading_rad);
  instance.turning = problem.turning;
  instance.yaw_rate = problem.yaw_rate_radps;
  instance.pitch_rate = problem.pitch_rate_radps;
  keep_useful_stops(problem, kept, instance);
  fill_drives(problem, instance);
  fill_nodes(problem, instance);
  for (std::uint32_t goal = 0; goal < instance.goals; ++goal) {
    if (instance.nodes_of[goal].empty()) {
      return fault(
          FaultCode::no_path,
          fmt::format("no stop that can be reached serves goal {}; leave it out or add a stop", goal));
    }
  }
  return instance;
}

}  // namespace outrider::tour
