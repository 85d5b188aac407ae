#include "outrider/jobs/cover/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "outrider/core/units.hpp"

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

/// Pieces of one role, one after the other, are one pass; a lap or a cell begins another.
std::vector<ReportPass> passes_of(const CoverPlan& plan, const PieceDrive& drive) {
  std::vector<ReportPass> passes;
  for (std::size_t i = 0; i < drive.ends_s.size(); ++i) {
    const bool begins = std::ranges::binary_search(plan.begins, i) || plan.roles[i] == PieceRole::lane;
    if (passes.empty() || begins || plan.roles[i] != plan.roles[i - 1])
      passes.push_back({begin_of(drive, i), 0.0, std::string(name_of(plan.roles[i]))});
    passes.back().end_s = drive.ends_s[i];
  }
  return passes;
}

/// Where it is then: between two samples it goes straight.
Vec2 place(const std::vector<TrackSample>& track, double time_s) {
  const auto next = std::ranges::lower_bound(track, time_s, {}, &TrackSample::time_s);
  if (next == track.begin()) return track.front().pose.position;
  if (next == track.end()) return track.back().pose.position;
  const TrackSample& before = *(next - 1);
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

std::vector<ReportCovered> covered_by_then(const CoverRun& run, double radius_m,
                                           const std::stop_token& stop) {
  std::vector<double> times{0.0};
  std::vector<std::vector<Vec2>> stretches{{run.drive.way.front()}};
  for (int i = 1; i <= covered_steps; ++i) {
    times.push_back(run.drive.time_s * i / covered_steps);
    stretches.push_back(stretch(run.drive, times[times.size() - 2], times.back()));
  }
  const auto sums = coverage_along(stretches, radius_m, run.plan.ground.reach, stop);
  std::vector<ReportCovered> rows;
  for (std::size_t i = 0; i < sums.size(); ++i)
    rows.push_back({times[i], sums[i].covered_m2, sums[i].overlap_m2});
  return rows;
}

std::string counted(std::size_t count, std::string_view what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

std::vector<ReportEvent> events_of(const CoverRun& run) {
  const CoverPlan& plan = run.plan;
  std::vector<ReportEvent> events{
      {0.0, "plan",
       fmt::format("the {} track of {:.2f} m has {}, {} with {}, and {}", plan.method, plan.sums.length_m,
                   counted(plan.laps, "lap"), counted(plan.cells, "cell"), counted(plan.lanes, "lane"),
                   counted(plan.sums.stops, "turn"))}};
  std::size_t laps = 0, cells = 0;
  for (const std::size_t piece : plan.begins) {
    if (piece >= run.drive.ends_s.size()) break;
    const bool lap = plan.roles[piece] == PieceRole::lap;
    const std::string text = lap ? fmt::format("lap {} of {} begins", ++laps, plan.laps)
                                 : fmt::format("cell {} of {} begins", ++cells, plan.cells);
    events.push_back({begin_of(run.drive, piece), lap ? "lap" : "cell", text});
  }
  if (run.finished())
    events.push_back({run.drive.time_s, "done",
                      fmt::format("{:.2f} % of the reach is covered, {:.4g} m2 of it more than once",
                                  100.0 * run.driven.fraction, run.driven.overlap_m2)});
  return events;
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

Report cover_report(const CoverProblem& problem, const CoverRun& run, std::uint64_t seed,
                    const std::string& name, const std::stop_token& stop) {
  const CoverageArea& ground = run.plan.ground;
  Report report;
  report.status = "done";
  report.job = "cover";
  report.seed = seed;
  report.world_name = name;
  report.bounds = bounds_of(ground.area);
  report.robot_radius_m = problem.radius_m();
  report.start = run.plan.track.start;
  report.metrics = metrics_of(problem, run);
  report.events = events_of(run);
  report.track = run.drive.track;
  report.cover = {problem.width_m,
                  outlines(ground.area),
                  outlines(ground.reach),
                  outlines(run.driven.missed),
                  outlines(run.driven.overlap),
                  points_along(run.plan.track.start.position, run.plan.track.pieces, arc_step_rad),
                  passes_of(run.plan, run.drive),
                  covered_by_then(run, problem.radius_m(), stop)};
  return report;
}

}  // namespace outrider
