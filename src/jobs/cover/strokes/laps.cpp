#include "strokes/laps.hpp"

#include <algorithm>
#include <limits>

namespace outrider::cover {
namespace {

constexpr double least_piece_m = 1e-9;
constexpr double joined_m = 1e-6;  // ends so near are one point but for rounding

std::vector<PathPiece> pieces_of(const PolygonGround& ground) {
  std::vector<PathPiece> pieces;
  const auto add = [&](const PathPiece& piece) {
    if (length_of(piece) > least_piece_m) pieces.push_back(piece);
  };
  for (const Segment& wall : ground.walls) add({wall.a, wall.b, {}, 0.0});
  for (const FreeArc& arc : ground.arcs) {
    const double radius = ground.radius_m;
    add({arc.centre + radius * arc.first, arc.centre + radius * arc.last, arc.centre, arc.width_rad});
  }
  return pieces;
}

/// Makes the next piece begin where the one before ends: a straight one is moved, else a leg joins them.
void join(Lap& lap, PathPiece next) {
  PathPiece& last = lap.back();
  if (last.to == next.from) {
    lap.push_back(next);
  } else if (next.turn_rad == 0.0) {
    next.from = last.to;
    lap.push_back(next);
  } else if (last.turn_rad == 0.0) {
    last.to = next.from;
    lap.push_back(next);
  } else {
    if (distance(last.to, next.from) > contact_m) lap.push_back({last.to, next.from, {}, 0.0});
    lap.push_back(next);
  }
}

void close(Lap& lap) {
  PathPiece &last = lap.back(), &first = lap.front();
  if (last.to == first.from) return;
  if (first.turn_rad == 0.0) {
    first.from = last.to;
  } else if (last.turn_rad == 0.0) {
    last.to = first.from;
  } else if (distance(last.to, first.from) > contact_m) {
    lap.push_back({last.to, first.from, {}, 0.0});
  }
}

}  // namespace

std::vector<Lap> laps_of(const PolygonGround& ground) {
  const std::vector<PathPiece> pieces = pieces_of(ground);
  std::vector<bool> used(pieces.size(), false);
  std::vector<Lap> laps;
  for (std::size_t begin = 0; begin < pieces.size(); ++begin) {
    if (used[begin]) continue;
    Lap lap{pieces[begin]};
    used[begin] = true;
    while (true) {
      const Vec2 at = lap.back().to;
      std::size_t next = pieces.size();
      double nearest = joined_m;
      for (std::size_t i = 0; i < pieces.size(); ++i) {
        const double apart = used[i] ? joined_m : distance(at, pieces[i].from);
        if (apart >= nearest) continue;
        nearest = apart;
        next = i;
      }
      if (next == pieces.size() || distance(at, lap.front().from) < nearest) break;
      used[next] = true;
      join(lap, pieces[next]);
    }
    if (distance(lap.back().to, lap.front().from) < joined_m) close(lap);
    laps.push_back(std::move(lap));
  }
  return laps;
}

Lap begun_at(const Lap& lap, std::size_t piece) {
  Lap begun = lap;
  std::rotate(begun.begin(), begun.begin() + static_cast<std::ptrdiff_t>(piece), begun.end());
  return begun;
}

Lap turned_round(const Lap& lap) {
  Lap turned;
  for (auto piece = lap.rbegin(); piece != lap.rend(); ++piece) turned.push_back(reversed(*piece));
  return turned;
}

}  // namespace outrider::cover
