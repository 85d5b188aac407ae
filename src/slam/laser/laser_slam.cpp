#include "outrider/slam/laser/laser_slam.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "algebra/small_cholesky.hpp"
#include "laser/laser_loops.hpp"
#include "laser/local_map.hpp"
#include "laser/odometry_bias.hpp"
#include "map/path_check.hpp"
#include "map/wall_crossings.hpp"
#include "motion_noise.hpp"
#include "scan/scan_agreement.hpp"
#include "scan/scan_match.hpp"

namespace outrider {
namespace {

constexpr double most_contradiction = 0.2;  // share of points; with more, odometry is wrong

bool in_the_world(const Pose2& pose) {
  constexpr double most = 1e6;
  return std::abs(pose.position.x) <= most && std::abs(pose.position.y) <= most &&
         std::abs(pose.heading_rad) <= most;
}

struct TrackPoint {
  std::uint32_t key = 0;
  Pose2 key_T_robot;
};

/// A keyframe that matched nothing.
struct Gap {
  std::uint32_t keyframe = 0;
  std::size_t part_before = 0;
  bool is_lost = false;  ///< else the robot is where odometry says, but sees nothing that it knows
};

}  // namespace

struct LaserSlam::State {
  LaserSlamOptions options;
  Pose2 pose;
  OccupancyMap map;
  KeyframeGraph graph;
  LoopSearch loops;
  std::vector<Pose2> before_keyframes;  ///< the track before the first keyframe, or of trusted odometry
  std::vector<TrackPoint> track;        ///< the track after that
  std::vector<Pose2> drawn;             ///< poses of the keyframes in the map as drawn
  LocalMap local;
  std::size_t part = 0;   ///< the first keyframe since the robot was last lost
  std::vector<Gap> gaps;  ///< keyframes that odometry alone joins to the ones before
  OdometryBias bias;
  BackOff wide;        ///< of searches for scans that match nothing nearby
  Driven unmatched;    ///< since the last match
  Driven unkept;       ///< since the last keyframe
  Pose2 moved;         ///< motion since the last keyframe, by odometry
  Pose2 counted;       ///< the same without what was learned of its errors
  bool blind = false;  ///< the last scan had too few points
  std::optional<double> last_scan_s;
  double pause_s = 0.0;  ///< longest time between two scans since the last keyframe

  State(const LaserSlamOptions& given, const Pose2& start)
      : options(given),
        pose(start),
        map(given.map),
        before_keyframes{start},
        local(given.robot_T_laser, given.reach_m) {}

