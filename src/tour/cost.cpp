#include <algorithm>
#include <cmath>
#include <limits>

#include "outrider/core/units.hpp"
#include "outrider/tour/problem.hpp"

namespace outrider {

double cost(const TourProblem& problem, const std::vector<Visit>& visits) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  std::size_t stop = 0;
  double heading = problem.heading_rad;
  double relative_yaw = 0.0;
  double pitch = 0.0;
  double time = 0.0;
  for (const Visit& visit : visits) {
    if (visit.stop >= problem.services.size()) return infinity;
    if (visit.stop != stop) {
      const Drive& drive = problem.drives[stop * problem.services.size() + visit.stop];
      if (!std::isfinite(drive.time_s)) return infinity;
      if (drive.time_s > 0.0) {
        time += duration(std::abs(wrap_angle(drive.departure_rad - heading)), problem.turning) + drive.time_s;
        heading = drive.arrival_rad;
      }
      stop = visit.stop;
    }
    for (const std::uint32_t goal : visit.goals) {
      const auto& here = problem.services[stop];
      const auto service = std::ranges::find(here, goal, &Service::goal);
      if (service == here.end()) return infinity;
      const double needed_yaw = service->yaw_rad - heading;
      time += std::max(std::abs(wrap_angle(needed_yaw - relative_yaw)) / problem.yaw_rate_radps,
                       std::abs(service->pitch_rad - pitch) / problem.pitch_rate_radps);
      time += service->duration_s;
      relative_yaw = needed_yaw;
      pitch = service->pitch_rad;
    }
  }
  return time;
}

}  // namespace outrider
