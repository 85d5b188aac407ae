// Guard missions told again from their logs: every shot is flown in fine steps, the stores are counted from
// the track. None of it uses the code that flew or counted before.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

#include "outrider/jobs/guard/problem.hpp"
#include "support/fine_flight.hpp"
#include "support/logged_targets.hpp"

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

/// The counts of a replay, so that a test can make sure that it showed something.
struct Replayed {
  int shots = 0;
  int hits = 0;
  double moved_by_air_m = 0.0;        ///< most that a ball was off its parabola at the end
  double moved_while_flying_m = 0.0;  ///< most that a target went on while a ball flew
};

/// Returns the place of a target: it goes straight from one of its places to the next, or stands still.
inline Vec2 place_by_moves(const LoggedTarget& target, double time_s) {
  const auto moves = target.moves();
  if (moves.empty()) return {};
  for (std::size_t i = moves.size() - 1; i > 0; --i) {
    if (time_s >= moves[i].time_s) return xy(moves[i].centre);
    const double span = moves[i].time_s - moves[i - 1].time_s;
    if (time_s < moves[i - 1].time_s) continue;
    const double part = span > 0.0 ? (time_s - moves[i - 1].time_s) / span : 1.0;
    return xy(moves[i - 1].centre) + part * (xy(moves[i].centre) - xy(moves[i - 1].centre));
  }
  return xy(moves.front().centre);
}

/// The box of somebody at a time: who is at the place of a target has its box.
inline Target box_in(const GuardProblem& problem, const LoggedTarget& target, double time_s) {
  const Vec2 place = place_by_moves(target, time_s);
  for (const Target& box : problem.targets) {
    if (distance(xy(box.base), place) < 1e-9) return box;
  }
  ADD_FAILURE() << target.name << " is at no place of a target at " << time_s << " s";
  return problem.targets.front();
}

/// The box of a target at a time while a shot at it, fired at `shot_s`, flies.
using BoxAt = std::function<Target(const LoggedTarget&, double shot_s, double time_s)>;

/// Flies every shot of a run in fine steps through the yard as it really is.
inline Replayed replay_shots(const Run& run, const GuardProblem& truth, const BoxAt& box_at,
                             double step_m = 5e-4) {
  Replayed told;
  const auto targets = targets_of(run.log);
  const FineLaw law{truth.world.gravity_mps2, truth.air.drag_per_m, truth.air.wind()};
  const HeightField* const field = truth.world.terrain.get();
  const auto ground = [&](Vec3 p) {
    if (field == nullptr || p.z > field->height(xy(p)) + 0.3) return std::numeric_limits<double>::infinity();
    return to_ground(*field, p);
  };
  for (const auto& stamped : shots_of(run.log)) {
    const outrider_msgs::Shot& shot = stamped.message;
    const double shot_s = stamped.time_s();
    const Vec3 muzzle = vec3_of(shot.muzzle), velocity_mps = vec3_of(shot.velocity);
    const auto entry = std::ranges::find(targets, shot.target, &LoggedTarget::name);
    EXPECT_NE(entry, targets.end()) << shot.target;
    if (entry == targets.end()) continue;
    const auto hits_with = [&](double radius_m) {
      const auto to_target = [&](Vec3 p, double after_s) {
        const Target box = box_at(*entry, shot_s, shot_s + after_s);
        return to_box(p, box, xy(box.base));
      };
      return fly_fine(muzzle, velocity_mps, law, radius_m, truth.world.solids, to_target, ground,
                      truth.world.floor_z_m - 1.0, step_m);
    };
    const FineEnd end = hits_with(truth.gun.ball_radius_m);
    const bool agrees = end.hit == shot.hit && std::abs(end.time_s - shot.flight) < 2e-3;
    // A graze may go either way: then a ball that is a little larger or smaller does what was said.
    const auto grazes = [&](double by_m) {
      const FineEnd other = hits_with(truth.gun.ball_radius_m + by_m);
      return other.hit == shot.hit && std::abs(other.time_s - shot.flight) < 5e-3;
    };
    EXPECT_TRUE(agrees || grazes(2.0 * step_m) || grazes(-2.0 * step_m))
        << shot.target << " at " << shot_s << " s: said " << shot.hit << " after " << shot.flight
        << " s, flown " << end.hit << " after " << end.time_s << " s";
    const double t = shot.flight;
    const Vec3 parabola = muzzle + t * velocity_mps - Vec3{0, 0, 0.5 * truth.world.gravity_mps2 * t * t};
    told.moved_by_air_m = std::max(told.moved_by_air_m, norm(parabola - vec3_of(shot.contact_point)));
    told.moved_while_flying_m = std::max(
        told.moved_while_flying_m,
        distance(xy(box_at(*entry, shot_s, shot_s).base), xy(box_at(*entry, shot_s, shot_s + t).base)));
    ++told.shots;
    told.hits += shot.hit ? 1 : 0;
  }
  return told;
}

