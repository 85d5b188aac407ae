#include <fmt/format.h>

#include "outrider/core/units.hpp"
#include "outrider/jobs/cover/plan.hpp"
#include "outrider/path/check.hpp"

namespace outrider {
namespace {

constexpr double slack_m = 2.0 * contact_m;
constexpr double measured_to = 1e-3;  // of the area, by chords and rounding
constexpr double proof_arc_step_rad = radians(2.0);

tl::unexpected<Fault> refused(std::string sentence) { return bad_input(std::move(sentence), "track"); }

Status check_joints(const CoverTrack& track) {
  Vec2 at = track.start.position;
  for (std::size_t i = 0; i < track.pieces.size(); ++i) {
    const PathPiece& piece = track.pieces[i];
    if (!(distance(at, piece.from) <= slack_m)) {
      return refused(fmt::format("piece {} does not begin where the one before ends", i));
    }
    const double radius = distance(piece.centre, piece.from);
    if (piece.turn_rad != 0.0 && !(std::abs(distance(piece.centre, piece.to) - radius) <= slack_m)) {
      return refused(fmt::format("piece {} is no arc about its centre", i));
    }
    at = piece.to;
  }
  return {};
}

}  // namespace

Outcome<CoverProof> prove(const CoverPlan& plan, const CoverProblem& problem, const Budget& budget) {
  const PolygonGround& ground = *plan.ground.ground;
  if (auto good = check_joints(plan.track); !good) return pass_on(good);
  CoverProof proof;
  Plan path;
  path.pieces = plan.track.pieces;
  proof.clearance_m = clearance_m(path, ground);
  if (!(proof.clearance_m >= problem.radius_m() - slack_m)) {
    return refused(fmt::format("it comes within {} m of an edge, nearer than the radius of {} m",
                               proof.clearance_m, problem.radius_m()));
  }
  if (!contains(plan.ground.area, plan.track.start.position)) return refused("it begins outside of the area");
  const std::vector<Vec2> points =
      points_along(plan.track.start.position, plan.track.pieces, proof_arc_step_rad);
  const double sure = problem.sure_radius_m(), error_m = problem.tracking_error_m;
  proof.planned = coverage_of(points, problem.radius_m(), plan.ground.reach, budget.stop);
  const Coverage surely =
      error_m > 0.0 ? coverage_of(points, sure, plan.ground.reach, budget.stop) : proof.planned;
  if (budget.stop.stop_requested())
    return fault(FaultCode::cancelled, "it was cancelled while it measured what the track covers");
  proof.sure_fraction = surely.fraction;
  const Region inner = error_m > 0.0
                           ? common(grown(plan.ground.standing, sure, plan.ground.arc_m), plan.ground.area)
                           : plan.ground.reach;
  const double inner_m2 = area_of(inner);
  proof.inner_fraction = inner_m2 > 0.0 ? area_of(common(surely.covered, inner)) / inner_m2 : 1.0;
  const double asked = 1.0 - problem.uncovered * area_of(plan.ground.reach) / std::max(inner_m2, 1e-12);
  if (!(proof.inner_fraction >= asked - measured_to)) {
    return refused(
        fmt::format("it surely covers only {:.5f} of what the robot can reach", proof.inner_fraction));
  }
  return proof;
}

}  // namespace outrider
