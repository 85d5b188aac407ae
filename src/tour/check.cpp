#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "outrider/core/text.hpp"
#include "outrider/tour/problem.hpp"

namespace outrider {
namespace {

constexpr std::size_t most_goals = 4096;
constexpr std::size_t most_stops = 4096;

bool rate_is_good(double rate) { return std::isfinite(rate) && rate > 0.0; }

Status check_sizes(const TourProblem& problem) {
  const std::size_t stops = problem.services.size();
  if (problem.goals > most_goals) {
    return bad_input(fmt::format("{} goals are too many; give at most {}", problem.goals, most_goals));
  }
  if (stops == 0 || stops > most_stops) {
    return bad_input(
        fmt::format("{} stops cannot be planned; give the start and at most {} more", stops, most_stops - 1));
  }
  if (problem.drives.size() != stops * stops) {
    return bad_input(fmt::format("{} drives do not fit {} stops; give {}, row by row", problem.drives.size(),
                                 stops, stops * stops));
  }
  return {};
}

Status check_rates(const TourProblem& problem) {
  if (!std::isfinite(problem.heading_rad)) {
    return bad_input(fmt::format("the heading {} at the start is not a finite angle", problem.heading_rad));
  }
  if (!rate_is_good(problem.turning.speed) || !(problem.turning.acceleration > 0.0)) {
    return bad_input(fmt::format("turning limits {} rad/s and {} rad/s2 are not valid; give positive numbers",
                                 problem.turning.speed, problem.turning.acceleration));
  }
  if (!rate_is_good(problem.yaw_rate_radps) || !rate_is_good(problem.pitch_rate_radps)) {
    return bad_input(
        fmt::format("gun rates {} rad/s (yaw) and {} rad/s (pitch) are not valid; give positive numbers",
                    problem.yaw_rate_radps, problem.pitch_rate_radps));
  }
  return {};
}

Status check_services(const TourProblem& problem) {
  std::vector<std::size_t> seen(problem.goals, problem.services.size());
  for (std::size_t stop = 0; stop < problem.services.size(); ++stop) {
    for (const Service& service : problem.services[stop]) {
      if (service.goal >= problem.goals) {
        return bad_input(fmt::format("stop {} serves goal {}, but there are only {} goals, counted from 0",
                                     stop, service.goal, problem.goals));
      }
      if (std::exchange(seen[service.goal], stop) == stop) {
        return bad_input(fmt::format("stop {} serves goal {} twice; keep one service", stop, service.goal));
      }
      if (!std::isfinite(service.yaw_rad) || !std::isfinite(service.pitch_rad) ||
          !std::isfinite(service.duration_s) || service.duration_s < 0.0) {
        return bad_input(
            fmt::format("the service of goal {} from stop {} has yaw {}, pitch {} and duration {}; give "
                        "finite angles and a finite time that is not negative",
                        service.goal, stop, service.yaw_rad, service.pitch_rad, service.duration_s));
      }
    }
  }
  return {};
}

Status check_drives(const TourProblem& problem) {
  const std::size_t stops = problem.services.size();
  for (std::size_t i = 0; i < stops; ++i) {
    for (std::size_t j = 0; j < stops; ++j) {
      if (i == j) continue;
      const Drive& drive = problem.drives[i * stops + j];
      if (std::isnan(drive.time_s) || drive.time_s < 0.0 ||
          (std::isfinite(drive.time_s) &&
           (!std::isfinite(drive.departure_rad) || !std::isfinite(drive.arrival_rad)))) {
        return bad_input(
            fmt::format("the drive from stop {} to stop {} has time {} and headings {}, {}; give a time that "
                        "is not negative (infinite for none) and finite headings",
                        i, j, drive.time_s, drive.departure_rad, drive.arrival_rad));
      }
      const bool both_reached =
          (i == 0 || std::isfinite(problem.drives[i].time_s)) && std::isfinite(problem.drives[j].time_s);
      if (j != 0 && both_reached && std::isinf(drive.time_s)) {
        return bad_input(fmt::format(
            "the start reaches stops {} and {}, but there is no drive from the first to the second; "
            "give one to every pair of stops that can be reached",
            i, j));
      }
    }
  }
  return {};
}

Status check_goals_served(const TourProblem& problem, const Tour& tour) {
  std::vector<int> served(problem.goals, 0);
  for (const Visit& visit : tour.visits) {
    for (const std::uint32_t goal : visit.goals) {
      if (goal >= problem.goals) return bad_input(fmt::format("the tour serves goal {}, unknown", goal));
      ++served[goal];
    }
  }
  for (std::size_t goal = 0; goal < problem.goals; ++goal) {
    if (served[goal] != 1) {
      return bad_input(fmt::format("goal {} is served {} times; once is right", goal, served[goal]));
    }
  }
  return {};
}

}  // namespace

Status check(const TourProblem& problem) {
  for (const auto part : {check_sizes, check_rates, check_services, check_drives}) {
    if (Status status = part(problem); !status) return status;
  }
  return {};
}

Status check(const TourProblem& problem, const Tour& tour) {
  if (Status status = check_goals_served(problem, tour); !status) return status;
  for (std::size_t v = 0; v < tour.visits.size(); ++v) {
    if (tour.visits[v].goals.empty()) return bad_input(fmt::format("visit {} serves no goal", v));
    if (v > 0 && tour.visits[v].stop == tour.visits[v - 1].stop) {
      return bad_input(
          fmt::format("visits {} and {} are one visit to stop {}", v - 1, v, tour.visits[v].stop));
    }
  }
  const double time = cost(problem, tour.visits);
  if (!std::isfinite(time)) return bad_input("the tour uses a service or a drive that does not exist");
  const double tolerance = 1e-6 * std::max(1.0, time);
  if (!(std::abs(time - tour.cost_s) <= tolerance)) {
    return bad_input(fmt::format("the tour takes {} s, not the {} s that it states", short_number(time),
                                 short_number(tour.cost_s)));
  }
  if (!(tour.lower_bound_s <= time + tolerance)) {
    return bad_input(fmt::format("the tour takes {} s, less than its lower bound of {} s", short_number(time),
                                 short_number(tour.lower_bound_s)));
  }
  if (tour.proven_optimal && tour.lower_bound_s < time - tolerance) {
    return bad_input(fmt::format("the tour is called optimal, but takes {} s and its lower bound is {} s",
                                 short_number(time), short_number(tour.lower_bound_s)));
  }
  return {};
}

}  // namespace outrider
