#include "outrider/estimate/localise.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "floor_fit.hpp"
#include "outrider/estimate/planar_pnp.hpp"
#include "symmetric_solve.hpp"

namespace outrider {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// x, y and heading with their covariance.
struct Place {
  Vector3d mean;
  Matrix3d covariance;
};

Place place_of(const PoseBelief& belief) {
  const Pose2& pose = belief.world_T_robot;
  return {{pose.position.x, pose.position.y, pose.heading_rad}, belief.covariance};
}

PoseBelief belief_of(const Place& place) {
  return {{{place.mean.x(), place.mean.y()}, wrap_angle(place.mean.z())},
          0.5 * (place.covariance + place.covariance.transpose())};
}

Vector3d difference(const Vector3d& a, const Vector3d& b) {
  Vector3d d = a - b;
  d.z() = wrap_angle(d.z());
  return d;
}

double squared_distance(const Vector3d& d, const Matrix3d& covariance) {
  return d.dot(solve_symmetric(covariance, d));
}

/// Returns the squared Mahalanobis distance between two places.
double disagreement(const Place& a, const Place& b) {
  return squared_distance(difference(a.mean, b.mean), a.covariance + b.covariance);
}

struct Frame {
  Matrix3d rotation;
  Vector3d position;
};
Frame frame_of(const Pose3& pose) { return {to_eigen(pose.rotation), to_eigen(pose.position)}; }

/// The pose of the robot from one solution, conditioned on standing upright on the floor z = 0.
struct Candidate {
  std::size_t sighting = 0;
  Place place;
  double floor_misfit = 0.0;  ///< chi-squared of height, roll and pitch
  double cost = 0.0;          ///< chi-squared of the corners, the floor and the prior
};

/// Returns the frame of the robot in the world that follows from a solution.
Frame robot_by(const TagPose& solution, const Tag& tag, const Pose3& robot_T_camera) {
  const Frame robot_T_tag = frame_of(robot_T_camera * solution.camera_T_tag);
  const Frame world_T_tag = frame_of(tag.world_T_tag);
  const Matrix3d rotation = world_T_tag.rotation * robot_T_tag.rotation.transpose();
  return {rotation, world_T_tag.position - rotation * robot_T_tag.position};
}

/// Returns the covariance of the position and the rotation vector of the robot, along the world axes. To
/// first order: position = world_tag - R robot_tag, and R changes by minus the rotation of the tag in the
/// robot frame.
Matrix6d propagate(const TagPose& solution, const Frame& robot, const Pose3& robot_T_camera,
                   const LocaliseOptions& options) {
  // Solutions come with the covariance of corners as good as planar_pnp() expects them.
  const double noise = std::max(1.0, options.corner_sigma_px / PlanarPnpOptions{}.corner_sigma_px);
  const Matrix3d turn = robot.rotation * to_eigen(robot_T_camera.rotation);  // from camera axes to world axes
  const Vector3d to_tag = robot.rotation * to_eigen((robot_T_camera * solution.camera_T_tag).position);
  Matrix6d by_error = Matrix6d::Zero();
  by_error.topLeftCorner<3, 3>() = -turn;
  by_error.topRightCorner<3, 3>() = -skew(to_tag) * turn;
  by_error.bottomRightCorner<3, 3>() = -turn;
  Matrix6d covariance = noise * noise * by_error * solution.covariance * by_error.transpose();
  covariance.topLeftCorner<3, 3>().diagonal().array() += options.tag_sigma_m * options.tag_sigma_m;
  return covariance;
}

/// Computes the pose from a solution and conditions it on a robot that stands upright on the floor.
Candidate on_floor(const TagPose& solution, const Tag& tag, const Pose3& robot_T_camera,
                   const LocaliseOptions& options) {
  const Frame robot = robot_by(solution, tag, robot_T_camera);
  const Matrix6d all = propagate(solution, robot, robot_T_camera, options);
  const Vector3d up = robot.rotation.col(2), ahead = robot.rotation.col(0);
  const double sine = std::hypot(up.x(), up.y());
  const double per_sine = sine > 0.0 ? std::atan2(sine, up.z()) / sine : 1.0;
  const Vector3d lean(robot.position.z(), -up.y() * per_sine, up.x() * per_sine);

  constexpr std::array<int, 3> kept{0, 1, 5}, told{2, 3, 4};
  const double tilt = options.floor_sigma_rad * options.floor_sigma_rad;
  const Matrix3d innovation =
      all(told, told) +
      Matrix3d(Vector3d(options.floor_sigma_m * options.floor_sigma_m, tilt, tilt).asDiagonal());
  const Matrix3d gain = all(kept, told) * inverse_of_symmetric(innovation);
  const Vector3d mean(robot.position.x(), robot.position.y(), std::atan2(ahead.y(), ahead.x()));
  Candidate candidate;
  candidate.place = {mean - gain * lean, all(kept, kept) - gain * all(told, kept)};
  candidate.floor_misfit = squared_distance(lean, innovation);
  const double corners = solution.error_px / options.corner_sigma_px;
  candidate.cost = candidate.floor_misfit + 4.0 * corners * corners;
  return candidate;
}

/// Returns the candidates that fit, and sets the verdict of each sighting that has none.
std::vector<Candidate> candidates_of(std::span<const TagSighting> sightings, const TagMap& map,
                                     const Pose3& robot_T_camera, const std::optional<PoseBelief>& prior,
                                     const LocaliseOptions& options, std::vector<TagVerdict>& verdicts) {
  const double gate = options.gate * most_plausible_distance;
  std::vector<Candidate> fitting;
  for (std::size_t i = 0; i < sightings.size(); ++i) {
    const Tag* tag = map.find(sightings[i].id);
    verdicts.push_back(tag == nullptr ? TagVerdict::unknown_id : TagVerdict::off_floor);
    if (tag == nullptr) continue;
    for (const TagPose& solution : sightings[i].poses) {
      Candidate candidate = on_floor(solution, *tag, robot_T_camera, options);
      candidate.sighting = i;
      if (!(candidate.floor_misfit <= gate)) continue;
      const double off_prior = prior ? disagreement(candidate.place, place_of(*prior)) : 0.0;
      candidate.cost += off_prior;
      if (verdicts[i] == TagVerdict::off_floor) verdicts[i] = TagVerdict::off_prior;
      if (!(off_prior <= gate)) continue;
      verdicts[i] = TagVerdict::outvoted;
      fitting.push_back(candidate);
    }
  }
  return fitting;
}

/// A set of solutions that agree with one of them, the centre; at most one for each tag.
struct Agreement {
  std::size_t centre = 0;
  std::vector<std::size_t> members;  ///< indices of candidates
  double cost = std::numeric_limits<double>::infinity();
};

Agreement agreement_with(std::size_t centre, const std::vector<Candidate>& all, std::size_t sightings,
                         double gate) {
  constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
  std::vector<std::size_t> chosen(sightings, none);
  std::vector<double> costs(sightings, std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < all.size(); ++i) {
    const std::size_t sighting = all[i].sighting;
    if (sighting == all[centre].sighting && i != centre) continue;
    const double apart = i == centre ? 0.0 : disagreement(all[centre].place, all[i].place);
    if (!(apart <= gate) || apart + all[i].cost >= costs[sighting]) continue;
    chosen[sighting] = i;
    costs[sighting] = apart + all[i].cost;
  }
  Agreement agreement{centre, {}, 0.0};
  for (std::size_t s = 0; s < sightings; ++s) {
    if (chosen[s] == none) continue;
    agreement.members.push_back(chosen[s]);
    agreement.cost += costs[s];
  }
  return agreement;
}

Place fuse(const Place& a, const Place& b) {
  const Matrix3d gain = a.covariance * inverse_of_symmetric(Matrix3d(a.covariance + b.covariance));
  return {a.mean + gain * difference(b.mean, a.mean), a.covariance - gain * a.covariance};
}

Place fuse(const Agreement& agreement, const std::vector<Candidate>& all) {
  Place place = all[agreement.members.front()].place;
  for (std::size_t i = 1; i < agreement.members.size(); ++i) {
    place = fuse(place, all[agreement.members[i]].place);
  }
  return place;
}

bool is_better(const Agreement& a, const Agreement& b) {
  if (a.members.size() != b.members.size()) return a.members.size() > b.members.size();
  return a.cost < b.cost;
}

}  // namespace

