// The suites of `outrider bench`: each measures the planners or policies of one kind on published data or on
// scenarios, and judges their answers.
//
// A suite takes a request with the values of the flags, and returns its rows as JSON and as a table. Faults
// name the flag that must change ("--planners") or the file that cannot be read. Times are measured, so no
// two runs give the same rows; everything else in them is the same for the same request.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "outrider/core/outcome.hpp"

namespace outrider::bench {

/// Called while a suite works. Each function may be empty, except the clock.
struct BenchObserver {
  std::function<void(int steps)> begin = nullptr;               ///< all is read; so many steps follow
  std::function<void(const std::string& step)> next = nullptr;  ///< the next step begins
  std::function<void(double done)> part = nullptr;              ///< of the present step, from 0 to 1
  std::function<double()> processor_s = nullptr;                ///< spent by the calling thread
};

struct BenchResult {
  bool right = true;  ///< no answer contradicts its judge or a published value
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  std::string table;                    ///< the rows for people, with their heads
  std::vector<std::string> complaints;  ///< a sentence for each row that is wrong
};

/// Path planners on the grids of MovingAI: time, expansions, length.
struct PathRequest {
  std::string data;                   ///< folder with .map and .scen files, searched to its depths
  std::vector<std::string> maps;      ///< empty: all
  std::vector<std::string> planners;  ///< empty: all that look for short paths on grids
  std::size_t queries = 1000;         ///< at most so many a map
  int repeat = 1;                     ///< the shortest time of so many counts
  bool all_rows = false;  ///< the rows of the scenario also where there is a table of shortest lengths
};
Outcome<BenchResult> measure_path(const PathRequest& request, const BenchObserver& observer);

/// Pursuit planners on every map of a folder: cost, time to the first catch, time to proof.
struct PursuitRequest {
  std::string data;
  std::vector<std::string> maps;
  std::vector<std::string> planners;
  double limit_s = 60.0;  ///< of each planner on each map
};
Outcome<BenchResult> measure_pursuit(const PursuitRequest& request, const BenchObserver& observer);

/// Guard planners: missions simulated, and where their time goes. With `arrivals`, the policies while
/// intruders keep coming in that scenario instead.
struct GuardRequest {
  std::vector<std::string> scenarios = {"scenarios/yard/yard.yaml"};
  std::string data;  ///< folder with goals_params.txt and worlds/by_small.sdf, by_small2.sdf; empty: none
  std::vector<std::string> planners;
  std::string arrivals;    ///< a scenario; empty: none
  std::int64_t seeds = 3;  ///< missions of each plan, from 1 on
};
Outcome<BenchResult> measure_guard(const GuardRequest& request, const BenchObserver& observer);

/// Pose graphs and laser logs: cost, error and time; graphs beside Ceres where it is installed.
struct SlamRequest {
  std::string data;  ///< folder with .g2o or .log files, which may be gzip-compressed
  int repeat = 1;
};
Outcome<BenchResult> measure_slam(const SlamRequest& request, const BenchObserver& observer);

/// Strategies of exploration: every world explored with SLAM in the loop, over many seeds.
struct ExploreRequest {
  std::vector<std::string> scenarios = {"scenarios/explore/office.yaml"};
  std::string data;  ///< folder with closed_maze.world and house_closed.world; empty: none
  std::vector<std::string> strategies;
  std::int64_t seeds = 20;
};
Outcome<BenchResult> measure_explore(const ExploreRequest& request, const BenchObserver& observer);

}  // namespace outrider::bench
