// Guard missions told again from their reports: every shot is flown in fine steps, the stores are counted
// from the track. None of it uses the code that flew or counted before.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

#include "outrider/jobs/guard/problem.hpp"
#include "outrider/report/page_report.hpp"
#include "support/fine_flight.hpp"
#include "support/paged.hpp"

namespace outrider::testing {

/// Distance from a point to an upright turned box whose base is at a place, by hand.
inline double to_box(Vec3 p, const Target& target, Vec2 place) {
  const double dx = p.x - place.x, dy = p.y - place.y;
  const double c = std::cos(target.yaw_rad), s = std::sin(target.yaw_rad);
  const double along = std::max(0.0, std::abs(c * dx + s * dy) - 0.5 * target.size.x);
  const double across = std::max(0.0, std::abs(-s * dx + c * dy) - 0.5 * target.size.y);
  const double up = std::max({0.0, target.base.z - p.z, p.z - target.base.z - target.size.z});
  return std::sqrt(along * along + across * across + up * up);
}

/// Distance from a point to the triangles near it; 0 below the ground.
inline double to_ground(const HeightField& field, Vec3 p) {
  const Cell cell = field.cell_at(xy(p));
  double nearest = std::numeric_limits<double>::infinity();
  for (int y = std::max(0, cell.y - 1); y <= std::min(field.rows() - 2, cell.y + 1); ++y) {
    for (int x = std::max(0, cell.x - 1); x <= std::min(field.columns() - 2, cell.x + 1); ++x) {
      const Vec3 low = field.post(x, y), high = field.post(x + 1, y + 1);
      for (const Vec3 side : {field.post(x + 1, y), field.post(x, y + 1)}) {
        nearest = std::min(nearest, distance_to_face(p, {low, side, high}));
      }
    }
  }
  return p.z <= field.height(xy(p)) ? 0.0 : nearest;
}

/// What a replay found, so that a test can make sure that it showed something.
struct Replayed {
  int shots = 0;
  int hits = 0;
  double moved_by_air_m = 0.0;        ///< most that a ball was off its parabola at the end
  double moved_while_flying_m = 0.0;  ///< most that a target went on while a ball flew
};

/// A target that went straight from one entry of its moves to the next, or stood still.
inline Vec2 place_by_moves(const ReportTarget& target, double time_s) {
  if (!target.moves || target.moves->empty()) return xy(target.centre);
  const auto& moves = *target.moves;
  for (std::size_t i = moves.size() - 1; i > 0; --i) {
    if (time_s >= moves[i].time_s) return moves[i].position;
    const double span = moves[i].time_s - moves[i - 1].time_s;
    if (time_s < moves[i - 1].time_s) continue;
    const double part = span > 0.0 ? (time_s - moves[i - 1].time_s) / span : 1.0;
    return moves[i - 1].position + part * (moves[i].position - moves[i - 1].position);
  }
  return moves.front().position;
}

/// The box of somebody at a time, by the moves of its entry: who is at the place of a target has its box.
inline Target box_in(const GuardProblem& problem, const ReportTarget& target, double time_s) {
  const Vec2 place = place_by_moves(target, time_s);
  for (const Target& box : problem.targets) {
    if (distance(xy(box.base), place) < 1e-9) return box;
  }
  ADD_FAILURE() << target.name << " is at no place of a target at " << time_s << " s";
  return problem.targets.front();
}

/// The box of a target at a time while a shot at it flies.
using BoxAt = std::function<Target(const ReportTarget&, const ReportShot&, double time_s)>;

/// Flies every shot of a report in fine steps through the yard as it really is.
inline Replayed replay_shots(const PageReport& report, const GuardProblem& truth, const BoxAt& box_at,
                             double step_m = 5e-4) {
  Replayed told;
  const FineLaw law{truth.world.gravity_mps2, truth.air.drag_per_m, truth.air.wind()};
  const HeightField* const field = truth.world.terrain.get();
  const auto ground = [&](Vec3 p) {
    if (field == nullptr || p.z > field->height(xy(p)) + 0.3) return std::numeric_limits<double>::infinity();
    return to_ground(*field, p);
  };
  for (const ReportShot& shot : report.shots) {
    const auto entry = std::ranges::find(report.targets, shot.target, &ReportTarget::name);
    EXPECT_NE(entry, report.targets.end()) << shot.target;
    if (entry == report.targets.end()) continue;
    const auto hits_with = [&](double radius_m) {
      const auto to_target = [&](Vec3 p, double after_s) {
        const Target box = box_at(*entry, shot, shot.time_s + after_s);
        return to_box(p, box, xy(box.base));
      };
      return fly_fine(shot.muzzle, shot.velocity_mps, law, radius_m, truth.world.solids, to_target, ground,
                      truth.world.floor_z_m - 1.0, step_m);
    };
    const FineEnd end = hits_with(truth.gun.ball_radius_m);
    const bool agrees = end.hit == shot.hit && std::abs(end.time_s - shot.flight_s) < 2e-3;
    // A graze may go either way: then a ball that is a little larger or smaller does what was said.
    const auto grazes = [&](double by_m) {
      const FineEnd other = hits_with(truth.gun.ball_radius_m + by_m);
      return other.hit == shot.hit && std::abs(other.time_s - shot.flight_s) < 5e-3;
    };
    EXPECT_TRUE(agrees || grazes(2.0 * step_m) || grazes(-2.0 * step_m))
        << shot.target << " at " << shot.time_s << " s: said " << shot.hit << " after " << shot.flight_s
        << " s, flown " << end.hit << " after " << end.time_s << " s";
    const double t = shot.flight_s;
    const Vec3 parabola =
        shot.muzzle + t * shot.velocity_mps - Vec3{0, 0, 0.5 * truth.world.gravity_mps2 * t * t};
    told.moved_by_air_m = std::max(told.moved_by_air_m, norm(parabola - shot.contact_point));
    told.moved_while_flying_m = std::max(
        told.moved_while_flying_m,
        distance(xy(box_at(*entry, shot, shot.time_s).base), xy(box_at(*entry, shot, shot.time_s + t).base)));
    ++told.shots;
    told.hits += shot.hit ? 1 : 0;
  }
  return told;
}

/// Every target has one final status and as many shots as the report has of it; the totals are theirs.
inline void expect_everybody_accounted_for(const PageReport& report, std::size_t targets) {
  ASSERT_EQ(report.targets.size(), targets);
  std::set<std::string> names;
  double reached = 0.0, failed = 0.0, unreachable = 0.0;
  for (const ReportTarget& target : report.targets) {
    EXPECT_TRUE(names.insert(target.name).second) << target.name << " is there twice";
    EXPECT_FALSE(target.reason.empty()) << target.name;
    reached += target.status == "reached" ? 1.0 : 0.0;
    failed += target.status == "failed" ? 1.0 : 0.0;
    unreachable += target.status == "unreachable" ? 1.0 : 0.0;
    EXPECT_EQ(target.shots, std::ranges::count(report.shots, target.name, &ReportShot::target))
        << target.name;
    const auto last = std::find_if(report.shots.rbegin(), report.shots.rend(),
                                   [&](const ReportShot& shot) { return shot.target == target.name; });
    if (target.status == "reached") {
      EXPECT_TRUE(last != report.shots.rend() && last->hit) << target.name;
    }
  }
  const auto count = static_cast<double>(targets);
  EXPECT_EQ(reached + failed + unreachable, count);
  EXPECT_EQ(metric(report, "targets"), count);
  EXPECT_EQ(metric(report, "reached"), reached);
  EXPECT_EQ(metric(report, "failed"), failed);
  EXPECT_EQ(metric(report, "shots"), static_cast<double>(report.shots.size()));
  if (report.status == "done") {
    EXPECT_EQ(failed, 0.0);
  } else {
    EXPECT_EQ(report.status, "not_done");
    EXPECT_FALSE(report.reason.empty());
  }
}

/// The stores counted again.
struct Ledger {
  double water = 0.0;
  double charge_j = 0.0;
  double least_water = 0.0;
  double least_charge_j = 0.0;
  int fills = 0;
  int recharges = 0;  ///< of these
};

/// Counts the stores from the track, the shots and the fills of a report, from full ones at its start.
/// Expects the robot to stand at the station when it fills, and the fill to take the time that it must.
inline Ledger count_stores(const PageReport& report, const GuardProblem& truth) {
  const Supplies& supplies = truth.supplies;
  constexpr double endless = std::numeric_limits<double>::infinity();
  const double tank = supplies.tank > 0.0 ? supplies.tank : endless;
  const double battery_j = supplies.battery_wh > 0.0 ? 3600.0 * supplies.battery_wh : endless;
  Ledger ledger{tank, battery_j, tank, battery_j};
  std::vector<ReportEvent> fills;
  for (const ReportEvent& event : report.events) {
    if (event.kind == "fill") fills.push_back(event);
  }
  std::size_t shots = 0;
  const auto note = [&] {
    ledger.least_water = std::min(ledger.least_water, ledger.water);
    ledger.least_charge_j = std::min(ledger.least_charge_j, ledger.charge_j);
  };
  const auto fire_until = [&](double time_s) {
    for (; shots < report.shots.size() && report.shots[shots].time_s <= time_s; ++shots) {
      ledger.water -= supplies.shot_water;
      ledger.charge_j -= supplies.shot_j;
      note();
    }
  };
  for (std::size_t i = 1; i < report.track.size(); ++i) {
    const TrackSample& from = report.track[i - 1];
    const TrackSample& to = report.track[i];
    if (to.time_s <= from.time_s) continue;
    fire_until(from.time_s);
    const auto fill = static_cast<std::size_t>(ledger.fills);
    if (fill < fills.size() && from.time_s >= fills[fill].time_s - 1e-9) {
      ++ledger.fills;
      const std::string& text = fills[fill].text;
      const bool water = text.find("takes in water") == 0;
      const auto station = std::ranges::find_if(
          supplies.stations, [&](const Station& one) { return text.ends_with(" at " + one.name); });
      EXPECT_NE(station, supplies.stations.end()) << text;
      if (station == supplies.stations.end()) continue;
      EXPECT_TRUE(water ? station->gives_water : station->gives_charge) << text;
      EXPECT_LE(distance(from.pose.position, station->position), truth.errors.position_m + 1e-5) << text;
      EXPECT_EQ(from.pose.position, to.pose.position) << text;
      const double missing = water ? tank - ledger.water : (battery_j - ledger.charge_j) / 3600.0;
      const double takes_s = water ? supplies.refill_s + supplies.refill_per_unit_s * missing
                                   : supplies.recharge_s + supplies.recharge_per_wh_s * missing;
      EXPECT_NEAR(to.time_s - from.time_s, takes_s, 0.01) << text;
      (water ? ledger.water : ledger.charge_j) = water ? tank : battery_j;
      ledger.recharges += water ? 0 : 1;
      continue;
    }
    const Segment step{from.pose.position, to.pose.position};
    const double way_m = truth.world.terrain ? truth.world.terrain->length(step) : distance(step.a, step.b);
    ledger.charge_j -= supplies.power_w * (to.time_s - from.time_s) + supplies.drive_jpm * way_m;
    note();
  }
  fire_until(endless);
  EXPECT_EQ(static_cast<std::size_t>(ledger.fills), fills.size());
  EXPECT_EQ(metric(report, "fills"), static_cast<double>(fills.size()));
  return ledger;
}

/// The ledger is what the report says, to within `slack_j`, and nothing ran dry in a mission that is done.
inline Ledger expect_sound_stores(const PageReport& report, const GuardProblem& truth,
                                  double slack_j = 1e-3) {
  const Ledger ledger = count_stores(report, truth);
  EXPECT_TRUE(report.supplies.has_value() && !report.supplies->levels.empty());
  if (!report.supplies || report.supplies->levels.empty()) return ledger;
  const ReportLevel& last = report.supplies->levels.back();
  if (std::isfinite(ledger.water)) {
    EXPECT_NEAR(last.water, ledger.water, 1e-9);
  }
  if (std::isfinite(ledger.charge_j)) {
    EXPECT_NEAR(last.charge_j, ledger.charge_j, slack_j);
  }
  if (report.status == "done") {
    EXPECT_GE(ledger.least_water, -1e-9);
    EXPECT_GE(ledger.least_charge_j, -slack_j);
  }
  return ledger;
}

}  // namespace outrider::testing
