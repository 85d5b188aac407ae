#include "guard_report.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "outrider/world/contours.hpp"
#include "outrider/world/steep_ground.hpp"

namespace outrider {
namespace {

ReportSolid solid_entry(const Solid& solid, const World& world, const RobotModel& robot) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  const Box3 box = bounds(solid);
  const double floor = world.floor_z_m;
  const Interval under = world.terrain ? world.terrain->heights_over(box.ground()) : Interval{floor, floor};
  ReportSolid entry{solid.name,
                    std::string(kind(solid.shape)),
                    footprint(solid, -inf, inf),
                    box.low.z,
                    box.high.z,
                    !footprint(solid, under.low + 1e-3, under.high + robot.height_m).empty()};
  if (!std::isfinite(entry.low_z_m)) entry.low_z_m = floor;  // the ground
  if (!std::isfinite(entry.high_z_m)) entry.high_z_m = floor;
  return entry;
}

/// Every so many-th post of a field with more of them than `most_posts`.
HeightField thinned(const HeightField& field, double most_posts) {
  const int step = static_cast<int>(std::ceil(std::sqrt(1.0 * field.columns() * field.rows() / most_posts)));
  const int columns = std::max(2, (field.columns() - 1) / step + 1);
  const int rows = std::max(2, (field.rows() - 1) / step + 1);
  if (step == 1 || (columns - 1) * step >= field.columns() || (rows - 1) * step >= field.rows()) return field;
  std::vector<double> heights;
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < columns; ++x) heights.push_back(field.post(x * step, y * step).z);
  }
  return HeightField::make(field.bounds().low, static_cast<double>(step) * field.spacing_m(), columns, rows,
                           std::move(heights))
      .value();
}

ReportRelief relief_entry(const HeightField& field) {
  ReportRelief entry{field.bounds().low, field.spacing_m(), field.columns(), field.rows(), {}};
  for (int y = 0; y < field.rows(); ++y) {
    for (int x = 0; x < field.columns(); ++x) entry.heights_m.push_back(field.post(x, y).z);
  }
  return entry;
}

ReportTerrain terrain_entry(const HeightField& field, const RobotModel& robot) {
  constexpr double most_posts_of_lines = 40'000.0, most_posts_of_relief = 10'000.0;
  ReportTerrain entry{{}, steep_ground(field, robot.max_slope_rad), {}};
  entry.relief = relief_entry(thinned(field, most_posts_of_relief));
  const HeightField drawn = thinned(field, most_posts_of_lines);
  for (Contour& line : contours(drawn, contour_step(drawn))) {
    entry.contours.push_back({line.height_m, std::move(line.points)});
  }
  return entry;
}

ReportSupplies supplies_entry(const Supplies& supplies) {
  ReportSupplies entry{supplies.full(Store::water), supplies.full(Store::charge), {}, {}};
  for (const Station& station : supplies.stations) {
    entry.stations.push_back({station.name, station.position, station.gives_water, station.gives_charge});
  }
  return entry;
}

}  // namespace

const GuardProblem& true_problem(const GuardRun& run) { return run.truth ? run.truth->problem : run.problem; }

const FiringMap& true_map(const GuardRun& run) { return run.truth ? run.truth->firing_map : run.firing_map; }

TargetSimParams target_params(const GuardRun& run) {
  TargetSimParams params;
  params.survival = run.survival;
  if (run.arrivals) {
    params.intruders = run.arrivals->yard.intruders;
    params.foreseen = run.arrivals->policy.foresees;
  }
  if (run.walkers) {
    params.walks = run.walkers->walks;
    params.look_s = run.walkers->plan.options.look_s;
    params.sight_m = run.walkers->plan.options.sight_m;
  }
  return params;
}

Report opened_report(const GuardRun& run) {
  const GuardProblem& problem = true_problem(run);
  Report report;
  report.job = "guard";
  report.seed = run.seed;
  if (run.rigid) report.sim = "physics";
  report.world_name = problem.world.name;
  report.bounds = problem.world.bounds;
  report.gravity_mps2 = problem.world.gravity_mps2;
  report.robot_radius_m = problem.robot.radius_m;
  report.gun_length_m = std::hypot(problem.gun.tip_forward_m, problem.gun.tip_up_m);
  report.ball_radius_m = problem.gun.ball_radius_m;
  report.margin_m = run.options.margin_m;
  report.start = problem.start;
  for (const Solid& solid : problem.world.solids) {
    report.solids.push_back(solid_entry(solid, problem.world, problem.robot));
  }
  if (problem.world.terrain) report.terrain = terrain_entry(*problem.world.terrain, problem.robot);
  if (problem.supplies.any()) report.supplies = supplies_entry(problem.supplies);
  return report;
}

}  // namespace outrider
