#include "outrider/jobs/guard/plan/stops.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

namespace outrider {
namespace {

constexpr float sure_ratio = 0.9F;  // largest error_ratio of a sure hit

/// Offsets of the cells that an error of the drive can put the robot on.
std::vector<Cell> disk(double radius_m, double step_m) {
  std::vector<Cell> offsets;
  const int n = static_cast<int>(std::ceil(radius_m / step_m));
  for (int y = -n; y <= n; ++y) {
    for (int x = -n; x <= n; ++x) {
      if (std::hypot(x, y) * step_m <= radius_m + 1e-9) offsets.push_back({x, y});
    }
  }
  return offsets;
}

bool hit_all_around(const FiringMap& firing_map, const FiringRegion& region, Cell c,
                    const std::vector<Cell>& around) {
  return std::all_of(around.begin(), around.end(), [&](Cell d) {
    const Cell n{c.x + d.x, c.y + d.y};
    return firing_map.frame.contains(n) && region.pitch[firing_map.frame.index(n)] != FiringRegion::no_shot;
  });
}

/// A cell from which targets can be hit.
struct Candidate {
  std::size_t cell = 0;
  int count = 0;           ///< number of targets
  float worth = 0.0;       ///< how well it serves: forgiving shots first, room to stand second
  std::uint64_t bits = 0;  ///< bit t % 64 for each target t: a set that contains another has all its bits
};

Candidate candidate(const FiringMap& firing_map, const SureHits& hits, std::size_t cell) {
  Candidate one{cell, 0, firing_map.clearance_m[cell], 0};
  for (const std::uint32_t target : hits.at(cell)) {
    ++one.count;
    one.bits |= std::uint64_t{1} << (target % 64);
    one.worth += 1.0F - std::min(1.0F, firing_map.regions[target].error_ratio[cell]);
  }
  return one;
}

using Tiles = std::map<std::pair<int, int>, std::vector<Candidate>>;

std::pair<int, int> tile_of(const GridFrame& frame, std::size_t cell, double tile_m) {
  const Vec2 p = frame.centre(frame.cell(cell)) - frame.origin;
  return {static_cast<int>(p.y / tile_m), static_cast<int>(p.x / tile_m)};
}

std::size_t count_tiles(const GridFrame& frame, const std::vector<Candidate>& cells, double tile_m) {
  if (cells.empty()) return 0;
  const auto [rows, columns] = tile_of(frame, frame.size() - 1, tile_m);
  std::vector<bool> occupied(static_cast<std::size_t>(rows + 1) * static_cast<std::size_t>(columns + 1));
  for (const Candidate& one : cells) {
    const auto [y, x] = tile_of(frame, one.cell, tile_m);
    occupied[static_cast<std::size_t>(y) * static_cast<std::size_t>(columns + 1) +
             static_cast<std::size_t>(x)] = true;
  }
  return static_cast<std::size_t>(std::ranges::count(occupied, true));
}

Tiles tiles_of(const GridFrame& frame, const std::vector<Candidate>& cells, double tile_m) {
  Tiles tiles;
  for (const Candidate& one : cells) tiles[tile_of(frame, one.cell, tile_m)].push_back(one);
  return tiles;
}

/// The cells of one tile reduced to one for each set of targets that no other set there contains.
std::vector<std::size_t> largest_sets(const SureHits& hits, std::vector<Candidate> cells) {
  std::ranges::stable_sort(cells, [](const Candidate& a, const Candidate& b) {
    return a.count != b.count ? a.count > b.count : a.worth > b.worth;
  });
  std::vector<std::size_t> kept;
  std::vector<const Candidate*> likely;  // the same, those first that contained a set lately
  for (const Candidate& one : cells) {
    const auto larger = std::ranges::find_if(likely, [&](const Candidate* k) {
      return (one.bits & ~k->bits) == 0 && std::ranges::includes(hits.at(k->cell), hits.at(one.cell));
    });
    if (larger != likely.end()) {
      std::rotate(likely.begin(), larger, larger + 1);
    } else {
      kept.push_back(one.cell);
      likely.push_back(&one);
    }
  }
  return kept;
}

/// Takes the cells of a greedy cover out of `cells`, always the one with most targets that no earlier one
/// has, and appends them to `chosen`. Returns false if nothing is left to cover.
bool take_cover(const SureHits& hits, std::vector<std::size_t>& cells, std::vector<std::size_t>& chosen) {
  std::set<std::uint32_t> covered;
  for (bool first = true;; first = false) {
    auto best = cells.end();
    std::ptrdiff_t most = 0;
    for (auto cell = cells.begin(); cell != cells.end(); ++cell) {
      const auto fresh =
          std::ranges::count_if(hits.at(*cell), [&](auto target) { return !covered.contains(target); });
      if (fresh > most) most = fresh, best = cell;
    }
    if (most == 0) return !first;
    covered.insert(hits.at(*best).begin(), hits.at(*best).end());
    chosen.push_back(*best);
    cells.erase(best);
  }
}

/// Takes cover after cover while there is room for `most` cells; of the first one, all.
std::vector<std::size_t> covers(const SureHits& hits, std::vector<std::size_t> cells, std::size_t most) {
  std::vector<std::size_t> chosen;
  take_cover(hits, cells, chosen);
  while (chosen.size() < most) {
    std::vector<std::size_t> more;
    if (!take_cover(hits, cells, more)) break;
    more.resize(std::min(more.size(), most - chosen.size()));
    chosen.insert(chosen.end(), more.begin(), more.end());
  }
  return chosen;
}

}  // namespace

std::vector<std::size_t> sure_cells(const GuardProblem& problem, const FiringMap& firing_map,
                                    std::size_t target) {
  const FiringRegion& region = firing_map.regions[target];
  const std::vector<Cell> around = disk(problem.errors.position_m, firing_map.frame.resolution_m);
  const auto roomy_m = static_cast<float>(problem.robot.radius_m + problem.errors.position_m);
  std::vector<std::size_t> sure, possible;
  region.pitch.each([&](std::size_t cell, std::uint8_t pitch) {
    if (pitch == FiringRegion::no_shot) return;
    possible.push_back(cell);
    if (region.error_ratio[cell] <= sure_ratio && firing_map.clearance_m[cell] >= roomy_m &&
        hit_all_around(firing_map, region, firing_map.frame.cell(cell), around))
      sure.push_back(cell);
  });
  return sure.empty() ? possible : sure;
}

SureHits::SureHits(std::size_t cells, const std::vector<std::vector<std::uint32_t>>& cells_of)
    : first_(cells + 1, 0) {
  for (const auto& of_target : cells_of) {
    for (const std::uint32_t cell : of_target) ++first_[cell + 1];
  }
  for (std::size_t cell = 0; cell < cells; ++cell) first_[cell + 1] += first_[cell];
  targets_.resize(first_[cells]);
  std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
  for (std::uint32_t target = 0; target < cells_of.size(); ++target) {
    for (const std::uint32_t cell : cells_of[target]) targets_[next[cell]++] = target;
  }
}

bool SureHits::has(std::size_t cell, std::size_t target) const {
  return std::ranges::binary_search(at(cell), static_cast<std::uint32_t>(target));
}

void SureHits::add(std::size_t cell, std::size_t target) {
  if (has(cell, target)) return;
  const auto id = static_cast<std::uint32_t>(target);
  const auto begin = targets_.begin() + static_cast<std::ptrdiff_t>(first_[cell]);
  const auto end = targets_.begin() + static_cast<std::ptrdiff_t>(first_[cell + 1]);
  targets_.insert(std::upper_bound(begin, end, id), id);
  for (std::size_t later = cell + 1; later < first_.size(); ++later) ++first_[later];
}

std::vector<std::size_t> targets_with_region(const FiringMap& firing_map) {
  std::vector<std::size_t> targets;
  for (std::size_t t = 0; t < firing_map.regions.size(); ++t) {
    if (firing_map.regions[t].hits > 0) targets.push_back(t);
  }
  return targets;
}

SureHits sure_hits(const GuardProblem& problem, const FiringMap& firing_map,
                   const std::vector<std::size_t>& targets) {
  std::vector<std::vector<std::uint32_t>> cells_of(firing_map.regions.size());
  for (const std::size_t t : targets) {
    const auto cells = sure_cells(problem, firing_map, t);
    cells_of[t].assign(cells.begin(), cells.end());
  }
  return {firing_map.frame.size(), cells_of};
}

std::vector<std::size_t> choose_stops(const FiringMap& firing_map, const SureHits& hits, double tile_m,
                                      std::size_t most, const std::vector<Vec2>& around, double near_m) {
  const auto counts = [&](std::size_t cell) {
    if (hits.at(cell).empty()) return false;
    const Vec2 p = firing_map.place(cell);
    return around.empty() ||
           std::any_of(around.begin(), around.end(), [&](Vec2 a) { return distance(a, p) <= near_m; });
  };
  std::vector<Candidate> useful;
  for (std::size_t i = 0; i < firing_map.frame.size(); ++i) {
    if (counts(i)) useful.push_back(candidate(firing_map, hits, i));
  }
  for (;; tile_m *= 1.25) {
    const std::size_t occupied = count_tiles(firing_map.frame, useful, tile_m);
    if (occupied > std::max<std::size_t>(most, 1)) continue;  // each has a cell at least
    Tiles tiles = tiles_of(firing_map.frame, useful, tile_m);
    const bool divided = tiles.size() > 1;
    std::vector<std::size_t> chosen;
    for (auto tile = tiles.begin(); tile != tiles.end() && (chosen.size() <= most || !divided); ++tile) {
      for (const std::size_t cell : largest_sets(hits, std::move(tile->second))) chosen.push_back(cell);
    }
    if (chosen.size() > most && divided) continue;
    if (chosen.size() > most) chosen = covers(hits, std::move(chosen), most);
    std::sort(chosen.begin(), chosen.end());
    return chosen;
  }
}

std::optional<Vec2> nearest_place(const FiringMap& firing_map, const std::vector<std::size_t>& cells,
                                  Vec2 here, double apart_m) {
  std::optional<Vec2> best;
  double least = std::numeric_limits<double>::infinity();
  for (const std::size_t cell : cells) {
    const Vec2 place = firing_map.place(cell);
    const double away = distance(here, place);
    if (away < apart_m || away >= least) continue;
    least = away;
    best = place;
  }
  return best;
}

}  // namespace outrider
