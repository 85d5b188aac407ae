// The suites of `outrider bench`. Each measures the planners or policies of one kind on published data or on
// scenarios, and checks their answers.
//
// A suite takes a request with the values of the flags, and returns its rows as JSON and as a table. Faults
// name the flag that must change ("--planners") or the file that cannot be read. Only the measured times in
// the rows differ between runs of the same request.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "outrider/core/outcome.hpp"

namespace outrider::bench {

/// Holds functions that a suite calls while it works. Each may be empty, except the clock.
struct BenchObserver {
  std::function<void(int steps)> begin = nullptr;               ///< input is read; `steps` steps follow
  std::function<void(const std::string& step)> next = nullptr;  ///< the next step begins
  std::function<void(double done)> part = nullptr;              ///< progress of the step, from 0 to 1
  std::function<double()> processor_s = nullptr;                ///< processor time of the calling thread
};

struct BenchResult {
  bool right = true;  ///< no answer contradicts its check or a published value
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  std::string table;                    ///< the rows for people, with headings
  std::vector<std::string> complaints;  ///< one sentence per wrong row
};

/// Requests a benchmark of path planners on the grids of MovingAI: time, expansions, length.
struct PathRequest {
  std::string data;                   ///< folder with .map and .scen files, searched recursively
  std::vector<std::string> maps;      ///< empty: all
  std::vector<std::string> planners;  ///< empty: all that find short paths on grids
  std::size_t queries = 1000;         ///< most queries per map
  int repeat = 1;                     ///< repetitions; the shortest time counts
  bool all_rows = false;              ///< use scenario rows even with a table of shortest lengths
  std::string index;                  ///< folder in which planners keep their indices; empty: none
};
Outcome<BenchResult> measure_path(const PathRequest& request, const BenchObserver& observer);

/// Requests a benchmark of pursuit planners on every map of a folder: cost, time to the first catch, time to
/// proof. With `smooth`, measures the optimal one on maps made from seeds, beside a plain programme instead.
struct PursuitRequest {
  std::string data;
  bool smooth = false;
  std::vector<std::string> maps;
  std::vector<std::string> planners;
  double limit_s = 60.0;  ///< time limit of each planner on each map
};
Outcome<BenchResult> measure_pursuit(const PursuitRequest& request, const BenchObserver& observer);

/// Requests a benchmark of guard planners: simulated missions, and how their time is spent. With `arrivals`,
/// compares the policies with arriving intruders in that scenario instead; with `robots`, teams with one
/// robot.
struct GuardRequest {
  std::vector<std::string> scenarios = {"scenarios/yard/yard.yaml"};
  std::string data;  ///< folder with goals_params.txt and worlds/by_small.sdf, by_small2.sdf; empty: none
  std::vector<std::string> planners;
  std::string arrivals;      ///< scenario; empty: none
  std::int64_t robots = 1;   ///< most robots of a team; 1: no teams
  std::int64_t targets = 0;  ///< of a yard with so many at random, instead of the others; 0: the others
  std::int64_t seeds = 3;    ///< missions of each plan, seeds from 1
};
Outcome<BenchResult> measure_guard(const GuardRequest& request, const BenchObserver& observer);

/// Requests a benchmark of pose graphs and laser logs: cost, error and time; graphs also with Ceres if it is
/// installed.
struct SlamRequest {
  std::string data;  ///< folder with .g2o or .log files, which may be gzip-compressed
  int repeat = 1;
};
Outcome<BenchResult> measure_slam(const SlamRequest& request, const BenchObserver& observer);

/// Requests a benchmark of exploration strategies: every world is explored with SLAM in the loop, over many
/// seeds. With `grids`, compares them on many maps with a perfect pose instead (explore_strategies.hpp).
struct ExploreRequest {
  std::vector<std::string> scenarios = {"scenarios/explore/office.yaml"};
  std::string data;  ///< folder with closed_maze.world and house_closed.world, or with grids; empty: none
  std::vector<std::string> strategies;
  std::int64_t seeds = 20;
  bool grids = false;
  std::vector<std::string> maps;  ///< of `grids`, names or groups; empty: all
};
Outcome<BenchResult> measure_explore(const ExploreRequest& request, const BenchObserver& observer);

/// Requests a benchmark of drives: each scenario is driven by each follower with one fault after another,
/// over many seeds, with modelled images. A stop that is called reached and is off by more than its tolerance
/// is wrong. The followers are compared on random courses, too.
struct DriveRequest {
  std::vector<std::string> scenarios = {"scenarios/waypoints/closed_loop.yaml"};
  std::vector<std::string> followers = {"pid", "pure_pursuit", "time_optimal"};
  std::int64_t seeds = 100;  ///< runs with each fault, seeds from 1
};
Outcome<BenchResult> measure_drive(const DriveRequest& request, const BenchObserver& observer);

/// Requests a benchmark of coverage plans: areas of twelve kinds, drawn at random, each covered and proven.
struct CoverRequest {
  std::int64_t each = 5;          ///< areas of each kind
  double turning_radius_m = 0.0;  ///< of the robot; with one, areas apart are left out
  bool reverse = false;           ///< it may drive backwards
};
Outcome<BenchResult> measure_cover(const CoverRequest& request, const BenchObserver& observer);

/// Requests a benchmark of rules of motion in the worlds of the BARN Challenge, which nobody has mapped.
struct BarnRequest {
  std::string data;                 ///< folder with static_even.json.gz
  std::vector<std::string> worlds;  ///< numbers; empty: all
  std::vector<std::string> rules = {"sampled", "dwa", "steer"};
  std::int64_t seeds = 10;  ///< runs of each rule in each world, seeds from 1
};
Outcome<BenchResult> measure_barn(const BarnRequest& request, const BenchObserver& observer);

/// Requests a benchmark of rules of motion among things and people that move (hall_worlds.hpp).
struct HallsRequest {
  std::vector<std::string> walkers = {"posts", "social", "inattentive"};
  std::vector<std::string> worlds;  ///< numbers; empty: all
  std::vector<std::string> rules = {"sampled", "dwa"};
  std::int64_t seeds = 1;  ///< runs of each rule in each world, seeds from 1
};
Outcome<BenchResult> measure_halls(const HallsRequest& request, const BenchObserver& observer);

/// Requests a benchmark of drives on known maps, with things, closed doors and people that the maps lack.
struct MapsRequest {
  std::vector<std::string> files = {"scenarios/explore/office_map.yaml", "scenarios/explore/cave_map.yaml"};
  std::string data;               ///< folder with more maps; empty: none
  std::vector<std::string> maps;  ///< names; empty: all
  std::int64_t goals = 50;        ///< drives on each map
};
Outcome<BenchResult> measure_maps(const MapsRequest& request, const BenchObserver& observer);

/// Requests a benchmark of the time that a step of the navigator takes, against beams, marks and things that
/// move.
struct NavigateRequest {
  std::int64_t steps = 400;  ///< steps of each case
};
Outcome<BenchResult> measure_navigate(const NavigateRequest& request, const BenchObserver& observer);

}  // namespace outrider::bench
