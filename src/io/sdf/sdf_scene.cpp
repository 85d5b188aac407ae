#include "sdf/sdf_scene.hpp"

#include <fmt/format.h>

#include <cmath>

#include "outrider/io/files/text.hpp"

namespace outrider {
namespace {

/// A frame, or the origin of a scope.
struct FramePlace {
  std::size_t scope = 0;
  std::size_t frame = no_index;
};

/// Poses of frames in their scopes.
class FramePoses {
 public:
  explicit FramePoses(const SdfScene& scene)
      : scene_(scene), state_(scene.frames.size()), poses_(scene.frames.size()) {}

  /// Determines the pose of a frame, and of all that it depends on.
  Status resolve(std::size_t frame) {
    std::vector<std::size_t> open = {frame};
    while (!open.empty()) {
      const std::size_t at = open.back();
      if (state_[at] != State::unseen) {
        if (state_[at] == State::waiting) finish(at);
        open.pop_back();
        continue;
      }
      state_[at] = State::waiting;
      auto needs = needs_of(at);
      if (!needs) return pass_on(needs);
      for (const std::size_t need : *needs) {
        if (state_[need] == State::waiting) return hangs(scene_.frames[at], "it is relative to itself");
        if (state_[need] == State::unseen) open.push_back(need);
      }
    }
    return {};
  }

  [[nodiscard]] const Pose3& pose(std::size_t frame) const { return poses_[frame]; }

  /// Resolves the frame of that name in a scope, and returns its pose there.
  Outcome<Pose3> pose_of(std::size_t scope, std::string_view name) {
    const auto place = find(scope, name);
    if (!place) return bad_input(fmt::format("there is no frame '{}'", excerpt(name)));
    for (const std::size_t frame : chain(*place, scope)) {
      if (auto resolved = resolve(frame); !resolved) return pass_on(resolved);
    }
    return in_scope(*place, scope);
  }

 private:
  enum class State : char { unseen, waiting, done };

  static tl::unexpected<Fault> hangs(const SdfFrame& frame, const std::string& why) {
    return bad_input(fmt::format("the pose of '{}' hangs in the air: {}", excerpt(frame.name), why),
                     frame.file->document.where(frame.element));
  }

  /// Finds a name such as "link", "model::nested::frame" or "model::__model__".
  [[nodiscard]] std::optional<FramePlace> find(std::size_t scope, std::string_view name) const {
    for (;;) {
      if (name.empty() || name == "__model__" || (scope == 0 && name == "world")) return FramePlace{scope};
      const auto& frames = scene_.scopes[scope].frames;
      if (const auto found = frames.find(name); found != frames.end())
        return FramePlace{scene_.frames[found->second].scope, found->second};
      const std::size_t colons = name.find("::");
      const auto head = frames.find(name.substr(0, colons));
      if (colons == std::string_view::npos || head == frames.end()) return std::nullopt;
      scope = scene_.frames[head->second].inside;
      if (scope == no_index) return std::nullopt;
      name.remove_prefix(colons + 2);
    }
  }

  /// Returns the frames from a place up to a scope around it.
  [[nodiscard]] std::vector<std::size_t> chain(const FramePlace& place, std::size_t scope) const {
    std::vector<std::size_t> frames;
    if (place.frame != no_index) frames.push_back(place.frame);
    for (std::size_t at = place.scope; at != scope; at = scene_.scopes[at].parent)
      frames.push_back(scene_.scopes[at].frame);
    return frames;
  }

  /// Returns the pose of a place in a scope around it; the chain between them is resolved.
  [[nodiscard]] Pose3 in_scope(const FramePlace& place, std::size_t scope) const {
    Pose3 pose;
    for (const std::size_t frame : chain(place, scope)) pose = poses_[frame] * pose;
    return pose;
  }

  Outcome<std::vector<std::size_t>> needs_of(std::size_t index) const {
    const SdfFrame& frame = scene_.frames[index];
    const auto base = find(frame.scope, frame.relative_to);
    if (!base) return hangs(frame, fmt::format("there is no frame '{}'", excerpt(frame.relative_to)));
    std::vector<std::size_t> needs = chain(*base, frame.scope);
    if (frame.placement.empty()) return needs;
    const auto placed = find(frame.inside, frame.placement);
    if (!placed) return hangs(frame, fmt::format("it has no frame '{}' to place", excerpt(frame.placement)));
    for (const std::size_t need : chain(*placed, frame.inside)) needs.push_back(need);
    return needs;
  }

