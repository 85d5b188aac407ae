#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "clocks.hpp"
#include "commands.hpp"
#include "flags.hpp"
#include "laser_run.hpp"
#include "output.hpp"
#include "outrider/io/files.hpp"
#include "outrider/io/g2o.hpp"
#include "outrider/slam/map_error.hpp"
#include "progress.hpp"
#include "slam_input.hpp"
#include "slam_laser.hpp"
#include "slam_picture.hpp"

namespace outrider::cli {
namespace {

using Json = nlohmann::ordered_json;

struct SlamCommand {
  std::string path;
  bool json = false;
  std::string out;
  std::string truth;
  std::string resume;
  bool measured_frame = false;
  LandmarkSlamOptions landmarks;
  LogNoise noise;
  PoseGraphOptions graph;
  CarmenOptions carmen;
  LaserSlamOptions laser = options_for_logs();
};

std::vector<OptionGroup> describe(SlamCommand& command) {
  return {{"",
           "output",
           {{"json", "", 0, 0, "print one JSON object on standard output", &command.json},
            {"out", "", 0, 0, "folder for the map, the track, the state and a picture", &command.out}}},
          {"",
           "input",
           {{"truth", "", 0, 0, "file with the true landmarks of a Freiburg log", &command.truth},
            {"resume", "", 0, 0, "state of an earlier run to continue from", &command.resume}}},
          {"slam", "landmarks", describe(command.landmarks)},
          {"noise", "noise of logs that give none", describe(command.noise)},
          {"carmen", "laser logs", describe(command.carmen)},
          {"laser", "laser scans", describe(command.laser)},
          {"map", "map of laser scans", describe(command.laser.map)},
          {"graph", "graphs", describe(command.graph)},
          {"graph",
           "graphs",
           {{"measured_frame", "", 0, 0, "errors of poses in the frame of the measured pose, as g2o has them",
             &command.measured_frame}}}};
}

Json known(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

std::vector<Vec2> places(const std::vector<Pose2>& poses) {
  std::vector<Vec2> result;
  for (const Pose2& pose : poses) result.push_back(pose.position);
  return result;
}

/// A pose a line: number, x, y, heading (m, rad).
std::string track_csv(const std::vector<Pose2>& poses) {
  std::string text = "step,x,y,heading\n";
  for (std::size_t i = 0; i < poses.size(); ++i) {
    text += fmt::format("{},{},{},{}\n", i, poses[i].position.x, poses[i].position.y, poses[i].heading_rad);
  }
  return text;
}

std::string landmarks_csv(const LandmarkMap& map) {
  std::string text = "id,x,y,xx,xy,yy,sightings\n";
  for (const LandmarkEstimate& l : map) {
    text += fmt::format("{},{},{},{},{},{},{}\n", l.id, l.position.x, l.position.y, l.covariance(0, 0),
                        l.covariance(0, 1), l.covariance(1, 1), l.sightings);
  }
  return text;
}

/// Loops: edges between poses that do not follow each other.
SlamPicture picture_of(const PoseGraph& graph, const PoseGraphSolution& solution,
                       const std::vector<Matrix3>& covariances) {
  SlamPicture picture;
  const auto at = [&](std::uint32_t node) { return solution.poses[node].position; };
  for (const GraphEdge& edge : graph.edges) {
    if (edge.kind != EdgeKind::pose) continue;
    const bool follows = edge.to == edge.from + 1;
    (follows ? picture.driven : picture.loops).push_back({at(edge.from), at(edge.to)});
  }
  for (std::uint32_t i = 0; i < graph.nodes.size() && !covariances.empty(); ++i) {
    if (!graph.nodes[i].is_point) continue;
    const Matrix3& c = covariances[i];
    picture.landmarks.push_back({i, at(i), {{c(0, 0), c(0, 1), c(1, 0), c(1, 1)}}, 0});
  }
  return picture;
}

/// Root mean squared error of the points, or of the poses, once the whole is moved onto the truth.
std::optional<double> aligned_error(const GraphInput& input, const std::vector<Pose2>& poses, bool points,
                                    bool aligned) {
  std::vector<Vec2> estimate, truth;
  for (std::size_t i = 0; i < input.truth.size(); ++i) {
    if (input.graph.nodes[i].is_point != points) continue;
    estimate.push_back(poses[i].position);
    truth.push_back(input.truth[i].position);
  }
  return rms_distance(estimate, truth, aligned ? rigid_alignment(estimate, truth) : Pose2{});
}

int solve_graph(const SlamCommand& command, GraphInput input) {
  if (command.measured_frame) input.graph = in_measured_frame(std::move(input.graph));
  Progress progress(1);
  progress.next("optimising");
  const auto begin = Clock::now();
  const auto solution = optimise(input.graph, command.graph, {});
  const double time_s = seconds_since(begin);
  progress.end();
  if (!solution) return say(solution.error(), command.json);
  if (!command.out.empty()) {
    const auto covariances = marginal_covariances(input.graph, solution->poses);
    const auto drawn =
        picture_of(input.graph, *solution, covariances ? *covariances : std::vector<Matrix3>());
    std::vector<NamedText> files = {{"track.csv", track_csv(solution->poses)}, {"slam.svg", to_svg(drawn)}};
    if (auto g2o = to_g2o(input.graph, solution->poses)) files.emplace_back("graph.g2o", *g2o);
    if (auto ok = write_files(command.out, files); !ok) return say(ok.error(), command.json);
  }
  const Json result = {
      {"status", solution->converged ? "done" : "not_done"},
      {"job", "slam"},
      {"file", command.path},
      {"engine", "pose_graph"},
      {"landmark_rmse_m", known(aligned_error(input, solution->poses, true, false))},
      {"landmark_rmse_aligned_m", known(aligned_error(input, solution->poses, true, true))},
      {"ate_m", known(aligned_error(input, solution->poses, false, true))},
      {"cost", solution->cost},
      {"steps", solution->iterations},
      {"time_s", time_s},
      {"max_step_s", time_s / static_cast<double>(std::max<std::int64_t>(1, solution->iterations))},
      {"nodes", input.graph.nodes.size()},
      {"edges", input.graph.edges.size()},
      {"start", solution->start},
      {"start_cost", solution->start_cost},
      {"robust_cost", solution->robust_cost}};
  if (command.json) {
    print(result);
  } else {
    fmt::print("{} nodes, {} edges: cost {:.6g}, from {:.6g} at the {} start, after {} steps in {}\n",
               input.graph.nodes.size(), input.graph.edges.size(), solution->cost, solution->start_cost,
               solution->start, solution->iterations, duration_text(time_s));
  }
  return solution->converged ? job_done : job_not_done;
}

struct Run {
  LandmarkSlam slam;
  std::vector<double> times_s;
  std::vector<Pose2> odometry;
  int used = 0;
  int refused = 0;
  int removed = 0;
  int lost = 0;
};

Outcome<Run> run_log(const SlamCommand& command, const LandmarkSlamOptions& options, LandmarkLog& log) {
  auto begun = LandmarkSlam::begin(options, log.start);
  if (!command.resume.empty()) {
    const auto state = read_file(command.resume);
    if (!state) return tl::unexpected<Fault>(state.error());
    begun = LandmarkSlam::load(*state);
    if (!begun) return bad_input(begun.error().sentence, command.resume);
  }
  if (!begun) return pass_on(begun);
  Run run{std::move(*begun), {}, {log.start}, 0, 0, 0, 0};
  Progress progress(1);
  progress.next("mapping");
  for (std::size_t i = 0; i < log.steps.size(); ++i) {
    LogStep& step = log.steps[i];
    const Pose2& last = run.odometry.back();
    run.odometry.push_back({last.position + rotated(last.heading_rad, step.odometry.position),
                            last.heading_rad + step.odometry.heading_rad});
    if (options.unknown_ids) {
      for (LandmarkSighting& sighting : step.sightings) sighting.id.reset();
    }
    const auto begin = Clock::now();
    const auto outcome = run.slam.advance(step);
    run.times_s.push_back(seconds_since(begin));
    if (!outcome) return bad_input(fmt::format("step {}: {}", i + 1, outcome.error().sentence), command.path);
    run.used += outcome->used;
    run.refused += outcome->refused;
    run.removed += static_cast<int>(outcome->removed.size());
    run.lost += outcome->lost ? 1 : 0;
    progress.part(static_cast<double>(i + 1) / static_cast<double>(log.steps.size()));
  }
  const auto begin = Clock::now();
  run.slam.settle();
  run.times_s.push_back(seconds_since(begin));
  return run;
}

/// The true places in the frame of the map.
std::vector<Vec2> truth_in_map(const LandmarkLog& log, const MapError& error) {
  std::vector<Vec2> result;
  const Pose2& motion = error.alignment;
  for (const auto& [id, place] : log.true_landmarks) {
    result.push_back(unrotated(motion.heading_rad, place - motion.position));
  }
  return error.landmarks > 0 ? result : std::vector<Vec2>();
}

int run_landmarks(const SlamCommand& command, const Command& flags, LandmarkLog log) {
  LandmarkSlamOptions options = command.landmarks;
  if (log.told_apart && !options.unknown_ids) {
    if (!flags.given("--slam-gate")) options.gate = 1.0;
    if (!flags.given("--slam-patience")) options.patience = 1;
  }
  auto run = run_log(command, options, log);
  if (!run) return say(run.error(), command.json);
  const LandmarkMap map = run->slam.landmarks();
  const auto exchanged = options.unknown_ids ? std::nullopt : exchanged_ids(map, log.true_landmarks);
  if (exchanged) {
    std::swap(log.true_landmarks[exchanged->first], log.true_landmarks[exchanged->second]);
    fmt::print(
        stderr,
        "outrider: warning: the truth has landmarks {} and {} exchanged; they are taken for each other\n",
        exchanged->first, exchanged->second);
  }
  constexpr double reach_m = 0.5;
  const MapError error = options.unknown_ids ? map_error_by_place(map, log.true_landmarks, reach_m)
                                             : map_error(map, log.true_landmarks);
  if (!command.out.empty()) {
    const std::vector<Pose2> track = run->slam.trajectory();
    const SlamPicture picture{{places(track)}, {places(run->odometry)}, {}, map, truth_in_map(log, error)};
    const std::vector<NamedText> files = {{"track.csv", track_csv(track)},
                                          {"landmarks.csv", landmarks_csv(map)},
                                          {"state.txt", run->slam.state()},
                                          {"slam.svg", to_svg(picture)}};
    if (auto ok = write_files(command.out, files); !ok) return say(ok.error(), command.json);
  }
  std::vector<double> sorted = run->times_s;
  std::sort(sorted.begin(), sorted.end());
  double time_s = 0.0;
  for (const double step_s : sorted) time_s += step_s;
  const Json result = {{"status", "done"},
                       {"job", "slam"},
                       {"file", command.path},
                       {"engine", options.engine},
                       {"landmark_rmse_m", known(error.rmse_m)},
                       {"landmark_rmse_aligned_m", known(error.aligned_rmse_m)},
                       {"ate_m", nullptr},
                       {"cost", options.engine == "graph" ? Json(run->slam.cost()) : Json(nullptr)},
                       {"steps", log.steps.size()},
                       {"time_s", time_s},
                       {"max_step_s", sorted.back()},
                       {"median_step_s", sorted[sorted.size() / 2]},
                       {"landmarks", map.size()},
                       {"landmarks_compared", error.landmarks},
                       {"sightings_used", run->used},
                       {"sightings_refused", run->refused},
                       {"landmarks_removed", run->removed},
                       {"steps_lost", run->lost}};
  if (command.json) {
    print(result);
    return job_done;
  }
  fmt::print("{} steps, {} landmarks in {}; {} sightings refused, lost for {} steps\n", log.steps.size(),
             map.size(), duration_text(time_s), run->refused, run->lost);
  if (error.aligned_rmse_m) {
    fmt::print("landmarks off by {:.3f} m, {:.3f} m once the map is laid over the truth\n", *error.rmse_m,
               *error.aligned_rmse_m);
  }
  return job_done;
}

int execute(SlamCommand& command, const Command& flags) {
  const bool json = flags.given("--json");
  if (auto ok = apply_flags(flags, describe(command)); !ok) return say(ok.error(), json);
  if (flags.given("--out")) {
    if (auto ok = check_folder(command.out); !ok) return say(ok.error(), json);
  }
  auto input = load_slam_input(command.path, command.truth, command.noise, command.carmen);
  if (!input) return say(input.error(), command.json);
  if (auto* graph = std::get_if<GraphInput>(&*input)) return solve_graph(command, std::move(*graph));
  if (const auto* log = std::get_if<LaserLog>(&*input)) {
    return map_laser_log({command.path, command.out, command.json, command.laser}, *log);
  }
  return run_landmarks(command, flags, std::move(std::get<LandmarkLog>(*input)));
}

}  // namespace

void add_slam(Command& tool) {
  Command& slam = tool.add("slam", "localise and map from a recorded log, or solve a pose graph");
  auto command = std::make_shared<SlamCommand>();
  slam.positional(
          "file", &command->path,
          "laser log, landmark log, g2o graph or PyFG graph; may be gzip-compressed; docs/jobs/slam.md")
      .required()
      .type("FILE");
  add_flags(slam, describe(*command));
  slam.does([command](const Command& flags) { return execute(*command, flags); });
  slam.footer("\nExample: outrider slam scenarios/slam/yard.g2o --out out");
}

}  // namespace outrider::cli
