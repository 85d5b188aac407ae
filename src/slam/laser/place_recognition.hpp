// Recognises the place of the last keyframes on the map: they are joined rigidly and matched with keyframes
// of before.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "laser/keyframe_surfaces.hpp"
#include "scan/surface_map.hpp"

namespace outrider {

/// Keyframes from `first` to before `end`.
struct KeyframeRange {
  std::uint32_t first = 0;
  std::uint32_t end = 0;
};

/// Returns the keyframes around one, without the last ones.
KeyframeRange visit_of(const KeyframeGraph& graph, std::uint32_t keyframe);

/// Returns the surfaces of some keyframes.
SurfaceMap map_of(const KeyframeGraph& graph, KeyframeSurfaces& surfaces,
                  std::span<const std::uint32_t> which, int levels);
SurfaceMap map_of(const KeyframeGraph& graph, KeyframeSurfaces& surfaces, const KeyframeRange& visit);

/// Returns surface points of the last six keyframes together, from `first` on, in the frame of the last one.
Surface last_surface(const KeyframeGraph& graph, KeyframeSurfaces& surfaces, std::uint32_t first);

/// Returns true if the scans of the last keyframes, from `first` on, and those of a visit contradict each
/// other with the last keyframe at `there`: too many points of the one are where the other looked through.
bool is_contradicted(const KeyframeGraph& graph, const Pose2& robot_T_laser, const KeyframeRange& visit,
                     std::uint32_t first, const Pose2& there);

/// A place that was recognised: the pose of the last keyframe there, and the nearest keyframe of before.
struct KnownPlace {
  std::uint32_t keyframe = 0;
  Fit fit;
};

/// Recognises the last keyframes, from `first` on, among many others, which are in order and not empty, if
/// they fit one place of the window and no other nearly as well. Takes more keyframes together than a search
/// in a small window: streets and corridors are alike in what a few show. About a second for 300 m by 100 m.
std::optional<KnownPlace> recognise_far(const KeyframeGraph& graph, KeyframeSurfaces& surfaces,
                                        std::span<const std::uint32_t> among, std::uint32_t first,
                                        const MatchWindow& window);

}  // namespace outrider
