#include "outrider/sim/simulated_team.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

namespace outrider {
namespace {

constexpr int most_draws = 1000;

/// Chebyshev distance.
int apart(Cell a, Cell b) { return std::max(std::abs(a.x - b.x), std::abs(a.y - b.y)); }

/// A cell within `by` of that one along each axis.
Cell drawn_near(Cell cell, std::int64_t by, Rng& rng) {
  const auto span = static_cast<std::uint64_t>(2 * by + 1);
  const auto off = [&] { return static_cast<int>(static_cast<std::int64_t>(rng.below(span)) - by); };
  const int x = cell.x + off();
  return {x, cell.y + off()};
}

bool within(double time_s, double from_s, double for_s) {
  return time_s >= from_s && time_s < from_s + for_s;
}

}  // namespace

SimulatedTeam::SimulatedTeam(std::vector<Cell> robots, std::vector<Cell> target, int known_s)
    : robots_(std::move(robots)), target_(std::move(target)), known_s_(known_s) {}

SimulatedTeam::SimulatedTeam(std::vector<Cell> robots, std::vector<Cell> target, int known_s,
                             const TeamFaults& faults, std::function<bool(Cell)> free, const Rng& rng)
    : robots_(std::move(robots)),
      target_(std::move(target)),
      known_s_(known_s),
      faults_(faults),
      faulty_(true),
      free_(std::move(free)),
      sighting_rng_(rng.child("sightings")),
      place_rng_(rng.child("place")) {}

Observation SimulatedTeam::sense() {
  const std::size_t known =
      std::min(target_.size(), static_cast<std::size_t>(time_s_) + static_cast<std::size_t>(known_s_) + 1);
  const auto first = target_.begin() + static_cast<std::ptrdiff_t>(std::exchange(told_, known));
  Observation seen;
  seen.time_s = time_s_;
  if (faulty_ && time_s_ > 0) {
    seen.grid = faulty_view();
  } else {
    seen.grid = GridObservation{robots_, {first, target_.begin() + static_cast<std::ptrdiff_t>(known)}};
  }
  return seen;
}

/// Returns the observation after the first second, with the sighting that is due, if there is one.
GridObservation SimulatedTeam::faulty_view() {
  GridObservation grid{robots_, {}};
  grid.closed = found_closed_;
  grid.caught = robots_[on_duty_] == target_[static_cast<std::size_t>(time_s_)];
  if (!coming_.empty() && coming_.front().due_s <= time_s_) {
    grid.target = {coming_.front().cell};
    grid.target_from_s = coming_.front().second;
    coming_.erase(coming_.begin());
  }
  return grid;
}

/// Makes the sighting of the present second.
void SimulatedTeam::sight() {
  const std::int64_t second = static_cast<std::int64_t>(time_s_) + known_s_;
  if (second >= static_cast<std::int64_t>(target_.size())) return;
  const bool missed = sighting_rng_.uniform() < faults_.missed;
  const bool wrong = sighting_rng_.uniform() < faults_.wrong;
  const Cell truth = target_[static_cast<std::size_t>(second)];
  Cell cell = truth;
  for (int draw = 0; wrong && cell == truth && draw < most_draws; ++draw) {
    const Cell near = drawn_near(truth, faults_.wrong_by, sighting_rng_);
    if (free_(near)) cell = near;
  }
  if (missed || within(time_s_, faults_.missing_from_s, faults_.missing_for_s)) {
    ++counts_.missing;
    return;
  }
  if (cell != truth) ++counts_.wrong;
  if (faults_.late_s > 0) ++counts_.late;
  coming_.push_back({static_cast<int>(second), cell, time_s_ + static_cast<int>(faults_.late_s)});
}

void SimulatedTeam::close_cells(std::size_t robot) {
  if (closed_ || time_s_ < faults_.closed_at_s) return;
  const Cell from = robots_[robot], to = target_[static_cast<std::size_t>(time_s_)];
  const double scale = static_cast<double>(faults_.closed_ahead) / std::max(1, apart(from, to));
  closed_ = Cell{from.x + static_cast<int>(std::lround(scale * (to.x - from.x))),
                 from.y + static_cast<int>(std::lround(scale * (to.y - from.y)))};
  closed_s_ = time_s_;
}

bool SimulatedTeam::is_closed(Cell cell) const {
  return closed_ && within(time_s_, closed_s_, faults_.closed_for_s) &&
         apart(cell, *closed_) <= faults_.closed_radius;
}

void SimulatedTeam::put_elsewhere(std::size_t robot) {
  if (counts_.kidnapped || time_s_ < faults_.kidnapped_at_s) return;
  for (int draw = 0; draw < most_draws; ++draw) {
    const Cell cell = drawn_near(robots_[robot], faults_.kidnapped_by, place_rng_);
    if (cell == robots_[robot] || !free_(cell) || is_closed(cell)) continue;
    robots_[robot] = cell;
    break;
  }
  counts_.kidnapped = true;
}

/// Makes the step as far as the faults let it.
void SimulatedTeam::move(const StepToCell& step) {
  const Cell from = robots_[step.robot];
  found_closed_.clear();
  if (step.cell == from) return;
  if (within(time_s_, faults_.stuck_from_s, faults_.stuck_for_s)) {
    ++counts_.stuck_s;
  } else if (!free_(step.cell) || apart(from, step.cell) > 1) {
    ++counts_.into_walls;
  } else if (is_closed(step.cell)) {
    ++counts_.blocked;
    found_closed_ = {step.cell};
  } else {
    robots_[step.robot] = step.cell;
  }
}

void SimulatedTeam::act(const Command& command) {
  const auto* step = std::get_if<StepToCell>(&command);
  if (step == nullptr) return;
  if (!faulty_) {
    robots_[step->robot] = step->cell;
    ++time_s_;
    return;
  }
  on_duty_ = step->robot;
  close_cells(step->robot);
  move(*step);
  ++time_s_;
  put_elsewhere(step->robot);
  sight();
}

}  // namespace outrider
