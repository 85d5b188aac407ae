#include "outrider/ballistics/air.hpp"

#include <gtest/gtest.h>

#include <tuple>

#include "outrider/ballistics/contact.hpp"
#include "support/fine_flight.hpp"
#include "support/random_cases.hpp"
#include "support/random_yard.hpp"

namespace outrider {
namespace {

using testing::cases;
using testing::own_distance;
using testing::random_solid;

constexpr double g = 9.8;

struct Throw {
  Air air;
  Vec3 muzzle, velocity;
};

/// A water ball in a breeze, or anything up to a shuttlecock in a storm.
Throw random_throw(Rng& rng, bool mild) {
  const Air air{mild ? rng.uniform(0.005, 0.1) : rng.uniform(0.0, 1.0), rng.uniform(0.0, mild ? 5.0 : 20.0),
                rng.uniform(-pi, pi)};
  const Vec2 along = direction(rng.uniform(-pi, pi));
  const double speed = rng.uniform(2.0, mild ? 12.0 : 60.0);
  const double pitch = rng.uniform(-0.5, 1.4);
  return {air,
          {0, 0, 0.4},
          {speed * std::cos(pitch) * along.x, speed * std::cos(pitch) * along.y, speed * std::sin(pitch)}};
}

Vec3 law(const Throw& thrown, Vec3 v) {
  const double wx = thrown.air.wind_mps * std::cos(thrown.air.wind_towards_rad);
  const double wy = thrown.air.wind_mps * std::sin(thrown.air.wind_towards_rad);
  const Vec3 u{v.x - wx, v.y - wy, v.z};
  const double size = std::sqrt(u.x * u.x + u.y * u.y + u.z * u.z);
  return Vec3{0, 0, -g} - thrown.air.drag_per_m * size * u;
}

/// Heun's method in steps of 10 microseconds, extrapolated from those of 20: off by less than 1e-9 m here.
Vec3 own_position(const Throw& thrown, double time) {
  const auto heun = [&](int steps) {
    Vec3 p = thrown.muzzle;
    Vec3 v = thrown.velocity;
    const double h = time / steps;
    for (int i = 0; i < steps; ++i) {
      const Vec3 a = law(thrown, v);
      const Vec3 later = v + h * a;
      p = p + 0.5 * h * (v + later);
      v = v + 0.5 * h * (a + law(thrown, later));
    }
    return p;
  };
  const int steps = std::max(1, static_cast<int>(time / 2e-5));
  const Vec3 coarse = heun(steps);
  const Vec3 fine = heun(2 * steps);
  return fine + 1.0 / 3.0 * (fine - coarse);
}

TEST(AirTrack, IsWhereASlowIntegratorIsWithinItsBound) {
  Rng rng(301);
  double worst = 0.0;
  for (int i = 0; i < cases(40); ++i) {
    const bool mild = i % 2 == 0;
    const Throw thrown = random_throw(rng, mild);
    const AirTrack track(thrown.air, thrown.muzzle, thrown.velocity, g, -1.0);
    for (int k = 1; k <= 3; ++k) {
      const double t = track.end_s() * k / 3.0;
      const double off = norm(track.position(t) - own_position(thrown, t));
      EXPECT_LE(off, 0.5 * track.defect_mps2() * t * t + 2e-9) << i << " " << t;
      if (mild) worst = std::max(worst, off / (t * t));
    }
  }
  EXPECT_LT(worst, 1e-6);
}

TEST(AirTrack, KeepsTheLawEverywhereWithinItsDefect) {
  Rng rng(302);
  for (int i = 0; i < cases(200); ++i) {
    const Throw thrown = random_throw(rng, false);
    const AirTrack track(thrown.air, thrown.muzzle, thrown.velocity, g, -1.0);
    constexpr double h = 1e-6;
    for (int k = 0; k < 400; ++k) {
      const double t = rng.uniform(h, track.end_s() - h);
      const Vec3 slope = 0.5 / h * (track.velocity(t + h) - track.velocity(t - h));
      EXPECT_LE(norm(slope - law(thrown, track.velocity(t))), 1.01 * track.defect_mps2() + 1e-7)
          << i << " " << t;
      EXPECT_LE(norm(slope), track.most_acceleration() + 1e-6);
      EXPECT_LT(norm(0.5 / h * (track.position(t + h) - track.position(t - h)) - track.velocity(t)), 1e-6);
    }
  }
}

/// Up and down without wind is known: tan on the way up, and tanh on the way down.
TEST(AirTrack, FallsAsTheTextbookSays) {
  for (const double c : {0.01, 0.1, 0.9}) {
    const Air air{c, 0.0, 0.0};
    const double terminal = std::sqrt(g / c);
    const double v0 = 15.0;
    const AirTrack track(air, {0, 0, 1}, {0, 0, v0}, g, -30.0);
    const double top = terminal / g * std::atan(v0 / terminal);
    EXPECT_NEAR(track.top_s(), top, 1e-6);
    const double height = 1.0 + 0.5 / c * std::log1p(v0 * v0 / (terminal * terminal));
    EXPECT_NEAR(track.position(top).z, height, 1e-6);
    for (double t = top; t < track.end_s(); t += 0.1) {
      EXPECT_NEAR(track.velocity(t).z, -terminal * std::tanh(g * (t - top) / terminal), 3e-6);
      EXPECT_NEAR(track.position(t).z, height - std::log(std::cosh(g * (t - top) / terminal)) / c, 1e-5);
    }
  }
}

TEST(AirTrack, WithoutDragIsTheParabolaAndWindIsAMovingFrame) {
  Rng rng(303);
  for (int i = 0; i < cases(50); ++i) {
    Throw thrown = random_throw(rng, true);
    const AirTrack windy(thrown.air, thrown.muzzle, thrown.velocity, g, -1.0);
    const AirTrack still({thrown.air.drag_per_m, 0.0, 0.0}, thrown.muzzle,
                         thrown.velocity - thrown.air.wind(), g, -1.0);
    thrown.air.drag_per_m = 1e-15;
    const AirTrack vacuum(thrown.air, thrown.muzzle, thrown.velocity, g, -1.0);
    const Flight parabola{thrown.muzzle, thrown.velocity, g};
    for (double t = 0.0; t < std::min(windy.end_s(), vacuum.end_s()); t += 0.05) {
      EXPECT_LT(norm(windy.position(t) - (still.position(t) + t * thrown.air.wind())), 1e-9);
      EXPECT_LT(norm(vacuum.position(t) - parabola.position(t)), 1e-9);
    }
  }
}

TEST(AirTrack, TellsWhenItHasFallen) {
  Rng rng(304);
  for (int i = 0; i < cases(100); ++i) {
    const Throw thrown = random_throw(rng, false);
    const AirTrack track(thrown.air, thrown.muzzle, thrown.velocity, g, -1.0);
    const double height = rng.uniform(-2.0, 3.0);
    const double t = track.fall_time(height);
    const double top = track.top_s();
    for (double s = 0.0; s < track.end_s() + 0.2; s += 0.01) {
      if (s < top) {
        EXPECT_GE(track.velocity(s).z, 0.0);
      }
      if (s > t + 1e-6) {
        EXPECT_LT(track.position(s).z, height + 1e-9);
      }
    }
    if (t > 0.0) {
      EXPECT_NEAR(track.position(t).z, height, 1e-6);
    } else {
      EXPECT_LE(track.position(top).z, height);
    }
  }
}

TEST(AirTrack, PassagesHoldEveryTimeInTheBox) {
  Rng rng(305);
  int inside = 0;
  for (int i = 0; i < cases(300); ++i) {
    const Throw thrown = random_throw(rng, i % 2 == 0);
    const AirTrack track(thrown.air, thrown.muzzle, thrown.velocity, g, -1.0);
    const Vec3 centre = track.position(rng.uniform(0.0, 1.2 * track.end_s())) +
                        Vec3{rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1)};
    const Vec3 half{rng.uniform(0.0, 1.0), rng.uniform(0.0, 1.0), rng.uniform(0.0, 1.0)};
    const Box3 box{centre - half, centre + half};
    const double from = rng.uniform(0.0, 0.5 * track.end_s());
    const double until = rng.uniform(from, 1.2 * track.end_s());
    const auto part = track.passage(box, from, until);
    for (int k = 0; k <= 500; ++k) {
      const double t = from + (until - from) * k / 500;
      const Vec3 p = track.position(t);
      const bool in = p.x >= box.low.x && p.x <= box.high.x && p.y >= box.low.y && p.y <= box.high.y &&
                      p.z >= box.low.z && p.z <= box.high.z;
      if (!in) continue;
      ++inside;
      ASSERT_TRUE(part.has_value());
      EXPECT_GE(t, part->first);
      EXPECT_LE(t, part->second);
    }
  }
  EXPECT_GT(inside, 1000);
}

/// As Contact.AgreesWithFineSteps (contact_test.cpp), with drag and wind.
TEST(ContactInAir, AgreesWithFineStepsOnEveryKindOfSolid) {
  Rng rng(306);
  constexpr double radius = 0.01;
  constexpr double unsure = 2e-4;
  int touched = 0;
  for (int i = 0; i < cases(150); ++i) {
    const Solid solid = random_solid(rng, static_cast<std::uint64_t>(i) % 7, 0.2);
    Throw thrown = random_throw(rng, true);
    const Vec2 along = 1.0 / norm(xy(thrown.velocity)) * xy(thrown.velocity);
    const Vec2 from = -rng.uniform(1.0, 2.0) * along + rng.uniform(-0.3, 0.3) * perpendicular(along);
    thrown.muzzle = {from.x, from.y, rng.uniform(0.1, 0.5)};
    Flight flight{thrown.muzzle, thrown.velocity, g};
    flight.in_air = std::make_shared<AirTrack>(thrown.air, thrown.muzzle, thrown.velocity, g, -0.6);
    const double end = fall_time(flight, -0.5);
    const auto found = contact_time(flight, radius, solid, 0.0, end);
    const auto contact = FlightSpace({solid}).first_contact(flight, radius, end);
    EXPECT_EQ(found.has_value(), contact.has_value());
    EXPECT_EQ(found.has_value(), touches(flight, radius, solid, 0.0, end));
    Vec3 p = thrown.muzzle;
    Vec3 v = thrown.velocity;
    double least = 1e9;
    for (constexpr double h = 1e-5; p.z > -0.5;) {
      least = std::min(least, own_distance(p, solid));
      const Vec3 later = v + h * law(thrown, v);
      p = p + 0.5 * h * (v + later);
      v = later;
    }
    if (least < radius - unsure) {
      EXPECT_TRUE(found.has_value()) << i;
    }
    if (least > radius + unsure) {
      EXPECT_FALSE(found.has_value()) << i;
    }
    const double gap = FlightSpace({solid}).clearance(flight, radius, end, 1.0).distance_m;
    EXPECT_NEAR(gap, std::clamp(least - radius, 0.0, 1.0), 4e-4);
    if (!found) continue;
    ++touched;
    EXPECT_LE(own_distance(contact->position, solid), radius + contact_tolerance_m + 1e-9);
  }
  EXPECT_GT(touched, 10);
}

}  // namespace
}  // namespace outrider
