#include "outline_room.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "outrider/geometry/convex.hpp"

namespace outrider {
namespace {

constexpr int most_side = 32'768;  // of squared_clearance()
constexpr double half_diagonal = 0.5 * std::numbers::sqrt2;

Cell on_rimmed(Vec2 p) {
  return {static_cast<int>(std::floor(p.x)) + 1, static_cast<int>(std::floor(p.y)) + 1};
}

}  // namespace

Status OutlineRoom::begin(const GridMap& ground, const std::vector<Vec2>& outline,
                          const std::stop_token& stop) {
  ground_ = &ground;
  const GridFrame& frame = ground.frame;
  tells_ = outline.size() > 1 && std::max(frame.width, frame.height) + 2 <= most_side;
  if (!tells_) return {};
  outer_ = 0.0;
  for (const Vec2 corner : outline) outer_ = std::max(outer_, norm(corner));
  const double inner = -signed_distance(Vec2{}, RoundedPolygon{outline, 0.0});
  Grid<std::uint8_t> rimmed(GridFrame{{}, 1.0, frame.width + 2, frame.height + 2});
  for (std::size_t i = 0; i < rimmed.cells.size(); ++i) {
    const Cell cell = rimmed.frame.cell(i);
    rimmed.cells[i] = ground.blocked({cell.x - 1, cell.y - 1}) ? 1 : 0;
  }
  squared_ = squared_clearance(rimmed, stop);
  if (stop.stop_requested())
    return fault(FaultCode::cancelled, "it was cancelled while the room was measured");
  Grid<std::uint8_t> narrow(frame);
  for (std::size_t i = 0; i < narrow.cells.size(); ++i) {
    const Cell cell = frame.cell(i);
    const double apart = std::sqrt(static_cast<double>(squared_[{cell.x + 1, cell.y + 1}]));
    narrow.cells[i] = apart == 0.0 || apart + half_diagonal < inner ? 1 : 0;
  }
  auto made = GridMap::of(narrow, GridModel::cells);
  if (!made) return pass_on(made);
  narrowed_ = std::move(*made);
  return {};
}

bool OutlineRoom::is_wide(Vec2 p, double length) const {
  if (!tells_ || !ground_->frame.contains(Cell{on_rimmed(p).x - 1, on_rimmed(p).y - 1})) return false;
  const double least = outer_ + length + 2.0 * half_diagonal + 1e-6;
  return static_cast<double>(squared_[on_rimmed(p)]) > least * least;
}

bool OutlineRoom::is_blocked(Vec2 p) const {
  return tells_ && narrowed_.blocked({static_cast<int>(std::floor(p.x)), static_cast<int>(std::floor(p.y))});
}

}  // namespace outrider
