#include "mission/way_back.hpp"

#include <cmath>
#include <numeric>

#include "outrider/path/pieces.hpp"
#include "outrider/path/visibility/visibility_graph.hpp"
#include "strokes/turning_transit.hpp"

namespace outrider::cover {
namespace {

constexpr std::size_t most_poses = 60;  // of the track, in a chain of turning paths

}  // namespace

std::optional<std::vector<PathPiece>> WayBack::way(const Pose2& from, const PathPiece& to,
                                                   const std::shared_ptr<const PolygonGround>& ground,
                                                   std::span<const PathPiece> track) {
  if (problem_.curves()) return turning_way(from, {to.from, heading_in(to)}, *ground, track);
  if (from.position == to.from) return std::vector<PathPiece>{};
  if (!ground->point_free(from.position) || !ground->point_free(to.from)) return std::nullopt;
  if (ground->segment_free({from.position, to.from}))
    return std::vector<PathPiece>{{from.position, to.from, {}, 0.0}};
  auto plan = visibility_graph_reduced({nullptr, from.position, to.from, ground}, {}, budget_, workspace_);
  if (!plan) return std::nullopt;
  return std::move(plan->pieces);
}

std::optional<std::vector<PathPiece>> WayBack::turning_way(const Pose2& from, const Pose2& to,
                                                           const PolygonGround& ground,
                                                           std::span<const PathPiece> track) const {
  if (!ground.point_free(from.position) || !ground.point_free(to.position)) return std::nullopt;
  const FreeRoom room(ground);
  if (auto direct = free_turning_path(from, to, problem_, room)) return direct;
  TurningTransit transit(problem_, room);
  const std::size_t start = transit.add(from), goal = transit.add(to);
  const std::size_t step = 1 + track.size() / most_poses;
  for (std::size_t i = 0; i < track.size(); i += step) {
    if (ground.point_free(track[i].from)) transit.add({track[i].from, heading_in(track[i])});
  }
  std::vector<std::size_t> all(transit.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  transit.connect(all, all, budget_.stop);
  const auto ways = transit.ways_from(start);
  if (!std::isfinite(ways.times_s[goal])) return std::nullopt;
  return transit.pieces(ways, start, goal);
}

}  // namespace outrider::cover
