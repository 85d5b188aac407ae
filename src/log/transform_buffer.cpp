#include "outrider/log/transform_buffer.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "outrider/core/text.hpp"
#include "outrider/log/messages/conversions.hpp"

namespace outrider {
namespace {

constexpr std::size_t most_frames = 10000;
constexpr std::size_t most_samples = 10000;
constexpr std::size_t largest_depth = 1000;
constexpr std::size_t longest_name = 1000;

std::string_view plain_name(std::string_view name) { return name.starts_with('/') ? name.substr(1) : name; }

/// A quaternion of length 1; nothing if that is not possible.
std::optional<Eigen::Quaterniond> unit(const geometry_msgs::Quaternion& q) {
  const Eigen::Quaterniond given(q.w, q.x, q.y, q.z);
  const double length = given.norm();
  if (!std::isfinite(length) || length < 1e-6) return std::nullopt;
  return Eigen::Quaterniond(given.coeffs() / length);
}

Rotation rotation_of_unit(const Eigen::Quaterniond& q) {
  const Eigen::Matrix3d matrix = q.toRotationMatrix();
  Rotation rotation;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto column = matrix.col(static_cast<Eigen::Index>(i));
    rotation.axes[i] = {column.x(), column.y(), column.z()};
  }
  return rotation;
}

Pose3 inverse_of(const Pose3& pose) {
  Rotation back;
  const auto& a = pose.rotation.axes;
  back.axes = {Vec3{a[0].x, a[1].x, a[2].x}, Vec3{a[0].y, a[1].y, a[2].y}, Vec3{a[0].z, a[1].z, a[2].z}};
  return {back * Vec3{-pose.position.x, -pose.position.y, -pose.position.z}, back};
}

}  // namespace

std::optional<Rotation> rotation_of(const geometry_msgs::Quaternion& q) {
  const auto rotation = unit(q);
  if (!rotation) return std::nullopt;
  return rotation_of_unit(*rotation);
}

Status TransformBuffer::add(const tf2_msgs::TFMessage& message, Transforms kind) {
  for (const geometry_msgs::TransformStamped& transform : message.transforms) {
    if (auto added = add(transform, kind); !added) return added;
  }
  return {};
}

Status TransformBuffer::add(const geometry_msgs::TransformStamped& transform, Transforms kind) {
  const std::string_view parent = plain_name(transform.header.frame_id);
  const std::string_view child = plain_name(transform.child_frame_id);
  const auto refuse = [&](std::string_view why) {
    return bad_input(fmt::format("the transform from '{}' to '{}' {}", excerpt(parent), excerpt(child), why));
  };
  if (parent == child || child.empty()) return refuse("joins a frame to itself; leave it out");
  if (child.size() > longest_name || parent.size() > longest_name)
    return refuse("has a name that is too long");
  const geometry_msgs::Vector3& t = transform.transform.translation;
  const auto rotation = unit(transform.transform.rotation);
  if (!rotation || !std::isfinite(t.x + t.y + t.z))
    return refuse("is not finite or has no rotation; leave it out");
  if (frames_.size() >= most_frames && !frames_.contains(child)) {
    return refuse(fmt::format("is that of more than {} frames", most_frames));
  }
  Frame& frame = frames_[std::string(child)];
  const bool moves = kind == Transforms::moving;
  if (frame.parent != parent || frame.moves != moves || !moves) frame = {std::string(parent), moves, {}};
  const Sample sample{nanoseconds_of(transform.header.stamp),
                      {t.x, t.y, t.z},
                      {rotation->x(), rotation->y(), rotation->z(), rotation->w()}};
  auto& samples = frame.samples;
  const auto place = std::ranges::lower_bound(samples, sample.time_ns, {}, &Sample::time_ns);
  if (place != samples.end() && place->time_ns == sample.time_ns) {
    *place = sample;
  } else {
    samples.insert(place, sample);
  }
  while (samples.size() > most_samples ||
         (samples.size() > 2 && samples.back().time_ns - samples.front().time_ns > window_ns_)) {
    samples.pop_front();
  }
  return {};
}

