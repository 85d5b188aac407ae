#include "plan/draft.hpp"

#include <algorithm>
#include <limits>

#include "outrider/ballistics/firing_region.hpp"
#include "outrider/core/parallel.hpp"

namespace outrider {
namespace {

constexpr double pitch_apart_rad = radians(5.0);  // of the pitches from which shots are looked for

/// A hit of the tour: its stop and target, and where the body points then.
struct Step {
  std::size_t stop = 0;
  std::uint32_t goal = 0;
  double heading_rad = 0.0;
  std::vector<PlannedShot> shots = {};  // to choose from
};

std::vector<Step> steps_of(const TourProblem& offered, const std::vector<Visit>& visits) {
  std::vector<Step> steps;
  double heading = offered.heading_rad;
  std::size_t at = 0;
  for (const Visit& visit : visits) {
    const Drive& drive = offered.drives[at * offered.services.size() + visit.stop];
    if (visit.stop != at && drive.time_s > 0.0) heading = drive.arrival_rad;
    at = visit.stop;
    for (const std::uint32_t goal : visit.goals) steps.push_back({visit.stop, goal, heading});
  }
  return steps;
}

/// The soonest shots from a gun that begins at one pitch or another, none less sure than `known`.
std::vector<PlannedShot> shots_like(const GuardProblem& problem, const FiringMap& firing_map,
                                    std::size_t target, Vec2 place, const PlannedShot& known) {
  std::vector<PlannedShot> shots{known};
  ShotRules coarse = firing_map.rules;
  coarse.pitch_step_rad = pitch_apart_rad;
  for (const double pitch : pitch_lattice(coarse)) {
    const auto shot = shot_from(problem, firing_map, target, place, pitch);
    if (!shot || shot->hit_rate < known.hit_rate) continue;
    const bool again = std::ranges::any_of(shots, [&](const PlannedShot& other) {
      return other.gun.pitch_rad == shot->gun.pitch_rad && other.gun.yaw_rad == shot->gun.yaw_rad;
    });
    if (!again) shots.push_back(*shot);
  }
  return shots;
}

/// A sequence of shots by its last one.
struct Label {
  double time_s = std::numeric_limits<double>::infinity();  // of aims and flights
  GunState gun;
  std::size_t before = 0;  // its index among the shots of the step before
};

/// The index of the shot to take at each step: the least sum of aims and flights, by dynamic programming.
std::vector<std::size_t> soonest(const GunModel& gun, const GuardOptions& options,
                                 const std::vector<Step>& steps) {
  std::vector<std::vector<Label>> layers{{{0.0, {}, 0}}};
  for (const Step& step : steps) {
    std::vector<Label> layer;
    for (const PlannedShot& shot : step.shots) {
      Label label{std::numeric_limits<double>::infinity(),
                  {wrap_angle(shot.gun.yaw_rad - step.heading_rad), shot.gun.pitch_rad},
                  0};
      for (std::size_t i = 0; i < layers.back().size(); ++i) {
        const Label& from = layers.back()[i];
        const double time =
            from.time_s + service_time(shot, options.shoot_on_the_move) +
            aim_time(gun, label.gun.yaw_rad - from.gun.yaw_rad, label.gun.pitch_rad - from.gun.pitch_rad);
        if (time < label.time_s) label.time_s = time, label.before = i;
      }
      layer.push_back(label);
    }
    layers.push_back(std::move(layer));
  }
  std::vector<std::size_t> chosen(steps.size());
  const auto& last = layers.back();
  auto at = static_cast<std::size_t>(std::ranges::min_element(last, {}, &Label::time_s) - last.begin());
  for (std::size_t k = steps.size(); k > 0; --k) {
    chosen[k - 1] = at;
    at = layers[k][at].before;
  }
  return chosen;
}

}  // namespace

void choose_shots(const GuardProblem& problem, const FiringMap& firing_map, const GuardOptions& options,
                  ShotBook& book, Draft& draft) {
  TourProblem& offered = draft.offered.table;
  std::vector<Step> steps = steps_of(offered, draft.tour.visits);
  parallel_for(steps.size(), [&](std::size_t i) {
    Step& step = steps[i];
    const std::size_t cell = draft.cells[step.stop], target = draft.targets[step.goal];
    step.shots = shots_like(problem, firing_map, target, firing_map.place(cell), *book.at({cell, target}));
  });
  const auto chosen = soonest(problem.gun, options, steps);
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const Step& step = steps[i];
    const PlannedShot& shot = step.shots[chosen[i]];
    book[{draft.cells[step.stop], draft.targets[step.goal]}] = shot;
    auto& services = offered.services[step.stop];
    *std::ranges::find(services, step.goal, &Service::goal) =
        service_of(step.goal, shot, options.shoot_on_the_move);
  }
  draft.tour.cost_s = cost(offered, draft.tour.visits);
  draft.tour.lower_bound_s = 0.0;  // what was proven holds for the shots that were offered before
  draft.tour.proven_optimal = false;
}

}  // namespace outrider
