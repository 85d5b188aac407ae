#include "outrider/jobs/cover/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "outrider/core/units.hpp"
#include "outrider/log/append.hpp"
#include "outrider/log/conversions.hpp"
#include "outrider/log/motion_messages.hpp"
#include "outrider/log/topics.hpp"

namespace outrider {
namespace {

constexpr int covered_steps = 60;
constexpr double arc_step_rad = radians(4.0);

std::vector<std::vector<Vec2>> outlines(const Region& region) {
  std::vector<std::vector<Vec2>> rings;
  for (const RingedPolygon& polygon : region) {
    rings.push_back(polygon.outer);
    rings.insert(rings.end(), polygon.holes.begin(), polygon.holes.end());
  }
  return rings;
}

std::string_view name_of(PieceRole role) {
  return role == PieceRole::lap ? "lap" : role == PieceRole::lane ? "lane" : "move";
}

double begin_of(const PieceDrive& drive, std::size_t piece) {
  return piece == 0 ? 0.0 : drive.ends_s[piece - 1];
}

/// A section of the path.
struct Pass {
  double start_s = 0.0;
  double end_s = 0.0;
  std::string role;  ///< lap, lane or move
};

/// Pieces of one role, one after the other, are one pass; a lap or a cell begins another.
std::vector<Pass> passes_of(const CoverPlan& plan, const PieceDrive& drive) {
  std::vector<Pass> passes;
  for (std::size_t i = 0; i < drive.ends_s.size(); ++i) {
    const bool begins = std::ranges::binary_search(plan.begins, i) || plan.roles[i] == PieceRole::lane;
    if (passes.empty() || begins || plan.roles[i] != plan.roles[i - 1])
      passes.push_back({begin_of(drive, i), 0.0, std::string(name_of(plan.roles[i]))});
    passes.back().end_s = drive.ends_s[i];
  }
  return passes;
}

/// Where it is then: between two samples it goes straight.
Vec2 place(const std::vector<TimedPose>& track, double time_s) {
  const auto next = std::ranges::lower_bound(track, time_s, {}, &TimedPose::time_s);
  if (next == track.begin()) return track.front().pose.position;
  if (next == track.end()) return track.back().pose.position;
  const TimedPose& before = *(next - 1);
  const double part = (time_s - before.time_s) / (next->time_s - before.time_s);
  return before.pose.position + part * (next->pose.position - before.pose.position);
}

/// The way between two times, with both ends.
std::vector<Vec2> stretch(const PieceDrive& drive, double from_s, double to_s) {
  std::vector<Vec2> points{place(drive.track, from_s)};
  auto next = std::ranges::upper_bound(drive.times_s, from_s);
  for (; next != drive.times_s.end() && *next < to_s; ++next)
    points.push_back(drive.way[static_cast<std::size_t>(next - drive.times_s.begin())]);
  points.push_back(place(drive.track, to_s));
  return points;
}

void log_coverage(Log& log, const CoverRun& run, double radius_m, const std::stop_token& stop) {
  std::vector<double> times{0.0};
  std::vector<std::vector<Vec2>> stretches{{run.drive.way.front()}};
  for (int i = 1; i <= covered_steps; ++i) {
    times.push_back(run.drive.time_s * i / covered_steps);
    stretches.push_back(stretch(run.drive, times[times.size() - 2], times.back()));
  }
  const auto sums = coverage_along(stretches, radius_m, run.plan.ground.reach, stop);
  for (std::size_t i = 0; i < sums.size(); ++i) {
    log.append(topic::coverage, times[i], outrider_msgs::Coverage{sums[i].covered_m2, sums[i].overlap_m2});
  }
}

std::string counted(std::size_t count, std::string_view what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

void log_events(Log& log, const CoverRun& run) {
  const CoverPlan& plan = run.plan;
  log_event(log, 0.0, "plan",
            fmt::format("the {} track of {:.2f} m has {}, {} with {}, and {}", plan.method,
                        plan.sums.length_m, counted(plan.laps, "lap"), counted(plan.cells, "cell"),
                        counted(plan.lanes, "lane"), counted(plan.sums.stops, "turn")));
  std::size_t laps = 0, cells = 0;
  for (const std::size_t piece : plan.begins) {
    if (piece >= run.drive.ends_s.size()) break;
    const bool lap = plan.roles[piece] == PieceRole::lap;
    const std::string text = lap ? fmt::format("lap {} of {} begins", ++laps, plan.laps)
                                 : fmt::format("cell {} of {} begins", ++cells, plan.cells);
    log_event(log, begin_of(run.drive, piece), lap ? "lap" : "cell", text);
  }
  if (run.finished())
    log_event(log, run.drive.time_s, "done",
              fmt::format("{:.2f} % of the reach is covered, {:.4g} m2 of it more than once",
                          100.0 * run.driven.fraction, run.driven.overlap_m2));
}

std::vector<std::pair<std::string, double>> metrics_of(const CoverProblem& problem, const CoverRun& run) {
  const auto& [plan, proof, bound, drive, driven] = run;
  const auto number = [](std::size_t count) { return static_cast<double>(count); };
  return {{"covered_fraction", driven.fraction},
          {"covered_m2", driven.covered_m2},
          {"missed_m2", driven.missed_m2},
          {"overlap_m2", driven.overlap_m2},
          {"reach_m2", area_of(plan.ground.reach)},
          {"area_m2", area_of(plan.ground.area)},
          {"width_m", problem.width_m},
          {"time_s", drive.time_s},
          {"t_min_s", bound.least_s},
          {"t_max_s", bound.most_s},
          {"planned_s", plan.sums.time_s},
          {"order_bound_s", plan.order_bound_s},
          {"length_m", drive.length_m},
          {"planned_m", plan.sums.length_m},
          {"turned_rad", drive.turned_rad},
          {"tracking_error_m", drive.tracking_error_m},
          {"tracking_error_limit_m", problem.tracking_error_m},
          {"stops", number(plan.sums.stops)},
          {"laps", number(plan.laps)},
          {"cells", number(plan.cells)},
          {"lanes", number(plan.lanes)},
          {"planned_fraction", proof.planned.fraction},
          {"planned_missed_m2", proof.planned.missed_m2},
          {"planned_overlap_m2", proof.planned.overlap_m2},
          {"sure_fraction", proof.sure_fraction},
          {"sure_inner_fraction", proof.inner_fraction},
          {"clearance_m", proof.clearance_m}};
}

}  // namespace

void log_cover(Log& log, const CoverProblem& problem, const CoverRun& run, std::uint64_t seed,
               const std::string& name, const std::stop_token& stop) {
  const CoverageArea& ground = run.plan.ground;
  const Box2 bounds = bounds_of(ground.area);
  outrider_msgs::RunInfo info;
  info.job = "cover";
  info.seed = seed;
  info.world = name;
  info.low = point_of(bounds.low);
  info.high = point_of(bounds.high);
  info.robot_radius = problem.radius_m();
  info.coverage_width = problem.width_m;
  log.append(topic::run, 0.0, std::move(info));
  const auto planned = points_along(run.plan.track.start.position, run.plan.track.pieces, arc_step_rad);
  outrider_msgs::CoverageArea area{
      outlines_of(outlines(ground.area)), outlines_of(outlines(ground.reach)), {}, {}, points_of(planned)};
  log.append(topic::coverage_area, 0.0, area);
  for (const Pass& pass : passes_of(run.plan, run.drive))
    log.append(topic::coverage_passes, pass.start_s, outrider_msgs::CoveragePass{pass.role, pass.end_s});
  for (const auto& [time_s, pose] : run.drive.track) log_pose(log, time_s, pose);
  log_coverage(log, run, problem.radius_m(), stop);
  log_events(log, run);
  area.missed = outlines_of(outlines(run.driven.missed));
  area.overlap = outlines_of(outlines(run.driven.overlap));
  log.append(topic::coverage_area, run.drive.time_s, std::move(area));
}

Report cover_report(const CoverProblem& problem, const CoverRun& run, const std::string& name) {
  Report report;
  report.status = "done";
  report.world_name = name;
  report.metrics = metrics_of(problem, run);
  return report;
}

}  // namespace outrider
