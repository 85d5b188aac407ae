#include "outrider/jobs/cover/mission/recovery.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ranges>
#include <utility>

#include "ground/free_room.hpp"
#include "mission/felt_posts.hpp"
#include "mission/way_back.hpp"
#include "outrider/core/units.hpp"
#include "outrider/path/pieces.hpp"

namespace outrider {
namespace {

constexpr double reached =
    0.01;  ///< of the robot's radius: the largest distance from a place that is reached
constexpr double wait_s = 10.0;
constexpr int most_stalls = 6;
constexpr std::size_t most_touches = 100;
constexpr std::size_t most_hold_ups = 10'000;
constexpr double aside_rad = radians(5.0);  ///< that a robot with a turning radius may look beside a piece
constexpr int lap_arcs = 12;                ///< of a lap around a post
constexpr int leave_ways = 16;              ///< directions in which it leaves what it touches
constexpr int off_steps = 9;        ///< each half as far again: how far it goes to leave what it touches
constexpr double clip_step = 0.02;  ///< of the distance from a post: between points that are looked at
constexpr double same_place_m = 1e-6;
constexpr double least_motion = 1e-3;  ///< of the robot's radius: less is no motion

}  // namespace

struct CoverRecovery::Parts {
  std::shared_ptr<const PolygonGround> map;     ///< without what was felt
  std::shared_ptr<const PolygonGround> ground;  ///< with it
  cover::FeltPosts posts;
  cover::WayBack ways;
};

CoverRecovery::CoverRecovery(const CoverTrack& track, const CoverProblem& problem,
                             const std::shared_ptr<const PolygonGround>& ground, const Budget& budget)
    : problem_(problem),
      tolerance_m_(problem.tracking_error_m + reached * problem.body_radius_m()),
      parts_(new Parts{ground, ground, {problem.radius_m(), tolerance_m_}, {problem, budget}}),
      heading_rad_(track.start.heading_rad),
      track_pieces_(track.pieces.size()),
      end_(track.start.position) {
  for (std::size_t i = 0; i < track.pieces.size(); ++i) tasks_.push_back({track.pieces[i], i});
}

CoverRecovery::CoverRecovery(CoverRecovery&&) noexcept = default;
CoverRecovery::~CoverRecovery() = default;

bool CoverRecovery::believes_complete() const {
  return !gave_up && tasks_.empty() && left_out_.empty() && strayed_m <= tolerance_m_;
}

double CoverRecovery::driven_part() const {
  if (looked_again_ || track_pieces_ == 0) return 1.0;
  const auto next = std::ranges::find_if(tasks_, [](const Task& task) { return task.index != off_track; });
  const std::size_t done = next == tasks_.end() ? track_pieces_ : next->index;
  return static_cast<double>(done) / static_cast<double>(track_pieces_);
}

double CoverRecovery::left_out_m() const {
  double sum_m = 0.0;
  const auto add = [&](const Task& task) {
    if (task.index != off_track) sum_m += length_of(task.piece);
  };
  std::ranges::for_each(left_out_, add);
  std::ranges::for_each(tasks_, add);
  return sum_m;
}

std::optional<Command> CoverRecovery::step(const Observation& seen) {
  if (current_) {
    const Task task = *current_;
    current_.reset();
    judge(task, seen);
  }
  if (wait_until_s_) {
    const Wait wait{*wait_until_s_};
    wait_until_s_.reset();
    return wait;
  }
  return next(seen.odometry);
}

void CoverRecovery::hold_up(const Observation& seen, std::string sentence) {
  hold_ups.push_back({seen.time_s, std::move(sentence)});
  if (hold_ups.size() > most_hold_ups) gave_up = true;
  heading_rad_ = seen.odometry.heading_rad;
  end_.reset();
}

/// Drives what is left of the piece next.
void CoverRecovery::keep_rest(const Task& task, double from_part) {
  Task rest = task;
  rest.piece = section_of(task.piece, from_part, 1.0);
  tasks_.push_front(rest);
}

void CoverRecovery::drop_way() {
  while (!tasks_.empty() && tasks_.front().way) tasks_.pop_front();
}

/// Decides what comes of the piece that was just driven.
void CoverRecovery::judge(const Task& task, const Observation& seen) {
  const Vec2 here = seen.odometry.position;
  // If its wheels stick when it drives off what it touches, it still does: that is no new contact.
  const bool stands = distance(began_, here) <= least_motion * problem_.body_radius_m();
  const bool touches_still = task.leaves && stands;
  if (seen.carried_from) {
    was_carried(task, seen.carried_from->position, seen);
    return;
  }
  if (seen.touch_rad && !touches_still) {
    touched(task, *seen.touch_rad, seen);
    return;
  }
  const double part = nearest_part(task.piece, here);
  const double left_m = (1.0 - part) * length_of(task.piece);
  const double beside_m = distance(here, point_on(task.piece, part));
  if (task.index != off_track) strayed_m = std::max(strayed_m, beside_m);
  if (left_m > tolerance_m_) {
    fell_short(task, part, stands, seen);
  } else {
    stalls_ = 0;
  }
}

void CoverRecovery::fell_short(const Task& task, double part, bool stands, const Observation& seen) {
  const Vec2 here = seen.odometry.position;
  hold_up(seen, fmt::format("stopped {:.3g} m before the end of a leg, at {}",
                            (1.0 - part) * length_of(task.piece), place_text(problem_.frame, here)));
  keep_rest(task, part);
  stalls_ = stands ? stalls_ + 1 : 0;
  if (stalls_ > most_stalls) gave_up = true;
  if (stalls_ > 0 && !gave_up) wait_until_s_ = seen.time_s + wait_s;
}

void CoverRecovery::was_carried(const Task& task, Vec2 from, const Observation& seen) {
  hold_up(seen, fmt::format("was carried from {} to {}", place_text(problem_.frame, from),
                            place_text(problem_.frame, seen.odometry.position)));
  stalls_ = 0;
  if (task.way) {
    drop_way();
  } else {
    keep_rest(task, nearest_part(task.piece, from));
  }
}

void CoverRecovery::touched(const Task& task, double touch_rad, const Observation& seen) {
  const Pose2& pose = seen.odometry;
  const Vec2 towards = direction(pose.heading_rad + touch_rad);
  const Vec2 contact = pose.position + problem_.body_radius_m() * towards;
  hold_up(seen, fmt::format("touched something that is not on the map, at {}",
                            place_text(problem_.frame, contact)));
  if (task.way) {
    drop_way();
  } else {
    keep_rest(task, nearest_part(task.piece, pose.position));
  }
  if (++touches_ > most_touches) {
    gave_up = true;
  } else if (parts_->posts.touch(contact, towards).stands) {
    drive_around(pose);
  } else {
    wait_until_s_ = seen.time_s + wait_s;
  }
}

/// Plans again with what was felt: a lap around each thing, and the track without what they hide.
void CoverRecovery::drive_around(const Pose2& pose) {
  auto ground = parts_->posts.without_posts(parts_->map);
  if (!ground) {
    gave_up = true;
    return;
  }
  parts_->ground = std::move(*ground);
  std::erase_if(tasks_, [](const Task& task) { return task.index == off_track; });
  for (Task& task : tasks_) task.clipped = false;
  const cover::FreeRoom room(*parts_->ground);
  for (const cover::FeltPost& post : parts_->posts.all()) {
    const double keep_m = parts_->posts.keep_m(post);
    if (!post.stands || keep_m < problem_.turning_radius_m) continue;
    const double begin_rad = heading_of(pose.position - post.centre());
    for (int i = lap_arcs; i > 0; --i) {
      const double step_rad = 2.0 * pi / lap_arcs;
      const auto at = [&](int k) { return post.centre() + keep_m * direction(begin_rad + step_rad * k); };
      const PathPiece arc{at(i - 1), at(i), post.centre(), step_rad};
      if (room.point_free(arc.from) && room.free(arc)) tasks_.push_front({arc, off_track, false, true});
    }
  }
  if (!leave(pose)) gave_up = true;
}

/// Returns the directions, as pieces 1 m long, in which the robot may leave a place: first straight away from
/// there, then to either side of that. A robot with a turning radius goes only where it looks, and back.
std::vector<PathPiece> CoverRecovery::ways_off(const Pose2& pose, Vec2 from) const {
  std::vector<PathPiece> ways;
  const auto add = [&](double heading_rad, bool backward) {
    ways.push_back({pose.position, pose.position + direction(heading_rad), {}, 0.0, backward});
  };
  if (problem_.curves()) {
    if (problem_.reverse) add(pose.heading_rad + pi, true);
    add(pose.heading_rad, false);
    return ways;
  }
  const double away_rad = heading_of(pose.position - from);
  for (int k = 0; k < leave_ways; ++k) {
    const double turn_rad = 2.0 * pi / leave_ways * std::ceil(0.5 * k);
    add(k % 2 == 0 ? away_rad + turn_rad : away_rad - turn_rad, false);
  }
  return ways;
}

/// Drives away from what it is too near to, to where it has room to plan. Returns false if there is no such
/// place.
bool CoverRecovery::leave(const Pose2& pose) {
  if (parts_->ground->point_free(pose.position)) return true;
  const cover::FeltPost* nearest = nullptr;
  double inside_m = 0.0;
  for (const cover::FeltPost& post : parts_->posts.all()) {
    const double by_m = parts_->posts.keep_m(post) - distance(pose.position, post.centre());
    if (!post.stands || by_m <= inside_m) continue;
    nearest = &post;
    inside_m = by_m;
  }
  if (nearest == nullptr) return false;
  for (PathPiece way : ways_off(pose, nearest->centre())) {
    const Vec2 along = way.to - way.from;
    double step_m = inside_m + tolerance_m_;
    for (int k = 0; k < off_steps; ++k, step_m *= 1.5) {
      way.to = way.from + step_m * along;
      if (!parts_->map->segment_free({way.from, way.to})) break;
      if (!parts_->ground->point_free(way.to)) continue;
      tasks_.push_front({way, off_track, true, true, true});
      return true;
    }
  }
  return false;
}

/// Returns true if that place is nearer to something that was felt than the robot may come.
bool CoverRecovery::is_hidden(Vec2 at) const {
  return std::ranges::any_of(parts_->posts.all(), [&](const cover::FeltPost& post) {
    return post.stands && distance(at, post.centre()) < parts_->posts.keep_m(post);
  });
}

/// Cuts the first task into the parts that are far enough from everything that was felt, and leaves out the
/// others.
void CoverRecovery::clip_front() {
  Task task = tasks_.front();
  tasks_.pop_front();
  task.clipped = true;
  double step_m = length_of(task.piece);
  for (const auto& post : parts_->posts.all()) {
    const Vec2 nearest = point_on(task.piece, nearest_part(task.piece, post.centre()));
    if (is_hidden(nearest)) step_m = std::min(step_m, clip_step * parts_->posts.keep_m(post));
  }
  const int steps =
      step_m > 0.0 ? std::max(1, static_cast<int>(std::ceil(length_of(task.piece) / step_m))) : 1;
  const auto part_at = [&](int k) { return static_cast<double>(k) / steps; };
  const auto hidden = [&](int k) { return is_hidden(point_on(task.piece, part_at(k))); };
  std::vector<Task> free;
  for (int begin = 0, k = 1; k <= steps; ++k) {
    const bool out = hidden(k - 1) || hidden(k);
    if (k < steps && (hidden(k) || hidden(k + 1)) == out) continue;
    Task part = task;
    if (begin > 0 || k < steps) part.piece = section_of(task.piece, part_at(begin), part_at(k));
    (out ? left_out_ : free).push_back(part);
    begin = k;
  }
  tasks_.insert(tasks_.begin(), free.begin(), free.end());
}

/// Returns true if the robot is where the piece begins. After a piece that ended there it may be beside it.
bool CoverRecovery::is_at(const Pose2& pose, const PathPiece& piece) const {
  const bool follows = end_ && distance(*end_, piece.from) <= same_place_m;
  const double turn_rad = std::abs(wrap_angle(pose.heading_rad - heading_in(piece)));
  if (!follows && problem_.curves() && turn_rad > aside_rad) return false;
  return distance(pose.position, piece.from) <= (follows ? problem_.body_radius_m() : tolerance_m_);
}

/// Puts the way to the first task before it, or first to where it has room to plan one. Returns false if
/// there is none; the task is left out then.
bool CoverRecovery::find_way(const Pose2& pose) {
  const Task task = tasks_.front();
  if (is_at(pose, task.piece)) return true;
  if (!parts_->ground->point_free(pose.position) && leave(pose)) return true;
  std::vector<PathPiece> track;
  track.reserve(tasks_.size());
  for (const Task& one : tasks_) track.push_back(one.piece);
  const auto way = parts_->ways.way(pose, task.piece, parts_->ground, track);
  if (!way) {
    tasks_.pop_front();
    if (task.index != off_track) left_out_.push_back(task);
    return false;
  }
  for (const PathPiece& piece : std::views::reverse(*way)) tasks_.push_front({piece, off_track, true, true});
  return true;
}

/// Begins once more with what was left out. Returns false if that is nothing, or was done before.
bool CoverRecovery::look_again() {
  if (looked_again_ || left_out_.empty()) return false;
  looked_again_ = true;
  end_.reset();
  parts_->posts.forget();
  parts_->ground = parts_->map;
  tasks_.assign(left_out_.begin(), left_out_.end());
  left_out_.clear();
  for (Task& task : tasks_) task.clipped = false;
  return true;
}

Command CoverRecovery::command_of(const Task& task) {
  FollowPiece command{task.piece};
  if (!tasks_.empty() && distance(tasks_.front().piece.from, task.piece.to) <= same_place_m)
    command.next = tasks_.front().piece;
  const bool turns = std::abs(wrap_angle(heading_in(task.piece) - heading_rad_)) > no_turn_rad;
  if (turns) command.pause_s = problem_.pace.pause_s;
  heading_rad_ = heading_out(task.piece);
  end_ = task.piece.to;
  return command;
}

std::optional<Command> CoverRecovery::next(const Pose2& pose) {
  while (!gave_up && (!tasks_.empty() || look_again())) {
    if (!tasks_.front().clipped && !parts_->posts.all().empty()) {
      clip_front();
      continue;
    }
    if (!tasks_.front().way && !find_way(pose)) continue;
    const Task task = tasks_.front();
    tasks_.pop_front();
    current_ = task;
    pieces.push_back(task.index);
    began_ = pose.position;
    return command_of(task);
  }
  return std::nullopt;
}

}  // namespace outrider
