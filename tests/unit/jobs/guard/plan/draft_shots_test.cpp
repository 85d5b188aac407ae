#include "plan/draft.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "support/guard_yard.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

using testing::cases;

/// The draft over all reachable cells of a coarse grid that hit something, with the visits as given: what
/// choose_shots() gets.
struct Drafted {
  FiringMap firing_map;
  ShotBook book;
  Draft draft;
};

std::optional<Drafted> drafted(const GuardProblem& problem, const GuardOptions& options) {
  auto firing_map = build_firing_map(problem, options);
  EXPECT_TRUE(firing_map.has_value()) << firing_map.error().sentence;
  Drafted made{std::move(*firing_map), {}, {}};
  auto draft =
      draft_tour(problem, made.firing_map, {targets_with_region(made.firing_map)}, options, {}, made.book);
  if (!draft) return std::nullopt;
  made.draft = std::move(*draft);
  return made;
}

/// Shots for the hits of the tour that begin at every half degree, and the time of the best combination of
/// them, by trying all.
double best_of_all(const GuardProblem& problem, const Drafted& given) {
  TourProblem offered = given.draft.offered.table;
  std::vector<std::pair<Service*, std::vector<Service>>> choices;
  for (const Visit& visit : given.draft.tour.visits) {
    for (const std::uint32_t goal : visit.goals) {
      auto& services = offered.services[visit.stop];
      auto service = std::ranges::find(services, goal, &Service::goal);
      const std::size_t cell = given.draft.cells[visit.stop], target = given.draft.targets[goal];
      const FiringMap& map = given.firing_map;
      std::vector<Service> shots{*service};
      for (double pitch = radians(-30.0); pitch < radians(45.1); pitch += radians(15.0)) {
        const auto shot = best_shot(map.rules, map.space(target), problem.targets[target],
                                    map.frame.centre(map.frame.cell(cell)), pitch);
        if (shot && shot->hit_rate >= given.book.at({cell, target})->hit_rate)
          shots.push_back({goal, shot->gun.yaw_rad, shot->gun.pitch_rad, service_time(*shot, {})});
      }
      choices.emplace_back(&*service, std::move(shots));
    }
  }
  double best = cost(offered, given.draft.tour.visits);
  const std::function<void(std::size_t)> choose = [&](std::size_t k) {
    if (k == choices.size()) {
      best = std::min(best, cost(offered, given.draft.tour.visits));
      return;
    }
    for (const Service& shot : choices[k].second) {
      *choices[k].first = shot;
      choose(k + 1);
    }
  };
  choose(0);
  return best;
}

TEST(ChooseShots, EndsTheTourAsSoonAsTheBestOfAllCombinations) {
  Rng rng(871);
  int sooner = 0;
  for (int i = 0; i < cases(8); ++i) {
    const auto problem = testing::random_guard_problem(rng, 10, 5, 4.0);
    GuardOptions options = testing::quick();
    options.refinements = 0;
    auto given = drafted(problem, options);
    if (!given) continue;
    // As the shots were before: the flattest ones.
    for (auto& [key, shot] : given->book) {
      if (!shot) continue;
      shot =
          best_shot(given->firing_map.rules, given->firing_map.space(key.second), problem.targets[key.second],
                    given->firing_map.frame.centre(given->firing_map.frame.cell(key.first)), radians(-30.0));
    }
    for (const Visit& visit : given->draft.tour.visits) {
      for (const std::uint32_t goal : visit.goals) {
        const auto& shot = given->book.at({given->draft.cells[visit.stop], given->draft.targets[goal]});
        auto& services = given->draft.offered.table.services[visit.stop];
        *std::ranges::find(services, goal, &Service::goal) = {goal, shot->gun.yaw_rad, shot->gun.pitch_rad,
                                                              service_time(*shot, {})};
      }
    }
    const double before = cost(given->draft.offered.table, given->draft.tour.visits);
    const double best = best_of_all(problem, *given);
    choose_shots(problem, given->firing_map, {}, given->book, given->draft);
    EXPECT_LE(given->draft.tour.cost_s, best + 1e-9);
    EXPECT_EQ(given->draft.tour.cost_s, cost(given->draft.offered.table, given->draft.tour.visits));
    sooner += given->draft.tour.cost_s < before - 0.01 ? 1 : 0;
    for (const Visit& visit : given->draft.tour.visits) {
      for (const std::uint32_t goal : visit.goals) {
        const auto& shot = given->book.at({given->draft.cells[visit.stop], given->draft.targets[goal]});
        const auto& services = given->draft.offered.table.services[visit.stop];
        EXPECT_EQ(std::ranges::find(services, goal, &Service::goal)->pitch_rad, shot->gun.pitch_rad);
      }
    }
  }
  EXPECT_GT(sooner, 0);
}

}  // namespace
}  // namespace outrider
