#include "outrider/jobs/guard/run/scout.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "outrider/world/blocks.hpp"
#include "outrider/world/collision_map.hpp"

namespace outrider {
namespace {

/// The cells that the disk meets become free.
void clear_disk(Grid<std::uint8_t>& occupancy, Vec2 centre, double radius_m) {
  const Cell low = occupancy.frame.cell_at(centre - Vec2{radius_m, radius_m});
  const Cell high = occupancy.frame.cell_at(centre + Vec2{radius_m, radius_m});
  const double half = 0.5 * occupancy.frame.resolution_m;
  for (int y = low.y; y <= high.y; ++y) {
    for (int x = low.x; x <= high.x; ++x) {
      if (!occupancy.contains({x, y})) continue;
      const Vec2 off = occupancy.frame.centre({x, y}) - centre;
      const Vec2 nearest{std::max(0.0, std::abs(off.x) - half), std::max(0.0, std::abs(off.y) - half)};
      if (norm(nearest) < radius_m) occupancy[{x, y}] = free_cell;
    }
  }
}

/// The part of the map with all that is free, and one cell around.
Grid<std::uint8_t> cut_out(const Grid<std::uint8_t>& occupancy) {
  constexpr int most = std::numeric_limits<int>::max();
  Cell low{most, most}, high{-1, -1};
  for (std::size_t i = 0; i < occupancy.cells.size(); ++i) {
    if (occupancy.cells[i] != free_cell) continue;
    const Cell cell = occupancy.frame.cell(i);
    low = {std::min(low.x, cell.x), std::min(low.y, cell.y)};
    high = {std::max(high.x, cell.x), std::max(high.y, cell.y)};
  }
  if (high.x < low.x) return {};
  const GridFrame frame{occupancy.frame.corner({low.x - 1, low.y - 1}), occupancy.frame.resolution_m,
                        high.x - low.x + 3, high.y - low.y + 3};
  Grid<std::uint8_t> part(frame);
  part.cells = moved_cells(occupancy.cells, occupancy.frame, frame, {1 - low.x, 1 - low.y},
                           std::uint8_t{unknown_cell});
  return part;
}

/// Returns how much wider the robot may be so that it still fits where it stands.
double spare_at(const GuardProblem& problem, double wanted_m) {
  const CollisionMap ground = CollisionMap::of(problem.world, room_height(problem));
  const double most_m = problem.robot.radius_m + wanted_m;
  const double room_m = ground.clearance(problem.start.position, most_m) - problem.robot.radius_m;
  return std::clamp(room_m - 1e-6, 0.0, wanted_m);
}

}  // namespace

std::vector<Option> describe(ScoutOptions& options) {
  return {{"unknown", "", 0, 0, "the yard is not known: explore it first, and see who is there",
           &options.unknown},
          {"sight", "m", 0.1, 1000, "a target farther away is not made out", &options.sight_m},
          {"sight_error", "m", 0, 1, "of the place of a target by one look, standard deviation",
           &options.sight_error_m},
          {"wall_height", "m", 0.1, 100, "to which what stands on the map is taken to rise",
           &options.wall_height_m}};
}

void SeenTarget::add(Vec2 place, double time_s) {
  if (looks == 0) first_s = time_s;
  last_s = time_s;
  ++looks;
  mean = mean + (1.0 / static_cast<double>(looks)) * (place - mean);
}

Outcome<FoundYard> found_yard(const GuardProblem& known, const ScoutOptions& options,
                              Grid<std::uint8_t> occupancy, const std::vector<Vec2>& stood,
                              const std::vector<std::optional<SeenTarget>>& seen, const Pose2& start,
                              const std::vector<Vec2>& touched) {
  for (const Vec2 place : stood) clear_disk(occupancy, place, known.robot.radius_m);
  clear_disk(occupancy, start.position, known.robot.radius_m);
  for (const Vec2 point : touched) {
    const Cell cell = occupancy.frame.cell_at(point);
    if (occupancy.contains(cell)) occupancy[cell] = occupied_cell;
  }
  const Grid<std::uint8_t> part = cut_out(occupancy);
  if (part.cells.empty()) {
    return bad_input("nothing free was found; exploring saw no ground to guard", "scout.unknown");
  }
  FoundYard found{known, {}};
  GuardProblem& problem = found.problem;
  problem.start = start;
  problem.world.bounds = part.frame.bounds();
  problem.world.solids = blocks(part, known.world.floor_z_m, known.world.floor_z_m + options.wall_height_m);
  problem.targets.clear();
  for (std::size_t i = 0; i < known.targets.size(); ++i) {
    if (!seen[i]) continue;
    Target target = known.targets[i];
    target.base = {seen[i]->mean.x, seen[i]->mean.y, target.base.z};
    const Cell cell = part.frame.cell_at(seen[i]->mean);
    const bool open = part.contains(cell) && part[cell] == free_cell;
    if (!open) continue;
    found.targets.push_back(i);
    problem.targets.push_back(std::move(target));
  }
  problem.robot.radius_m += spare_at(problem, part.frame.resolution_m + known.errors.position_m);
  return found;
}

}  // namespace outrider