  [[nodiscard]] Pose2 since_keyframe() const {
    return wrap_heading(relative_pose(graph.keyframes.back().pose, pose));
  }
  void move(const Pose2& motion);
  [[nodiscard]] double contradiction(const LaserScan& scan, const Pose2& at) const;
  bool close_loops();
  bool bridge_gap();
  void take_scan(const LaserScan& scan, const Surface& surface, LaserSlamStep& step);
  void learn(const Fit& fit);
  [[nodiscard]] bool is_keyframe_due() const;
  void add_keyframe(const LaserScan& scan, const std::optional<Fit>& fit, bool is_carried);
  void build_local_map() { local.build(graph, part, pose); }
  [[nodiscard]] bool stands_as_drawn() const;
  MapUpdate redraw();
  void add_track_point();
  [[nodiscard]] std::vector<std::size_t> pose_numbers() const;
};

std::vector<Option> describe(LaserSlamOptions& o) {
  return {
      {"trust_odometry", "", 0, 0, "map from the poses of the odometry, without matching scans",
       &o.trust_odometry},
      {"draw_late", "", 0, 0, "draw the map at the end only", &o.draw_late},
      {"close_loops", "", 0, 0, "recognise places that come again", &o.close_loops},
      {"loop_reach", "", 0.01, 100,
       "how far from where it believes that they are, in standard deviations of its pose", &o.loop_reach_sd},
      {"learn_odometry", "", 0, 0, "learn from the scans what odometry always counts wrong",
       &o.learn_odometry},
      {"reach", "m", 0.5, 200, "how far readings are matched", &o.reach_m},
      {"key_distance", "m", 0.01, 100, "way after which a scan is kept", &o.key_distance_m},
      {"key_turn", "deg", 0.1, 360, "turn after which a scan is kept", &o.key_turn_rad},
      {"odometry_distance", "", 0.001, 10, "m of error of odometry in the root of a metre driven",
       &o.odometry_distance},
      {"odometry_turn", "", 0.001, 10, "rad of error in the root of a radian turned", &o.odometry_turn},
      {"odometry_turn_per_distance", "deg", 0.01, 360, "error of its heading in the root of a metre driven",
       &o.odometry_turn_per_distance_rad},
      {"odometry_rest", "m", 1e-4, 10, "error of each step besides", &o.odometry_rest_m},
      {"odometry_rest_turn", "deg", 1e-3, 360, "and of its heading", &o.odometry_rest_rad},
      {"laser_x", "m", -100, 100, "where the laser stands on the robot, ahead", &o.robot_T_laser.position.x},
      {"laser_y", "m", -100, 100, "and to the left", &o.robot_T_laser.position.y},
      {"laser_heading", "deg", -180, 180, "and how it is turned", &o.robot_T_laser.heading_rad}};
}

Outcome<LaserSlam> LaserSlam::begin(const LaserSlamOptions& options, const Pose2& start) {
  if (!in_the_world(start)) return bad_input("the start is not finite; give x, y and heading", "start");
  LaserSlamOptions held = options;
  if (auto ok = check_ranges(describe(held)); !ok) return pass_on(ok);
  if (auto ok = check_ranges(describe(held.map)); !ok) return pass_on(ok);
  if (auto ok = outrider::check(options.map); !ok) return pass_on(ok);
  return LaserSlam(std::make_unique<State>(options, start));
}

LaserSlam::LaserSlam(std::unique_ptr<State> state) : state_(std::move(state)) {}
LaserSlam::LaserSlam(LaserSlam&&) noexcept = default;
LaserSlam& LaserSlam::operator=(LaserSlam&&) noexcept = default;
LaserSlam::~LaserSlam() = default;

/// Returns the share of the points that one of the two looked through, of a scan at that pose and the one of
/// the last keyframe; 0 if they share too few.
double LaserSlam::State::contradiction(const LaserScan& scan, const Pose2& at) const {
  constexpr std::size_t least_points = 40;
  if (graph.keyframes.size() <= part) return 0.0;
  const Keyframe& last = graph.keyframes.back();
  const Agreement pair = mutual_agreement(scan, compose(at, options.robot_T_laser), last.scan,
                                          compose(last.pose, options.robot_T_laser));
  return pair.seen() >= least_points ? pair.contradiction() : 0.0;
}

/// Closes loops with the keyframes since the robot was last lost, if nothing spans that gap.
bool LaserSlam::State::close_loops() {
  const auto lost = std::ranges::find_if(gaps.rbegin(), gaps.rend(), &Gap::is_lost);
  const bool is_open = lost != gaps.rend() && !loops.spans(lost->keyframe);
  return loops.close(graph, local.surfaces(), options.loop_reach_sd, is_open ? lost->keyframe : 0);
}

/// Joins the last keyframes with those before the last gap if nothing spans it: with the last ones while the
/// gap is recent, with any later. Returns true if this moved the poses.
bool LaserSlam::State::bridge_gap() {
  constexpr std::size_t most_keyframes = 8;
  if (gaps.empty() || loops.spans(gaps.back().keyframe)) return false;
  const Gap& gap = gaps.back();
  const bool is_recent = graph.keyframes.size() - gap.keyframe <= most_keyframes;
  const double reach_sd = options.loop_reach_sd;
  if (!(is_recent ? loops.bridge(graph, local.surfaces(), reach_sd, gap.keyframe)
                  : options.close_loops && loops.rejoin(graph, local.surfaces(), reach_sd, gap.keyframe)))
    return false;
  part = gap.part_before;
  return true;
}

bool LaserSlam::State::is_keyframe_due() const {
  if (graph.keyframes.empty()) return true;
  const Pose2 motion = since_keyframe();
  return norm(motion.position) >= options.key_distance_m ||
         std::abs(motion.heading_rad) >= options.key_turn_rad;
}

/// Adds a keyframe with a constraint to the one before, and to an earlier visit if it was matched with one.
void LaserSlam::State::add_keyframe(const LaserScan& scan, const std::optional<Fit>& fit, bool is_carried) {
  constexpr MotionNoise unmatched_noise{0.3, 0.3};  // regardless of the stated odometry noise
  constexpr MotionNoise adrift{3.0, 1.0};
  constexpr MotionNoise loose{0.1, 0.1};
  constexpr double least_share = 0.5;
  const auto key = static_cast<std::uint32_t>(graph.keyframes.size());
  const Pose2 motion = key == 0 ? Pose2{} : since_keyframe();
  const double way_m = key == 0 ? 0.0 : graph.keyframes.back().way_m + norm(motion.position);
  const MotionNoise driven = odometry_noise(unkept, options);
  graph.keyframes.push_back({pose, way_m, scan, moved, driven, pause_s});
  graph.keyframes.back().counted = counted;
  moved = counted = {};
  pause_s = 0.0;
  if (key == 0) return;
  graph.keyframes.back().shared_before = shared_surface(graph, local.surfaces(), key - 1, key);
  const MotionNoise& least = is_carried ? adrift : unmatched_noise;
  const MotionNoise noise{std::max(least.position_m, driven.position_m),
                          std::max(least.heading_rad, driven.heading_rad)};
  graph.add_constraint(key - 1, key, pose,
                       fit     ? Eigen::Matrix3d(fit->information + driven.information())
                       : blind ? driven.information()
                               : noise.information());
  if (fit) {
    graph.share_last_constraint(fit->information, local.matched(graph, part));
    graph.last_constraint().certainty = fit->certainty();
  }
  unkept = {};
  if (!fit || !local.anchor()) return;
  const Fit visit = local.map()->refine(local.surfaces().of(graph, key), pose, {pose, loose.information()},
                                        LocalMap::earlier_group);
  if (visit.share >= least_share) {
    graph.add_constraint(*local.anchor(), key, visit.pose, visit.information + Eigen::Matrix3d::Identity());
    graph.last_constraint().certainty = visit.certainty();
    graph.last_constraint().is_known_place = local.is_crowded();
  }
}

/// Returns true if no keyframe, and no point 2 m away from it, has moved by a cell since it was drawn.
bool LaserSlam::State::stands_as_drawn() const {
  constexpr double lever_m = 2.0;
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    const Pose2& now = graph.keyframes[i].pose;
    const double moved_m = distance(drawn[i].position, now.position) +
                           lever_m * std::abs(drawn[i].heading_rad - now.heading_rad);
    if (moved_m > options.map.resolution_m) return false;
  }
  return true;
}

