// Stops: the few places, of the many from which something can be hit, that a tour is chosen from.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "outrider/jobs/guard/firing_map.hpp"

namespace outrider {

/// By cell, which targets can be hit from there for sure: the shot forgives the errors of the gun, the
/// robot fits wherever the errors of a drive put it, and the target can be hit from all cells whose centres
/// lie within these errors too. A target that no cell hits for sure counts wherever it can be hit at all.
struct SureHits {
  std::size_t words = 1;               ///< 64-bit words a cell
  std::vector<std::uint64_t> targets;  ///< cell-major bit sets

  [[nodiscard]] std::span<const std::uint64_t> at(std::size_t cell) const {
    return {targets.data() + cell * words, words};
  }
  void add(std::size_t cell, std::size_t target) {
    targets[cell * words + target / 64] |= std::uint64_t{1} << (target % 64);
  }
  [[nodiscard]] bool has(std::size_t cell, std::size_t target) const {
    return (targets[cell * words + target / 64] >> (target % 64) & 1U) != 0;
  }
};

SureHits sure_hits(const GuardProblem& problem, const FiringMap& firing_map);

/// In each square tile of the yard, for each largest set of targets hit from there, the best cell. Tiles
/// are no smaller than `tile_m`, and larger until at most `most` cells are left; where one tile still has
/// more, a greedy cover is taken. Each target that a cell which counts can hit is in some set.
/// Only cells within `near_m` of one of `around` count, unless that is empty. Ascending.
std::vector<std::size_t> choose_stops(const FiringMap& firing_map, const SureHits& hits, double tile_m,
                                      std::size_t most, const std::vector<Vec2>& around, double near_m);

}  // namespace outrider