Pose3 TransformBuffer::Frame::at(std::int64_t time_ns) const {
  const auto quaternion = [](const Sample& sample) {
    const auto& q = sample.rotation;
    return Eigen::Quaterniond(q.w, q.x, q.y, q.z);
  };
  const auto after = std::ranges::lower_bound(samples, time_ns, {}, &Sample::time_ns);
  const bool exact = after != samples.end() && (after->time_ns == time_ns || after == samples.begin());
  if (exact || after == samples.end()) {
    const Sample& nearest = exact ? *after : samples.back();
    return {nearest.position, rotation_of_unit(quaternion(nearest))};
  }
  const Sample& before = *std::prev(after);
  const double share =
      static_cast<double>(time_ns - before.time_ns) / static_cast<double>(after->time_ns - before.time_ns);
  return {before.position + share * (after->position - before.position),
          rotation_of_unit(quaternion(before).slerp(share, quaternion(*after)))};
}

/// Follows both frames upwards to the first frame that they share. A loop ends at the largest depth.
std::optional<TransformBuffer::Route> TransformBuffer::route(std::string_view parent,
                                                             std::string_view child) const {
  const auto chain = [&](std::string_view name) {
    std::vector<std::string_view> names{plain_name(name)};
    for (auto frame = frames_.find(names.back()); frame != frames_.end() && names.size() < largest_depth;
         frame = frames_.find(names.back())) {
      names.push_back(frame->second.parent);
    }
    return names;
  };
  const auto up_from_parent = chain(parent), up_from_child = chain(child);
  for (std::size_t i = 0; i < up_from_child.size(); ++i) {
    const auto shared = std::ranges::find(up_from_parent, up_from_child[i]);
    if (shared == up_from_parent.end()) continue;
    Route route;
    for (auto name = up_from_parent.begin(); name != shared; ++name) {
      route.from_parent.push_back(&frames_.find(*name)->second);
    }
    for (std::size_t k = 0; k < i; ++k) route.from_child.push_back(&frames_.find(up_from_child[k])->second);
    return route;
  }
  return std::nullopt;
}

std::optional<Pose3> TransformBuffer::find(std::string_view parent, std::string_view child,
                                           std::int64_t time_ns) const {
  const auto way = route(parent, child);
  if (!way) return std::nullopt;
  const auto climb = [&](const std::vector<const Frame*>& frames) {
    Pose3 pose;  // of the first frame in the one reached so far
    for (const Frame* frame : frames) pose = frame->at(time_ns) * pose;
    return pose;
  };
  const Pose3 shared_T_child = climb(way->from_child);
  if (way->from_parent.empty()) return shared_T_child;
  return inverse_of(climb(way->from_parent)) * shared_T_child;
}

std::optional<std::int64_t> TransformBuffer::known_until_ns(std::string_view parent,
                                                            std::string_view child) const {
  const auto way = route(parent, child);
  if (!way) return std::nullopt;
  std::int64_t time_ns = std::numeric_limits<std::int64_t>::max();
  for (const auto* frames : {&way->from_parent, &way->from_child}) {
    for (const Frame* frame : *frames) {
      if (frame->moves) time_ns = std::min(time_ns, frame->samples.back().time_ns);
    }
  }
  return time_ns;
}

std::optional<std::int64_t> TransformBuffer::known_from_ns(std::string_view parent,
                                                           std::string_view child) const {
  const auto way = route(parent, child);
  if (!way) return std::nullopt;
  std::int64_t time_ns = std::numeric_limits<std::int64_t>::min();
  for (const auto* frames : {&way->from_parent, &way->from_child}) {
    for (const Frame* frame : *frames) {
      if (frame->moves) time_ns = std::max(time_ns, frame->samples.front().time_ns);
    }
  }
  return time_ns;
}

}  // namespace outrider
