// outrider bench: the flags of the suites (bench/suites), which measure, and their rows on the terminal.
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "commands/commands.hpp"
#include "output/output.hpp"
#include "output/progress.hpp"
#include "output/terminal.hpp"
#include "outrider/job/clock.hpp"
#include "suites/suites.hpp"

namespace outrider::cli {
namespace {

/// Holds the flag values of one suite.
template <class Request>
struct Asked {
  Request request;
  bool json = false;
};

template <class Request>
using Suite = Outcome<bench::BenchResult> (*)(const Request&, const bench::BenchObserver&);

/// Runs a suite while showing a progress line, then prints its rows. Returns the exit status.
template <class Request>
int execute(const std::string& job, Suite<Request> suite, const Asked<Request>& asked) {
  std::optional<Progress> progress;
  bench::BenchObserver observer;
  observer.begin = [&](int steps) { progress.emplace(steps); };
  observer.next = [&](const std::string& step) { progress->next(step); };
  observer.part = [&](double done) { progress->part(done); };
  observer.processor_s = processor_s;
  auto result = suite(asked.request, observer);
  progress.reset();  // clears the progress line
  if (!result) return print_fault(result.error(), asked.json);
  if (asked.json) {
    print({{"status", result->right ? "done" : "not_done"}, {"job", job}, {"rows", std::move(result->rows)}});
  } else {
    show_text(result->table);
  }
  for (const std::string& complaint : result->complaints) complain(complaint);
  return result->right ? job_done : job_not_done;
}

/// Adds --json and sets the action of the command.
template <class Request>
void finish(Command& command, const std::string& job, Suite<Request> suite,
            const std::shared_ptr<Asked<Request>>& asked) {
  command.flag("--json", &asked->json, "print one JSON object on standard output");
  command.does([=](const Command&) { return execute(job, suite, *asked); });
}

void add_names(Command& command, const std::string& flag, std::vector<std::string>& names,
               const std::string& sentence = "names from 'outrider list'; all unless given") {
  command.option(flag, &names, sentence).separated_by(',').type("NAME,...");
}

void add_scenarios(Command& command, std::vector<std::string>& paths, const std::string& sentence) {
  command.option("--scenarios", &paths, sentence).separated_by(',').type("FILE,...");
}

void add_seeds(Command& command, std::int64_t& seeds, const std::string& sentence) {
  command.option("--seeds", &seeds, sentence).between(1, 10'000).type("N");
}

void add_path_suite(Command& bench) {
  Command& path = bench.add("path", "path planners on grids: time, expansions, length");
  auto asked = std::make_shared<Asked<bench::PathRequest>>();
  bench::PathRequest& request = asked->request;
  path.option("--data", &request.data, "folder with MovingAI .map and .scen files, searched to its depths")
      .required()
      .type("DIR");
  add_names(path, "--maps", request.maps, "names of maps, such as lak303d,brc202d; all unless given");
  add_names(path, "--planners", request.planners);
  path.option("--queries", &request.queries, "at most so many a map, spread over its rows [1000]")
      .between(1, 1'000'000)
      .type("N");
  path.option("--repeat", &request.repeat,
              "go through the queries so often and keep the shortest time of each [1]")
      .between(1, 1000)
      .type("N");
  path.flag("--all-rows", &request.all_rows,
            "the rows of the scenario also where there is a table of shortest lengths");
  path.option("--index", &request.index,
              "folder in which hub_labels and octile_labels keep their indices: read where they exist, else "
              "written")
      .type("DIR");
  finish(path, "bench path", bench::measure_path, asked);
  path.footer("\nExample: outrider bench path --data DIR --maps lak303d --planners a_star,jps");
}

void add_pursuit_suite(Command& bench) {
  Command& pursuit = bench.add("pursuit", "pursuit planners: cost, time to the first catch, time to proof");
  auto asked = std::make_shared<Asked<bench::PursuitRequest>>();
  bench::PursuitRequest& request = asked->request;
  pursuit.option("--data", &request.data, "folder with pursuit maps, searched to its depths").type("DIR");
  pursuit.flag("--smooth", &request.smooth,
               "instead: smooth maps of 500 to 1500 cells a side, beside a plain programme over layers");
  add_names(pursuit, "--maps", request.maps, "names of maps, such as map3,map1s; all unless given");
  add_names(pursuit, "--planners", request.planners);
  pursuit.option("--limit", &request.limit_s, "time of each planner on each map [60]")
      .between(0.001, 86'400.0)
      .type("s");
  finish(pursuit, "bench pursuit", bench::measure_pursuit, asked);
  pursuit.footer("\nExample: outrider bench pursuit --data DIR --maps map3,map4");
}

void add_guard_suite(Command& bench) {
  Command& guard = bench.add("guard", "guard planners: missions simulated, and where their time goes");
  auto asked = std::make_shared<Asked<bench::GuardRequest>>();
  bench::GuardRequest& request = asked->request;
  add_scenarios(guard, request.scenarios, "scenario files of yards [scenarios/yard/yard.yaml]");
  guard
      .option("--data", &request.data,
              "folder with goals_params.txt and worlds/by_small.sdf, by_small2.sdf, for these yards too")
      .type("DIR");
  add_names(guard, "--planners", request.planners);
  add_seeds(guard, request.seeds, "missions of each plan, with seeds from 1 on [3]");
  guard
      .option("--arrivals", &request.arrivals,
              "a scenario in which intruders keep coming: compare the policies there instead")
      .type("FILE");
  guard
      .option("--robots", &request.robots,
              "most robots of a team: compare teams of 2 to so many with one robot instead [1]")
      .between(1, 5)
      .type("N");
  guard
      .option("--targets", &request.targets,
              "measure a yard with so many targets and boxes at random places instead of the others")
      .between(1, 2000)
      .type("N");
  finish(guard, "bench guard", bench::measure_guard, asked);
  guard.footer("\nExample: outrider bench guard --targets 100");
}

void add_slam_suite(Command& bench) {
  Command& slam = bench.add(
      "slam", "pose graphs and laser logs: cost, error and time; graphs beside Ceres where it is installed");
  auto asked = std::make_shared<Asked<bench::SlamRequest>>();
  bench::SlamRequest& request = asked->request;
  slam.option("--data", &request.data, "folder with .g2o or .log files, which may be gzip-compressed")
      .required()
      .type("DIR");
  slam.option("--repeat", &request.repeat, "do each so often and keep the shortest time [1]")
      .between(1, 1000)
      .type("N");
  finish(slam, "bench slam", bench::measure_slam, asked);
  slam.footer("\nExample: outrider bench slam --data DIR --repeat 5");
}

void add_explore_suite(Command& bench) {
  Command& explore =
      bench.add("explore", "ways to choose the next view: worlds explored with SLAM in the loop");
  auto asked = std::make_shared<Asked<bench::ExploreRequest>>();
  bench::ExploreRequest& request = asked->request;
  add_scenarios(explore, request.scenarios, "scenario files [scenarios/explore/office.yaml]");
  explore
      .option("--data", &request.data,
              "folder with closed_maze.world and house_closed.world, for these worlds too; with --grids, "
              "one with MovingAI .map files, searched to its depths")
      .type("DIR");
  explore.flag("--grids", &request.grids,
               "instead: many maps with a perfect pose, in groups, over a proven bound and beside nearest");
  add_names(explore, "--maps", request.maps,
            "with --grids: maps or groups, such as office,hall; all unless given");
  add_names(explore, "--strategies", request.strategies);
  add_seeds(explore, request.seeds, "runs of each strategy in each world, with seeds from 1 on [20]");
  finish(explore, "bench explore", bench::measure_explore, asked);
  explore.footer("\nExample: outrider bench explore --strategies tour,nearest --seeds 5");
}

void add_drive_suite(Command& bench) {
  Command& drive =
      bench.add("drive", "drives with faults: what they claim against where the robot truly was");
  auto asked = std::make_shared<Asked<bench::DriveRequest>>();
  bench::DriveRequest& request = asked->request;
  add_scenarios(drive, request.scenarios, "scenario files [scenarios/waypoints/closed_loop.yaml]");
  add_names(drive, "--followers", request.followers, "pid, pure_pursuit or time_optimal; all unless given");
  add_seeds(drive, request.seeds, "runs of each follower with each fault, with seeds from 1 on [100]");
  finish(drive, "bench drive", bench::measure_drive, asked);
  drive.footer("\nExample: outrider bench drive --seeds 10");
}

void add_cover_suite(Command& bench) {
  Command& cover =
      bench.add("cover", "coverage of areas of twelve kinds: proofs, and lengths against bounds");
  auto asked = std::make_shared<Asked<bench::CoverRequest>>();
  add_seeds(cover, asked->request.each, "areas of each kind [5]");
  cover
      .option("--turning-radius", &asked->request.turning_radius_m,
              "of the robot; 0: it turns in place [0]; areas that lie apart are left out with one")
      .between(0.0, 100.0)
      .type("m");
  cover.flag("--reverse", &asked->request.reverse, "the robot with a turning radius may drive backwards");
  finish(cover, "bench cover", bench::measure_cover, asked);
  cover.footer("\nExample: outrider bench cover --seeds 1 --turning-radius 1");
}

void add_barn_suite(Command& bench) {
  Command& barn =
      bench.add("barn", "driving through clutter that nobody mapped: the worlds of the BARN Challenge");
  auto asked = std::make_shared<Asked<bench::BarnRequest>>();
  bench::BarnRequest& request = asked->request;
  barn.option("--data", &request.data, "folder with static_even.json.gz").required().type("DIR");
  add_names(barn, "--worlds", request.worlds, "numbers of worlds, such as 0,60; all unless given");
  add_names(barn, "--rules", request.rules, "rules of motion [sampled,dwa,steer]");
  add_seeds(barn, request.seeds, "runs of each rule in each world, with seeds from 1 on [10]");
  finish(barn, "bench barn", bench::measure_barn, asked);
  barn.footer("\nExample: outrider bench barn --data DIR --worlds 0,60 --seeds 1");
}

void add_halls_suite(Command& bench) {
  Command& halls = bench.add("halls", "driving among posts and people that move, in worlds drawn at random");
  auto asked = std::make_shared<Asked<bench::HallsRequest>>();
  bench::HallsRequest& request = asked->request;
  add_names(halls, "--walkers", request.walkers, "who moves [posts,social,inattentive]");
  add_names(halls, "--worlds", request.worlds,
            "numbers of worlds, such as 1,20; all unless given, 60 of posts and 20 halls");
  add_names(halls, "--rules", request.rules, "rules of motion [sampled,dwa]");
  add_seeds(halls, request.seeds, "runs of each rule in each world, with seeds from 1 on [1]");
  finish(halls, "bench halls", bench::measure_halls, asked);
  halls.footer("\nExample: outrider bench halls --walkers social --worlds 1,10");
}

void add_maps_suite(Command& bench) {
  Command& maps = bench.add("maps", "driving on known maps, around what they lack: are all claims true?");
  auto asked = std::make_shared<Asked<bench::MapsRequest>>();
  bench::MapsRequest& request = asked->request;
  maps.option("--files", &request.files, "map files [scenarios/explore/office_map.yaml,.../cave_map.yaml]")
      .separated_by(',')
      .type("FILE,...");
  maps.option("--data", &request.data,
              "folder with more maps (.yaml, and .map with .scen), searched to its depths")
      .type("DIR");
  add_names(maps, "--maps", request.maps, "names of maps; all unless given");
  maps.option("--goals", &request.goals, "drives on each map [50]").between(1, 10'000).type("N");
  finish(maps, "bench maps", bench::measure_maps, asked);
  maps.footer("\nExample: outrider bench maps --goals 5");
}

void add_navigate_suite(Command& bench) {
  Command& navigate =
      bench.add("navigate", "time of a step of the navigator, and robots that a core carries");
  auto asked = std::make_shared<Asked<bench::NavigateRequest>>();
  navigate.option("--steps", &asked->request.steps, "steps of each case [400]")
      .between(20, 100'000)
      .type("N");
  finish(navigate, "bench navigate", bench::measure_navigate, asked);
  navigate.footer("\nExample: outrider bench navigate --steps 100");
}

}  // namespace

void add_bench(Command& tool) {
  Command& bench = tool.add("bench", "measure planners on published benchmarks");
  bench.require_command();
  add_path_suite(bench);
  add_pursuit_suite(bench);
  add_guard_suite(bench);
  add_slam_suite(bench);
  add_explore_suite(bench);
  add_drive_suite(bench);
  add_cover_suite(bench);
  add_barn_suite(bench);
  add_halls_suite(bench);
  add_maps_suite(bench);
  add_navigate_suite(bench);
}

}  // namespace outrider::cli