MapUpdate LaserSlam::State::redraw() {
  map = OccupancyMap(options.map);
  for (const Keyframe& key : graph.keyframes) {
    if (key.has_scan()) map.insert(wrap_heading(compose(key.pose, options.robot_T_laser)), key.scan);
  }
  drawn = graph.poses();
  return {true, {}};
}

void LaserSlam::State::add_track_point() {
  if (graph.keyframes.empty()) {
    before_keyframes.push_back(pose);
  } else {
    track.push_back({static_cast<std::uint32_t>(graph.keyframes.size() - 1),
                     relative_pose(graph.keyframes.back().pose, pose)});
  }
}

/// Returns the number of the pose of each keyframe: the first one that is attached to it.
std::vector<std::size_t> LaserSlam::State::pose_numbers() const {
  std::vector<std::size_t> numbers;
  for (std::size_t i = 0; i < track.size(); ++i) {
    if (track[i].key == numbers.size()) numbers.push_back(before_keyframes.size() + i);
  }
  return numbers;
}

/// Moves the robot by odometry, corrected for its known systematic errors.
void LaserSlam::State::move(const Pose2& motion) {
  bias.count(motion);
  const Pose2 corrected = options.learn_odometry ? bias.corrected(motion) : motion;
  pose = wrap_heading(compose(pose, corrected));
  moved = wrap_heading(compose(moved, corrected));
  counted = wrap_heading(compose(counted, motion));
  unmatched += motion;
  unkept += motion;
}

