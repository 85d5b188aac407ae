#include "mission/look.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace outrider {
namespace {

constexpr double sharp = 2.0;  ///< standard deviations that a stop needs; a tag cannot contradict more
constexpr double same_time_s = 1e-9;
constexpr double corner_memory = 30.0;  ///< number of tags over which the noise of corners is averaged
constexpr double clearly_larger =
    1.3;  ///< ratio of the estimated to the expected noise, 4 standard deviations
constexpr std::int64_t many_refusals = 10;  ///< of a tag that is doubtful
constexpr double doubtful_part = 0.2;       ///< of the images with a tag: more refusals are doubtful

/// Estimates the noise of corners from how well four corners fit a square: two degrees of freedom for each
/// tag.
void note_corners(DriveMission& mission, const std::vector<TagSighting>& sightings) {
  for (const TagSighting& sighting : sightings) {
    if (sighting.poses.empty()) continue;
    const double error_px = sighting.poses.front().error_px;  // squared: a quarter of the sum of squares
    mission.corner_variance_px2 += (2.0 * error_px * error_px - mission.corner_variance_px2) / corner_memory;
  }
}

/// Returns the options with the estimated noise of corners, if it is clearly larger than the expected noise.
LocaliseOptions adapted(const DriveMission& mission) {
  LocaliseOptions options = mission.task.localise;
  const double sigma_px = std::sqrt(mission.corner_variance_px2);
  if (sigma_px > clearly_larger * options.corner_sigma_px) options.corner_sigma_px = sigma_px;
  return options;
}

bool is_refused(TagVerdict verdict) {
  return verdict == TagVerdict::off_prior || verdict == TagVerdict::outvoted;
}

/// Forgets the suspicion against tags that explain the image together with others, and returns true if a tag
/// without suspicion explains it.
bool clear_suspects(DriveMission& mission, const std::vector<TagSighting>& sightings, const TagFix& fix) {
  std::set<int> used;
  for (std::size_t i = 0; i < sightings.size(); ++i) {
    if (fix.verdicts[i] == TagVerdict::used) used.insert(sightings[i].id);
  }
  const auto is_suspect = [&](int id) { return mission.suspects.contains(id); };
  if (std::ranges::all_of(used, is_suspect)) return false;
  for (const int id : used) mission.suspects.erase(id);
  return true;
}

/// Notes which tags explain the image and which contradict them. A tag corroborates those on which the belief
/// rests only if it could have contradicted it: the belief was sharp before, or another tag of the image
/// agrees.
void note_tags(DriveMission& mission, const std::vector<TagSighting>& sightings, const TagFix& fix,
               bool was_sharp) {
  const bool corroborates = was_sharp || std::ranges::count(fix.verdicts, TagVerdict::used) > 1;
  for (std::size_t i = 0; i < sightings.size(); ++i) {
    TagRecord& record = mission.tag_records[sightings[i].id];
    if (fix.verdicts[i] == TagVerdict::used) {
      ++record.used;
      if (!mission.support || mission.suspects.contains(sightings[i].id) || !corroborates) continue;
      mission.support->tags.insert(sightings[i].id);
      mission.support->corroborated = mission.support->tags.size() > 1;
    } else if (is_refused(fix.verdicts[i])) {
      ++record.refused;
    }
  }
}

/// A tag that may have been moved, and alone corrects a belief whose position was too wide to contradict it,
/// tells no more than one that relocalises the robot alone. (A heading that is wide does not matter: where a
/// moved tag puts the robot does not depend on it.)
void note_lone_tag(DriveMission& mission, const std::vector<TagSighting>& sightings, const TagFix& fix) {
  if (std::ranges::count(fix.verdicts, TagVerdict::used) != 1) return;
  const auto used = std::ranges::find(fix.verdicts, TagVerdict::used) - fix.verdicts.begin();
  const int id = sightings[static_cast<std::size_t>(used)].id;
  if (mission.support && mission.support->tags == std::set<int>{id}) return;
  mission.support = {mission.reckoning.time_s, {id}, false};
}

/// Returns true if the robot has not left its start, which is exact.
bool is_at_start(const DriveMission& mission) {
  constexpr double near_m = 0.02;
  return mission.arrivals.empty() && mission.relocalisations.empty() &&
         distance(mission.reckoning.belief.world_T_robot.position, mission.task.start.position) < near_m;
}

void accept(DriveMission& mission, const std::vector<TagSighting>& sightings, const TagFix& fix) {
  const bool sharp_position =
      position_sigma_m(mission.reckoning.belief) <= sharp * mission.task.rules.settle_sigma_m;
  const bool was_sharp = sharp_position && heading_sigma_rad(mission.reckoning.belief) <=
                                               sharp * mission.task.rules.settle_sigma_rad;
  const PoseBelief before = mission.reckoning.belief;
  if (mission.task.rules.tags_move && !is_at_start(mission) &&
      position_sigma_m(before) > mission.task.rules.settle_sigma_m)
    mission.wide = true;
  correct(mission.reckoning, *fix.belief);
  mission.votes.note_correction(before, mission.reckoning.belief);
  if (mission.task.rules.tags_move && !sharp_position) note_lone_tag(mission, sightings, fix);
  const bool confirms = clear_suspects(mission, sightings, fix);
  note_tags(mission, sightings, fix, was_sharp);
  ++mission.used;
  mission.tag_s = mission.image_s;
  mission.refused = 0;
  mission.relocaliser = {};
  if (!mission.stop || mission.image_s < mission.stop->counts_from_s) return;
  mission.stop->is_still = false;
  if (!is_at_rest(mission.reckoning)) return;
  if (confirms && fix.belief) mission.stop->accept(*fix.belief);
  mission.stop->compare(sightings, adapted(mission).corner_sigma_px, mission.image_s);
  if (mission.wide && mission.stop->is_still) {
    mission.votes.add(sightings, fix.verdicts, mission.reckoning.belief, mission.task.tags,
                      robot_camera(mission.task.eye), adapted(mission));
  }
}

void refuse(DriveMission& mission, const std::vector<TagSighting>& sightings) {
  const DriveTask& task = mission.task;
  ++mission.refused;
  mission.refused_s = mission.image_s;
  mission.votes = {};
  if (mission.stop) mission.stop->refuse(mission.image_s);
  if (is_at_rest(mission.reckoning))
    mission.relocaliser.add(sightings, task.tags, robot_camera(task.eye), adapted(mission));
}

/// Corrects the belief, which is that of the time of the image. Returns true if the image corrected it.
bool correct_by(DriveMission& mission, const std::vector<TagSighting>& sightings) {
  note_corners(mission, sightings);
  const DriveTask& task = mission.task;
  const TagFix fix =
      localise(sightings, task.tags, robot_camera(task.eye), mission.reckoning.belief, adapted(mission));
  if (fix.belief) {
    accept(mission, sightings, fix);
    return true;
  }
  if (std::ranges::any_of(fix.verdicts, is_refused)) refuse(mission, sightings);
  return false;
}

}  // namespace

