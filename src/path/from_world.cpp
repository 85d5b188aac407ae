#include "outrider/path/from_world.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "outrider/core/text.hpp"
#include "outrider/path/grid/from_occupancy.hpp"

namespace outrider {
namespace {

/// Returns true if some point of the closed square is nearer to the obstacle than the radius, or lies in its
/// core (which alone decides when both radii are 0). Exact.
bool too_near(const Box2& square, const RoundedPolygon& obstacle, double radius_m) {
  if (std::any_of(obstacle.core.begin(), obstacle.core.end(), [&](Vec2 p) { return square.contains(p); })) {
    return true;
  }
  const std::array<Vec2, 4> corners = {
      {square.low, {square.high.x, square.low.y}, square.high, {square.low.x, square.high.y}}};
  for (std::size_t i = 0; i < 4; ++i) {
    const double apart = signed_distance(Segment{corners[i], corners[(i + 1) % 4]}, obstacle);
    if (apart < radius_m || apart <= -obstacle.radius_m) return true;
  }
  return false;
}

void block_near(Grid<std::uint8_t>& blocked, const RoundedPolygon& obstacle, double radius_m,
                const std::stop_token& stop) {
  const GridFrame& frame = blocked.frame;
  const double half_diagonal = frame.resolution_m / std::numbers::sqrt2;
  const Box2 reach = obstacle.bounds().grown(radius_m + frame.resolution_m);
  const auto cell = [](double p, double origin, double resolution, int count) {
    return static_cast<int>(std::clamp(std::floor((p - origin) / resolution), 0.0, count - 1.0));
  };
  const int x1 = cell(reach.high.x, frame.origin.x, frame.resolution_m, frame.width);
  const int y1 = cell(reach.high.y, frame.origin.y, frame.resolution_m, frame.height);
  for (int y = cell(reach.low.y, frame.origin.y, frame.resolution_m, frame.height); y <= y1; ++y) {
    if (stop.stop_requested()) return;
    for (int x = cell(reach.low.x, frame.origin.x, frame.resolution_m, frame.width); x <= x1; ++x) {
      if (blocked[{x, y}] != 0) continue;
      const double from_centre = signed_distance(frame.centre({x, y}), obstacle);
      if (from_centre >= radius_m + half_diagonal) continue;
      const Box2 square{frame.corner({x, y}), frame.corner({x + 1, y + 1})};
      if (from_centre < radius_m || too_near(square, obstacle, radius_m)) blocked[{x, y}] = 1;
    }
  }
}

/// Blocks the cells that are not entirely inside the box in which the centre must stay.
void block_outside(Grid<std::uint8_t>& blocked, const Box2& box) {
  constexpr double touch_m = 1e-9;
  const Box2 inside = box.grown(touch_m);
  for (int y = 0; y < blocked.frame.height; ++y) {
    for (int x = 0; x < blocked.frame.width; ++x) {
      const bool within = inside.contains(blocked.frame.corner({x, y})) &&
                          inside.contains(blocked.frame.corner({x + 1, y + 1}));
      if (!within) blocked[{x, y}] = 1;
    }
  }
}

Outcome<GridFrame> frame_for(const CollisionMap& ground, double radius_m, const GridOptions& options) {
  const bool good_radius = radius_m >= 0.0 && radius_m <= 1e6;
  if (!good_radius) {
    return bad_input(
        fmt::format("a robot radius of {} m is not valid; expected 0 to 1e6", short_number(radius_m)));
  }
  if (!(options.resolution_m > 0.0)) {
    return bad_input(
        fmt::format("{} m is not valid; expected a number above 0", short_number(options.resolution_m)),
        "resolution");
  }
  const Vec2 size = ground.bounds().size();
  const double columns = std::ceil(size.x / options.resolution_m),
               rows = std::ceil(size.y / options.resolution_m);
  const double most = std::min(static_cast<double>(options.most_cells), static_cast<double>(most_grid_cells));
  const bool has_room = size.x > 0.0 && size.y > 0.0;
  if (!has_room) {
    return bad_input(fmt::format("bounds of {} x {} m leave no room for a grid", short_number(size.x),
                                 short_number(size.y)));
  }
  const bool fits = columns * rows <= most && columns <= most_grid_side && rows <= most_grid_side;
  if (!fits) {
    return bad_input(
        fmt::format("{} m over {} x {} m makes {:.0f} cells, more than the {:.0f} allowed; take a "
                    "coarser one",
                    short_number(options.resolution_m), short_number(size.x), short_number(size.y),
                    columns * rows, most),
        "resolution");
  }
  const GridFrame frame = covering(ground.bounds(), options.resolution_m);
  if (auto good = check_frame(frame); !good) return pass_on(good);
  return frame;
}

}  // namespace

std::vector<Option> describe(GridOptions& options) {
  return {
      {"resolution", "m", 1e-4, 1e3, "side of the cells of the grid on which paths are planned",
       &options.resolution_m},
      {"most_cells", "", 1.0, static_cast<double>(most_grid_cells), "a grid of more cells is refused",
       &options.most_cells},
  };
}

Outcome<Grid<std::uint8_t>> blocked_for_disk(const CollisionMap& ground, double radius_m,
                                             const GridOptions& options, const std::stop_token& stop) {
  auto frame = frame_for(ground, radius_m, options);
  if (!frame) return pass_on(frame);
  Grid<std::uint8_t> blocked(*frame);
  block_outside(blocked, ground.bounds().grown(-radius_m));
  for (const RoundedPolygon& obstacle : ground.obstacles()) block_near(blocked, obstacle, radius_m, stop);
  if (stop.stop_requested()) return fault(FaultCode::cancelled, "it was cancelled while it made the grid");
  return blocked;
}

Outcome<GridMap> grid_from_world(const CollisionMap& ground, double radius_m, GridModel model,
                                 const GridOptions& options, const std::stop_token& stop) {
  auto blocked = blocked_for_disk(ground, radius_m, options, stop);
  if (!blocked) return pass_on(blocked);
  return grid_map_of(*blocked, model, stop);
}

}  // namespace outrider
