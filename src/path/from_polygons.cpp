#include "outrider/path/from_polygons.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "outrider/core/text.hpp"

namespace outrider {
namespace {

double distance(const Box2& square, const Segment& edge) {
  if (square.contains(edge.a) || square.contains(edge.b)) return 0.0;
  const std::array<Vec2, 4> corners = {
      square.low, {square.high.x, square.low.y}, square.high, {square.low.x, square.high.y}};
  double least = outrider::distance(Segment{corners[3], corners[0]}, edge);
  for (std::size_t i = 0; i < 3; ++i) {
    least = std::min(least, outrider::distance(Segment{corners[i], corners[i + 1]}, edge));
  }
  return least;
}

Outcome<GridFrame> frame_of(const PolygonGround& ground, const GridOptions& options) {
  const Vec2 size = ground.bounds.size();
  const double resolution = options.resolution_m;
  const bool good = resolution > 0.0 && std::isfinite(resolution);
  const double width = std::ceil(size.x / resolution - 1e-9), height = std::ceil(size.y / resolution - 1e-9);
  const bool fits = width * height <= static_cast<double>(options.most_cells) && width < most_grid_side &&
                    height < most_grid_side;
  if (!good || !fits) {
    return bad_input(
        fmt::format("a resolution of {} m is not valid for {} x {} m; expected a number above 0 "
                    "that makes at most {} cells",
                    short_number(resolution), short_number(size.x), short_number(size.y), options.most_cells),
        "resolution");
  }
  return GridFrame{ground.bounds.low, resolution, static_cast<int>(width), static_cast<int>(height)};
}

/// Blocks the cells that are nearer to the edge than the radius.
void block_beside(Grid<std::uint8_t>& blocked, const Segment& edge, double radius_m,
                  const std::stop_token& stop) {
  const GridFrame& frame = blocked.frame;
  Box2 box;
  box.include(edge.a);
  box.include(edge.b);
  box = box.grown(radius_m);
  const auto cell = [&](double away, int most) {
    return std::clamp(static_cast<int>(std::floor(away / frame.resolution_m)), 0, most - 1);
  };
  const int first_x = cell(box.low.x - frame.origin.x - 1e-9, frame.width);
  const int last_x = cell(box.high.x - frame.origin.x + 1e-9, frame.width);
  const int last_y = cell(box.high.y - frame.origin.y + 1e-9, frame.height);
  for (int y = cell(box.low.y - frame.origin.y - 1e-9, frame.height); y <= last_y; ++y) {
    if (stop.stop_requested()) return;
    for (int x = first_x; x <= last_x; ++x) {
      if (blocked[{x, y}] != 0) continue;
      if (outrider::distance(frame.centre({x, y}), edge) > radius_m + 0.71 * frame.resolution_m) continue;
      const Vec2 low = frame.corner({x, y});
      const Box2 square{low, frame.corner({x + 1, y + 1})};
      if (distance(square, edge) < radius_m - contact_m) blocked[{x, y}] = 1;
    }
  }
}

}  // namespace

Outcome<Grid<std::uint8_t>> blocked_for_disk(const PolygonGround& ground, const GridOptions& options,
                                             const std::stop_token& stop) {
  auto frame = frame_of(ground, options);
  if (!frame) return pass_on(frame);
  if (auto good = check_frame(*frame); !good) return pass_on(good);
  Grid<std::uint8_t> blocked(*frame);
  for (const Segment& edge : ground.edges) block_beside(blocked, edge, ground.radius_m, stop);
  for (int y = 0; y < frame->height && !stop.stop_requested(); ++y) {
    for (int x = 0; x < frame->width; ++x) {
      if (blocked[{x, y}] == 0 && ground.solid(frame->centre({x, y}))) blocked[{x, y}] = 1;
    }
  }
  if (stop.stop_requested()) return fault(FaultCode::cancelled, "it was cancelled while it made the grid");
  return blocked;
}

}  // namespace outrider
