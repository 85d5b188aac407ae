// Loop closing: recognises a place that was visited before and adds a constraint between the two visits.
//
// The last keyframes, joined rigidly, are matched with the keyframes of each earlier visit whose uncertainty
// allows the same place. A match is accepted if most points lie on a surface, no other pose in the window
// scores nearly as well, the two visits agree on what is free, and the optimised graph still agrees with the
// constraint. Where the window is wider than 6 m, streets and corridors look alike: then more of the last
// keyframes are matched with all older visits at once. A gap, which odometry alone spans because a scan
// matched nothing, is bridged by the same rules: the keyframes after it are searched among those just before
// it, in the full turn. If that fails, as for a robot that was carried away, they are searched on the whole
// map before the gap, again and again while the robot drives on.
//
// A loop is judged once more after the next twelve keyframes, and whenever another one contradicts it;
// see loop_review.hpp. One that was wrong is undone.
#pragma once

#include <span>
#include "back_off.hpp"
#include "laser/loop_review.hpp"
#include "laser/place_recognition.hpp"

namespace outrider {

struct LoopSearch {
  std::vector<KeyframePair> closed;
  std::vector<KeyframePair> bridged;       ///< one before a gap, and one after it
  std::vector<KeyframePair> undone;        ///< were closed, and turned out to be wrong
  std::vector<KeyframeConstraint> rivals;  ///< the last places recognised that the graph contradicts
  std::size_t rivals_found = 0;
  std::size_t rivals_due = 1;   ///< number of rivals found at which they are weighed; doubles
  std::size_t refused = 0;      ///< places that were recognised and not believed
  BackOff bridging, rejoining;  ///< of the searches of these two, over all gaps
  double tried_at_m = 0.0;      ///< distance driven at the last search
  double far_due_at_m = 0.0;    ///< distance driven at which older visits are searched again
  double far_every_m = 0.0;     ///< distance between two such searches; grows while they find nothing

  /// Adds constraints between the last keyframe and earlier visits and optimises the graph; returns true if
  /// it added any. Rejects a match farther than `reach_sd` standard deviations from the believed pose. Uses
  /// the keyframes from `first` on only, before which is a gap: where the robot is on the map before it is
  /// not known, and a window would leave out other places that look the same.
  bool close(KeyframeGraph& graph, KeyframeSurfaces& surfaces, double reach_sd, std::uint32_t first);
  /// Joins the last keyframes with those before the gap, which ends at the keyframe `gap`. Returns true if it
  /// moved the poses. How far is plausible depends on what odometry is taken to err by in the gap.
  bool bridge(KeyframeGraph& graph, KeyframeSurfaces& surfaces, double reach_sd, std::uint32_t gap);
  /// Searches the keyframes since the gap on the whole map before it, each time the robot has driven another
  /// half of the way since the gap. Returns true if it joined them, which moves the poses. Takes about a
  /// second, and is not done on a map of more than 500 m by 500 m.
  bool rejoin(KeyframeGraph& graph, KeyframeSurfaces& surfaces, double reach_sd, std::uint32_t gap);
  /// Judges closed loops by what came later, and undoes wrong ones. Returns true if this moved the poses.
  bool review(KeyframeGraph& graph, const Pose2& robot_T_laser);
  /// Returns true if a constraint of this search spans the gap.
  [[nodiscard]] bool spans(std::uint32_t gap) const;
  /// Returns those of the gaps, which are in order, between whose two sides no chain of matches leads: a loop
  /// around several gaps joins the first part with the last, and those between hang loosely.
  [[nodiscard]] std::vector<std::uint32_t> open_gaps(std::span<const std::uint32_t> gaps) const;

 private:
  bool close_near(KeyframeGraph& graph, KeyframeSurfaces& surfaces, double reach_sd, std::uint32_t first,
                  MatchWindow window);
  bool close_far(KeyframeGraph& graph, KeyframeSurfaces& surfaces, double reach_sd,
                 const KeyframeRange& earlier, const MatchWindow& window);
  /// Moves the loops whose constraints were removed to `undone`. Returns true if there are any.
  bool drop_removed(const KeyframeGraph& graph);
  /// Lets the rivals take the place of loops that they cannot be reconciled with, if they outweigh them.
  bool weigh_rivals(KeyframeGraph& graph);
  /// Returns true if the last keyframe and this one are near a loop that was undone.
  [[nodiscard]] bool was_undone(const KeyframeGraph& graph, std::uint32_t keyframe) const;
  /// Adds the constraint of a place that was recognised, and returns true; unless the scans or the other
  /// constraints contradict it, which is counted as refused.
  bool believe(KeyframeGraph& graph, const Pose2& robot_T_laser, const KnownPlace& place,
               const KeyframeRange& visit, std::uint32_t first);
};

}  // namespace outrider
