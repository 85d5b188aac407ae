// The strokes of a robot with a turning radius: laps of the headland, lanes inside of it, and what these
// leave.
#pragma once

#include "outrider/core/budget.hpp"
#include "strokes/headland.hpp"
#include "strokes/turning_transit.hpp"

namespace outrider::cover {

inline constexpr int all_laps = 1 << 20;

/// Returns the strokes with that number of laps along every border. Lanes begin and end where a turn leads to
/// the headland; they are shortened as far as that takes. The area that laps and lanes leave is covered by
/// strokes along walls and sweeps, where these cover enough. There is no guarantee that all strokes can be
/// reached, nor that all is covered.
Outcome<std::vector<Stroke>> turning_strokes(const CoverProblem& problem, const CoverField& field,
                                             double arc_m, std::int64_t directions, int laps,
                                             const FreeRoom& room, const std::stop_token& stop);

/// The stroke in the opposite direction.
std::vector<PathPiece> turned_round(const Stroke& stroke);

/// The stroke without the excursions into corners.
std::vector<PathPiece> without_excursions(const std::vector<PathPiece>& pieces);

/// Adds the corners of the strokes, as poses in both directions, and the ways along the strokes between them.
/// Returns their nodes.
std::vector<std::size_t> add_strokes(TurningTransit& transit, const std::vector<Stroke>& strokes);

}  // namespace outrider::cover
