#include "outrider/ballistics/contact.hpp"

#include <gtest/gtest.h>

#include "support/fine_flight.hpp"
#include "support/random_cases.hpp"
#include "support/random_yard.hpp"

namespace outrider {
namespace {

using testing::box_at;
using testing::cases;
using testing::floor_at;
using testing::fly_fine;
using testing::own_distance;
using testing::random_solid;

Flight random_flight(Rng& rng) {
  const double pitch = rng.uniform(-0.5, 0.8);
  const double yaw = rng.uniform(-pi, pi);
  const double speed = rng.uniform(2.0, 10.0);
  const double away = rng.uniform(1.0, 2.5);
  const Vec2 from = -away * direction(yaw + rng.uniform(-0.3, 0.3));
  return {{from.x, from.y, rng.uniform(0.1, 0.5)},
          {speed * std::cos(pitch) * std::cos(yaw), speed * std::cos(pitch) * std::sin(yaw),
           speed * std::sin(pitch)},
          9.8};
}

/// Contact of a ball a little smaller must be found, and what is found must be one of a ball a little
/// larger: between them lies what steps of 0.2 mm cannot tell.
TEST(Contact, AgreesWithFineStepsOnEveryKindOfSolid) {
  Rng rng(21);
  constexpr double radius = 0.01;
  constexpr double unsure = 1.5e-4;
  int touched = 0;
  for (int i = 0; i < cases(700); ++i) {
    const std::vector<Solid> solids{random_solid(rng, static_cast<std::uint64_t>(i) % 7, 0.2)};
    const Flight flight = random_flight(rng);
    const double end = fall_time(flight, -0.5);
    const auto found = contact_time(flight, radius, solids[0], 0.0, end);
    const auto contact = FlightSpace(solids).first_contact(flight, radius, end);
    ASSERT_EQ(found.has_value(), contact.has_value()) << solids[0].name << " " << i;
    const auto less =
        fly_fine(flight.muzzle, flight.velocity_mps, 9.8, radius - unsure, solids, nullptr, -0.5);
    const auto more =
        fly_fine(flight.muzzle, flight.velocity_mps, 9.8, radius + unsure, solids, nullptr, -0.5);
    if (less.solid) {
      EXPECT_TRUE(found.has_value()) << solids[0].name << " " << i;
    }
    if (!found) continue;
    ++touched;
    EXPECT_TRUE(more.solid.has_value()) << solids[0].name << " " << i;
    EXPECT_LT(10.0 * std::abs(*found - contact->time_s), 1e-4);  // either is within the tolerance
    EXPECT_GE(*found, more.time_s - 1e-4);                       // a step
    if (less.solid) {
      EXPECT_LE(*found, less.time_s + 1e-4);
    }
    EXPECT_LE(own_distance(contact->position, solids[0]), radius + contact_tolerance_m + 1e-9);
  }
  EXPECT_GT(touched, 50);
}

TEST(Contact, FirstOfManyIsTheFirst) {
  Rng rng(22);
  int touched = 0;
  for (int i = 0; i < cases(100); ++i) {
    std::vector<Solid> solids{floor_at(0.0)};
    for (std::uint64_t k = 0; k < 12; ++k) solids.push_back(random_solid(rng, k % 7, 2.0));
    const Flight flight = random_flight(rng);
    const FlightSpace space(solids);
    const auto first = space.first_contact(flight, 0.01, 10.0);
    ASSERT_TRUE(first.has_value());  // the floor at the latest
    const auto fine = fly_fine(flight.muzzle, flight.velocity_mps, 9.8, 0.01, solids, nullptr, -1.0);
    const double reach = norm(flight.velocity(first->time_s)) * std::abs(first->time_s - fine.time_s);
    if (first->solid == *fine.solid) {
      // A grazing contact may be seen later by steps than it is.
      if (reach > 5e-4) {
        EXPECT_LT(own_distance(first->position, solids[first->solid]), 0.01 + 2e-6);
      }
      touched += reach <= 5e-4 ? 1 : 0;
    } else {
      EXPECT_LT(own_distance(first->position, solids[first->solid]), 0.01 + 2e-6);
      EXPECT_LE(first->time_s, fine.time_s);
    }
  }
  EXPECT_GT(touched, 90);
}

TEST(Contact, SkipsNoWallHoweverThin) {
  Rng rng(23);
  for (const double thick : {1e-3, 1e-6, 1e-9, 0.0}) {
    const Solid wall = box_at("wall", {1.5, 0, 1.0}, {thick, 4.0, 4.0});
    const Solid sheet{
        "sheet", {{1.5, 0, 0}, {}}, MeshShape{{{Vec3{0, -2, -2}, Vec3{0, 4, -2}, Vec3{0, 0, 9}}}}};
    for (int i = 0; i < cases(50); ++i) {
      const double speed = rng.uniform(3.0, 500.0);
      const Flight flight{
          {0, 0, rng.uniform(0.5, 1.5)}, {speed, 0.1 * rng.normal(), rng.uniform(0.0, 1.0)}, 9.8};
      const double arrival = (1.5 - 0.5 * thick - 0.01) / speed;
      for (const Solid& solid : {wall, sheet}) {
        const auto t = contact_time(flight, 0.01, solid, 0.0, 3.0);
        ASSERT_TRUE(t.has_value()) << solid.name << " " << thick << " " << speed;
        EXPECT_NEAR(*t * speed, arrival * speed, 1e-3);
      }
    }
  }
}

TEST(Contact, StartsInsideASolidAtOnceAndTiesGoToTheFirst) {
  const Solid a = box_at("a", {0, 0, 1}, {1, 1, 1});
  const FlightSpace space({box_at("far", {5, 0, 1}, {1, 1, 1}), a, a});
  const auto contact = space.first_contact({{0, 0, 1}, {1, 0, 0}, 9.8}, 0.01, 5.0);
  ASSERT_TRUE(contact.has_value());
  EXPECT_EQ(contact->time_s, 0.0);
  EXPECT_EQ(contact->solid, 1U);
}

TEST(Contact, NothingIsTouchedOutsideTheTimeAsked) {
  const Solid wall = box_at("wall", {2, 0, 0}, {0.1, 10, 100});
  const Flight flight{{0, 0, 1}, {10, 0, 0}, 9.8};
  EXPECT_FALSE(contact_time(flight, 0.01, wall, 0.0, 0.19).has_value());
  EXPECT_TRUE(contact_time(flight, 0.01, wall, 0.0, 0.2).has_value());
  EXPECT_FALSE(contact_time(flight, 0.01, wall, 0.3, 0.2).has_value());
  EXPECT_FALSE(FlightSpace({wall}).first_contact(flight, 0.01, 0.19).has_value());
  EXPECT_FALSE(FlightSpace({}).first_contact(flight, 0.01, 10.0).has_value());
  EXPECT_FALSE(FlightSpace({{"none", {}, MeshShape{}}}).first_contact(flight, 0.01, 10.0).has_value());
}

TEST(Clearance, IsTheLeastDistanceOnTheWay) {
  Rng rng(24);
  int near = 0;
  for (int i = 0; i < cases(100); ++i) {
    std::vector<Solid> solids;
    for (std::uint64_t k = 0; k < 5; ++k)
      solids.push_back(random_solid(rng, (k + static_cast<std::uint64_t>(i)) % 7, 1.5));
    const Flight flight = random_flight(rng);
    const double end = fall_time(flight, 0.0);
    const Clearance least = FlightSpace(solids).clearance(flight, 0.01, end, 1.0);
    double own = 1.0;
    const double dt = 1e-3 / 12.0;
    for (double t = 0.0; t <= end; t += dt) {
      for (const Solid& solid : solids) {
        own = std::min(own, std::max(0.0, own_distance(flight.position(t), solid) - 0.01));
      }
    }
    near += own < 1.0 ? 1 : 0;
    EXPECT_NEAR(least.distance_m, own, 6e-4);
    EXPECT_GE(least.distance_m, 0.0);
    if (least.distance_m < 1.0) {
      EXPECT_NEAR(std::max(0.0, own_distance(flight.position(least.time_s), solids[least.solid]) - 0.01),
                  least.distance_m, 1e-9);
    }
  }
  EXPECT_GT(near, 50);
}

TEST(FallTime, IsWhenTheFlightIsBelowForGood) {
  const Flight up{{0, 0, 1}, {1, 0, 3}, 10.0};
  EXPECT_NEAR(up.position(fall_time(up, 0.5)).z, 0.5, 1e-12);
  EXPECT_LT(up.velocity(fall_time(up, 0.5)).z, 0.0);
  EXPECT_NEAR(fall_time(up, 1.4), 0.3 + std::sqrt(0.01), 1e-9);  // it starts below and rises to it
  EXPECT_EQ(fall_time(up, 2.0), 0.0);                            // never
  EXPECT_EQ(fall_time({{0, 0, 1}, {1, 0, -3}, 10.0}, 1.5), 0.0);
}

/// The first contact among many solids is the first of those with each of them alone, whatever else is there.
TEST(Contact, AmongManySolidsIsTheFirstOfAll) {
  Rng rng(27);
  int touched = 0;
  for (int i = 0; i < cases(60); ++i) {
    std::vector<Solid> solids{floor_at(0.0)};
    for (int k = 0; k < 40; ++k) {
      Solid solid = random_solid(rng, rng.below(7), 0.2);
      solid.world_T_solid.position =
          solid.world_T_solid.position + Vec3{rng.uniform(-4.0, 4.0), rng.uniform(-4.0, 4.0), 0.0};
      solids.push_back(std::move(solid));
    }
    const FlightSpace space(solids);
    for (int k = 0; k < 20; ++k) {
      const Flight flight = random_flight(rng);
      const double end = fall_time(flight, -0.5);
      const auto contact = space.first_contact(flight, 0.01, end);
      std::optional<Contact> first;
      for (std::size_t j = 0; j < solids.size(); ++j) {
        const auto alone = FlightSpace({solids[j]}).first_contact(flight, 0.01, end);
        if (alone && (!first || alone->time_s < first->time_s))
          first = Contact{alone->time_s, j, alone->position};
      }
      ASSERT_EQ(contact.has_value(), first.has_value());
      if (!contact) continue;
      EXPECT_EQ(contact->time_s, first->time_s);
      EXPECT_EQ(contact->solid, first->solid);
      touched += contact->solid == 0 ? 0 : 1;
      const double until = 0.9 * contact->time_s;
      double least = 1.0;
      for (const Solid& solid : solids)
        least = std::min(least, FlightSpace({solid}).clearance(flight, 0.01, until, 1.0).distance_m);
      EXPECT_NEAR(space.clearance(flight, 0.01, until, 1.0).distance_m, least, 2e-4);
    }
  }
  EXPECT_GT(touched, 50);
}

}  // namespace
}  // namespace outrider
