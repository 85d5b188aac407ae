#include "strokes/lap_sections.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "outrider/geometry/convex.hpp"

namespace outrider::cover {
namespace {

/// A place on the lap: so many metres along that piece.
struct Cut {
  std::size_t piece;
  double at_m;
};

/// Ends of lanes at which cells are entered and left, and those that are far from the next one.
std::vector<Vec2> ends_apart(const std::vector<SweepCell>& cells, double far_m) {
  std::vector<Vec2> ends;
  for (const SweepCell& cell : cells) {
    if (cell.lanes.empty()) continue;
    for (const Segment& lane : {cell.lanes.front(), cell.lanes.back()})
      ends.insert(ends.end(), {lane.a, lane.b});
    for (std::size_t i = 1; i < cell.lanes.size(); ++i) {
      const Segment &before = cell.lanes[i - 1], &lane = cell.lanes[i];
      if (distance(before.a, lane.a) > far_m) ends.insert(ends.end(), {before.a, lane.a});
      if (distance(before.b, lane.b) > far_m) ends.insert(ends.end(), {before.b, lane.b});
    }
  }
  return ends;
}

/// Adds the nearest place of the lap, if it is near and not at the end of a straight piece.
void add_cut(std::vector<Cut>& cuts, const Lap& lap, Vec2 end, double near_m) {
  std::optional<Cut> nearest;
  double least_m = near_m;
  for (std::size_t i = 0; i < lap.size(); ++i) {
    if (lap[i].turn_rad != 0.0) continue;
    const double length_m = distance(lap[i].from, lap[i].to);
    const double away_m = distance(end, Segment{lap[i].from, lap[i].to});
    const double at_m = dot(end - lap[i].from, lap[i].to - lap[i].from) / length_m;
    if (away_m > least_m) continue;
    least_m = away_m;
    nearest = Cut{i, at_m};
    if (at_m < near_m || at_m > length_m - near_m) nearest.reset();
  }
  if (!nearest) return;
  const bool known = std::any_of(cuts.begin(), cuts.end(), [&](const Cut& cut) {
    return cut.piece == nearest->piece && std::abs(cut.at_m - nearest->at_m) < near_m;
  });
  if (!known) cuts.push_back(*nearest);
}

}  // namespace

std::vector<Lap> lap_sections(const Lap& lap, const std::vector<SweepCell>& cells, double far_m,
                              double near_m, const std::stop_token& stop) {
  std::vector<Cut> cuts;
  for (const Vec2 end : ends_apart(cells, far_m)) {
    if (stop.stop_requested()) break;
    add_cut(cuts, lap, end, near_m);
  }
  if (cuts.empty()) return {lap};
  std::sort(cuts.begin(), cuts.end(), [](const Cut& a, const Cut& b) {
    return a.piece != b.piece ? a.piece < b.piece : a.at_m < b.at_m;
  });
  Lap cut_lap;
  std::vector<std::size_t> begins;
  auto cut = cuts.begin();
  for (std::size_t i = 0; i < lap.size(); ++i) {
    Vec2 from = lap[i].from;
    for (; cut != cuts.end() && cut->piece == i; ++cut) {
      const Vec2 along = (1.0 / distance(lap[i].from, lap[i].to)) * (lap[i].to - lap[i].from);
      const Vec2 at = lap[i].from + cut->at_m * along;
      cut_lap.push_back({from, at, {}, 0.0});
      begins.push_back(cut_lap.size());
      from = at;
    }
    PathPiece rest = lap[i];
    rest.from = from;
    cut_lap.push_back(rest);
  }
  const Lap begun = begun_at(cut_lap, begins.front());
  std::vector<Lap> sections;
  for (std::size_t k = 0; k < begins.size(); ++k) {
    const std::size_t first = begins[k] - begins.front();
    const std::size_t end = k + 1 < begins.size() ? begins[k + 1] - begins.front() : begun.size();
    sections.emplace_back(begun.begin() + static_cast<std::ptrdiff_t>(first),
                          begun.begin() + static_cast<std::ptrdiff_t>(end));
  }
  return sections;
}

}  // namespace outrider::cover
