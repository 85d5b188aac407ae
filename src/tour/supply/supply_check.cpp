#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "outrider/core/units.hpp"
#include "outrider/tour/supply/supply.hpp"
#include "supply/supplied.hpp"

namespace outrider {
namespace {

bool is_amount(double value) { return std::isfinite(value) && value >= 0.0; }

Status check_rates(const SupplyProblem& problem) {
  for (const double full : {problem.water, problem.charge}) {
    if (!(full > 0.0)) {
      return bad_input(fmt::format("a full store of {} is not valid; give a positive number", full));
    }
  }
  for (const double rate : {problem.water_per_shot, problem.charge_per_metre, problem.charge_per_second,
                            problem.charge_per_shot}) {
    if (!is_amount(rate)) {
      return bad_input(
          fmt::format("a use of {} is not valid; give finite numbers that are not negative", rate));
    }
  }
  if (problem.water_per_shot > problem.water) {
    return bad_input(fmt::format("a tank of {:g} is too small for any shot, which takes {:g}", problem.water,
                                 problem.water_per_shot));
  }
  if (problem.charge_per_shot > problem.charge) {
    return bad_input(fmt::format("a battery of {:g} J is too small for any shot, which takes {:g} J",
                                 problem.charge, problem.charge_per_shot));
  }
  return {};
}

Status check_fillers(const SupplyProblem& problem) {
  for (std::size_t f = 0; f < problem.stations.size(); ++f) {
    const TourStation& station = problem.stations[f];
    if (station.stop >= problem.table.services.size() || !is_amount(station.fixed_s) ||
        !is_amount(station.per_unit_s)) {
      return bad_input(
          fmt::format("station {} is at stop {} and takes {} s and {} s a unit; give one of the {} stops and "
                      "times that are finite and not negative",
                      f, station.stop, station.fixed_s, station.per_unit_s, problem.table.services.size()));
    }
    if (std::isinf(station.store == Store::water ? problem.water : problem.charge)) {
      return bad_input(fmt::format("station {} fills a store that has no end; leave it out", f));
    }
  }
  return {};
}

Status check_lengths(const SupplyProblem& problem) {
  const auto& drives = problem.table.drives;
  if (problem.lengths_m.size() != drives.size()) {
    return bad_input(fmt::format("{} lengths do not fit {} drives", problem.lengths_m.size(), drives.size()));
  }
  for (std::size_t i = 0; i < drives.size(); ++i) {
    if (std::isfinite(drives[i].time_s) && !is_amount(problem.lengths_m[i])) {
      return bad_input(fmt::format("drive {} is {} m long; give finite lengths that are not negative", i,
                                   problem.lengths_m[i]));
    }
  }
  return {};
}

/// The robot of the model, followed step by step.
class Walk {
 public:
  explicit Walk(const SupplyProblem& problem)
      : problem_(problem),
        heading_(problem.table.heading_rad),
        now_{0.0, problem.water, problem.charge, 0.0} {}

  Status take(const SupplyStep& step) {
    now_.filling_s = 0.0;
    if (auto ok = drive_to(step.stop); !ok) return ok;
    if (step.station) return fill(step);
    for (const std::uint32_t goal : step.goals) {
      if (auto ok = serve(goal); !ok) return ok;
    }
    return {};
  }
  [[nodiscard]] const SupplyLevel& now() const { return now_; }

