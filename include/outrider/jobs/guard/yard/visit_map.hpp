// VisitMap: a learned map of the places where intruders rest, and a forecast of their motion.
//
// The map is a set of regions: points of free ground about 1.5 m apart and the centres of recorded rests.
// Each region has the time that intruders rested within 1 m of it. A few seconds are added to every region,
// so that no region has probability zero. The duration of rests and the walking speed are learned too.
//
// A forecast is a random sample of the future of one intruder. A resting intruder continues to rest for an
// exponential time. A walking intruder goes straight to a region and rests there; the region is drawn with
// its weight times a von Mises density (concentration 30) of the turn that it requires. Every later region is
// drawn by weight alone.
#pragma once

#include <vector>

#include "outrider/core/rng.hpp"
#include "outrider/jobs/guard/yard/wander.hpp"

namespace outrider {

/// The map.
struct VisitMap {
  std::vector<Vec2> regions;    ///< centre of each region
  std::vector<double> seconds;  ///< time of rest in each region
  double rests = 1.0;           ///< number of completed rests
  double rest_s = 15.0;         ///< total duration of these rests; the mean rest is rest_s / rests
  double speed_mps = 1.0;       ///< walking speed
};

/// Makes the regions on the ground where a robot can stand. If `options.learn`, learns from the history.
VisitMap visit_map(const GuardProblem& problem, const FiringMap& firing_map,
                   const std::vector<Track>& history, const WanderOptions& options);

/// Adds the rests of a track to the map, from its position number `from` on.
void learn(VisitMap& map, const Track& track, const WanderOptions& options, std::size_t from);

/// The present motion of an intruder: at rest, or straight with constant velocity.
struct Stride {
  Vec2 position;        ///< last observed position
  Vec2 velocity_mps;    ///< 0: at rest
  double seen_s = 0.0;  ///< time of the last observation
};

/// Estimates the present motion. It uses the longest final part of the track, of at least two positions, that
/// is a straight motion with constant velocity up to the error of observations. The intruder is at rest if it
/// moved by no more than that error.
Stride stride_of(const Track& track, const WanderOptions& options);

/// Extrapolates the present motion until `until_s`. Shots are aimed with this prediction.
Walk straight_on(const Stride& stride, double until_s);

/// Draws one possible future, from the last observation on.
Walk possible_future(const VisitMap& map, const Stride& stride, double until_s, Rng& rng);

}  // namespace outrider
