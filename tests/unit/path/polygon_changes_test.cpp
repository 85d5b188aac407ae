// Obstacles that come and go: the ground, the legs and the answers, against all made anew.
#include <gtest/gtest.h>

#include "outrider/path/catalog.hpp"
#include "outrider/path/check.hpp"
#include "polygon_worlds.hpp"
#include "support/random_cases.hpp"
#include "visibility/tangent_graph.hpp"

namespace outrider {
namespace {

using testing::PolygonWorld;

bool same(Vec2 a, Vec2 b) { return a.x == b.x && a.y == b.y; }
bool same(const Segment& s, const Segment& t) { return same(s.a, t.a) && same(s.b, t.b); }
bool same(const FreeArc& a, const FreeArc& b) {
  return same(a.centre, b.centre) && a.from_rad == b.from_rad && a.width_rad == b.width_rad &&
         same(a.first, b.first) && same(a.middle, b.middle) && same(a.last, b.last);
}
bool same(const Departure& a, const Departure& b) {
  return a.to == b.to && a.leaves == b.leaves && a.arrives == b.arrives && a.length == b.length &&
         same(a.at, b.at);
}
template <class T>
bool same(const std::vector<T>& a, const std::vector<T>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const T& x, const T& y) { return same(x, y); });
}

/// One of the kind that the world is made of: a star, or a square of the lattice.
std::vector<Vec2> random_obstacle(Rng& rng) {
  for (;;) {
    const PolygonWorld world =
        rng.below(2) == 0 ? testing::scattered_world(rng, 1) : testing::lattice_world(rng, 6, 0.2);
    if (!world.obstacles.empty()) return world.obstacles[rng.below(world.obstacles.size())];
  }
}

/// An obstacle comes, or one goes.
PolygonGround changed(Rng& rng, const PolygonGround& ground) {
  if (!ground.obstacles.empty() && rng.below(2) == 0) {
    return ground.without_obstacle(rng.below(ground.obstacles.size())).value();
  }
  return ground.with_obstacle(random_obstacle(rng)).value();
}

PolygonGround anew(const PolygonGround& ground) {
  return PolygonGround::of(ground.boundary, ground.obstacles, ground.radius_m).value();
}

TEST(PolygonChanges, AChangedGroundIsTheSameAsOneMadeAnew) {
  Rng rng = Rng(31).child("ground");
  for (int i = 0; i < testing::cases(100); ++i) {
    const PolygonWorld world = testing::random_world(rng);
    auto ground = PolygonGround::of(world.boundary, world.obstacles, world.radius_m).value();
    for (int step = 0; step < 6; ++step) {
      ground = changed(rng, ground);
      const PolygonGround again = anew(ground);
      ASSERT_TRUE(same(ground.edges, again.edges) && same(ground.arcs, again.arcs) &&
                  same(ground.walls, again.walls))
          << "world " << i << ", step " << step;
      ASSERT_EQ(ground.first_arc, again.first_arc);
      ASSERT_EQ(ground.first_wall, again.first_wall);
      ASSERT_EQ(ground.index.items, again.index.items);
      ASSERT_EQ(ground.index.rows, again.index.rows);
    }
  }
}

TEST(PolygonChanges, TheLegsAreThoseFoundAnew) {
  Rng rng = Rng(32).child("legs");
  for (int i = 0; i < testing::cases(60); ++i) {
    const PolygonWorld world = testing::random_world(rng);
    auto ground = PolygonGround::of(world.boundary, world.obstacles, world.radius_m).value();
    Workspace kept;
    for (int step = 0; step < 6; ++step) {
      for (const TangentForm form : {TangentForm::swept, TangentForm::paired}) {
        Workspace fresh;
        const auto shared = std::make_shared<const PolygonGround>(ground);
        const TangentGraph& followed = **tangent_graph(shared, form, {}, kept);
        const TangentGraph& found = **tangent_graph(shared, form, {}, fresh);
        ASSERT_EQ(followed.first, found.first) << "world " << i << ", step " << step;
        ASSERT_EQ(followed.count, found.count) << "world " << i << ", step " << step;
        ASSERT_TRUE(same(followed.legs, found.legs)) << "world " << i << ", step " << step;
      }
      ground = changed(rng, ground);
    }
  }
}

TEST(PolygonChanges, EveryPlannerAnswersAsItDoesAnew) {
  Rng rng = Rng(33).child("planners");
  std::vector<std::pair<std::string, ConfiguredPlanner>> planners;
  for (const PathPlanner& row : path_planners()) {
    if (row.polygons && row.index) planners.emplace_back(row.name, row.configure());
  }
  for (int i = 0; i < testing::cases(15); ++i) {
    const PolygonWorld world = testing::random_world(rng);
    auto ground = PolygonGround::of(world.boundary, world.obstacles, world.radius_m).value();
    std::vector<Workspace> kept(planners.size());
    for (int step = 0; step < 6; ++step) {
      ground = changed(rng, ground);
      Problem on_changed{nullptr, testing::random_place(rng, world), testing::random_place(rng, world),
                         std::make_shared<const PolygonGround>(ground)};
      Problem on_new = on_changed;
      on_new.polygons = std::make_shared<const PolygonGround>(anew(ground));
      for (std::size_t p = 0; p < planners.size(); ++p) {
        SCOPED_TRACE(::testing::Message() << planners[p].first << " in world " << i << ", step " << step);
        Workspace fresh;
        const auto plan = planners[p].second.plan(on_changed, {}, kept[p]);
        const auto other = planners[p].second.plan(on_new, {}, fresh);
        ASSERT_EQ(plan.has_value(), other.has_value());
        if (!plan) {
          ASSERT_EQ(plan.error().sentence, other.error().sentence);
          continue;
        }
        ASSERT_EQ(*plan, *other);
        ASSERT_TRUE(check(*plan, on_new));
      }
    }
  }
}

TEST(PolygonChanges, WhatCannotComeOrGoIsRefused) {
  const std::vector<Vec2> square = {{0, 0}, {10, 0}, {10, 10}, {0, 10}};
  const auto ground = PolygonGround::of(square, {{{4, 4}, {5, 4}, {5, 5}}}, 0.2).value();
  const auto gone = ground.without_obstacle(1);
  ASSERT_FALSE(gone);
  EXPECT_EQ(gone.error().sentence, "there is no obstacle 1 to take away; there are 1, counted from 0");
  const auto crossed = ground.with_obstacle({{1, 1}, {2, 2}, {2, 1}, {1, 2}});
  ASSERT_FALSE(crossed);
  EXPECT_EQ(crossed.error().code, FaultCode::bad_input);
  EXPECT_EQ(crossed.error().sentence.find("the new obstacle crosses or touches itself"), 0U);
}

}  // namespace
}  // namespace outrider
