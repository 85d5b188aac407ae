// CoverPlan: a track that covers everything the robot can reach, with the proof that it does.
//
// Every method drives laps along the border of the standing room S of the disk's centre, and lanes inside of
// them (sweep_cells.hpp). Let the sure radius q = radius - tracking error be at least half a stride h. Then
// every point x within q of S is covered for every allowed tracking error:
//   1. x is nearer than q to the border of S, on either side of it: a lap passes within q.
//   2. x is in S, h or more from its border: x is in the core that the lanes cover, and the lane of its slab
//   passes
//      beside x at a distance of at most h. All of that lane is in S, because each of its points is at most h
//      beside a point of the core.
// The rest of the reach is farther than q from S: a strip along its rim, as wide as the tracking error beside
// straight walls, where nothing can be guaranteed. A fraction `uncovered` of the reach may be left out where
// only a detour would cover it. The order, starting points and directions of laps and cells form a tour with
// one stop for each way to begin a lap or cell (tour/solve.hpp). The moves between them are shortest paths of
// the disk.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "outrider/core/budget.hpp"
#include "outrider/jobs/cover/ground/coverage.hpp"
#include "outrider/jobs/cover/ground/problem.hpp"
#include "outrider/tour/solve.hpp"

namespace outrider {

/// The purpose of a piece of the track: a move between cells, a lap along a border, a lane of a cell, or a
/// transfer between areas.
enum class PieceRole { move, lap, lane, transfer };

/// Options of the planner.
struct CoverOptions {
  std::int64_t directions =
      4;  ///< number of sweep directions tried: along the longest edges, and across them
  TourOptions order{.exact_goals = 9,
                    .expansions = 20'000,
                    .iterations = 4000,
                    .gap = 0.05,
                    .operations = 100'000'000};  ///< of the tour; it proves nothing for more than 40 laps and
                                                 ///< cells, of which order_bound_s still holds
};
/// Describes the options by name.
std::vector<Option> describe(CoverOptions& options);

/// A planned track.
struct CoverPlan {
  std::string method;
  CoverTrack track;
  std::vector<PieceRole> roles;     ///< roles of the pieces of the track
  std::vector<std::size_t> begins;  ///< first piece of each lap and cell, in driving order
  TrackSums sums;
  CoverageArea ground;
  std::size_t laps = 0;
  std::size_t cells = 0;
  std::size_t lanes = 0;
  double uncovered_m2 = 0.0;   ///< area left out on purpose; at most the fraction `uncovered` of the reach
  double order_bound_s = 0.0;  ///< lower bound of the time over all orders of the same laps and cells
};

/// A row of the catalogue of methods. The same problem and options give the same track. Faults of plan():
/// those of cover_ground(); bad_input on more than 4095 ways to begin the laps and cells; budget_exhausted;
/// cancelled.
struct CoverMethod {
  std::string_view name;
  std::string_view sentence;
  std::string_view paper;
  std::function<Outcome<CoverPlan>(const CoverProblem&, const CoverOptions&, const Budget&)> plan;
  /// The guarantee in words; see the head of this file.
  std::string_view guarantee =
      "covers, for every allowed tracking error, all within the sure radius of where the robot can "
      "stand, but for the fraction left out; no bound of its time";
};
/// Returns all methods in display order.
const std::vector<CoverMethod>& cover_methods();
/// Fault: bad_input with the nearest known name.
Outcome<CoverMethod> find_cover_method(std::string_view name);

/// The guaranteed coverage of one of the fields.
struct FieldProof {
  double area_m2 = 0.0;
  double reach_m2 = 0.0;
  double inner_m2 = 0.0;          ///< of all within the sure radius of the standing room
  double planned_fraction = 0.0;  ///< of the reach, by the disk exactly on the track
  double inner_fraction = 0.0;    ///< as below
};

/// A place that nothing on the track covers.
struct MissedPlace {
  Vec2 at;  ///< a point in the middle of it
  double area_m2 = 0.0;
};

/// The guaranteed coverage of a track, computed from the track and the area alone.
struct CoverProof {
  Coverage planned;             ///< coverage of the reach by the disk exactly on the track
  double sure_fraction = 0.0;   ///< covered fraction of the reach for every allowed tracking error
  double inner_fraction = 0.0;  ///< the same for all points within the sure radius of the standing room
  double clearance_m = 0.0;  ///< exact smallest distance of the track from an edge; of transfers from a hole
  double length_bound_m = 0.0;  ///< no track that covers all is shorter (length_bound.hpp)
  std::vector<FieldProof> fields = {};
  bool complete = true;                  ///< at most the fraction `uncovered` is left out; else see `missed`
  std::vector<MissedPlace> missed = {};  ///< what is left out, the largest first
};

/// Checks the track independently of the planner. Refuses a track whose pieces do not join, that comes nearer
/// to an edge of its field than the radius (a transfer: to a hole), that begins outside or in a hole, or that
/// covers, of any field, less than 1 - `uncovered` - 0.1 % of all points within the sure radius of the
/// standing room. With a turning radius it refuses turns in place, curves that are tighter and pieces that
/// are driven backwards without `reverse`; a track that covers less than 1 - `uncovered` - 0.01 % is not
/// refused, but not complete. With a bar it refuses a track on which the disk of the robot or the bar leaves
/// the area; one that covers less is not complete either.
Outcome<CoverProof> prove(const CoverPlan& plan, const CoverProblem& problem, const Budget& budget = {});

/// The same for a plan that may be of another problem: prepares the areas from the problem, so that only the
/// track of the plan counts. Faults: also those of cover_ground().
Outcome<CoverProof> prove_anew(CoverPlan plan, const CoverProblem& problem, const Budget& budget = {});

}  // namespace outrider
