#include "outrider/slam/landmark/landmark_slam.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "algebra/small_cholesky.hpp"
#include "covariances.hpp"
#include "landmark/slam_engine.hpp"
#include "outrider/core/text.hpp"

namespace outrider {
namespace {

constexpr std::string_view state_head = "outrider-landmark-slam-2";

template <int N>
bool usable(const Eigen::Matrix<double, N, N>& covariance) {
  return is_symmetric(covariance) && SmallCholesky<N>(covariance).is_positive();
}

Status check_options(const LandmarkSlamOptions& options) {
  const auto refuse = [](const std::string& value, std::string_view takes, const char* key) {
    return bad_input(fmt::format("'{}' is not valid; expected {}", excerpt(value), takes), key);
  };
  const auto& [engine, kernel] = std::tie(options.engine, options.kernel);
  if (engine != "kalman" && engine != "ekf" && engine != "graph") {
    return refuse(engine, "kalman, ekf or graph", "engine");
  }
  if (kernel != "none" && kernel != "huber" && kernel != "cauchy" && kernel != "geman_mcclure") {
    return refuse(kernel, "none, huber, cauchy or geman_mcclure", "kernel");
  }
  if (options.unknown_ids && engine == "graph") {
    return bad_input("the graph takes landmarks with ids only; take the engine ekf", "engine");
  }
  if (options.unknown_ids && options.gate >= 1.0) {
    return bad_input("'1' is not valid; without ids, expected a share below 1", "gate");
  }
  return {};
}

/// The options as they are stored in a state.
struct KeptOptions {
  LandmarkSlamOptions& o;
  template <class Archive>
  void exchange(Archive& archive) {
    std::int64_t unknown = o.unknown_ids ? 1 : 0;
    archive(o.engine, unknown, o.gate, o.patience, o.patience_distance_m, o.sensor_range_m,
            o.field_of_view_rad, o.misses, o.lost_after, o.kernel, o.kernel_width, o.relinearise,
            o.reorder_every);
    o.unknown_ids = unknown != 0;
  }
};

}  // namespace

std::vector<Option> describe(LandmarkSlamOptions& o) {
  return {
      {"engine", "", 0, 0, "how to estimate: kalman, ekf or graph", &o.engine},
      {"unknown_ids", "", 0, 0, "tell landmarks apart by where they stand, not by their ids", &o.unknown_ids},
      {"gate", "", 0.5, 1, "share of right sightings that the gate lets pass; 1: there is no gate", &o.gate},
      {"patience", "", 1, 1000, "sightings that a new landmark needs", &o.patience},
      {"patience_distance", "m", 1e-3, 1000, "how far apart they may be", &o.patience_distance_m},
      {"sensor_range", "m", 0, 1e6, "how far the sensor sees every landmark; 0: not known",
       &o.sensor_range_m},
      {"field_of_view", "deg", 1, 360, "field of view", &o.field_of_view_rad},
      {"misses", "", 1, 1'000'000, "misses in a row after which a landmark is taken for gone", &o.misses},
      {"lost_after", "", 1, 1'000'000,
       "steps in a row without one sighting that fits until the robot is lost", &o.lost_after},
      {"kernel", "", 0, 0, "loss of a sighting in the graph: none, huber, cauchy or geman_mcclure",
       &o.kernel},
      {"kernel_width", "", 1e-3, 1e6, "standard deviations from which a kernel weighs down", &o.kernel_width},
      {"relinearise", "", 0, 10, "change in m or rad at which the graph linearises again", &o.relinearise},
      {"reorder_every", "", 1, 1'000'000, "steps after which the graph chooses its order of elimination anew",
       &o.reorder_every},
  };
}

std::vector<Option> describe(LogNoise& noise) {
  return {{"distance", "", 1e-6, 100, "m of error in the root of a metre driven, along and across",
           &noise.distance},
          {"turn_per_distance", "deg", 0, 360, "error of heading in the root of a metre driven",
           &noise.turn_per_distance_rad},
          {"turn", "", 0, 100, "rad of error in the root of a radian turned", &noise.turn},
          {"range", "m", 1e-6, 1000, "error of a range", &noise.range_m},
          {"bearing", "deg", 1e-6, 180, "error of a bearing", &noise.bearing_rad}};
}

/// Adds independent errors for each part, so that the variances grow with the distance and the angle (Thrun,
/// Burgard and Fox, Probabilistic Robotics, section 5.4, with standard deviations that grow with the square
/// root).
void LogMotion::add(double turn_rad, double distance_m, double then_turn_rad, const LogNoise& noise) {
  const double heading_rad = pose.heading_rad + turn_rad;
  const Vec2 arm = distance_m * direction(heading_rad);
  Eigen::Matrix3d by_pose = Eigen::Matrix3d::Identity();
  by_pose(0, 2) = -arm.y;
  by_pose(1, 2) = arm.x;
  const double driven_m = std::abs(distance_m);
  const double turned_rad = std::abs(turn_rad) + std::abs(then_turn_rad);
  constexpr double least = 1e-8;  // a robot at rest may still have been pushed
  const double place = noise.distance * noise.distance * driven_m + least;
  const double heading = noise.turn_per_distance_rad * noise.turn_per_distance_rad * driven_m +
                         noise.turn * noise.turn * turned_rad + least;
  covariance = by_pose * covariance * by_pose.transpose();
  covariance.diagonal() += Eigen::Vector3d(place, place, heading);
  pose = {pose.position + arm, wrap_angle(heading_rad + then_turn_rad)};
}

LandmarkSighting sighted(std::optional<std::int64_t> id, double range_m, double bearing_rad,
                         double range_sd_m, double bearing_sd_rad) {
  const double along = range_sd_m * range_sd_m;
  const double across = std::max(1e-6, range_m * range_m) * bearing_sd_rad * bearing_sd_rad;
  const Eigen::Matrix2d turn = Eigen::Rotation2Dd(bearing_rad).toRotationMatrix();
  Eigen::Matrix2d covariance = turn * Eigen::Vector2d(along, across).asDiagonal() * turn.transpose();
  covariance(1, 0) = covariance(0, 1);
  return {id, range_m * direction(bearing_rad), covariance};
}

Status check(const LogStep& step) {
  if (!std::isfinite(step.time_s) || !finite(step.odometry)) {
    return bad_input("its odometry is not finite; leave the step out");
  }
  if (!step.covariance.isZero(0.0) && !usable(step.covariance)) {
    return bad_input("the covariance of its odometry is not positive definite; correct it");
  }
  constexpr std::size_t most_sightings = 1000;
  if (step.sightings.size() > most_sightings) {
    return bad_input(fmt::format("it has {} sightings; a step has at most {}, so split it",
                                 step.sightings.size(), most_sightings));
  }
  for (const LandmarkSighting& sighting : step.sightings) {
    if (!finite(sighting.position)) return bad_input("a sighting is not finite; leave it out");
    if (!usable(sighting.covariance)) {
      return bad_input("the covariance of a sighting is not positive definite; correct it");
    }
    if (sighting.id && *sighting.id < 0) {
      return bad_input(fmt::format("a landmark has the id {}; ids start at 0", *sighting.id));
    }
  }
  return {};
}

std::optional<Candidate> Memory::remember(const LandmarkSighting& sighting, Vec2 world,
                                          const LandmarkSlamOptions& options) {
  const std::int64_t id = options.unknown_ids ? -1 : sighting.id.value_or(-1);
  auto found = candidates.end();
  for (auto it = candidates.begin(); it != candidates.end(); ++it) {
    if (it->id != id) continue;
    const double apart = distance(it->position, world);
    if (id < 0 && apart > options.patience_distance_m) continue;
    if (found == candidates.end() || apart < distance(found->position, world)) found = it;
  }
  if (found == candidates.end()) found = candidates.insert(found, {id, world, {}, {}});
  if (distance(found->position, world) > options.patience_distance_m) {
    found->steps.clear();  // a ghost before, or now
    found->sightings.clear();
  }
  found->position = world;
  found->steps.push_back(step);
  found->sightings.push_back(sighting);
  if (static_cast<std::int64_t>(found->steps.size()) < options.patience) return std::nullopt;
  Candidate ready = std::move(*found);
  candidates.erase(found);
  if (ready.id < 0) ready.id = next_id++;
  return ready;
}

void note_fit(Memory& memory, const StepOutcome& outcome) {
  if (outcome.used > 0) memory.misfits = 0;
  if (outcome.used == 0 && outcome.refused > 0) ++memory.misfits;
}

bool has_to_be_seen(Vec2 in_robot_frame, const LandmarkSlamOptions& options) {
  constexpr double well_within = 0.9;
  return norm(in_robot_frame) < well_within * options.sensor_range_m &&
         std::abs(heading_of(in_robot_frame)) <= 0.5 * well_within * options.field_of_view_rad;
}

LandmarkSlam::LandmarkSlam(std::unique_ptr<SlamEngine> engine) : engine_(std::move(engine)) {}
LandmarkSlam::LandmarkSlam(LandmarkSlam&&) noexcept = default;
LandmarkSlam& LandmarkSlam::operator=(LandmarkSlam&&) noexcept = default;
LandmarkSlam::~LandmarkSlam() = default;

Outcome<LandmarkSlam> LandmarkSlam::begin(const LandmarkSlamOptions& options, const Pose2& start) {
  if (auto ok = check_options(options); !ok) return pass_on(ok);
  if (!finite(start)) return bad_input("the start is not finite; give x, y and heading", "start");
  return LandmarkSlam(options.engine == "graph" ? make_graph_engine(options, start)
                                                : make_filter_engine(options, start));
}

Outcome<LandmarkSlam> LandmarkSlam::load(std::string_view state) {
  StateReader reader{state, true};
  const bool head = reader.word() == state_head;
  LandmarkSlamOptions options;
  KeptOptions kept{options};
  if (head) kept.exchange(reader);
  std::unique_ptr<SlamEngine> engine;
  if (head && reader.ok && check_options(options)) {
    engine =
        options.engine == "graph" ? load_graph_engine(options, reader) : load_filter_engine(options, reader);
  }
  if (!engine || reader.word() != "end" || reader.rest != "\n") {
    return bad_input("this is no state of landmark SLAM, or a damaged one; save it again");
  }
  return LandmarkSlam(std::move(engine));
}

std::string LandmarkSlam::state() const {
  StateWriter writer;
  LandmarkSlamOptions options = engine_->options();
  KeptOptions kept{options};
  writer.text = state_head;
  writer.text += ' ';
  kept.exchange(writer);
  writer.text += '\n';
  engine_->save(writer);
  writer.text += "end\n";
  return std::move(writer.text);
}

Outcome<StepOutcome> LandmarkSlam::advance(const LogStep& step) {
  if (auto ok = outrider::check(step); !ok) return pass_on(ok);
  if (!engine_->options().unknown_ids) {
    for (const LandmarkSighting& sighting : step.sightings) {
      if (!sighting.id) return bad_input("a sighting has no id; set unknown_ids");
    }
  }
  return engine_->advance(step);
}

void LandmarkSlam::settle() { engine_->settle(); }
Pose2 LandmarkSlam::pose() const { return engine_->pose(); }
Eigen::Matrix3d LandmarkSlam::pose_covariance() const { return engine_->pose_covariance(); }
LandmarkMap LandmarkSlam::landmarks() const { return engine_->landmarks(); }
std::vector<Pose2> LandmarkSlam::trajectory() const { return engine_->trajectory(); }
double LandmarkSlam::cost() const { return engine_->cost(); }
std::int64_t LandmarkSlam::degrees_of_freedom() const { return engine_->degrees_of_freedom(); }

}  // namespace outrider
