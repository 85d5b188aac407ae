#include "outrider/tour/sequence.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "support/random_cases.hpp"

namespace outrider {
namespace {

using testing::cases;

struct SequenceCase {
  TourProblem table;
  std::vector<PendingTarget> pending;
  RobotState from;
};

SequenceCase random_case(Rng& rng, std::size_t stops, std::size_t goals, bool nimble, bool walking) {
  SequenceCase c;
  c.table.goals = goals;
  c.table.turning = {nimble ? 1e9 : 0.8, nimble ? 1e12 : 6.0};
  c.table.yaw_rate_radps = c.table.pitch_rate_radps = nimble ? 1e9 : 1.0;
  c.table.services.resize(stops);
  std::vector<Vec2> places;
  for (std::size_t i = 0; i < stops; ++i) places.push_back(testing::random_point(rng, 5.0));
  for (std::uint32_t goal = 0; goal < goals; ++goal) {
    const std::size_t sure = rng.below(stops);
    for (std::size_t stop = 0; stop < stops; ++stop) {
      if (stop != sure && rng.below(2) == 0) continue;
      c.table.services[stop].push_back(
          {goal, rng.uniform(-pi, pi), rng.uniform(0.0, 0.7), rng.uniform(0.1, 2.0)});
    }
    c.pending.push_back({goal, walking ? rng.uniform(0.0, 20.0) : 0.0});
  }
  const auto drive = [](Vec2 a, Vec2 b) {
    const double heading = std::atan2((b - a).y, (b - a).x);
    return Drive{distance(a, b), heading, heading};
  };
  for (const Vec2 a : places) {
    for (const Vec2 b : places) c.table.drives.push_back(drive(a, b));
  }
  const Vec2 here = testing::random_point(rng, 5.0);
  for (const Vec2 b : places) c.from.drives.push_back(drive(here, b));
  c.from.time_s = rng.uniform(0.0, 5.0);
  c.from.heading_rad = rng.uniform(-pi, pi);
  return c;
}

double turned(double a, double b) { return std::abs(std::remainder(a - b, 2.0 * pi)); }

/// Every order with every choice of stops, by recursion over plain numbers.
double brute_force(const SequenceCase& c, ArrivalObjective objective, std::vector<char> done,
                   std::size_t stop, double time, double sum, double heading, double yaw, double pitch) {
  if (std::count(done.begin(), done.end(), 0) == 0)
    return objective == ArrivalObjective::makespan ? time : sum;
  double best = std::numeric_limits<double>::infinity();
  const std::size_t stops = c.table.services.size();
  for (std::size_t next = 0; next < stops; ++next) {
    for (const Service& s : c.table.services[next]) {
      if (done[s.goal] != 0) continue;
      double t = time;
      double facing = heading;
      if (next != stop) {
        const Drive& drive = stop == stops ? c.from.drives[next] : c.table.drives[stop * stops + next];
        t += drive.time_s + duration(turned(drive.departure_rad, heading), c.table.turning);
        facing = drive.arrival_rad;
      }
      const double relative = s.yaw_rad - facing;
      t = std::max(t, c.pending[s.goal].settles_s);
      t += std::max(turned(relative, yaw) / c.table.yaw_rate_radps,
                    std::abs(s.pitch_rad - pitch) / c.table.pitch_rate_radps);
      t += s.duration_s;
      auto with = done;
      with[s.goal] = 1;
      best = std::min(best, brute_force(c, objective, with, next, t, sum + t, facing, relative, s.pitch_rad));
    }
  }
  return best;
}

double brute_force(const SequenceCase& c, ArrivalObjective objective) {
  return brute_force(c, objective, std::vector<char>(c.pending.size(), 0), c.table.services.size(),
                     c.from.time_s, 0.0, c.from.heading_rad, 0.0, 0.0);
}

/// Nothing is lost when turning and aiming take no time and nobody is on the way.
TEST(BestSequence, IsTheBestOfAll) {
  Rng rng(31);
  for (int i = 0; i < cases(200); ++i) {
    const SequenceCase c = random_case(rng, 2 + rng.below(3), 1 + rng.below(4), true, false);
    for (const auto objective : {ArrivalObjective::time_inside, ArrivalObjective::makespan}) {
      const Sequence best = best_sequence(c.table, c.pending, c.from, objective, 100000);
      EXPECT_NEAR(best.value, brute_force(c, objective), 1e-6);
    }
  }
}

/// Returns true if another that is still to be hit at the same place settles there earlier.
bool is_out_of_turn(const SequenceCase& c, std::uint32_t who, const std::vector<char>& done) {
  for (std::size_t other = 0; other < c.pending.size(); ++other) {
    if (done[other] == 0 && c.pending[other].goal == c.pending[who].goal &&
        c.pending[other].settles_s < c.pending[who].settles_s)
      return true;
  }
  return false;
}

/// The least value of all orders of hits, each from every stop; or of those in turn at each place alone.
double best_of_orders(const SequenceCase& c, ArrivalObjective objective, bool in_turn,
                      std::vector<Visit>& visits, std::vector<char>& done) {
  if (visits.size() == c.pending.size()) return value_of(c.table, c.pending, c.from, objective, visits);
  double best = std::numeric_limits<double>::infinity();
  for (std::uint32_t who = 0; who < c.pending.size(); ++who) {
    if (done[who] != 0 || (in_turn && is_out_of_turn(c, who, done))) continue;
    done[who] = 1;
    for (std::uint32_t stop = 0; stop < c.table.services.size(); ++stop) {
      visits.push_back({stop, {who}});
      best = std::min(best, best_of_orders(c, objective, in_turn, visits, done));
      visits.pop_back();
    }
    done[who] = 0;
  }
  return best;
}

/// Nothing is lost by hitting those in turn who come to one place at different times.
TEST(BestSequence, HitsInTurnWhereSeveralAreAtOnePlace) {
  Rng rng(33);
  for (int i = 0; i < cases(60); ++i) {
    const bool walking = i % 2 == 0;
    SequenceCase c = random_case(rng, 2, 2, true, walking);
    for (const std::uint32_t goal : {0U, 1U})
      c.pending.push_back({goal, walking ? rng.uniform(0.0, 20.0) : 0.0});
    for (const auto objective : {ArrivalObjective::time_inside, ArrivalObjective::makespan}) {
      std::vector<Visit> visits;
      std::vector<char> done(c.pending.size(), 0);
      const double least = best_of_orders(c, objective, false, visits, done);
      EXPECT_NEAR(best_of_orders(c, objective, true, visits, done), least, 1e-9);
      const double found = best_sequence(c.table, c.pending, c.from, objective, 100000).value;
      EXPECT_GE(found, least - 1e-9);
      EXPECT_LE(found, walking ? 1.1 * least : least + 1e-6);
    }
  }
}

/// Not many more sequences than the beam are held: forty at two places, with a beam of 2,000.
TEST(BestSequence, IsQuickWhereManyAreAtOnePlace) {
  Rng rng(34);
  SequenceCase c = random_case(rng, 3, 2, false, false);
  for (std::uint32_t i = 0; i < 38; ++i) c.pending.push_back({i % 2, 0.0});
  const Sequence best = best_sequence(c.table, c.pending, c.from, ArrivalObjective::time_inside, 2000);
  EXPECT_LT(best.value, std::numeric_limits<double>::infinity());
  EXPECT_NEAR(best.value, value_of(c.table, c.pending, c.from, ArrivalObjective::time_inside, best.visits),
              1e-6);
}

TEST(BestSequence, IsWholeWorthWhatItSaysAndSeldomFarFromTheBest) {
  Rng rng(32);
  double value = 0.0;
  double least = 0.0;
  for (int i = 0; i < cases(100); ++i) {
    const SequenceCase c = random_case(rng, 2 + rng.below(3), 1 + rng.below(4), false, true);
    for (const auto objective : {ArrivalObjective::time_inside, ArrivalObjective::makespan}) {
      const Sequence best = best_sequence(c.table, c.pending, c.from, objective, 20);
      std::vector<int> hits(c.pending.size(), 0);
      for (const Visit& visit : best.visits) {
        for (const std::uint32_t who : visit.goals) ++hits[who];
      }
      EXPECT_EQ(hits, std::vector<int>(c.pending.size(), 1));
      EXPECT_NEAR(value_of(c.table, c.pending, c.from, objective, best.visits), best.value, 1e-9);
      auto part = best.visits;
      part.back().goals.pop_back();
      EXPECT_TRUE(std::isinf(value_of(c.table, c.pending, c.from, objective, part)))
          << "somebody is left out";
      const double optimum = brute_force(c, objective);
      EXPECT_GE(best.value, optimum - 1e-9);
      value += best.value;
      least += optimum;
    }
  }
  EXPECT_LE(value, 1.02 * least);
}

TEST(BestSequence, SaysWhenSomebodyCannotBeHit) {
  Rng rng(33);
  SequenceCase c = random_case(rng, 3, 3, false, false);
  for (auto& services : c.table.services) {
    std::erase_if(services, [](const Service& s) { return s.goal == 1; });
  }
  const Sequence none = best_sequence(c.table, c.pending, c.from, ArrivalObjective::makespan, 10);
  EXPECT_TRUE(none.visits.empty());
  EXPECT_TRUE(std::isinf(none.value));
  EXPECT_TRUE(best_sequence(c.table, {}, c.from, ArrivalObjective::makespan, 10).visits.empty());
}

}  // namespace
}  // namespace outrider
