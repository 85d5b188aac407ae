#include "turning_pieces.hpp"

#include <cmath>

namespace outrider {

PathPiece piece_of(const Pose2& from, const TurningPiece& part, double radius_m) {
  const Pose2 end = after(from, part, radius_m);
  PathPiece piece{from.position, end.position, {}, 0.0, part.length_m < 0.0};
  if (part.side != 0) {
    piece.centre = from.position + part.side * radius_m * perpendicular(direction(from.heading_rad));
    piece.turn_rad = part.side * part.length_m / radius_m;
  }
  return piece;
}

std::vector<TurningPiece> joined(const std::vector<TurningPiece>& parts, double radius_m) {
  std::vector<TurningPiece> all;
  for (const TurningPiece& part : parts) {
    if (!(std::abs(part.length_m) > no_length * radius_m)) continue;
    if (!all.empty()) {
      TurningPiece& last = all.back();
      const bool same = last.side == part.side && (last.length_m < 0.0) == (part.length_m < 0.0);
      const bool whole = part.side != 0 && std::abs(last.length_m + part.length_m) > 6.0 * radius_m;
      if (same && !whole) {
        last.length_m += part.length_m;
        continue;
      }
    }
    all.push_back(part);
  }
  return all;
}

}  // namespace outrider
