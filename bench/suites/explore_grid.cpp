#include "explore_grid.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "outrider/core/units.hpp"
#include "outrider/geometry/pose.hpp"
#include "outrider/path/grid/from_occupancy.hpp"
#include "outrider/world/grid_ray.hpp"
#include "outrider/world/occupancy.hpp"

namespace outrider::bench {
namespace {

constexpr double step_m = 0.1;    // between scans
constexpr double decide_m = 0.5;  // between decisions, unless the goal is seen before

LatticePoint lattice_at(const GridFrame& frame, Vec2 point) {
  return lattice_point(1.0 / frame.resolution_m * (point - frame.origin));
}

/// The robot and what it knows.
class Explorer {
 public:
  explicit Explorer(const GridExploration& asked)
      : asked_(asked),
        known_(asked.solid.frame, unknown_cell),
        frontiers_(asked.options.frontier, asked.robot.radius_m),
        pose_{asked.start, 0.0} {
    blacklist_.ban_s = asked.options.ban_s;
    run.track = {asked.start};
    look({true, {}});
  }

  Outcome<Decision> decide_anew() {
    auto decision = decide({frontiers_,
                            blacklist_,
                            asked_.robot,
                            asked_.range_m,
                            pose_,
                            {asked_.start, 0.0},
                            run.time_s,
                            choice_},
                           asked_.options, workspace_);
    if (decision) choice_ = decision->choice;
    return decision;
  }

  /// Drives along the path until it is time to decide again, or to its end.
  void drive(const std::vector<Vec2>& path, bool to_the_end) {
    double since_m = 0.0;
    for (std::size_t i = 1; i < path.size(); ++i) {
      turn_to(path[i]);
      while (distance(pose_.position, path[i]) > 1e-9) {
        const double step = std::min(step_m, distance(pose_.position, path[i]));
        pose_.position = pose_.position + step * direction(pose_.heading_rad);
        if (step < step_m) pose_.position = path[i];
        run.driven_m += step;
        run.time_s += step / asked_.robot.speed_mps;
        since_m += step;
        look({});
        const bool gone = !frontiers_.frontiers().contains(choice_.frontier);
        if (!to_the_end && (gone || since_m >= decide_m)) return run.track.push_back(pose_.position);
      }
      run.track.push_back(path[i]);
    }
    // It looked from where the frontier was to be seen, and the frontier is still there.
    if (!to_the_end && frontiers_.frontiers().contains(choice_.frontier))
      blacklist_.add(choice_.place, run.time_s);
  }

  /// Returns the part of the cells that are not blocked that it knows.
  [[nodiscard]] double known_part(const std::vector<std::uint8_t>& blocked) const {
    std::size_t all = 0, known = 0;
    for (std::size_t i = 0; i < blocked.size(); ++i) {
      all += blocked[i] == 0 ? 1 : 0;
      known += blocked[i] == 0 && known_.cells[i] == free_cell ? 1 : 0;
    }
    return static_cast<double>(known) / static_cast<double>(all);
  }
  [[nodiscard]] Vec2 position() const { return pose_.position; }

  GridExplorationRun run;

 private:
  void turn_to(Vec2 point) {
    if (distance(pose_.position, point) < 1e-9) return;
    const double heading = heading_of(point - pose_.position);
    run.time_s += std::abs(wrap_angle(heading - pose_.heading_rad)) / asked_.robot.turn_rate_radps;
    pose_.heading_rad = heading;
  }

  void note(Cell cell, std::uint8_t value, MapUpdate& update) {
    if (std::exchange(known_[cell], value) != value) update.cells.push_back(known_.frame.index(cell));
  }

  void look(MapUpdate update) {
    constexpr int beams = 360;
    const GridFrame& frame = known_.frame;
    for (int i = 0; i < beams; ++i) {
      const Vec2 end = pose_.position + asked_.range_m * direction(2.0 * pi * i / beams);
      const LatticePoint to = lattice_at(frame, end);
      const Cell last = to.cell();
      walk_ray(lattice_at(frame, pose_.position), to, [&](Cell cell) {
        if (!frame.contains(cell)) return false;
        const bool solid = asked_.solid[cell] != 0;
        note(cell, solid ? occupied_cell : free_cell, update);
        return !solid && !(cell == last);
      });
    }
    std::ranges::sort(update.cells);
    if (update.redrawn || !update.cells.empty()) frontiers_.update(known_, update);
  }

  const GridExploration& asked_;
  Grid<std::uint8_t> known_;
  FrontierMap frontiers_;
  Blacklist blacklist_;
  Workspace workspace_;
  Pose2 pose_;
  ExploreChoice choice_;
};

/// Marks all but the cells to which the robot gets from the start, with clearance to spare.
Outcome<std::vector<std::uint8_t>> unreached(const GridExploration& asked) {
  auto free = inflated(asked.solid, asked.robot.radius_m + asked.options.frontier.ground.margin_m);
  if (!free) return pass_on(free);
  std::vector<std::uint8_t> met(free->cells.size(), 1);
  std::vector<Cell> cells{asked.solid.frame.cell_at(asked.start)};
  if (!free->contains(cells[0]) || (*free)[cells[0]] != 0)
    return fault(FaultCode::start_blocked, "the robot does not fit where it starts");
  met[free->frame.index(cells[0])] = 0;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    for (const Cell step : {Cell{1, 0}, Cell{-1, 0}, Cell{0, 1}, Cell{0, -1}}) {
      const Cell next{cells[i].x + step.x, cells[i].y + step.y};
      if (free->contains(next) && (*free)[next] == 0 &&
          std::exchange(met[free->frame.index(next)], std::uint8_t{0}) != 0)
        cells.push_back(next);
    }
  }
  return met;
}

}  // namespace

Outcome<GridExplorationRun> explore_on_grid(const GridExploration& asked,
                                            const std::function<double()>& processor_s) {
  constexpr int most_decisions = 100'000;
  constexpr double complete_part = 0.995;
  auto rest = unreached(asked);
  if (!rest) return pass_on(rest);
  Explorer explorer(asked);
  GridExplorationRun& run = explorer.run;
  while (run.decisions < most_decisions) {
    const double began_s = processor_s ? processor_s() : 0.0;
    auto decision = explorer.decide_anew();
    if (processor_s) run.max_decision_s = std::max(run.max_decision_s, processor_s() - began_s);
    if (!decision) break;
    ++run.decisions;
    const bool go = decision->kind == DecisionKind::go;
    explorer.drive(decision->waypoints, !go);
    if (!go) break;
  }
  run.complete =
      explorer.known_part(*rest) >= complete_part && distance(explorer.position(), asked.start) < 0.1;
  return run;
}

}  // namespace outrider::bench