/// Every target has one final status and as many shots as the log has at it; the totals are theirs.
inline void expect_everybody_accounted_for(const Run& run, std::size_t count) {
  const auto targets = targets_of(run.log);
  const auto& shots = shots_of(run.log);
  ASSERT_EQ(targets.size(), count);
  std::set<std::string> names;
  double reached = 0.0, failed = 0.0, unreachable = 0.0;
  for (const LoggedTarget& target : targets) {
    EXPECT_TRUE(names.insert(target.name).second) << target.name << " is there twice";
    EXPECT_FALSE(target.reason.empty()) << target.name;
    reached += target.status == "reached" ? 1.0 : 0.0;
    failed += target.status == "failed" ? 1.0 : 0.0;
    unreachable += target.status == "unreachable" ? 1.0 : 0.0;
    const auto at_it = [&](const auto& shot) { return shot.message.target == target.name; };
    EXPECT_EQ(target.shots, std::ranges::count_if(shots, at_it)) << target.name;
    const auto last = std::find_if(shots.rbegin(), shots.rend(), at_it);
    if (target.status == "reached") {
      EXPECT_TRUE(last != shots.rend() && last->message.hit) << target.name;
    }
  }
  EXPECT_EQ(reached + failed + unreachable, static_cast<double>(count));
  EXPECT_EQ(metric(run, "targets"), static_cast<double>(count));
  EXPECT_EQ(metric(run, "reached"), reached);
  EXPECT_EQ(metric(run, "failed"), failed);
  EXPECT_EQ(metric(run, "shots"), static_cast<double>(shots.size()));
  if (run.report.status == "done") {
    EXPECT_EQ(failed, 0.0);
  } else {
    EXPECT_EQ(run.report.status, "not_done");
    EXPECT_FALSE(run.report.reason.empty());
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

/// Counts the stores from the track, the shots and the fills of a log, from full ones at its start.
/// Expects the robot to stand at the station when it fills, and the fill to take the time that it must.
inline Ledger count_stores(const Run& run, const GuardProblem& truth) {
  const Supplies& supplies = truth.supplies;
  constexpr double endless = std::numeric_limits<double>::infinity();
  const double tank = supplies.tank > 0.0 ? supplies.tank : endless;
  const double battery_j = supplies.battery_wh > 0.0 ? 3600.0 * supplies.battery_wh : endless;
  Ledger ledger{tank, battery_j, tank, battery_j};
  const auto track = track_of(run.log);
  const auto fills = events_of(run.log, "fill");
  const auto& all_shots = shots_of(run.log);
  std::size_t shots = 0;
  const auto note = [&] {
    ledger.least_water = std::min(ledger.least_water, ledger.water);
    ledger.least_charge_j = std::min(ledger.least_charge_j, ledger.charge_j);
  };
  const auto fire_until = [&](double time_s) {
    for (; shots < all_shots.size() && all_shots[shots].time_s() <= time_s; ++shots) {
      ledger.water -= supplies.shot_water;
      ledger.charge_j -= supplies.shot_j;
      note();
    }
  };
  for (std::size_t i = 1; i < track.size(); ++i) {
    const TrackSample& from = track[i - 1];
    const TrackSample& to = track[i];
    if (to.time_s <= from.time_s) continue;
    fire_until(from.time_s);
    const auto fill = static_cast<std::size_t>(ledger.fills);
    if (fill < fills.size() && from.time_s >= fills[fill].time_s() - 1e-9) {
      ++ledger.fills;
      const std::string& text = fills[fill].message.msg;
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
  EXPECT_EQ(metric(run, "fills"), static_cast<double>(fills.size()));
  return ledger;
}

/// The ledger is what the log says, to within `slack_j`, and nothing ran dry in a mission that is done.
inline Ledger expect_sound_stores(const Run& run, const GuardProblem& truth, double slack_j = 1e-3) {
  const Ledger ledger = count_stores(run, truth);
  const auto* last = run.log.latest<outrider_msgs::StoreLevels>(topic::stores);
  EXPECT_NE(run.log.latest<outrider_msgs::Supplies>(topic::supplies), nullptr);
  EXPECT_NE(last, nullptr);
  if (last == nullptr) return ledger;
  if (std::isfinite(ledger.water)) {
    EXPECT_NEAR(last->water, ledger.water, 1e-9);
  }
  if (std::isfinite(ledger.charge_j)) {
    EXPECT_NEAR(last->charge, ledger.charge_j, slack_j);
  }
  if (run.report.status == "done") {
    EXPECT_GE(ledger.least_water, -1e-9);
    EXPECT_GE(ledger.least_charge_j, -slack_j);
  }
  return ledger;
}

}  // namespace outrider::testing
