// A* with each heuristic and each rule for ties, against Dijkstra.
#include "outrider/path/grid/a_star.hpp"

#include <gtest/gtest.h>

#include <map>
#include <string>

#include "outrider/path/check.hpp"
#include "outrider/path/grid/dijkstra.hpp"
#include "support/random_cases.hpp"
#include "support/random_grid.hpp"

namespace outrider {
namespace {

using testing::cases;

TEST(AStar, FindsTheSameCostByEveryHeuristicAndRuleForTies) {
  Rng rng(17);
  Workspace workspace;
  std::map<std::string, std::uint64_t> expansions;
  for (int i = 0; i < cases(300); ++i) {
    const auto ground = std::make_shared<const GridMap>(*GridMap::of(random_grid(rng, 24), GridModel::cells));
    const GridFrame& frame = ground->frame;
    const auto any = [&] {
      return ground->point({static_cast<int>(rng.below(static_cast<std::uint64_t>(frame.width))),
                            static_cast<int>(rng.below(static_cast<std::uint64_t>(frame.height)))});
    };
    const Problem problem{ground, any(), any()};
    const auto expected = dijkstra(problem, {}, {}, workspace);
    for (const char* heuristic : {"octile", "euclidean", "chebyshev"}) {
      for (const char* ties : {"largest_g", "smallest_g"}) {
        const auto plan = a_star(problem, {1.0, heuristic, ties}, {}, workspace);
        ASSERT_EQ(plan.has_value(), expected.has_value());
        if (!plan) continue;
        EXPECT_DOUBLE_EQ(plan->cost, expected->cost) << heuristic << " " << ties;
        EXPECT_DOUBLE_EQ(plan->lower_bound, expected->cost);
        EXPECT_TRUE(check(*plan, problem));
        expansions[std::string(heuristic) + " " + ties] += plan->counters.expansions;
        const auto quick = a_star(problem, {2.0, heuristic, ties}, {}, workspace);
        ASSERT_TRUE(quick);
        EXPECT_LE(quick->cost, 2.0 * expected->cost + 1e-9);
        EXPECT_LE(quick->lower_bound, expected->cost + 1e-9);
      }
    }
  }
  // The closer an estimate is to the truth, the less is expanded; who goes on to the goal expands less.
  for (const std::string ties : {"largest_g", "smallest_g"}) {
    EXPECT_LT(expansions["octile " + ties], expansions["euclidean " + ties]);
    EXPECT_LT(expansions["euclidean " + ties], expansions["chebyshev " + ties]);
  }
  for (const std::string heuristic : {"octile", "euclidean", "chebyshev"})
    EXPECT_LE(expansions[heuristic + " largest_g"], expansions[heuristic + " smallest_g"]);
}

TEST(AStar, NamesWhatItTakes) {
  Rng rng(1);
  Workspace workspace;
  const auto ground = std::make_shared<const GridMap>(*GridMap::of(random_grid(rng, 8), GridModel::cells));
  const Problem problem{ground, {}, {}};
  const auto heuristic = a_star(problem, {1.0, "euclid", "largest_g"}, {}, workspace);
  ASSERT_FALSE(heuristic);
  EXPECT_EQ(heuristic.error().sentence, "there is no heuristic 'euclid'; did you mean 'euclidean'?");
  EXPECT_EQ(heuristic.error().where, "heuristic");
  const auto ties = a_star(problem, {1.0, "octile", "xyz"}, {}, workspace);
  ASSERT_FALSE(ties);
  EXPECT_EQ(ties.error().where, "ties");
}

TEST(AStar, TakesEachNameItListsAsAChoice) {
  AStarOptions options;
  std::size_t named = 0;
  for (const Option& option : describe(options)) {
    auto* const* text = std::get_if<std::string*>(&option.value);
    ASSERT_EQ(text != nullptr, !option.choices.empty()) << option.name;
    if (text == nullptr) continue;
    EXPECT_EQ(**text, option.choices.front()) << "the default comes first";
    Rng rng(2);
    Workspace workspace;
    const auto ground = std::make_shared<const GridMap>(*GridMap::of(random_grid(rng, 8), GridModel::cells));
    const Problem problem{ground, {}, {}};
    const std::string usual = **text;
    for (const std::string& choice : option.choices) {
      **text = choice;
      const auto plan = a_star(problem, options, {}, workspace);  // which may end at a wall
      EXPECT_TRUE(plan || plan.error().where != option.name) << option.name << " " << choice;
      ++named;
    }
    **text = usual;
  }
  EXPECT_EQ(named, 5U);
}

}  // namespace
}  // namespace outrider
