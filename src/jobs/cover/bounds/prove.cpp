#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "ground/tool_coverage.hpp"
#include "outrider/core/text.hpp"
#include "outrider/core/units.hpp"
#include "outrider/jobs/cover/bounds/length_bound.hpp"
#include "outrider/jobs/cover/strokes/plan.hpp"
#include "outrider/path/check.hpp"

namespace outrider {
namespace {

constexpr double slack_m = 2.0 * contact_m;
constexpr double measured_to = 1e-3;  // of the area, by chords and rounding
constexpr double chords_only = 1e-4;  // of it, where a track may leave something out
constexpr double same_heading_rad = 1e-6;
constexpr double least_missed = 1e-5;  // of the reach, worth a row

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

/// Checks that a robot with the turning radius can drive the track: no turn in place, no curve that is
/// tighter, and backwards only where it may.
Status check_curvature(const CoverTrack& track, const CoverProblem& problem) {
  double heading = track.start.heading_rad;
  for (std::size_t i = 0; i < track.pieces.size(); ++i) {
    const PathPiece& piece = track.pieces[i];
    const double turn = std::abs(wrap_angle(heading_in(piece) - heading));
    if (!(turn <= same_heading_rad)) {
      return refused(fmt::format("the robot would have to turn by {:.3g} degrees on the spot before piece {}",
                                 degrees(turn), i));
    }
    if (piece.backward && !problem.reverse) return refused(fmt::format("piece {} is driven backwards", i));
    const double radius = distance(piece.centre, piece.from);
    if (piece.turn_rad != 0.0 && !(radius >= problem.turning_radius_m - slack_m)) {
      return refused(fmt::format("piece {} has a radius of {} m, below the {} m that the robot can drive", i,
                                 short_number(radius), short_number(problem.turning_radius_m)));
    }
    heading = heading_out(piece);
  }
  return {};
}

/// Checks that the bar stays within the area.
Status check_bar(const CoverPlan& plan, const CoverProblem& problem, const Bar& bar,
                 const std::stop_token& stop) {
  const Region out =
      cover::outside_of(cover::poses_along(plan.track.start, plan.track.pieces), bar, plan.ground.area, stop);
  if (out.empty()) return {};
  const Vec2 at = out.front().outer.front();
  return refused(fmt::format("the bar leaves the area about {}, by {:.3g} m2 in all",
                             place_text(problem.frame, at), area_of(out)));
}

/// Returns the parts of the region, the largest first, without those that are only chords and rounding; at
/// least the largest.
std::vector<MissedPlace> places_of(const Region& missed, double reach_m2) {
  std::vector<MissedPlace> places;
  for (const RingedPolygon& part : missed) places.push_back({middle_of(part), area_of(part)});
  std::stable_sort(places.begin(), places.end(),
                   [](const MissedPlace& a, const MissedPlace& b) { return a.area_m2 > b.area_m2; });
  while (places.size() > 1 && places.back().area_m2 < least_missed * reach_m2) places.pop_back();
  return places;
}

/// Returns the smallest distance of the track from an edge of the field that each piece is in, and of
/// transfers from an edge of the ground of all.
double clearance_of(const CoverPlan& plan, const std::stop_token& stop) {
  const auto& fields = plan.ground.fields;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < plan.track.pieces.size() && !stop.stop_requested(); ++i) {
    const PathPiece& piece = plan.track.pieces[i];
    const auto field = std::find_if(fields.begin(), fields.end(), [&](const CoverField& one) {
      return fields.size() == 1 || contains(one.area, piece.from);
    });
    const bool transfer = plan.roles[i] == PieceRole::transfer || field == fields.end();
    Plan part;
    part.pieces.push_back(piece);
    least = std::min(least, clearance_m(part, transfer ? *plan.ground.ground : *field->ground));
  }
  return least;
}

/// Returns all within the sure radius of the standing room of the field.
Region inner_of(const CoverField& field, const CoverProblem& problem, double arc_m) {
  if (!(problem.tracking_error_m > 0.0)) return field.reach;
  return common(grown(field.standing, problem.sure_radius_m(), arc_m), field.area);
}

/// Measures what of a field the regions cover.
FieldProof measured(const CoverField& field, const CoverProblem& problem, const Region& planned,
                    const Region& surely, double arc_m) {
  const Region inner = inner_of(field, problem, arc_m);
  const auto fraction = [](const Region& covered, const Region& of) {
    const double all_m2 = area_of(of);
    return all_m2 > 0.0 ? area_of(common(covered, of)) / all_m2 : 1.0;
  };
  return {area_of(field.area), area_of(field.reach), area_of(inner), fraction(planned, field.reach),
          fraction(surely, inner)};
}

}  // namespace

