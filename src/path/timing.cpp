#include "outrider/path/timing.hpp"

#include <cmath>
#include <optional>

#include "outrider/core/units.hpp"
#include "outrider/path/pieces.hpp"

namespace outrider {
namespace {

constexpr double least_corner_rad = 1e-6, least_length_m = 1e-9;

/// Returns the path as pieces that take some length.
std::vector<PathPiece> driven_pieces(const Plan& plan) {
  std::vector<PathPiece> pieces = plan.pieces;
  for (std::size_t i = 1; plan.pieces.empty() && i < plan.waypoints.size(); ++i) {
    pieces.push_back({plan.waypoints[i - 1], plan.waypoints[i], {}, 0.0});
  }
  std::erase_if(pieces, [](const PathPiece& piece) { return length_of(piece) < least_length_m; });
  return pieces;
}

}  // namespace

std::vector<CurvePiece> curve_of(const Plan& plan) {
  std::vector<CurvePiece> curve;
  const std::vector<PathPiece> pieces = driven_pieces(plan);
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const PathPiece& piece = pieces[i];
    CurvePiece& next = curve.emplace_back();
    next.length_m = length_of(piece);
    next.curvature_per_m = piece.turn_rad / next.length_m;
    if (i == 0) continue;
    if (plan.steering) {
      next.stop = piece.backward != pieces[i - 1].backward;
      continue;
    }
    const double turn_rad = turn_in_place(heading_out(pieces[i - 1]), heading_in(piece));
    if (std::abs(turn_rad) > least_corner_rad) next.turn_rad = turn_rad;
  }
  return curve;
}

Outcome<FastestDrive> fastest_drive(const Plan& plan, const DriveLimits& limits) {
  return fastest_drive(curve_of(plan), limits);
}

}  // namespace outrider