bool look(DriveMission& mission, const Observation& seen) {
  if (!seen.image) return false;
  const DriveTask& task = mission.task;
  const auto& [taken_s, sightings] = *seen.image;
  const double most_age_s = task.eye.latency_s + 0.5 * task.rules.period_s;
  const bool fresh = seen.time_s - taken_s <= most_age_s + same_time_s;
  if (!fresh || taken_s <= mission.image_s) return false;
  mission.image_s = taken_s;
  ++mission.images;
  if (sightings.empty()) return false;
  std::vector<double> repeated_s;
  const bool late = taken_s < mission.reckoning.time_s - same_time_s;
  if (late) {
    auto then = mission.history.rewind(taken_s, repeated_s);
    if (!then) return false;
    mission.reckoning = std::move(*then);
  }
  advance(mission.reckoning, taken_s, task.reckoning, task.chassis);
  const bool accepted = correct_by(mission, sightings);
  if (late) mission.history.states.push_back(mission.reckoning);
  for (const double time_s : repeated_s) {
    advance(mission.reckoning, time_s, task.reckoning, task.chassis);
    mission.history.states.push_back(mission.reckoning);
  }
  return accepted;
}

std::optional<std::set<int>> indispensable_tags(const DriveMission& mission, double part) {
  const double most_m = part * (tolerance_m(mission.task) - mission.task.follow.within_m);
  std::optional<std::set<int>> common;
  const Vec2 believed = mission.reckoning.belief.world_T_robot.position;
  for (const std::set<int>& ids : mission.votes.agreeing(believed, most_m)) {
    if (std::ranges::any_of(ids, [&](int id) { return mission.suspects.contains(id); })) continue;
    if (!common) common = ids;
    std::erase_if(*common, [&](int id) { return !ids.contains(id); });
  }
  return common;
}

bool is_corroborated(const DriveMission& mission, double part) {
  if (!is_trusted(mission) || !mission.wide) return is_trusted(mission);
  const auto needed = indispensable_tags(mission, part);
  return needed && needed->empty();
}

const TagSupport* lone_support(const DriveMission& mission) {
  return mission.support && !mission.support->corroborated ? &*mission.support : nullptr;
}

bool is_trusted(const DriveMission& mission) { return lone_support(mission) == nullptr; }

void begin_leg_anew(DriveMission& mission) {
  const std::size_t next = mission.follower.next;
  mission.follower = {};
  mission.follower.next = next;
  mission.follower.from = mission.reckoning.belief.world_T_robot;
}

bool relocalise(DriveMission& mission) {
  const Relocaliser& found = mission.relocaliser;
  if (!found.pose || found.images < mission.task.rules.relocalise) return false;
  PoseBelief belief = *found.pose;  // the images share the errors of where the tags hang
  const double tag_sigma_m = mission.task.localise.tag_sigma_m;
  belief.covariance.diagonal().head<2>().array() += tag_sigma_m * tag_sigma_m;
  if (const TagSupport* const lone = lone_support(mission)) {
    const int alone = *lone->tags.begin();
    if (!found.tags.contains(alone)) mission.suspects.insert(alone);
  }
  if (mission.used == 0) mission.start_contradicted = true;
  relocate(mission.reckoning, belief);
  mission.history.clear();
  mission.relocalisations.push_back({mission.reckoning.time_s, belief, found.tags});
  mission.support = {mission.reckoning.time_s, found.tags, found.tags.size() > 1};
  mission.relocaliser = {};
  mission.refused = 0;
  mission.stop.reset();
  mission.look_round.reset();
  mission.votes = {};
  begin_leg_anew(mission);
  return true;
}

std::string tag_doubt(const DriveMission& mission) {
  for (const auto& [id, record] : mission.tag_records) {
    const auto all = static_cast<double>(record.used + record.refused);
    if (record.refused < many_refusals || static_cast<double>(record.refused) <= doubtful_part * all)
      continue;
    return fmt::format(
        "tag {} was not where the map says in {} of {} images that other tags explain; does it hang "
        "elsewhere?",
        id, record.refused, record.used + record.refused);
  }
  return {};
}

}  // namespace outrider