 private:
  static tl::unexpected<Fault> no(std::string sentence) {
    return fault(FaultCode::no_path, std::move(sentence));
  }
  [[nodiscard]] bool runs_dry() const {
    return now_.water < -tour::store_rounding * problem_.water ||
           now_.charge < -tour::store_rounding * problem_.charge;
  }
  void pass(double seconds) {
    now_.time_s += seconds;
    now_.charge -= problem_.charge_per_second * seconds;
  }
  [[nodiscard]] std::pair<double, double> way(std::size_t to) const {  // seconds, metres
    const std::size_t index = stop_ * problem_.table.services.size() + to;
    const Drive& drive = problem_.table.drives[index];
    if (to == stop_ || drive.time_s == 0.0) return {0.0, 0.0};
    const double turn = std::abs(wrap_angle(drive.departure_rad - heading_));
    return {duration(turn, problem_.table.turning) + drive.time_s, problem_.lengths_m[index]};
  }
  Status drive_to(std::size_t to) {
    if (to >= problem_.table.services.size()) return no(fmt::format("there is no stop {}", to));
    const auto [seconds, metres] = way(to);
    if (!std::isfinite(seconds)) return no(fmt::format("no drive leads from stop {} to stop {}", stop_, to));
    pass(seconds);
    now_.charge -= problem_.charge_per_metre * metres;
    if (seconds > 0.0)
      heading_ = problem_.table.drives[stop_ * problem_.table.services.size() + to].arrival_rad;
    stop_ = to;
    if (runs_dry()) return no(fmt::format("the battery runs out on the way to stop {}", to));
    return {};
  }
  void turn_gun(double yaw, double pitch) {
    pass(std::max(std::abs(wrap_angle(yaw - yaw_)) / problem_.table.yaw_rate_radps,
                  std::abs(pitch - pitch_) / problem_.table.pitch_rate_radps));
    yaw_ = yaw;
    pitch_ = pitch;
  }
  Status serve(std::uint32_t goal) {
    const auto& here = problem_.table.services[stop_];
    const auto service = std::ranges::find(here, goal, &Service::goal);
    if (service == here.end()) return no(fmt::format("stop {} does not serve goal {}", stop_, goal));
    turn_gun(service->yaw_rad - heading_, service->pitch_rad);
    pass(service->duration_s);
    now_.water -= problem_.water_per_shot;
    now_.charge -= problem_.charge_per_shot;
    if (runs_dry()) return no(fmt::format("the supplies run out while goal {} is served", goal));
    if (std::isfinite(now_.charge) && now_.charge < way_home() - tour::store_rounding * problem_.charge) {
      return no(fmt::format("after goal {} the charge does not suffice to get to a charger", goal));
    }
    return {};
  }
  [[nodiscard]] double way_home() const {
    double least = std::numeric_limits<double>::infinity();
    bool any = false;
    for (const TourStation& station : problem_.stations) {
      if (station.store != Store::charge || !std::isfinite(problem_.table.drives[station.stop].time_s))
        continue;
      any = true;
      const auto [seconds, metres] = way(station.stop);
      least = std::min(least, problem_.charge_per_second * seconds + problem_.charge_per_metre * metres);
    }
    return any ? least : 0.0;
  }
  Status fill(const SupplyStep& step) {
    if (*step.station >= problem_.stations.size() || problem_.stations[*step.station].stop != stop_) {
      return no(fmt::format("station {} is not at stop {}", *step.station, stop_));
    }
    const TourStation& station = problem_.stations[*step.station];
    turn_gun(0.0, 0.0);
    if (runs_dry()) return no(fmt::format("the battery runs out at station {}", *step.station));
    double& level = station.store == Store::water ? now_.water : now_.charge;
    const double full = station.store == Store::water ? problem_.water : problem_.charge;
    now_.filling_s = station.fixed_s + station.per_unit_s * (full - level);
    now_.time_s += now_.filling_s;
    level = full;
    return {};
  }

  const SupplyProblem& problem_;
  std::size_t stop_ = 0;
  double heading_;
  double yaw_ = 0.0;  // of the gun, relative to the body
  double pitch_ = 0.0;
  SupplyLevel now_;
};

}  // namespace

Status check(const SupplyProblem& problem) {
  if (auto ok = check(problem.table); !ok) return ok;
  for (const auto part : {check_rates, check_fillers, check_lengths}) {
    if (auto ok = part(problem); !ok) return ok;
  }
  return {};
}

Outcome<std::vector<SupplyLevel>> levels(const SupplyProblem& problem, const std::vector<SupplyStep>& steps) {
  Walk walk(problem);
  std::vector<SupplyLevel> after;
  for (const SupplyStep& step : steps) {
    if (auto ok = walk.take(step); !ok) return pass_on(ok);
    after.push_back(walk.now());
  }
  return after;
}

}  // namespace outrider
