#include "slam_laser.hpp"

#include <fmt/format.h>

#include <iterator>
#include <nlohmann/json.hpp>

#include "laser_picture.hpp"
#include "laser_run.hpp"
#include "output.hpp"
#include "outrider/io/map_server.hpp"
#include "progress.hpp"

namespace outrider::cli {
namespace {

using Json = nlohmann::ordered_json;

Json known(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

/// A scan a line: number, time (s), x, y (m), heading (rad).
std::string track_csv(const LaserLog& log, const std::vector<Pose2>& poses) {
  std::string text = "step,time,x,y,heading\n";
  for (std::size_t i = 0; i < log.steps.size(); ++i) {
    const Pose2& pose = poses[i + 1];
    fmt::format_to(std::back_inserter(text), "{},{},{},{},{}\n", i, log.steps[i].scan.time_s, pose.position.x,
                   pose.position.y, pose.heading_rad);
  }
  return text;
}

Status write_map(const LaserJob& job, const LaserLog& log, const LaserRun& run) {
  const std::vector<Pose2> poses = run.slam.trajectory();
  std::vector<Vec2> track;
  for (const Pose2& pose : poses) track.push_back(pose.position);
  const Grid<std::uint8_t> map = known_part(run.slam.map().occupancy());
  const std::vector<NamedText> files = {{"track.csv", track_csv(log, poses)},
                                        {"slam.svg", to_svg(map, track, run.reference)}};
  if (auto ok = write_files(job.out, files); !ok) return ok;
  return save_map_server(job.out + "/map.yaml", {map, 0.0});
}

}  // namespace

int map_laser_log(const LaserJob& job, const LaserLog& log) {
  Progress progress(1);
  progress.next("mapping");
  const auto run = run_laser_log(log, job.options, [&](double done) { progress.part(done); });
  progress.end();
  if (!run) return say(run.error(), job.json);
  if (!job.out.empty()) {
    if (auto ok = write_map(job, log, *run); !ok) return say(ok.error(), job.json);
  }
  const bool timed = run->log_s > 0.0 && run->time_s > 0.0;
  const double factor = timed ? run->log_s / run->time_s : 0.0;
  if (job.json) {
    print({{"status", "done"},
           {"job", "slam"},
           {"file", job.path},
           {"engine", "laser"},
           {"mean_absolute_error_m", known(run->mean_error_m)},
           {"ate_m", known(run->rms_error_m)},
           {"steps", log.steps.size()},
           {"steps_matched", run->matched},
           {"loops", run->slam.loops()},
           {"time_s", run->time_s},
           {"max_step_s", run->max_step_s},
           {"log_s", run->log_s},
           {"real_time_factor", timed ? Json(factor) : Json(nullptr)}});
    return job_done;
  }
  fmt::print("{} scans, {} matched, {} loops closed in {}{}\n", log.steps.size(), run->matched,
             run->slam.loops(), duration_text(run->time_s),
             timed ? fmt::format(", {:.0f} times as fast as the robot drove", factor) : "");
  if (run->mean_error_m) {
    fmt::print("poses {:.3f} m from the reference on average, once the track is laid over it\n",
               *run->mean_error_m);
  }
  return job_done;
}

}  // namespace outrider::cli
