// The surfaces of keyframes, computed from their scans when they are needed.
//
// A keyframe holds its scan only. Its surface takes four times the memory and is computed in the time in
// which one scan is matched, so only those of the local map are held. Thread rule: one at a time.
#pragma once

#include <map>

#include "laser/keyframe_graph.hpp"
#include "scan/surface.hpp"

namespace outrider {

class KeyframeSurfaces {
 public:
  KeyframeSurfaces(const Pose2& robot_T_laser, double reach_m)
      : robot_T_laser_(robot_T_laser), reach_m_(reach_m) {}

  /// Returns the surface of a keyframe, which is empty if its scan was released. The reference holds until
  /// the next call of forget_unused().
  const Surface& of(const KeyframeGraph& graph, std::uint32_t keyframe) {
    const auto [found, is_new] = held_.try_emplace(keyframe);
    const Keyframe& key = graph.keyframes[keyframe];
    if (is_new && key.has_scan()) found->second.surface = surface_of(key.scan, robot_T_laser_, reach_m_);
    found->second.is_used = true;
    return found->second.surface;
  }

  /// Forgets the surfaces that were not asked for since the last call.
  void forget_unused() {
    std::erase_if(held_, [](const auto& held) { return !held.second.is_used; });
    for (auto& [keyframe, held] : held_) held.is_used = false;
  }

  [[nodiscard]] const Pose2& robot_T_laser() const { return robot_T_laser_; }

 private:
  struct Held {
    Surface surface;
    bool is_used = false;
  };

  Pose2 robot_T_laser_;
  double reach_m_;
  std::map<std::uint32_t, Held> held_;  ///< by keyframe
};

}  // namespace outrider
