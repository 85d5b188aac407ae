// The job `fleet`: lead several robots over one grid without collisions.
//
//   job: fleet
//   map: hall.map                # map_server .yaml, MovingAI .map, PNG or PGM image
//   starts: "0.5,0.5 9.5,0.5"    # x,y in m, one for each robot
//   goals: "9.5,0.5 0.5,0.5"
//   planner: cbs
//
// Or `agents: hall.scen`, a scenario of MovingAI with a robot in each row. For the definition of a plan see
// path/fleet/fleet.hpp. Every plan is verified by check() before it is returned; one that fails is a bug and
// throws std::logic_error.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "outrider/job/job.hpp"
#include "outrider/path/fleet/planners.hpp"

namespace outrider {

/// The settings.
struct FleetScenario {
  FleetScenario();

  std::string map;                ///< path of a file with cells
  std::string starts;             ///< x,y of each robot, separated by blanks
  std::string goals;              ///< x,y of each robot, in the same order
  std::string agents;             ///< instead, path of a MovingAI scenario, a robot in each row
  std::int64_t robots = 0;        ///< robots taken from its beginning; 0: all
  std::string planner = "lacam";  ///< a name of fleet_planners()
  double radius_m = 0.0;          ///< radius of each robot, at most 0.35 cells
  double resolution_m = 0.05;     ///< side of a pixel, for an image without a YAML file
  std::int64_t budget = 0;        ///< expansions after which the search is given up; 0: unlimited
  std::vector<std::pair<FleetPlanner, ConfiguredFleetPlanner>> planners;  ///< all, with their options
};

/// Returns the options: top-level keys first, then a section for each planner.
std::vector<OptionGroup> describe(FleetScenario& scenario);

/// A task of the job `fleet`.
///
/// run() returns a table "rows" with the path of each robot, metrics, and a picture. If there is no plan, or
/// none was found, the status is "not_done". A robot that cannot stand at its start or goal is a fault.
class FleetJob final : public JobTask {
 public:
  FleetJob() : JobTask("fleet") {}
  Outcome<Warnings> load() override;
  Status run(Run& run, const RunWatch& watch) override;

  FleetScenario scenario;
  std::optional<FleetProblem> problem;  ///< set by load()

 protected:
  std::vector<OptionGroup> describe() override { return outrider::describe(scenario); }
};

/// Returns the catalogue entry of the job.
Job fleet_job();

}  // namespace outrider
