// CoverPlan: a track that covers all that a robot can reach, with the proof that it does.
//
// Every method drives laps along all that bounds the standing room S of the disk's centre, and inside of
// them lanes (sweep_cells.hpp). Let the sure radius q = radius - tracking error be at least half a stride h.
// Then every point x within q of S is covered, however the robot strays:
//   1. x nearer than q to the border of S, on either side of it: a lap passes within q.
//   2. x in S, h or more from its border: x is in the core that the lanes are made for, and the lane of its
//      slab passes beside x at most h away. All of that lane is in S, because each of its points is at most
//      h beside a point of the core.
// The rest of the reach is farther than q from S: a strip along its rim, `tracking_error` wide beside
// straight walls, where a robot that may tracking error can promise nothing. A part `uncovered` of the reach
// may be left out where only a detour would cover it. In which order, from where and which way round laps and
// cells are driven is a tour with one stop for each way to begin one of them (tour/solve.hpp); the moves
// between are shortest paths of the disk.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "outrider/core/budget.hpp"
#include "outrider/jobs/cover/coverage.hpp"
#include "outrider/jobs/cover/problem.hpp"
#include "outrider/tour/solve.hpp"

namespace outrider {

enum class PieceRole { move, lap, lane };

struct CoverOptions {
  std::int64_t directions = 4;  ///< sweep directions tried: those of the longest edges, and across them
  TourOptions order{
      .exact_goals = 9, .expansions = 20'000, .iterations = 4000, .gap = 1.0};  ///< no long proof
};
std::vector<Option> describe(CoverOptions& options);

struct CoverPlan {
  std::string method;
  CoverTrack track;
  std::vector<PieceRole> roles;     ///< of the pieces of the track
  std::vector<std::size_t> begins;  ///< first pieces of the laps and cells, in the order they are driven in
  TrackSums sums;
  CoverageArea ground;
  std::size_t laps = 0;
  std::size_t cells = 0;
  std::size_t lanes = 0;
  double uncovered_m2 = 0.0;   ///< not covered by choice; at most `uncovered` of the reach
  double order_bound_s = 0.0;  ///< no other order of the same laps and cells takes less time
};

/// A row of the catalogue of methods. Faults: those of cover_ground(); bad_input on more than 4095 ways to
/// begin the laps and cells; budget_exhausted; cancelled. Same problem and options, same track.
struct CoverMethod {
  std::string_view name;
  std::string_view sentence;
  std::string_view paper;
  std::function<Outcome<CoverPlan>(const CoverProblem&, const CoverOptions&, const Budget&)> plan;
};
const std::vector<CoverMethod>& cover_methods();
Outcome<CoverMethod> find_cover_method(std::string_view name);

/// What a track is worth, found from the track and the area alone.
struct CoverProof {
  Coverage planned;             ///< by the full disk on the track, of the reach
  double sure_fraction = 0.0;   ///< of the reach, however the robot strays
  double inner_fraction = 0.0;  ///< the same of all within the sure radius of the standing room
  double clearance_m = 0.0;     ///< least distance of the track from an edge, exactly
};

/// The judge. Refuses a track whose pieces do not join, that comes nearer to an edge than the radius, begins
/// outside or in a hole, or leaves more than `uncovered` of the reach and 0.1 % within the sure radius of the
/// standing room.
Outcome<CoverProof> prove(const CoverPlan& plan, const CoverProblem& problem, const Budget& budget = {});

}  // namespace outrider
