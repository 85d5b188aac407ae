#include "outrider/jobs/pursue/navigated.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "outrider/io/scenario/things.hpp"
#include "outrider/job/navigation_log.hpp"
#include "outrider/job/scene.hpp"
#include "outrider/job/scene_markers.hpp"
#include "outrider/log/append.hpp"
#include "outrider/world/blocks.hpp"
#include "outrider/world/collision_map.hpp"
#include "outrider/world/occupancy.hpp"

namespace outrider {
namespace {

constexpr double wall_height_m = 1.0;
constexpr double within_part = 0.2;   // of a cell: so near to its middle it has arrived
constexpr double known_cell_m = 0.1;  // of the map that its range finder is compared with, at most
constexpr std::size_t most_known_cells = 4'000'000;
constexpr std::size_t most_pieces = 200'000;
constexpr int vain_s = 3;         // after which a cell counts as closed
constexpr int closed_for_s = 30;  // because of that
constexpr int seen_for_s = 2;     // after something was seen in it

/// Returns the cells that the robot may enter, with a ring around them.
Grid<std::uint8_t> walled(const PursuitProblem& problem) {
  const GridFrame& frame = problem.costs->frame;
  Grid<std::uint8_t> cells(frame);
  for (std::size_t i = 0; i < cells.cells.size(); ++i)
    cells.cells[i] = problem.wall(frame.cell(i)) ? occupied_cell : free_cell;
  return bordered(cells, occupied_cell);
}

Outcome<World> world_of(const PursuitProblem& problem, const PursuerOptions& options) {
  World world;
  world.solids = blocks(walled(problem), 0.0, wall_height_m);
  if (world.solids.size() > most_pieces)
    return bad_input(
        fmt::format("the walls of the map are {} pieces, more than {}; a robot on wheels needs a "
                    "smaller map, or give sim: ideal",
                    world.solids.size(), most_pieces),
        "map");
  if (auto ok = add_things(options.things, options.robot.height_m, world); !ok) return pass_on(ok);
  const GridFrame& frame = problem.costs->frame;
  world.bounds = frame.bounds().grown(frame.resolution_m);
  const Vec2 start = frame.centre(problem.start);
  if (!CollisionMap::of(world, options.robot.height_m).segment_free({start, start}, options.robot.radius_m))
    return bad_input(fmt::format("the robot has no room where it starts, at ({:.2f}, {:.2f}); give it a "
                                 "smaller radius, larger cells or other things",
                                 start.x, start.y),
                     options.things.empty() ? "cell" : "things");
  return world;
}

/// Returns the walls in cells that are fine enough to tell where the robot is.
KnownMap map_of(const PursuitProblem& problem) {
  const Grid<std::uint8_t> coarse = walled(problem);
  int parts = std::max(1, static_cast<int>(std::ceil(coarse.frame.resolution_m / known_cell_m)));
  const auto size = [&] {
    return coarse.cells.size() * static_cast<std::size_t>(parts) * static_cast<std::size_t>(parts);
  };
  while (parts > 1 && size() > most_known_cells) --parts;
  GridFrame frame = coarse.frame;
  frame.resolution_m /= parts;
  frame.width *= parts;
  frame.height *= parts;
  Grid<std::uint8_t> fine(frame, free_cell);
  for (std::size_t i = 0; i < fine.cells.size(); ++i) {
    const Cell cell = frame.cell(i);
    fine.cells[i] = coarse[{cell.x / parts, cell.y / parts}];
  }
  return {std::move(fine)};
}

}  // namespace

PursuerOptions::PursuerOptions() {
  robot.speed_mps = 1.5;
  robot.acceleration_mps2 = 2.0;
  robot.turn_rate_radps = 3.0;
  robot.turn_acceleration_radps2 = 12.0;
  navigation.laser.most_m = 15.0;
  navigation.laser.rate_hz = 10.0;
  navigation.wheels.track_m = 0.4;
}

NavigatedPursuer::NavigatedPursuer(const PursuitProblem& problem, int known_s, NavigatedBody body,
                                   double radius_m)
    : problem_(&problem),
      known_s_(known_s),
      body_(std::move(body)),
      radius_m_(radius_m),
      here_(problem.start) {}

Outcome<NavigatedPursuer> NavigatedPursuer::make(const PursuitProblem& problem, const PursuerOptions& options,
                                                 int known_s, std::uint64_t seed) {
  auto made = world_of(problem, options);
  if (!made) return pass_on(made);
  auto world = std::make_unique<const World>(std::move(*made));
  const Footprint footprint = Footprint::disk(options.robot.radius_m);
  const GridFrame& frame = problem.costs->frame;
  const Pose2 start{frame.centre(problem.start), 0.0};
  NavigatorSetup setup = setup_of(options.navigation, options.robot, footprint);
  setup.known = map_of(problem);
  auto navigator = Navigator::make(std::move(setup), start);
  if (!navigator) return pass_on(navigator);
  return NavigatedPursuer(
      problem, known_s,
      NavigatedBody(std::move(world), start, options.robot, devices_of(options.navigation, footprint), seed,
                    std::move(*navigator), within_part * frame.resolution_m),
      options.robot.radius_m);
}

void NavigatedPursuer::log_to(Log& log, std::stop_token stop) {
  log_solids(log, body_.world(), wall_height_m);
  log_markers(log);
  log_pose(log, 0.0, body_.pose());
  body_.watch(
      [this, &log, navigation = NavigationLog(log)](const Observation& seen, const Situation& now,
                                                    const Navigator& navigator) mutable {
        navigation.note(seen, now.time_s, navigator.map());
        if (seen.scan) log_pose(log, now.time_s, body_.pose());
      },
      std::move(stop));
}

Cell NavigatedPursuer::cell_of(Vec2 place) const {
  const CostGrid& costs = *problem_->costs;
  const auto is_free = [&](Cell cell) { return costs.contains(cell) && !problem_->wall(cell); };
  const Cell cell = costs.frame.cell_at(place);
  if (is_free(cell)) return cell;
  Cell nearest = here_;
  for (int y = cell.y - 1; y <= cell.y + 1; ++y) {
    for (int x = cell.x - 1; x <= cell.x + 1; ++x) {
      if (is_free({x, y}) &&
          distance(place, costs.frame.centre({x, y})) < distance(place, costs.frame.centre(nearest)))
        nearest = {x, y};
    }
  }
  return nearest;
}

/// Marks a cell as closed until some seconds from now.
void NavigatedPursuer::close(Cell cell, int for_s) {
  const CostGrid& costs = *problem_->costs;
  if (!costs.contains(cell) || problem_->wall(cell) || cell == here_) return;
  const auto [entry, is_new] = closed_until_.try_emplace(costs.frame.index(cell), time_s_ + for_s);
  entry->second = std::max(entry->second, time_s_ + for_s);
  if (is_new) newly_closed_.push_back(cell);
}

/// Closes the cells in whose middle it has no room, and opens those in which nothing was seen lately.
void NavigatedPursuer::note_closed(GridObservation& grid) {
  const GridFrame& frame = problem_->costs->frame;
  for (const Mark& mark : body_.map().marks()) {
    if (!mark.stands() || mark.mapped) continue;
    const Cell cell = frame.cell_at(mark.place);
    if (distance(mark.place, frame.centre(cell)) < radius_m_) close(cell, seen_for_s);
  }
  std::erase_if(closed_until_, [&](const auto& entry) {
    const Cell cell = frame.cell(entry.first);
    const bool open = entry.second <= time_s_ || cell == here_;
    if (open) grid.opened.push_back(cell);
    return open;
  });
  grid.closed = std::exchange(newly_closed_, {});
}

Observation NavigatedPursuer::sense() {
  const std::vector<Cell>& target = problem_->target;
  const std::size_t known =
      std::min(target.size(), static_cast<std::size_t>(time_s_) + static_cast<std::size_t>(known_s_) + 1);
  const auto first = target.begin() + static_cast<std::ptrdiff_t>(std::exchange(told_, known));
  here_ = cell_of(body_.believed_pose().position);
  const Cell truly = cell_of(body_.pose().position);
  Observation seen;
  seen.time_s = time_s_;
  GridObservation grid{{here_}, {first, target.begin() + static_cast<std::ptrdiff_t>(known)}};
  if (time_s_ > 0) grid.caught = truly == target[static_cast<std::size_t>(time_s_)];
  if (grid.caught.value_or(false)) grid.robots = {truly};
  note_closed(grid);
  seen.grid = std::move(grid);
  return seen;
}

/// Returns true for a diagonal step between two walls.
bool NavigatedPursuer::is_between_walls(Cell from, Cell to) const {
  return from.x != to.x && from.y != to.y && problem_->wall({from.x, to.y}) && problem_->wall({to.x, from.y});
}

/// Returns the order to get to the cell, or on to the next one if it need not wait there.
Order NavigatedPursuer::order_to(const StepToCell& step) const {
  const GridFrame& frame = problem_->costs->frame;
  const bool on = std::abs(step.then.x - here_.x) > 1 || std::abs(step.then.y - here_.y) > 1;
  GoTo order{frame.centre(on ? step.then : step.cell), within_part * frame.resolution_m};
  if (!on) {
    order.heading_rad = body_.believed_pose().heading_rad;
    order.within_rad = pi;
  }
  return order;
}

void NavigatedPursuer::act(const Command& command) {
  const auto* step = std::get_if<StepToCell>(&command);
  if (step == nullptr) return;
  const Cell from = here_;
  body_.go(order_to(*step), ++time_s_);
  in_vain_s_ = step->cell != from && cell_of(body_.believed_pose().position) == from ? in_vain_s_ + 1 : 0;
  if (in_vain_s_ < vain_s && !is_between_walls(from, step->cell)) return;
  in_vain_s_ = 0;
  close(step->cell, closed_for_s);
}

}  // namespace outrider
