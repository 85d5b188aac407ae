#include <gtest/gtest.h>

#include <functional>

#include "outrider/tour/solve.hpp"
#include "random_tour.hpp"

namespace outrider {
namespace {

TEST(CheckTour, RefusesCorruptedTours) {
  const TourProblem problem = random_yard(8, 12, 4, 1);
  const Tour good = *solve(problem, {}, {});
  ASSERT_TRUE(check(problem, good));
  ASSERT_GE(good.visits.size(), 2U);
  const std::vector<std::function<void(Tour&)>> corruptions = {
      [](Tour& t) { t.visits.pop_back(); },
      [](Tour& t) { t.visits[0].goals.clear(); },
      [](Tour& t) { t.visits[0].goals.push_back(t.visits[0].goals[0]); },
      [](Tour& t) { t.visits[0].goals[0] = t.visits[1].goals[0]; },
      [](Tour& t) { t.visits[0].goals[0] = 99; },
      [](Tour& t) { t.visits[0].stop = 99; },
      [](Tour& t) { t.visits[0].stop = 0; },
      [](Tour& t) { t.visits.push_back({t.visits.back().stop, {}}); },
      [](Tour& t) { t.cost_s += 0.01; },
      [](Tour& t) { t.cost_s = std::numeric_limits<double>::quiet_NaN(); },
      [](Tour& t) { t.lower_bound_s = t.cost_s + 0.01; },
      [](Tour& t) { t.lower_bound_s = t.cost_s - 0.01; },
  };
  for (std::size_t i = 0; i < corruptions.size(); ++i) {
    Tour bad = good;
    corruptions[i](bad);
    const Status status = check(problem, bad);
    ASSERT_FALSE(status) << "corruption " << i;
    EXPECT_FALSE(status.error().sentence.empty());
  }
}

TEST(CheckTour, RefusesAVisitInTwoParts) {
  TourProblem problem;
  problem.goals = 2;
  problem.services = {{{0, 0.0, 0.0, 1.0}, {1, 0.0, 0.0, 1.0}}};
  problem.drives.resize(1);
  EXPECT_TRUE(check(problem, Tour{.visits = {{0, {0, 1}}}, .cost_s = 2.0}));
  EXPECT_FALSE(check(problem, Tour{.visits = {{0, {0}}, {0, {1}}}, .cost_s = 2.0}));
}

TEST(CheckProblem, RefusesBadNumbers) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const std::vector<std::function<void(TourProblem&)>> corruptions = {
      [](TourProblem& p) { p.goals = 5000; },
      [](TourProblem& p) { p.services.clear(); },
      [](TourProblem& p) { p.services.resize(5000); },
      [](TourProblem& p) { p.drives.pop_back(); },
      [](TourProblem& p) { p.heading_rad = nan; },
      [](TourProblem& p) { p.turning.speed = 0.0; },
      [](TourProblem& p) { p.turning.acceleration = nan; },
      [](TourProblem& p) { p.yaw_rate_radps = infinity; },
      [](TourProblem& p) { p.pitch_rate_radps = -1.0; },
      [](TourProblem& p) { p.services[1][0].goal = 8; },
      [](TourProblem& p) { p.services[1].push_back(p.services[1][0]); },
      [](TourProblem& p) { p.services[1][0].yaw_rad = infinity; },
      [](TourProblem& p) { p.services[1][0].duration_s = -1.0; },
      [](TourProblem& p) { p.drives[1].time_s = -1.0; },
      [](TourProblem& p) { p.drives[1].time_s = nan; },
      [](TourProblem& p) { p.drives[1].arrival_rad = nan; },
      [](TourProblem& p) { p.drives[p.services.size() + 2].time_s = infinity; },
  };
  const TourProblem good = random_yard(8, 4, 4, 1);
  ASSERT_TRUE(check(good));
  ASSERT_FALSE(good.services[1].empty());
  for (std::size_t i = 0; i < corruptions.size(); ++i) {
    TourProblem bad = good;
    corruptions[i](bad);
    const auto tour = solve(bad, {}, {});
    ASSERT_FALSE(tour) << "corruption " << i;
    EXPECT_EQ(tour.error().code, FaultCode::bad_input);
  }
}

TEST(CheckProblem, AStopThatCannotBeReachedNeedsNoDrives) {
  TourProblem problem = random_yard(4, 4, 2, 1);
  const std::size_t stops = problem.services.size() + 1;
  TourProblem with = problem;
  with.services.push_back({{0, 0.0, 0.0, 0.0}});
  with.drives.assign(stops * stops, {std::numeric_limits<double>::infinity(), 0.0, 0.0});
  for (std::size_t i = 0; i + 1 < stops; ++i) {
    for (std::size_t j = 0; j + 1 < stops; ++j)
      with.drives[i * stops + j] = problem.drives[i * (stops - 1) + j];
  }
  EXPECT_EQ(solve(with, {}, {})->visits, solve(problem, {}, {})->visits);
}

}  // namespace
}  // namespace outrider
