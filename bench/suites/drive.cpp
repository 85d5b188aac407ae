// Drives a scenario many times with one fault after another, and compares what each drive claims with where
// the robot truly was.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "drive_followers.hpp"
#include "outrider/core/rng.hpp"
#include "outrider/core/units.hpp"
#include "outrider/job/run_job.hpp"
#include "outrider/jobs/drive/job.hpp"
#include "outrider/jobs/drive/run.hpp"
#include "rows.hpp"

namespace outrider::bench {
namespace {

/// Draws the size of a fault and puts it into the setup. `seed` is that of the run.
using ApplyFault = void (*)(DriveSetup&, Rng&, std::uint64_t seed);

struct DriveFault {
  std::string name;
  ApplyFault apply;
};

/// Counts the outcomes of all runs of one follower with one fault.
struct DriveRow {
  std::string follower;
  std::string fault;
  int runs = 0, done = 0, doubtful = 0, unconfirmed = 0, not_done = 0;
  int stops = 0, reached = 0;
  int false_reached = 0;             ///< stops called reached that were off by more than the tolerance
  double worst_m = 0.0;              ///< largest error at a stop that was called reached
  double worst_rad = 0.0;            ///< the same of the heading
  std::vector<double> error_ratios;  ///< of each run: largest error of the belief in standard deviations
};

double either_sign(Rng& rng) { return rng.uniform() < 0.5 ? -1.0 : 1.0; }

Report driven(const DriveSetup& setup, std::uint64_t seed) {
  Log log;
  return run_drive(setup.task, setup.sim, setup.rendered, seed, log);
}

/// Moves the robot while it settles at one of its stops. A drive without the fault tells when that is.
void nudge(DriveSetup& setup, Rng& rng, std::uint64_t seed, double by_m) {
  const Report report = driven(setup, seed);
  std::vector<double> reached_s;
  const Table& waypoints = table_named(report, "waypoints");
  for (const auto& values : waypoints.rows) {
    const double at_s = TableRow{waypoints, values}.number("reached_s");
    if (std::isfinite(at_s)) reached_s.push_back(at_s);
  }
  if (reached_s.empty()) return;
  const double before_s = rng.uniform(0.0, setup.task.rules.settle_s);
  setup.sim.kidnapping = {reached_s[rng.below(reached_s.size())] - before_s, by_m, rng.uniform(-0.1, 0.1)};
}

void set_wheel_off(DriveSetup& setup, Rng& rng) {
  setup.sim.wheels.gains[rng.below(setup.task.chassis.wheels.size())] += 0.1 * either_sign(rng);
}

/// Hangs the tags of the world elsewhere than on the map of the robot: each is kept, taken away, exchanged
/// for one that is not on the map, or moved by up to a metre along its wall.
void change_world(DriveSetup& setup, Rng& rng) {
  TagMap world;
  for (Tag tag : setup.task.tags.tags) {
    const std::uint64_t change = rng.below(4);
    if (change == 1) continue;
    if (change == 2) tag.id += 100;
    const double by_m = change == 3 ? rng.uniform(0.1, 1.0) * either_sign(rng) : 0.0;
    tag.world_T_tag.position = tag.world_T_tag.position + by_m * tag.world_T_tag.rotation.axes[0];
    world.tags.push_back(tag);
  }
  setup.sim.tags = std::move(world);
}

const std::vector<DriveFault>& drive_faults() {
  static const std::vector<DriveFault> faults = {
      {"none", [](DriveSetup&, Rng&, std::uint64_t) {}},
      {"no tags", [](DriveSetup& setup, Rng&, std::uint64_t) { setup.task.tags.tags.clear(); }},
      {"blinded", [](DriveSetup& setup, Rng& rng,
                     std::uint64_t) { setup.sim.sight.blind_from_s = rng.uniform(0.0, 40.0); }},
      {"kidnapped by 0.8 m",
       [](DriveSetup& setup, Rng& rng, std::uint64_t) {
         setup.sim.kidnapping = {rng.uniform(0.0, 40.0), 0.8 * either_sign(rng), rng.uniform(-pi, pi)};
       }},
      {"kidnapped by 30 m",
       [](DriveSetup& setup, Rng& rng, std::uint64_t) {
         setup.sim.kidnapping = {rng.uniform(0.0, 40.0), 30.0 * either_sign(rng), rng.uniform(-pi, pi)};
       }},
      {"nudged by 0.2 m at a stop",
       [](DriveSetup& setup, Rng& rng, std::uint64_t seed) {
         nudge(setup, rng, seed, 0.2 * either_sign(rng));
       }},
      {"nudged by 1 to 10 cm",
       [](DriveSetup& setup, Rng& rng, std::uint64_t seed) {
         nudge(setup, rng, seed, rng.uniform(0.01, 0.1) * either_sign(rng));
       }},
      {"wheel 10 % off", [](DriveSetup& setup, Rng& rng, std::uint64_t) { set_wheel_off(setup, rng); }},
      {"strafe slip 50 %",
       [](DriveSetup& setup, Rng&, std::uint64_t) { setup.sim.wheels.strafe_slip = 0.5; }},
      {"wheel off, slip, few images",
       [](DriveSetup& setup, Rng& rng, std::uint64_t) {
         set_wheel_off(setup, rng);
         setup.sim.wheels.strafe_slip = 0.5;
         setup.sim.sight.missed = 0.8;
       }},
      {"tag moved by 10 to 50 cm",
       [](DriveSetup& setup, Rng& rng, std::uint64_t) {
         const auto& tags = setup.task.tags.tags;
         setup.sim.moved_tag = {tags[rng.below(tags.size())].id, rng.uniform(0.1, 0.5) * either_sign(rng)};
       }},
      {"tag moved on the way",
       [](DriveSetup& setup, Rng& rng, std::uint64_t) {
         const auto& tags = setup.task.tags.tags;
         setup.sim.moved_tag = {tags[rng.below(tags.size())].id, rng.uniform(0.1, 0.5) * either_sign(rng),
                                rng.uniform(2.0, 35.0)};
       }},
      {"tags 3 to 10 % larger or smaller",
       [](DriveSetup& setup, Rng& rng, std::uint64_t) {
         setup.sim.tag_scale = 1.0 + rng.uniform(0.03, 0.1) * either_sign(rng);
       }},
      {"tags of another world", [](DriveSetup& setup, Rng& rng, std::uint64_t) { change_world(setup, rng); }},
      {"images 0.3 s late", [](DriveSetup& setup, Rng&, std::uint64_t) { setup.task.eye.latency_s = 0.3; }},
      {"corners off by 1 px",
       [](DriveSetup& setup, Rng&, std::uint64_t) { setup.sim.sight.corner_sigma_px = 1.0; }},
  };
  return faults;
}

void count(DriveRow& row, const DriveSetup& setup, const Report& report) {
  ++row.runs;
  row.done += report.status == "done" ? 1 : 0;
  row.doubtful += report.status == "doubtful" ? 1 : 0;
  row.unconfirmed += report.status == "unconfirmed" ? 1 : 0;
  row.not_done += report.status == "not_done" ? 1 : 0;
  row.error_ratios.push_back(metric(report, "belief_error_ratio"));
  const Table& waypoints = table_named(report, "waypoints");
  const double most_m = metric(report, "tolerance_m"), most_rad = metric(report, "tolerance_rad");
  for (std::size_t i = 0; i < waypoints.rows.size(); ++i) {
    const TableRow waypoint{waypoints, waypoints.rows[i]};
    if (!setup.task.waypoints[i].stop) continue;
    ++row.stops;
    if (!std::isfinite(waypoint.number("reached_s"))) continue;
    ++row.reached;
    const double off_m = std::hypot(waypoint.number("dx"), waypoint.number("dy"));
    const double off_rad = std::abs(waypoint.number("dtheta"));
    row.worst_m = std::max(row.worst_m, off_m);
    row.worst_rad = std::max(row.worst_rad, off_rad);
    row.false_reached += off_m > most_m || off_rad > most_rad ? 1 : 0;
  }
}

nlohmann::ordered_json row_json(const DriveRow& row) {
  return {{"follower", row.follower},
          {"fault", row.fault},
          {"runs", row.runs},
          {"done", row.done},
          {"doubtful", row.doubtful},
          {"unconfirmed", row.unconfirmed},
          {"not_done", row.not_done},
          {"stops", row.stops},
          {"reached", row.reached},
          {"false_reached", row.false_reached},
          {"worst_m", row.worst_m},
          {"worst_rad", row.worst_rad},
          {"median_belief_error_ratio", quantile(row.error_ratios, 0.5)},
          {"most_belief_error_ratio", quantile(row.error_ratios, 1.0)}};
}

std::string table_text(const std::vector<DriveRow>& rows) {
  std::string text =
      fmt::format("  {:<12}  {:<34} {:>5} {:>5} {:>8} {:>11} {:>8} {:>12} {:>6} {:>9} {:>9} {:>15}\n",
                  "follower", "fault", "runs", "done", "doubtful", "unconfirmed", "not done", "reached",
                  "false", "worst mm", "worst deg", "belief, sigmas");
  for (const DriveRow& row : rows) {
    text += fmt::format(
        "  {:<12}  {:<34} {:>5} {:>5} {:>8} {:>11} {:>8} {:>7}/{:<4} {:>6} {:>9.1f} {:>9.2f} {:>7.1f} "
        "{:>7.1f}\n",
        row.follower, row.fault, row.runs, row.done, row.doubtful, row.unconfirmed, row.not_done, row.reached,
        row.stops, row.false_reached, 1e3 * row.worst_m, degrees(row.worst_rad),
        quantile(row.error_ratios, 0.5), quantile(row.error_ratios, 1.0));
  }
  return text;
}

Outcome<DriveSetup> loaded(const std::string& path, const std::string& follower) {
  DriveJob job;
  if (auto ok = read_scenario(job, path); !ok) return pass_on(ok);
  if (auto ok = change(job, {{"sight", "modelled"}, {"follow.follower", follower}}); !ok) return pass_on(ok);
  if (auto ok = job.load(); !ok) return pass_on(ok);
  return std::move(*job.setup);
}

/// Drives with one fault after another.
std::vector<DriveRow> drive_with_faults(const DriveSetup& setup, std::int64_t seeds,
                                        const BenchObserver& observer, std::vector<std::string>& complaints) {
  std::vector<DriveRow> rows;
  const std::string& follower = setup.task.follow.follower;
  for (const DriveFault& fault : drive_faults()) {
    next_step(observer, fmt::format("{}, {}", follower, fault.name));
    DriveRow row{.follower = follower, .fault = fault.name, .error_ratios = {}};
    for (std::int64_t i = 1; i <= seeds; ++i) {
      const auto seed = static_cast<std::uint64_t>(i);
      DriveSetup one = setup;
      Rng rng = Rng(seed).child(fault.name);
      fault.apply(one, rng, seed);
      const int before = row.false_reached;
      count(row, one, driven(one, seed));
      if (row.false_reached > before)
        complaints.push_back(
            fmt::format("{}, {}, seed {}: a stop called reached was off by more than the tolerance", follower,
                        fault.name, seed));
      if (observer.part) observer.part(static_cast<double>(i) / static_cast<double>(seeds));
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace

Outcome<BenchResult> measure_drive(const DriveRequest& request, const BenchObserver& observer) {
  std::vector<DriveRow> rows;
  std::vector<std::string> complaints;
  std::vector<FollowerRow> follower_rows;
  begin_steps(observer, request.scenarios.size() * request.followers.size() * (drive_faults().size() + 1));
  for (const std::string& path : request.scenarios) {
    std::optional<DriveSetup> plain;
    for (const std::string& follower : request.followers) {
      auto setup = loaded(path, follower);
      if (!setup) return pass_on(setup);
      for (DriveRow& row : drive_with_faults(*setup, request.seeds, observer, complaints))
        rows.push_back(std::move(row));
      plain = std::move(*setup);
    }
    if (!plain) continue;
    for (FollowerRow& row : compare_followers(*plain, request.followers, request.seeds, observer)) {
      if (row.false_reached > 0 || row.touched > 0)
        complaints.push_back(
            fmt::format("{}: {} stops called reached were off by more than the tolerance, {} courses "
                        "touched something",
                        row.follower, row.false_reached, row.touched));
      follower_rows.push_back(std::move(row));
    }
  }
  BenchResult result = result_of(rows);
  for (const FollowerRow& row : follower_rows) result.rows.push_back(row_json(row));
  result.table += table_text(follower_rows);
  result.right = complaints.empty();
  result.complaints = std::move(complaints);
  return result;
}

}  // namespace outrider::bench
