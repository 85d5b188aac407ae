// The tour solver on TSPLIB, whose optima are proven (Reinelt, ORSA Journal on Computing 3(4), 1991).
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "outrider/geometry/vec.hpp"
#include "outrider/tour/solve.hpp"
#include "support/costly_cases.hpp"

namespace outrider {
namespace {

std::filesystem::path data() {
  const char* const folder = std::getenv("OUTRIDER_DATA");
  const auto root = folder != nullptr ? std::filesystem::path(folder)
                                      : std::filesystem::path(OUTRIDER_SOURCE_DIR) / "../shared/data";
  return root / "slam" / "tsp";
}

/// The cities of a file with EDGE_WEIGHT_TYPE EUC_2D.
std::vector<Vec2> read_cities(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::string line;
  while (std::getline(file, line) && !line.starts_with("NODE_COORD_SECTION")) {
  }
  std::vector<Vec2> cities;
  std::size_t number = 0;
  for (Vec2 city; file >> number >> city.x >> city.y;) {
    EXPECT_EQ(number, cities.size() + 1);
    cities.push_back(city);
  }
  return cities;
}

/// EUC_2D: the distance rounded to a whole number.
double rounded_distance(Vec2 a, Vec2 b) { return std::floor(distance(a, b) + 0.5); }

constexpr double never_s = 1e7;

/// A round trip as a tour: a goal in each city, the start in the first, and there a last stop with a goal
/// of its own, from which every drive takes too long. Headings and aims cost nothing.
TourProblem round_trip(const std::vector<Vec2>& cities) {
  const std::size_t stops = cities.size() + 1;
  TourProblem problem;
  problem.goals = cities.size();
  problem.turning = {1.0, 1.0};
  problem.services.resize(stops);
  for (std::uint32_t stop = 1; stop < stops; ++stop) problem.services[stop] = {{stop - 1, 0.0, 0.0, 0.0}};
  const auto place = [&](std::size_t stop) { return cities[stop % cities.size()]; };
  for (std::size_t i = 0; i < stops; ++i) {
    for (std::size_t j = 0; j < stops; ++j) {
      // In the file a drive of no length is one; here it would join the stops.
      const double length = std::max(1e-3, rounded_distance(place(i), place(j)));
      problem.drives.push_back({i + 1 == stops ? never_s : length, 0.0, 0.0});
    }
  }
  return problem;
}

struct Instance {
  const char* name;
  double optimum;      ///< of the list of proven optima
  double most_excess;  ///< of the tour, as a part
};

class Tsplib : public ::testing::TestWithParam<Instance> {};
INSTANTIATE_TEST_SUITE_P(Published, Tsplib,
                         ::testing::Values(Instance{"eil51", 426, 0.01}, Instance{"berlin52", 7542, 0.01},
                                           Instance{"st70", 675, 0.01}, Instance{"kroA100", 21282, 0.02},
                                           Instance{"ch130", 6110, 0.02}),
                         [](const auto& instance) { return std::string(instance.param.name); });

TEST_P(Tsplib, IsSolvedWithinAFewPercentOfTheOptimum) {
  const auto [name, optimum, most_excess] = GetParam();
  const auto path = data() / (std::string(name) + ".tsp");
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is absent; set OUTRIDER_DATA";
  const TourProblem problem = round_trip(read_cities(path));
  if (!testing::in_full() && problem.goals > 60) GTEST_SKIP() << "the smaller ones take the same ways";
  TourOptions options;
  options.operations = 10'000'000;
  options.expansions = 20'000;
  const auto tour = solve(problem, options, {});
  ASSERT_TRUE(tour.has_value()) << tour.error().sentence;
  const Status judged = check(problem, *tour);
  ASSERT_TRUE(judged) << judged.error().sentence;
  EXPECT_GE(tour->cost_s, optimum - 1e-6);
  EXPECT_LE(tour->cost_s, optimum * (1.0 + most_excess));
  EXPECT_LE(tour->lower_bound_s, optimum + 1e-6);
  EXPECT_GT(tour->lower_bound_s, 0.0);
  RecordProperty("excess_percent", std::to_string(100.0 * (tour->cost_s / optimum - 1.0)));
}

}  // namespace
}  // namespace outrider
