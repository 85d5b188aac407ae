// Why the shot of a place is chosen by what it forgives, and not by how far it keeps from solids.
#include <gtest/gtest.h>

#include "outrider/ballistics/firing_region.hpp"
#include "support/random_cases.hpp"
#include "support/random_yard.hpp"

namespace outrider {
namespace {

using testing::cases;
using testing::random_small_yard;

/// Returns the shot at the centre whose flight keeps farthest from every solid, of the pitches tried.
std::optional<Shot> clearest_shot(const ShotRules& rules, const FlightSpace& space, const Target& target,
                                  Vec2 place) {
  std::optional<Shot> clearest;
  double most = rules.margin_m;
  const Vec2 sight = xy(target.base) - place;
  for (const double pitch : pitch_lattice(rules)) {
    const auto speed = speed_through(rules.gun, pitch, norm(sight), target.centre().z, rules.gravity_mps2);
    if (!speed) continue;
    const Shot shot{heading_of(sight), pitch, *speed};
    const Flight flight = launch(rules.gun, place, 0.0, shot, rules.gravity_mps2);
    const Impact impact = fly(flight, rules.gun.ball_radius_m, space, target, 0.0);
    if (!impact.hit) continue;
    const double clearance = space.clearance(flight, rules.gun.ball_radius_m, impact.time_s, 1.0).distance_m;
    if (clearance < most) continue;
    most = clearance;
    clearest = shot;
  }
  return clearest;
}

double hit_rate(const ShotRules& rules, const FlightSpace& space, const Target& target, Vec2 place,
                const Shot& shot, Rng& rng) {
  constexpr int shots = 200;
  int hits = 0;
  for (int i = 0; i < shots; ++i) {
    const Shot off{shot.yaw_rad + rules.errors.gun_rad * rng.uniform(-1.0, 1.0),
                   shot.pitch_rad + rules.errors.gun_rad * rng.uniform(-1.0, 1.0),
                   shot.speed_mps * (1.0 + rules.errors.speed_ratio * rng.uniform(-1.0, 1.0))};
    const Flight flight = launch(rules.gun, place, 0.0, off, rules.gravity_mps2);
    hits += fly(flight, rules.gun.ball_radius_m, space, target, 0.0).hit ? 1 : 0;
  }
  return static_cast<double>(hits) / shots;
}

TEST(BestShot, HitsMoreOftenThanTheShotWithTheMostClearance) {
  Rng rng(321);
  ShotRules rules;
  rules.errors = {0.03, 0.03};  // with the usual ones both hit nearly always
  double best_hits = 0.0;
  double clearest_hits = 0.0;
  int compared = 0;
  int best_sure = 0;
  int clearest_sure = 0;
  for (int i = 0; i < cases(150); ++i) {
    const auto yard = random_small_yard(rng, 5, 2.5);
    const FlightSpace space(yard.solids);
    const Vec2 place = xy(yard.target.base) + testing::random_offset(rng, 2.0, 9.0);
    const auto best = best_shot(rules, space, yard.target, place, 0.0);
    const auto clearest = clearest_shot(rules, space, yard.target, place);
    if (!best || !clearest) continue;
    ++compared;
    const double best_rate = hit_rate(rules, space, yard.target, place, best->shot, rng);
    const double clearest_rate = hit_rate(rules, space, yard.target, place, *clearest, rng);
    best_hits += best_rate;
    clearest_hits += clearest_rate;
    best_sure += best_rate >= 0.99 ? 1 : 0;
    clearest_sure += clearest_rate >= 0.99 ? 1 : 0;
    EXPECT_GE(best->clearance_m, rules.margin_m - 1e-4);  // what must be kept is kept in any case
  }
  ASSERT_GT(compared, 30);
  EXPECT_GT(best_hits, clearest_hits);
  EXPECT_GT(best_sure, clearest_sure);
  RecordProperty("compared", compared);
  RecordProperty("best_percent", static_cast<int>(100.0 * best_hits / compared));
  RecordProperty("clearest_percent", static_cast<int>(100.0 * clearest_hits / compared));
  RecordProperty("best_sure", best_sure);
  RecordProperty("clearest_sure", clearest_sure);
}

}  // namespace
}  // namespace outrider
