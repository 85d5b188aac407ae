#include "outrider/navigate/surroundings.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "navigate_grid.hpp"

namespace outrider {
namespace {

constexpr double tile_m = 0.2;

}  // namespace

void Surroundings::look(const LiveMap& map, Vec2 middle, double reach_m, bool edges, const Zones* zones,
                        double margin_m) {
  const double cell_m = map.options().resolution_m;
  const Cell low = map.frame().cell_at(middle - Vec2{reach_m, reach_m});
  frame_.resolution_m = cell_m;
  frame_.origin = map.frame().corner(low);
  frame_.width = frame_.height = static_cast<int>(std::ceil(2.0 * reach_m / cell_m)) + 1;
  tiles_ = covering(frame_.bounds().grown(most_m), tile_m);
  places_.clear();
  inside_.clear();
  const auto take = [&](Vec2 place) {
    if (tiles_.contains(tiles_.cell_at(place))) places_.push_back(place);
  };
  std::ranges::for_each(map.close_places(), take);
  if (edges) std::ranges::for_each(map.edges(), take);
  sort_into_tiles();
  edges_.clear();
  if (zones == nullptr) return;
  zone_margin_m_ = std::max(zones->margin_m(), margin_m);
  nearer_m_ = zone_margin_m_ - margin_m;
  edges_ = zones->edges_near(middle, reach_m + most_m + nearer_m_);
}

void Surroundings::leave_inside(const Footprint& footprint, const Pose2& pose) {
  const auto is_inside = [&](Vec2 place) {
    return distance(place, pose.position) < footprint.outer_m() &&
           footprint.gap_m(pose.to_local(place)) < 0.0;
  };
  std::ranges::copy_if(places_, std::back_inserter(inside_), is_inside);
  if (inside_.empty()) return;
  std::erase_if(places_, is_inside);
  sort_into_tiles();
}

double Surroundings::inside_gap(const Footprint& footprint, const Pose2& pose) const {
  double least = 0.0;
  for (const Vec2 place : inside_) least = std::min(least, footprint.gap_m(pose.to_local(place)));
  return least;
}

void Surroundings::find_distances() {
  spread_distances(frame_, places_, most_m, distance_m_);
  if (edges_.empty()) return;
  std::vector<Vec2> points;
  for (const Segment& edge : edges_) add_points(edge, 0.5 * frame_.resolution_m, points);
  std::vector<float> edge_m;
  spread_distances(frame_, points, most_m + nearer_m_, edge_m);
  for (std::size_t i = 0; i < edge_m.size(); ++i)
    distance_m_[i] = std::min(distance_m_[i], std::max(0.0F, edge_m[i] - static_cast<float>(nearer_m_)));
}

void Surroundings::sort_into_tiles() {
  const auto tile_of = [&](Vec2 place) { return tiles_.index(tiles_.cell_at(place)); };
  first_.assign(tiles_.size() + 1, 0);
  for (const Vec2 place : places_) ++first_[tile_of(place) + 1];
  for (std::size_t t = 1; t < first_.size(); ++t) first_[t] += first_[t - 1];
  std::vector<Vec2> sorted(places_.size());
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  for (const Vec2 place : places_) sorted[next[tile_of(place)]++] = place;
  places_ = std::move(sorted);
}

double Surroundings::clearance(Vec2 place) const {
  const double x = (place.x - frame_.origin.x) / frame_.resolution_m - 0.5;
  const double y = (place.y - frame_.origin.y) / frame_.resolution_m - 0.5;
  const double column = std::floor(x), row = std::floor(y);
  const bool inside = column >= 0.0 && row >= 0.0 && column + 1.0 < frame_.width && row + 1.0 < frame_.height;
  if (!inside) return most_m;
  const auto at = frame_.index({static_cast<int>(column), static_cast<int>(row)});
  const auto up = at + static_cast<std::size_t>(frame_.width);
  const double u = x - column, v = y - row;
  const auto value = [&](std::size_t index) { return static_cast<double>(distance_m_[index]); };
  return (1.0 - v) * ((1.0 - u) * value(at) + u * value(at + 1)) +
         v * ((1.0 - u) * value(up) + u * value(up + 1));
}

double Surroundings::gap(const Footprint& footprint, const Pose2& pose, double most) const {
  const double reach = footprint.outer_m() + most;
  const Cell low = tiles_.cell_at(pose.position - Vec2{reach, reach});
  const Cell high = tiles_.cell_at(pose.position + Vec2{reach, reach});
  double least = most;
  for (int y = std::max(low.y, 0); y <= std::min(high.y, tiles_.height - 1); ++y) {
    const int left = std::max(low.x, 0), right = std::min(high.x, tiles_.width - 1);
    if (left > right) continue;
    // The tiles of a row lie side by side, and so do their places.
    const auto end = first_[tiles_.index({right, y}) + 1];
    for (auto i = first_[tiles_.index({left, y})]; i < end; ++i) {
      const Vec2 off = places_[i] - pose.position;
      const double nearest = footprint.outer_m() + least;
      if (squared_norm(off) >= nearest * nearest) continue;
      least = std::min(least, footprint.gap_m(unrotated(pose.heading_rad, off)));
    }
  }
  return edges_.empty() ? least : std::min(least, zone_gap(footprint, pose, most + nearer_m_) - nearer_m_);
}

double Surroundings::zone_gap(const Footprint& footprint, const Pose2& pose, double most) const {
  double least = most;
  for (const Segment& edge : edges_) {
    if (distance(pose.position, edge) - footprint.outer_m() >= least) continue;
    least = std::min(least, footprint.gap_m(pose, {{edge.a, edge.b}, 0.0}));
  }
  return std::max(least, 0.0);
}

}  // namespace outrider
