// The common part of the two families of turning paths: the question with a radius of 1 and the start at the
// origin.
#pragma once

#include <span>

#include "outrider/motion/turning_path.hpp"

namespace outrider::turning {

/// The words of one question; some may not end at the goal.
class Words {
 public:
  void add(const TurningPath& path) { paths_[count_++] = path; }
  [[nodiscard]] std::span<TurningPath> found() { return {paths_.data(), count_}; }
  [[nodiscard]] std::span<const TurningPath> found() const { return {paths_.data(), count_}; }

 private:
  std::array<TurningPath, 48> paths_;  // as many as Reeds and Shepp have
  std::size_t count_ = 0;
};

/// Returns the pose `to` in the frame of `from`, lengths in radii.
Pose2 normalised(const Pose2& from, const Pose2& to, double radius_m);

void add_dubins_words(const Pose2& goal, Words& words);
void add_reeds_shepp_words(const Pose2& goal, Words& words);

/// Returns those of the paths that end at the goal, shortest first, scaled to the radius. Pieces of no length
/// are left out.
std::vector<TurningPath> arriving(const Words& words, const Pose2& goal, double radius_m);

/// Returns the length of the shortest word that ends at the goal.
double shortest_length(Words& words, const Pose2& goal);

}  // namespace outrider::turning
