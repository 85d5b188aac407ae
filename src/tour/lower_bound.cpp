#include "lower_bound.hpp"

#include "relaxation.hpp"

namespace outrider::tour {
namespace {

constexpr double most_work = 4e8;          // of one relaxation
constexpr std::uint32_t most_stops = 768;  // for the shortest chains, O(stops^3)

/// Drives by way of any other stops, so that leaving goals out never makes a tour slower. The way from
/// a stop to itself is a round trip. Floyd and Warshall's algorithm.
RelaxedDrives shortest_chains(const Instance& instance) {
  RelaxedDrives drives = sectored(instance, 1);
  const std::size_t stops = instance.stops;
  for (std::size_t via = 0; via < stops; ++via) {
    const float* onto = &drives.time_to[via * stops];
    for (std::size_t to = 0; to < stops; ++to) {
      float* row = &drives.time_to[to * stops];
      const float last = row[via];
      if (to == via || last == std::numeric_limits<float>::infinity()) continue;
      for (std::size_t from = 0; from < stops; ++from) {
        const float time = onto[from] + last;
        row[from] = time < row[from] ? time : row[from];
      }
    }
  }
  return drives;
}

/// Time from the start to each stop, the first turn included.
std::vector<float> first_drives(const Instance& instance, const RelaxedDrives& drives) {
  std::vector<float> time(instance.stops, std::numeric_limits<float>::infinity());
  for (std::uint32_t first = 1; first < instance.stops; ++first) {
    State state = start_of(instance);
    const auto leg = static_cast<float>(drive(instance, state, first));
    for (std::uint32_t to = 0; to < instance.stops; ++to) {
      const float onward = to == first ? 0.0F : drives.time_to[std::size_t{to} * instance.stops + first];
      time[to] = std::min(time[to], leg + onward);
    }
  }
  return time;
}

struct RelaxedTour {
  double cost = infinity;
  std::vector<std::uint32_t> stops;
};

/// Reads the tour out of the relaxation: at each step the choice of least value. A service that is chosen
/// stays at the stop; a drive is followed by a service.
RelaxedTour read_tour(const Instance& instance, const Relaxation& r, const RelaxedDrives& drives,
                      const std::vector<float>& from_start) {
  RelaxedTour tour;
  std::uint32_t set = (1U << r.goals.size()) - 1;
  std::uint32_t stop = 0;
  float value = r.arrived[r.index(set, 0, 0)];
  for (std::uint32_t s = 0; s < r.stops; ++s) {
    const float there = from_start[s] + r.arrived[r.index(set, s, 0)];
    if (there < value) {
      value = there;
      stop = s;
    }
  }
  tour.cost = static_cast<double>(value);
  tour.stops = {stop};
  bool just_arrived = true;
  while (set != 0) {
    std::uint32_t best_set = set;
    std::uint32_t best_stop = stop;
    float least = std::numeric_limits<float>::infinity();
    for (std::uint32_t bits = set & r.covered[stop]; bits != 0; bits &= bits - 1) {
      const auto bit = static_cast<std::uint32_t>(std::countr_zero(bits));
      const std::uint32_t node = instance.node(stop, r.goals[bit]);
      const std::uint32_t rest = set & ~(1U << bit);
      const float time = static_cast<float>(instance.nodes[node].duration) +
                         r.served[r.index(rest, stop, 0)] + (just_arrived ? 0.0F : r.least_aim[node]);
      if (time < least) {
        least = time;
        best_set = rest;
      }
    }
    for (std::uint32_t to = 0; to < r.stops && !just_arrived; ++to) {
      if ((r.covered[to] & set) == 0) continue;
      const float time = drives.time_to[std::size_t{to} * r.stops + stop] + r.arrived[r.index(set, to, 0)];
      if (time < least) {
        least = time;
        best_set = set;
        best_stop = to;
      }
    }
    just_arrived = best_set == set;
    if (just_arrived) tour.stops.push_back(best_stop);
    set = best_set;
    stop = best_stop;
  }
  return tour;
}

/// How far out of its way the tour would go for the goal; 0 when it comes by.
double detour(const Instance& instance, const RelaxedDrives& drives, const std::vector<float>& from_start,
              const std::vector<std::uint32_t>& stops, std::uint32_t goal) {
  const auto drive = [&](std::uint32_t from, std::uint32_t to) {
    return from == to ? 0.0F : drives.time_to[std::size_t{to} * instance.stops + from];
  };
  float least = std::numeric_limits<float>::infinity();
  for (const std::uint32_t node : instance.nodes_of[goal]) {
    const std::uint32_t stop = instance.nodes[node].stop;
    if (stop == 0) return 0.0;
    if (stops.empty()) {
      least = std::min(least, from_start[stop]);
      continue;
    }
    least = std::min(
        {least, from_start[stop] + drive(stop, stops[0]) - from_start[stops[0]], drive(stops.back(), stop)});
    for (std::size_t i = 1; i < stops.size(); ++i) {
      least =
          std::min(least, drive(stops[i - 1], stop) + drive(stop, stops[i]) - drive(stops[i - 1], stops[i]));
    }
    for (const std::uint32_t by : stops) least = by == stop ? 0.0F : least;
  }
  return static_cast<double>(least);
}

/// The goal outside of `chosen` with the greatest detour; none when the tour comes by them all.
std::uint32_t farthest_goal(const Instance& instance, const RelaxedDrives& drives,
                            const std::vector<float>& from_start, const std::vector<std::uint32_t>& stops,
                            const std::vector<std::uint32_t>& chosen) {
  std::uint32_t farthest = none;
  double greatest = 0.0;
  for (std::uint32_t goal = 0; goal < instance.goals; ++goal) {
    if (std::ranges::find(chosen, goal) != chosen.end()) continue;
    const double way = detour(instance, drives, from_start, stops, goal);
    if (way <= greatest) continue;
    greatest = way;
    farthest = goal;
  }
  return farthest;
}

std::vector<double> least_durations(const Instance& instance) {
  std::vector<double> least(instance.goals, infinity);
  for (const Node& node : instance.nodes) least[node.goal] = std::min(least[node.goal], node.duration);
  return least;
}

}  // namespace

double lower_bound(const Instance& instance, const TourOptions& options, BudgetMeter& meter) {
  const std::vector<double> durations = least_durations(instance);
  double outside = 0.0;  // least durations of the goals not toured
  for (const double duration : durations) outside += duration;
  double bound = outside;
  if (instance.stops > most_stops) return bound;
  const RelaxedDrives drives = shortest_chains(instance);
  const std::vector<float> from_start = first_drives(instance, drives);
  std::vector<std::uint32_t> chosen;
  std::vector<std::uint32_t> stops;
  while (chosen.size() < static_cast<std::size_t>(options.bound_goals)) {
    const std::uint32_t goal = farthest_goal(instance, drives, from_start, stops, chosen);
    if (goal == none) break;
    chosen.push_back(goal);
    outside -= durations[goal];
    const double work =
        std::ldexp(static_cast<double>(instance.stops) * instance.stops, static_cast<int>(chosen.size()));
    if (work > most_work) break;
    const auto relaxation = relax(instance, chosen, drives, meter);
    if (!relaxation) break;
    RelaxedTour tour = read_tour(instance, *relaxation, drives, from_start);
    bound = std::max(bound, tour.cost * rounded_down + outside);
    stops = std::move(tour.stops);
  }
  return bound;
}

}  // namespace outrider::tour