/// Updates the estimate of odometry errors with the motion since the last keyframe.
void LaserSlam::State::learn(const Fit& fit) {
  constexpr double nothing = 1e-3;
  const SmallCholesky<3> factor(fit.information + nothing * Eigen::Matrix3d::Identity());
  const MotionNoise noise = odometry_noise(unkept, options);
  if (!factor.is_positive()) return;
  bias.learn(pose, factor.inverse(), noise.position_m * noise.position_m,
             noise.heading_rad * noise.heading_rad);
}

/// Corrects the pose with a scan, and makes the scan a keyframe if one is due. A robot that may be in several
/// places and is recognised in none is lost: the scan becomes the first keyframe of a new part of the map.
/// Only this part is used to match the next scans, and only odometry joins it to the part before.
void LaserSlam::State::take_scan(const LaserScan& scan, const Surface& surface, LaserSlamStep& step) {
  if (blind && local.map() != nullptr) build_local_map();
  const MatchWindow about = odometry_window(pose, unmatched, options);
  const bool begun = local.map() != nullptr;
  const auto contradicted = [&](const Pose2& at) { return contradiction(scan, at); };
  const auto fit = begun ? match_scan(*local.map(), surface, about, contradicted, wide) : std::nullopt;
  step.matched = fit.has_value();
  const bool is_carried = begun && !fit && contradiction(scan, pose) > most_contradiction;
  step.lost = begun && !fit && (about.reach_m > most_correction_m || is_carried);
  if (fit) pose = fit->pose;
  if (!fit) bias.forget();
  if (fit || step.lost) unmatched = {};
  if (step.lost || is_keyframe_due()) {
    if (begun && !fit) gaps.push_back({static_cast<std::uint32_t>(graph.keyframes.size()), part, step.lost});
    if (step.lost) part = graph.keyframes.size();
    if (fit) learn(*fit);
    add_keyframe(scan, fit, is_carried);
    graph.update_covariance();
    step.kept = true;
    step.closed_loop = options.close_loops && close_loops();
    step.undid_loop = loops.review(graph, options.robot_T_laser);
    step.closed_loop = step.closed_loop || step.undid_loop;
    if (bridge_gap()) {
      graph.update_covariance();
      step.closed_loop = true;
    }
    pose = graph.keyframes.back().pose;
    build_local_map();
    step.is_known_place = local.is_crowded();
    if (!options.draw_late) drawn.push_back(pose);
  }
  blind = false;
}

Outcome<LaserSlamStep> LaserSlam::advance(const Pose2& motion, const LaserScan& scan) {
  State& s = *state_;
  if (!in_the_world(motion) || !in_the_world(wrap_heading(compose(s.pose, motion)))) {
    return bad_input("the motion is not finite or leads out of the world; leave it out");
  }
  LaserSlamStep step;
  if (s.last_scan_s) s.pause_s = std::max(s.pause_s, scan.time_s - *s.last_scan_s);
  s.last_scan_s = scan.time_s;
  if (s.options.trust_odometry) {
    s.pose = wrap_heading(compose(s.pose, motion));
  } else {
    s.move(motion);
    Surface surface;
    if (outrider::check(scan)) surface = surface_of(scan, s.options.robot_T_laser, s.options.reach_m);
    constexpr std::size_t least_points = 10;
    if (surface.size() >= least_points) {
      s.take_scan(scan, surface, step);
    } else {
      s.blind = true;
      s.bias.forget();
    }
  }
  s.add_track_point();
  step.pose = s.pose;
  if (step.closed_loop && !s.stands_as_drawn()) {
    step.update = s.redraw();
  } else if (!s.options.draw_late) {
    step.update = s.map.insert(wrap_heading(compose(s.pose, s.options.robot_T_laser)), scan);
  }
  return step;
}

