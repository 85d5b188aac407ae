// VisitMap: where intruders like to be, learned from where they were; and what they may do next.
//
// The map is a set of regions, points of free ground about 1.5 m apart and the centres of rests in the
// recorded past, each with the seconds that intruders rested within 1 m of it. To these a few seconds are
// added everywhere, so that nothing is impossible. What is learned beside it: how long they rest and how fast
// they walk.
//
// The forecast of one intruder is drawn, many times: one who rests goes on doing so for an exponential time;
// one who walks goes straight on, as far as a region that is drawn by its weight and by how little one would
// have to turn to it (von Mises, concentration 30), and rests there; then a region is drawn by weight alone.
#pragma once

#include <vector>

#include "outrider/core/rng.hpp"
#include "outrider/jobs/guard/wander.hpp"

namespace outrider {

struct VisitMap {
  std::vector<Vec2> regions;
  std::vector<double> seconds;  ///< of rest, by region
  double rests = 1.0;           ///< number of rests that ended
  double rest_s = 15.0;         ///< of these, summed; the mean rest is rest_s / rests
  double speed_mps = 1.0;       ///< of those who walk
};

/// The regions over the standable ground, with what the history tells, if `options.learn`.
VisitMap visit_map(const GuardProblem& problem, const FiringMap& firing_map,
                   const std::vector<Track>& history, const WanderOptions& options);

/// Adds the rests of a track, from glimpse `from` on, to the map.
void learn(VisitMap& map, const Track& track, const WanderOptions& options, std::size_t from);

/// What one does at the moment: at rest, or straight on.
struct Stride {
  Vec2 position;      ///< at the last glimpse
  Vec2 velocity_mps;  ///< 0: at rest
  double seen_s = 0.0;
};

/// From the longest end of the track that is straight and even to within the error of sight, and at least
/// two glimpses: at rest when it has moved by no more than that.
Stride stride_of(const Track& track, const WanderOptions& options);

/// Straight on for ever, or at rest for ever: what the aim leads by.
Walk straight_on(const Stride& stride, double until_s);

/// One possible future from the last glimpse on.
Walk possible_future(const VisitMap& map, const Stride& stride, double until_s, Rng& rng);

}  // namespace outrider
