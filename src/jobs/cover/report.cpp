#include "outrider/jobs/cover/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "ground/tool_coverage.hpp"
#include "outrider/core/units.hpp"
#include "outrider/job/scene_markers.hpp"
#include "outrider/log/append.hpp"
#include "outrider/log/messages/conversions.hpp"
#include "outrider/log/messages/motion_messages.hpp"
#include "outrider/log/topics.hpp"

namespace outrider {
namespace {

constexpr int covered_steps = 60;
constexpr double arc_step_rad = radians(4.0);
constexpr double good_part = 0.005;  // of the reach, that a steered drive may cover less than its track

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

/// Returns the pose at a time. Between two samples the robot moves along a straight line.
Pose2 pose_at(const std::vector<TimedPose>& track, double time_s) {
  const auto next = std::ranges::lower_bound(track, time_s, {}, &TimedPose::time_s);
  if (next == track.begin()) return track.front().pose;
  if (next == track.end()) return track.back().pose;
  const TimedPose& before = *(next - 1);
  const double part = (time_s - before.time_s) / (next->time_s - before.time_s);
  return {before.pose.position + part * (next->pose.position - before.pose.position),
          before.pose.heading_rad + part * wrap_angle(next->pose.heading_rad - before.pose.heading_rad)};
}

/// The way between two times, with both ends.
std::vector<Vec2> stretch(const PieceDrive& drive, double from_s, double to_s) {
  std::vector<Vec2> points{pose_at(drive.track, from_s).position};
  auto next = std::ranges::upper_bound(drive.times_s, from_s);
  for (; next != drive.times_s.end() && *next < to_s; ++next)
    points.push_back(drive.way[static_cast<std::size_t>(next - drive.times_s.begin())]);
  points.push_back(pose_at(drive.track, to_s).position);
  return points;
}

/// The poses between two times, with both ends.
std::vector<Pose2> poses_between(const PieceDrive& drive, double from_s, double to_s) {
  std::vector<Pose2> poses{pose_at(drive.track, from_s)};
  auto next = std::ranges::upper_bound(drive.track, from_s, {}, &TimedPose::time_s);
  for (; next != drive.track.end() && next->time_s < to_s; ++next) cover::add_pose(poses, next->pose);
  cover::add_pose(poses, pose_at(drive.track, to_s));
  return poses;
}

GrowingCoverage coverage_begun(const CoverProblem& problem, const Region& reach) {
  const auto bar = problem.bar();
  return bar ? GrowingCoverage(*bar, reach) : GrowingCoverage(problem.body_radius_m(), reach);
}

std::string counted(std::size_t count, std::string_view what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

std::string described(const CoverPlan& plan) {
  return fmt::format("the {} track of {:.2f} m has {}, {} with {}, and {}", plan.method, plan.sums.length_m,
                     counted(plan.laps, "lap"), counted(plan.cells, "cell"), counted(plan.lanes, "lane"),
                     counted(plan.sums.stops, "turn"));
}

double length_of(const CoverPlan& plan, PieceRole role) {
  double length = 0.0;
  for (std::size_t i = 0; i < plan.roles.size(); ++i) {
    if (plan.roles[i] == role) length += outrider::length_of(plan.track.pieces[i]);
  }
  return length;
}

/// One row for each area that lies apart.
Table areas_table(const CoverProof& proof) {
  Table table{"areas", {"area", "area_m2", "reach_m2", "planned_fraction", "sure_inner_fraction"}, {}};
  for (std::size_t i = 0; i < proof.fields.size(); ++i) {
    const FieldProof& field = proof.fields[i];
    table.rows.push_back({static_cast<double>(i + 1), field.area_m2, field.reach_m2, field.planned_fraction,
                          field.inner_fraction});
  }
  return table;
}

/// One row for each place that is left out.
Table missed_table(const CoverProof& proof) {
  Table table{"missed", {"x", "y", "area_m2"}, {}};
  for (const MissedPlace& place : proof.missed) table.rows.push_back({place.at.x, place.at.y, place.area_m2});
  return table;
}

/// Returns the reason why a track that leaves something out is not done.
std::string shortfall(const CoverProblem& problem, const CoverProof& proof) {
  double missed_m2 = 0.0;
  for (const MissedPlace& place : proof.missed) missed_m2 += place.area_m2;
  const MissedPlace& largest = proof.missed.front();
  const FieldProof& field = proof.fields.front();
  std::string found =
      problem.bar() ? fmt::format("the bar {:g} m wide", problem.strip_m())
                    : fmt::format("the robot with a turning radius of {:g} m", problem.turning_radius_m);
  if (problem.bar() && problem.curves())
    found += fmt::format(" on a robot with a turning radius of {:g} m", problem.turning_radius_m);
  const bool forwards = problem.curves() && !problem.reverse;
  return fmt::format(
      "{:.3f} % of the reach is surely covered; {} with {:.4g} m2 left, the largest {:.4g} m2 about {}; "
      "{} {}; {}an 'uncovered' of {:.4f} accepts it",
      100.0 * proof.sure_fraction, counted(proof.missed.size(), "place"), missed_m2, largest.area_m2,
      place_text(problem.frame, largest.at), found,
      forwards ? "and without reverse found no way to cover more" : "found no way to cover more",
      forwards ? "'reverse' may cover it, " : "",
      std::ceil(1e4 * (1.0 - field.inner_fraction) * field.inner_m2 / field.reach_m2) * 1e-4);
}

/// Returns true if a drive with the navigator covers clearly less of what it can reach than its track.
bool misses_something(const NavigatedCover& done, const CoverProof& proof) {
  return done.missed_m2 > (1.0 - proof.planned.fraction + good_part) * area_of(done.reach);
}

/// Returns the reason why a drive with the navigator is not done; empty if it is.
std::string why_not_done(const NavigatedCover& done, const CoverProof& proof) {
  std::string reason;
  const auto add = [&](const std::string& one) { reason += (reason.empty() ? "" : "; ") + one; };
  if (done.left_ground > 0)
    add(fmt::format("the robot came out of the area {}", counted(done.left_ground, "time")));
  if (done.contacts > 0)
    add(fmt::format("the robot touched something {}",
                    counted(static_cast<std::size_t>(done.contacts), "time")));
  if (!done.believed_complete) add(done.reason);
  if (misses_something(done, proof))
    add(fmt::format("{:.4g} m2 are not covered of the {:.4g} m2 that can be, among what stands there",
                    done.missed_m2, area_of(done.reach)));
  return reason;
}

/// Adds the metrics of a drive with the navigator. The bounds on the time hold for a robot that stops at each
/// corner, which this one does not.
void add_metrics(std::vector<std::pair<std::string, double>>& metrics, const NavigatedCover& done,
                 const CoverProof& proof) {
  const std::vector<std::pair<std::string, double>> more = {
      {"reachable_m2", area_of(done.reach)},
      {"reachable_fraction", done.driven.fraction},
      {"left_m2", done.left_m2},
      {"rounds", static_cast<double>(done.rounds)},
      {"recoveries", static_cast<double>(done.recoveries)},
      {"contacts", static_cast<double>(done.contacts)},
      {"walked_into", static_cast<double>(done.walked_into)},
      {"left_ground", static_cast<double>(done.left_ground)},
      {"blocked_s", done.blocked_s},
      {"false_covered", done.believed_complete && misses_something(done, proof) ? 1.0 : 0.0}};
  std::erase_if(metrics,
                [](const auto& metric) { return metric.first == "t_min_s" || metric.first == "t_max_s"; });
  metrics.insert(metrics.end(), more.begin(), more.end());
}

std::vector<std::pair<std::string, double>> metrics_of(const CoverProblem& problem, const CoverRun& run) {
  const auto& [plan, proof, bound, drive, driven, navigated] = run;
  const auto number = [](std::size_t count) { return static_cast<double>(count); };
  return {{"covered_fraction", driven.fraction},
          {"covered_m2", driven.covered_m2},
          {"missed_m2", driven.missed_m2},
          {"overlap_m2", driven.overlap_m2},
          {"reach_m2", area_of(plan.ground.reach)},
          {"area_m2", area_of(plan.ground.area)},
          {"width_m", problem.width_m},
          {"strip_m", problem.strip_m()},
          {"time_s", drive.time_s},
          {"t_min_s", bound.least_s},
          {"t_max_s", bound.most_s},
          {"planned_s", plan.sums.time_s},
          {"order_bound_s", plan.order_bound_s},
          {"length_m", drive.length_m},
          {"planned_m", plan.sums.length_m},
          {"length_bound_m", proof.length_bound_m},
          {"turned_rad", drive.turned_rad},
          {"tracking_error_m", drive.tracking_error_m},
          {"tracking_error_limit_m", problem.tracking_error_m},
          {"areas_apart", number(plan.ground.fields.size())},
          {"transfer_m", length_of(plan, PieceRole::transfer)},
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

CoverLog::CoverLog(Log& log, const CoverProblem& problem, const CoverPlan& plan, std::uint64_t seed,
                   const std::string& name)
    : log_(log),
      plan_(plan),
      bar_(problem.bar().has_value()),
      coverage_(coverage_begun(problem, plan.ground.reach)) {
  const Box2 bounds = bounds_of(plan.ground.area);
  outrider_msgs::RunInfo info;
  info.job = "cover";
  info.seeded = true;
  info.seed = seed;
  info.world = name;
  info.low = point_of(bounds.low);
  info.high = point_of(bounds.high);
  info.robot_radius = problem.body_radius_m();
  info.coverage_width = problem.strip_m();
  if (const auto bar = problem.bar()) {
    info.coverage_length = bar->length_m;
    info.coverage_forward = bar->forward_m;
  }
  log.append(topic::run, 0.0, std::move(info));
  area_.area = outlines_of(outlines(plan.ground.area));
  area_.reach = outlines_of(outlines(plan.ground.reach));
  area_.planned = points_of(points_along(plan.track.start.position, plan.track.pieces, arc_step_rad));
  log.append(topic::coverage_area, 0.0, area_);
  log_markers(log);
  log_event(log, 0.0, "plan", described(plan));
}

/// Notes the passes, laps and cells that begin. Pieces of one role, one after the other, are one pass; a lap
/// or a cell begins another.
void CoverLog::note_piece(std::size_t index, double time_s) {
  const PieceRole role = plan_.roles[index];
  const bool begins = std::ranges::binary_search(plan_.begins, index);
  if (begins || role == PieceRole::lane || role != role_)
    queue_.note(time_s, topic::coverage_passes, outrider_msgs::CoveragePass{std::string(name_of(role))});
  role_ = role;
  if (!begins) return;
  const bool lap = role == PieceRole::lap;
  queue_.note_event(time_s, lap ? "lap" : "cell",
                    lap ? fmt::format("lap {} of {} begins", ++laps_, plan_.laps)
                        : fmt::format("cell {} of {} begins", ++cells_, plan_.cells));
}

/// Notes the poses before the index `end`.
void CoverLog::note_poses(const PieceDrive& drive, std::size_t end) {
  for (; poses_ < end; ++poses_) queue_.note_pose(drive.track[poses_].time_s, drive.track[poses_].pose);
}

/// Notes what is covered at that time. While the robot was carried it covered nothing.
void CoverLog::note_coverage(const PieceDrive& drive, double time_s) {
  const auto add = [&](double from_s, double until_s) {
    sums_ = bar_ ? coverage_.add(poses_between(drive, from_s, until_s))
                 : coverage_.add(stretch(drive, from_s, until_s));
  };
  if (measured_s_ < 0.0) {
    sums_ = bar_ ? coverage_.add(std::vector<Pose2>{drive.track.front().pose})
                 : coverage_.add(std::vector<Vec2>{drive.way.front()});
  } else {
    double from_s = measured_s_;
    for (const Carried& carried : drive.carried) {
      if (carried.until_s <= from_s || carried.from_s >= time_s) continue;
      if (carried.from_s > from_s) add(from_s, carried.from_s);
      from_s = carried.until_s;
    }
    if (from_s < time_s) add(from_s, time_s);
  }
  measured_s_ = time_s;
  queue_.note(time_s, topic::coverage, outrider_msgs::Coverage{sums_.covered_m2, sums_.overlap_m2});
}

void CoverLog::note(const PieceDrive& drive) {
  for (; pieces_ < drive.ends_s.size(); ++pieces_) note_piece(pieces_, begin_of(drive, pieces_));
  note_drive(drive);
}

void CoverLog::note_steered(const PieceDrive& drive) {
  note_poses(drive, drive.track.size());
  note_drive(drive);
}

/// Notes the motion since the last call, and logs all until now.
void CoverLog::note_drive(const PieceDrive& drive) {
  note_poses(drive, drive.track.size() - 1);  // the next piece may replace the last one
  if (measured_s_ < 0.0) note_coverage(drive, 0.0);
  const double step_s = plan_.sums.time_s / covered_steps;
  while (step_s > 0.0 && measured_s_ + step_s <= drive.time_s) note_coverage(drive, measured_s_ + step_s);
  queue_.flush(log_, drive.time_s);
}

void CoverLog::finish(const PieceDrive& drive, const Coverage& driven, const CoverEnding& ending) {
  note_poses(drive, drive.track.size());
  if (measured_s_ < drive.time_s) note_coverage(drive, drive.time_s);
  if (ending.finished)
    queue_.note_event(drive.time_s, ending.kept ? "done" : "not_done",
                      fmt::format("{:.2f} % of the reach is covered, {:.4g} m2 of it more than once",
                                  100.0 * driven.fraction, driven.overlap_m2));
  area_.missed = outlines_of(outlines(driven.missed));
  area_.overlap = outlines_of(outlines(driven.overlap));
  queue_.note(drive.time_s, topic::coverage_area, area_);
  queue_.flush(log_, drive.time_s);
}

Report cover_report(const CoverProblem& problem, const CoverRun& run, const std::string& name) {
  Report report;
  report.status = "done";
  report.world_name = name;
  report.metrics = metrics_of(problem, run);
  if (run.navigated) add_metrics(report.metrics, *run.navigated, run.proof);
  if (run.proof.fields.size() > 1) report.tables.push_back(areas_table(run.proof));
  if (!run.proof.complete) {
    report.status = "not_done";
    report.reason = shortfall(problem, run.proof);
    report.tables.push_back(missed_table(run.proof));
  }
  if (!run.navigated) return report;
  if (const std::string why = why_not_done(*run.navigated, run.proof); !why.empty()) {
    report.status = "not_done";
    report.reason += (report.reason.empty() ? "" : "; ") + why;
  }
  return report;
}

}  // namespace outrider