void LaserSlam::settle() {
  State& s = *state_;
  if (s.graph.keyframes.empty()) return;
  s.graph.optimise();
  s.redraw();
  s.pose = wrap_heading(compose(s.graph.keyframes[s.track.back().key].pose, s.track.back().key_T_robot));
}

const Pose2& LaserSlam::pose() const { return state_->pose; }
Eigen::Matrix3d LaserSlam::pose_covariance() const { return state_->graph.covariance(); }
const OccupancyMap& LaserSlam::map() const { return state_->map; }
PoseGraph LaserSlam::pose_graph() const {
  const std::vector<std::size_t> pose_of = state_->pose_numbers();
  PoseGraph graph = state_->graph.pose_graph();
  for (std::size_t i = 0; i < pose_of.size(); ++i) graph.nodes[i].name = std::to_string(pose_of[i] - 1);
  return graph;
}
std::size_t LaserSlam::loops() const { return state_->loops.closed.size(); }
std::vector<PlacedScan> LaserSlam::placed_scans() const {
  const std::vector<std::size_t> pose_of = state_->pose_numbers();
  std::vector<PlacedScan> scans;
  for (std::size_t i = 0; i < pose_of.size(); ++i) {
    const Keyframe& key = state_->graph.keyframes[i];
    if (!key.has_scan()) continue;
    scans.push_back({&key.scan, compose(key.pose, state_->options.robot_T_laser), key.way_m, pose_of[i]});
  }
  return scans;
}
RangeCheck LaserSlam::check_range_finder() const {
  return outrider::check_range_finder(placed_scans(), state_->options.reach_m);
}
OdometryRatio LaserSlam::odometry_ratio() const {
  const std::vector<Keyframe>& keyframes = state_->graph.keyframes;
  std::vector<CountedStep> steps;
  for (std::size_t i = 1; i < keyframes.size(); ++i) {
    const Pose2 by_map = relative_pose(keyframes[i - 1].pose, keyframes[i].pose);
    steps.push_back({keyframes[i].counted, wrap_heading(by_map)});
  }
  return compare_with_odometry(steps);
}
MapCheck LaserSlam::check() const {
  const std::vector<std::size_t> pose_of = state_->pose_numbers();
  const std::vector<PlacedScan> scans = placed_scans();
  MapCheck result = check_map(scans);
  KeyframeSurfaces surfaces(state_->options.robot_T_laser, state_->options.reach_m);
  result.jumps = find_jumps(state_->graph, surfaces);
  for (Jump& jump : result.jumps) {
    jump.before = pose_of[jump.before];
    jump.after = pose_of[jump.after];
  }
  result.crossings = wall_crossings(trajectory(), state_->map.occupancy(), scans);
  return result;
}
std::vector<std::size_t> LaserSlam::gaps() const {
  const std::vector<std::size_t> pose_of = state_->pose_numbers();
  std::vector<std::uint32_t> keyframes;
  for (const Gap& gap : state_->gaps) keyframes.push_back(gap.keyframe);
  std::vector<std::size_t> open;
  for (const std::uint32_t gap : state_->loops.open_gaps(keyframes)) open.push_back(pose_of[gap]);
  return open;
}
std::size_t LaserSlam::loops_refused() const { return state_->loops.refused; }
std::size_t LaserSlam::loops_undone() const { return state_->loops.undone.size(); }
std::vector<LaserLoop> LaserSlam::closed_loops() const {
  const std::vector<std::size_t> pose_of = state_->pose_numbers();
  std::vector<LaserLoop> result;
  for (const auto& [from, to] : state_->loops.closed) result.push_back({pose_of[from], pose_of[to]});
  return result;
}
std::vector<Pose2> LaserSlam::trajectory() const {
  std::vector<Pose2> poses = state_->before_keyframes;
  poses.reserve(poses.size() + state_->track.size());
  for (const TrackPoint& point : state_->track) {
    poses.push_back(wrap_heading(compose(state_->graph.keyframes[point.key].pose, point.key_T_robot)));
  }
  return poses;
}

}  // namespace outrider
