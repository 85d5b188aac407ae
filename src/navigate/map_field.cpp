#include "outrider/navigate/map_field.hpp"

#include <algorithm>
#include <cmath>

#include "outrider/world/known_extent.hpp"
#include "outrider/world/occupancy.hpp"

namespace outrider {
namespace {

constexpr double least_cell_m = 0.05;
constexpr std::size_t most_cells = 1'000'000;

/// The cells of a map in the world, about whose origin they are turned.
class TurnedMap {
 public:
  explicit TurnedMap(const KnownMap& map) : map_(map) {}

  [[nodiscard]] bool free(Cell cell) const {
    return map_.occupancy.contains(cell) && map_.occupancy[cell] == free_cell;
  }
  [[nodiscard]] Vec2 to_world(Vec2 place) const { return origin() + rotated(map_.yaw_rad, place - origin()); }
  [[nodiscard]] Cell cell_at(Vec2 world) const {
    return map_.occupancy.frame.cell_at(origin() + rotated(-map_.yaw_rad, world - origin()));
  }
  /// Returns the box around all that is known, with a rim.
  [[nodiscard]] Box2 bounds() const {
    const GridFrame& frame = map_.occupancy.frame;
    const CellExtent known = known_extent(map_.occupancy);
    const Vec2 low = frame.corner(known.low), high = frame.corner({known.high.x + 1, known.high.y + 1});
    Box2 box;
    for (const Vec2 corner : {low, {high.x, low.y}, high, {low.x, high.y}}) box.include(to_world(corner));
    return box.grown(2.0 * std::max(least_cell_m, frame.resolution_m));
  }
  /// Returns points on the cells that are not free beside a free one, at most 5 cm apart in each.
  [[nodiscard]] std::vector<Vec2> walls() const {
    const GridFrame& frame = map_.occupancy.frame;
    const int parts = std::max(1, static_cast<int>(std::ceil(frame.resolution_m / least_cell_m - 1e-9)));
    std::vector<Vec2> walls;
    for (int y = -1; y <= frame.height; ++y) {
      for (int x = -1; x <= frame.width; ++x) {
        if (free({x, y}) || !is_beside_free({x, y})) continue;
        for (int i = 0; i < parts * parts; ++i) {
          const Vec2 part{(i % parts + 0.5) / parts, (i / parts + 0.5) / parts};
          walls.push_back(to_world(frame.corner({x, y}) + frame.resolution_m * part));
        }
      }
    }
    return walls;
  }

 private:
  [[nodiscard]] Vec2 origin() const { return map_.occupancy.frame.origin; }
  [[nodiscard]] bool is_beside_free(Cell cell) const {
    return free({cell.x + 1, cell.y}) || free({cell.x - 1, cell.y}) || free({cell.x, cell.y + 1}) ||
           free({cell.x, cell.y - 1});
  }

  const KnownMap& map_;
};

}  // namespace

MapField::MapField(const KnownMap& map) {
  const TurnedMap turned(map);
  walls_ = std::make_shared<const std::vector<Vec2>>(turned.walls());
  const Box2 bounds = turned.bounds();
  double cell_m = std::max(least_cell_m, map.occupancy.frame.resolution_m);
  for (frame_ = covering(bounds, cell_m); frame_.size() > most_cells; frame_ = covering(bounds, cell_m))
    cell_m *= 1.25;
  closed_.resize(frame_.size());
  for (std::size_t i = 0; i < closed_.size(); ++i)
    closed_[i] = turned.free(turned.cell_at(frame_.centre(frame_.cell(i)))) ? 0 : 1;
}

void MapField::keep_to(const Zones& zones, double most_m) { zones_ = zones.cells(frame_, most_m); }

GoalGround MapField::ground(const LiveMap& live, bool remembered) const {
  GoalGround ground{frame_, live.places(), &closed_, &zones_};
  const Box2 window = live.frame().bounds();
  for (const Vec2 wall : *walls_) {
    if (!window.contains(wall)) ground.obstacles.push_back(wall);
  }
  if (remembered) {
    for (const Mark& mark : live.behind()) ground.obstacles.push_back(mark.place);
  }
  return ground;
}

void MapField::compute(const LiveMap& live, const Footprint& footprint, const RobotModel& robot,
                       const GoalQuery& query, bool remembered) {
  field_.compute(ground(live, remembered), footprint, robot, query, {});
}

}  // namespace outrider