Outcome<CoverProof> prove(const CoverPlan& plan, const CoverProblem& problem, const Budget& budget) {
  if (plan.roles.size() != plan.track.pieces.size()) {
    return refused(
        fmt::format("it has {} pieces and roles of {}", plan.track.pieces.size(), plan.roles.size()));
  }
  if (auto good = check_joints(plan.track); !good) return pass_on(good);
  if (auto good = problem.curves() ? check_curvature(plan.track, problem) : Status{}; !good)
    return pass_on(good);
  CoverProof proof;
  proof.clearance_m = clearance_of(plan, budget.stop);
  if (!(proof.clearance_m >= problem.body_radius_m() - slack_m)) {
    return refused(fmt::format("it comes within {} m of an edge, nearer than the radius of {} m",
                               short_number(proof.clearance_m), short_number(problem.body_radius_m())));
  }
  if (plan.ground.ground->solid(plan.track.start.position)) return refused("it begins outside of the area");
  if (auto good = problem.bar() ? check_bar(plan, problem, *problem.bar(), budget.stop) : Status{}; !good)
    return pass_on(good);
  const double error_m = problem.tracking_error_m;
  proof.length_bound_m = least_length_m(plan.ground, problem, budget.stop);
  const auto covered = [&](bool surely) {
    return cover::coverage_along(plan.track.start, plan.track.pieces, problem, plan.ground.reach, surely,
                                 budget.stop);
  };
  proof.planned = covered(false);
  const Coverage surely = error_m > 0.0 ? covered(true) : proof.planned;
  if (budget.stop.stop_requested())
    return fault(FaultCode::cancelled, "it was cancelled while it measured what the track covers");
  proof.sure_fraction = surely.fraction;
  double inner_m2 = 0.0, inner_covered_m2 = 0.0;
  for (const CoverField& field : plan.ground.fields) {
    const FieldProof one = measured(field, problem, proof.planned.covered, surely.covered, plan.ground.arc_m);
    const bool may_miss = problem.curves() || problem.bar();
    const double slack = may_miss ? chords_only : measured_to;
    const bool complete =
        one.inner_fraction >= 1.0 - problem.uncovered * one.reach_m2 / std::max(one.inner_m2, 1e-12) - slack;
    if (!complete && may_miss) {
      proof.complete = false;
      proof.missed =
          places_of(without(inner_of(field, problem, plan.ground.arc_m), surely.covered), one.reach_m2);
    } else if (!complete) {
      return refused(
          fmt::format("it surely covers only {:.5f} of what the robot can reach", one.inner_fraction));
    }
    inner_m2 += one.inner_m2;
    inner_covered_m2 += one.inner_fraction * one.inner_m2;
    proof.fields.push_back(one);
  }
  proof.inner_fraction = inner_m2 > 0.0 ? inner_covered_m2 / inner_m2 : 1.0;
  return proof;
}

Outcome<CoverProof> prove_anew(CoverPlan plan, const CoverProblem& problem, const Budget& budget) {
  auto ground = cover_ground(problem);
  if (!ground) return pass_on(ground);
  plan.ground = std::move(*ground);
  return prove(plan, problem, budget);
}

}  // namespace outrider