std::vector<Option> describe(LocaliseOptions& options) {
  return {
      {"floor_sigma", "m", 1e-6, 10, "standard deviation of the robot's height above the floor",
       &options.floor_sigma_m},
      {"floor_sigma_tilt", "deg", 1e-4, 45, "standard deviation of its roll and of its pitch",
       &options.floor_sigma_rad},
      {"tag_sigma", "m", 0, 10, "standard deviation of where a tag hangs, along each axis",
       &options.tag_sigma_m},
      {"gate", "", 0.01, 1e6, "widens what still fits", &options.gate},
      {"ambiguity", "", 0, 1e6, "by which one place must beat another, as chi-squared", &options.ambiguity},
      {"corner_sigma", "px", 0.01, 100, "expected error of a corner along each axis",
       &options.corner_sigma_px}};
}

std::string_view to_string(TagVerdict verdict) {
  switch (verdict) {
    case TagVerdict::used: return "used";
    case TagVerdict::unknown_id: return "unknown_id";
    case TagVerdict::off_floor: return "off_floor";
    case TagVerdict::off_prior: return "off_prior";
    case TagVerdict::outvoted: return "outvoted";
    case TagVerdict::ambiguous: break;
  }
  return "ambiguous";
}

TagFix localise(std::span<const TagSighting> sightings, const TagMap& map, const RobotCamera& robot_camera,
                const std::optional<PoseBelief>& prior, const LocaliseOptions& options) {
  TagFix fix;
  const auto all = candidates_of(sightings, map, robot_camera.robot_T_camera, prior, options, fix.verdicts);
  if (all.empty()) return fix;

  const double gate = options.gate * most_plausible_distance;
  std::vector<Agreement> agreements;
  for (std::size_t i = 0; i < all.size(); ++i) {
    agreements.push_back(agreement_with(i, all, sightings.size(), gate));
  }
  const Agreement best = *std::ranges::min_element(agreements, is_better);
  const Place place = fuse(best, all);
  const bool contested = std::ranges::any_of(agreements, [&](const Agreement& other) {
    return other.members.size() == best.members.size() && other.cost < best.cost + options.ambiguity &&
           disagreement(all[other.centre].place, place) > gate;
  });
  for (const std::size_t member : best.members) {
    fix.verdicts[all[member].sighting] = contested ? TagVerdict::ambiguous : TagVerdict::used;
  }
  if (!contested) {
    std::vector<TagView> views;
    for (const std::size_t member : best.members) {
      const TagSighting& sighting = sightings[all[member].sighting];
      views.push_back({map.find(sighting.id), sighting.corners_px});
    }
    const PoseBelief start = belief_of(place);
    const auto expected = prior ? std::optional(prior->world_T_robot) : std::nullopt;
    fix.belief = fit_on_floor(start.world_T_robot, views, robot_camera, options, expected).value_or(start);
  }
  return fix;
}

PoseBelief fuse(const PoseBelief& a, const PoseBelief& b) {
  return belief_of(fuse(place_of(a), place_of(b)));
}

double squared_mahalanobis(const PoseBelief& a, const PoseBelief& b) {
  return disagreement(place_of(a), place_of(b));
}

}  // namespace outrider