  void finish(std::size_t index) {
    const SdfFrame& frame = scene_.frames[index];
    state_[index] = State::done;
    poses_[index] = frame.pose;
    if (!frame.relative_to.empty())
      poses_[index] = in_scope(*find(frame.scope, frame.relative_to), frame.scope) * poses_[index];
    if (!frame.placement.empty())
      poses_[index] = poses_[index] * inverse(in_scope(*find(frame.inside, frame.placement), frame.inside));
  }

  const SdfScene& scene_;
  std::vector<State> state_;
  std::vector<Pose3> poses_;  // scope_T_frame
};

/// Returns the pose of a saved state, or else the one below the parent.
Pose3 stated_or(const SdfScene& scene, const std::string& key, const Pose3& pose) {
  const auto found = scene.stated.find(key);
  return found == scene.stated.end() ? pose : found->second;
}

}  // namespace

Rotation rotation_of(std::array<double, 4> q) {
  const double length = std::sqrt(q[3] * q[3] + q[0] * q[0] + q[1] * q[1] + q[2] * q[2]);
  if (!(length > 0.0)) return {};
  const auto [x, y, z, w] = std::array{q[0] / length, q[1] / length, q[2] / length, q[3] / length};
  return {{Vec3{1 - (2 * y * y + 2 * z * z), 2 * y * x + 2 * z * w, 2 * z * x - 2 * y * w},
           {2 * y * x - 2 * z * w, 1 - (2 * x * x + 2 * z * z), 2 * z * y + 2 * x * w},
           {2 * z * x + 2 * y * w, 2 * z * y - 2 * x * w, 1 - (2 * x * x + 2 * y * y)}}};
}

std::array<double, 4> quaternion_of(double roll_rad, double pitch_rad, double yaw_rad) {
  const auto [sr, cr] = std::array{std::sin(0.5 * roll_rad), std::cos(0.5 * roll_rad)};
  const auto [sp, cp] = std::array{std::sin(0.5 * pitch_rad), std::cos(0.5 * pitch_rad)};
  const auto [sy, cy] = std::array{std::sin(0.5 * yaw_rad), std::cos(0.5 * yaw_rad)};
  return {sr * cp * cy - cr * sp * sy, cr * sp * cy + sr * cp * sy, cr * cp * sy - sr * sp * cy,
          cr * cp * cy + sr * sp * sy};
}

Outcome<std::vector<Pose3>> collision_poses(const SdfScene& scene) {
  FramePoses poses(scene);
  std::vector<Pose3> world_T_scope(scene.scopes.size());
  for (std::size_t i = 1; i < scene.scopes.size(); ++i) {
    const SdfScope& scope = scene.scopes[i];
    if (auto resolved = poses.resolve(scope.frame); !resolved) return pass_on(resolved);
    const Pose3 world_T_model = world_T_scope[scope.parent] * poses.pose(scope.frame);
    world_T_scope[i] = scope.merged ? world_T_model : stated_or(scene, scope.key, world_T_model);
  }
  std::vector<Pose3> result;
  for (const SdfCollision& collision : scene.collisions) {
    const SdfFrame& link = scene.frames[collision.link];
    if (auto resolved = poses.resolve(collision.link); !resolved) return pass_on(resolved);
    const Pose3& model_T_link = poses.pose(collision.link);
    const std::string key = scene.scopes[link.scope].key + "::" + link.name;
    const Pose3 world_T_link = stated_or(scene, key, world_T_scope[link.scope] * model_T_link);
    Pose3 link_T_collision = collision.pose;
    if (!collision.relative_to.empty()) {
      auto model_T_base = poses.pose_of(link.scope, collision.relative_to);
      if (!model_T_base) {
        return bad_input(fmt::format("the pose of '{}' hangs in the air: {}", excerpt(collision.name),
                                     model_T_base.error().sentence),
                         collision.file->document.where(collision.shape));
      }
      link_T_collision = inverse(model_T_link) * (*model_T_base * collision.pose);
    }
    result.push_back(world_T_link * link_T_collision);
  }
  return result;
}

Outcome<std::map<std::string, Pose3, std::less<>>> frame_poses(const SdfScene& scene, std::size_t scope) {
  FramePoses poses(scene);
  std::map<std::string, Pose3, std::less<>> result;
  for (const auto& [name, frame] : scene.scopes[scope].frames) {
    auto pose = poses.pose_of(scope, name);
    if (!pose) return pass_on(pose);
    result.emplace(name, *pose);
  }
  return result;
}

}  // namespace outrider
