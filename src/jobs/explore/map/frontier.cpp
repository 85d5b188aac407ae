#include "outrider/jobs/explore/map/frontier.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <tuple>
#include <utility>

#include "map/beside.hpp"

namespace outrider {
namespace {

constexpr std::uint32_t first_label = 1U << 31U;  // above the ids: cells that are sorted anew

constexpr std::array<Cell, 4> beside = {{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};

struct Extent {
  Cell low, high;
  [[nodiscard]] int width() const { return high.x - low.x + 1; }
  [[nodiscard]] int height() const { return high.y - low.y + 1; }
};

Extent extent_of(const std::vector<std::uint32_t>& cells, const GridFrame& frame) {
  Extent extent{frame.cell(cells.front()), frame.cell(cells.front())};
  for (const std::uint32_t cell : cells) {
    const Cell c = frame.cell(cell);
    extent.low = {std::min(extent.low.x, c.x), std::min(extent.low.y, c.y)};
    extent.high = {std::max(extent.high.x, c.x), std::max(extent.high.y, c.y)};
  }
  return extent;
}

/// visit(cell) for the 8 cells around one that lies off the edge.
template <class Visit>
void for_each_around(std::uint32_t cell, const GridFrame& frame, Visit visit) {
  for (const Cell d : grid_moves) {
    visit(
        static_cast<std::uint32_t>(static_cast<std::int64_t>(cell) + std::int64_t{d.y} * frame.width + d.x));
  }
}

Frontier frontier_of_cells(std::vector<std::uint32_t> cells, const GridFrame& frame) {
  Frontier made;
  Vec2 sum;
  for (const std::uint32_t cell : cells) {
    const Vec2 centre = frame.centre(frame.cell(cell));
    sum = sum + centre;
    made.bounds.include(centre);
  }
  made.centroid = 1.0 / static_cast<double>(cells.size()) * sum;
  made.cells = std::move(cells);
  return made;
}

/// The cells of the owner array that carry labels, taken apart into frontiers.
class Sorter {
 public:
  Sorter(const GridFrame& frame, std::vector<std::uint32_t>& owner, double longest_cells)
      : frame_(frame), owner_(owner), longest_(std::max(1.0, longest_cells)) {}

  /// Each group of the cells, in parts no longer than wanted; by their least cells.
  std::vector<std::vector<std::vector<std::uint32_t>>> groups(std::vector<std::uint32_t> cells) {
    std::vector<std::vector<std::vector<std::uint32_t>>> all;
    for (auto& group : connected(relabelled(std::move(cells)))) {
      std::vector<std::vector<std::uint32_t>> parts;
      cut(std::move(group), parts);
      std::sort(parts.begin(), parts.end());
      all.push_back(std::move(parts));
    }
    return all;
  }

 private:
  std::vector<std::uint32_t> relabelled(std::vector<std::uint32_t> cells) {
    ++label_;
    for (const std::uint32_t cell : cells) owner_[cell] = label_;
    return cells;
  }

  /// The connected parts of cells that all carry the last label, each ascending.
  std::vector<std::vector<std::uint32_t>> connected(const std::vector<std::uint32_t>& cells) {
    std::vector<std::vector<std::uint32_t>> parts;
    const std::uint32_t label = label_++;
    for (const std::uint32_t seed : cells) {
      if (owner_[seed] != label) continue;
      std::vector<std::uint32_t> part{seed};
      owner_[seed] = label_;
      for (std::size_t i = 0; i < part.size(); ++i) {
        for_each_around(part[i], frame_, [&](std::uint32_t next) {
          if (owner_[next] != label) return;
          owner_[next] = label_;
          part.push_back(next);
        });
      }
      std::sort(part.begin(), part.end());
      parts.push_back(std::move(part));
    }
    return parts;
  }

  /// Adds the parts of a group that are no longer than wanted, or a single cell.
  void cut(std::vector<std::uint32_t> group, std::vector<std::vector<std::uint32_t>>& parts) {
    std::vector<std::vector<std::uint32_t>> open{std::move(group)};
    while (!open.empty()) {
      std::vector<std::uint32_t> cells = std::move(open.back());
      open.pop_back();
      const Extent extent = extent_of(cells, frame_);
      if (std::max(extent.width(), extent.height()) <= longest_) {
        parts.push_back(std::move(cells));
        continue;
      }
      const bool across = extent.width() >= extent.height();
      const int middle = across ? extent.low.x + extent.width() / 2 : extent.low.y + extent.height() / 2;
      std::vector<std::uint32_t> lower, upper;
      for (const std::uint32_t cell : cells) {
        const Cell c = frame_.cell(cell);
        ((across ? c.x : c.y) < middle ? lower : upper).push_back(cell);
      }
      for (auto* half : {&lower, &upper}) {
        for (auto& part : connected(relabelled(std::move(*half)))) open.push_back(std::move(part));
      }
    }
  }

  const GridFrame& frame_;
  std::vector<std::uint32_t>& owner_;
  double longest_;
  std::uint32_t label_ = first_label;
};

using Parts = std::vector<std::vector<std::uint32_t>>;

/// The id of each part: former ids go to those that hold most of their cells; 0 without one.
std::vector<std::uint32_t> inherited(const Parts& parts,
                                     const std::map<std::uint32_t, std::uint32_t>& former) {
  std::vector<std::tuple<std::int64_t, std::uint32_t, std::size_t>> claims;  // -cells, id, part
  for (std::size_t i = 0; i < parts.size(); ++i) {
    std::map<std::uint32_t, std::int64_t> held;
    for (const std::uint32_t cell : parts[i]) {
      if (const auto before = former.find(cell); before != former.end()) ++held[before->second];
    }
    for (const auto& [id, cells] : held) claims.emplace_back(-cells, id, i);
  }
  std::sort(claims.begin(), claims.end());
  std::vector<std::uint32_t> ids(parts.size(), 0);
  std::set<std::uint32_t> taken;
  for (const auto& [cells, id, part] : claims) {
    if (ids[part] == 0 && taken.insert(id).second) ids[part] = id;
  }
  return ids;
}

}  // namespace

std::vector<Option> describe(FrontierOptions& options) {
  std::vector<Option> all = describe(options.ground);
  all.push_back({"longest_frontier", "m", 0.1, 1000.0, "length from which a frontier is cut in two",
                 &options.longest_m});
  all.push_back({"patience", "", 1.0, 60000.0, "decisions for a frontier nearby before it is given up",
                 &options.patience});
  return all;
}

FrontierMap::FrontierMap(const FrontierOptions& options, double radius_m)
    : options_(options), ground_(options.ground, radius_m) {}

bool FrontierMap::borders(std::uint32_t cell) const {
  const std::vector<std::uint8_t>& known = ground_.known().cells;
  if (known[cell] != free_cell) return false;
  const auto row = static_cast<std::uint32_t>(frame().width);
  return known[cell - 1] == unknown_cell || known[cell + 1] == unknown_cell ||
         known[cell - row] == unknown_cell || known[cell + row] == unknown_cell;
}

bool FrontierMap::update(const Grid<std::uint8_t>& occupancy, const MapUpdate& update) {
  const GridFrame before = frame();
  const TraversabilityGrid::Change change = ground_.update(occupancy, update);
  if (change.reframed) reframe(before, change);

  std::set<std::uint32_t> groups;    // that change
  std::vector<std::uint32_t> cells;  // to be sorted into frontiers
  const auto turn = [&](std::uint32_t cell) {
    const bool was = owner_[cell] != 0, is = borders(cell);
    if (was == is) return;
    if (was && owner_[cell] < first_label) groups.insert(frontiers_.at(owner_[cell]).group);
    owner_[cell] = is ? first_label : 0;
    if (!is) return;
    cells.push_back(cell);
    for_each_around(cell, frame(), [&](std::uint32_t next) {
      if (owner_[next] != 0 && owner_[next] < first_label) groups.insert(frontiers_.at(owner_[next]).group);
    });
  };
  for (const std::uint32_t cell : change.cells) {
    pursuits_[cell] = 0;
    turn(cell);
    const Cell at = frame().cell(cell);
    for (const Cell d : beside) {
      const Cell next{at.x + d.x, at.y + d.y};
      if (frame().contains(next)) turn(static_cast<std::uint32_t>(frame().index(next)));
    }
  }
  sort_anew(groups, std::move(cells));
  pursued_ = false;
  constexpr std::size_t many = 5000;
  return change.reframed || change.cells.size() > many;
}

void FrontierMap::pursue(std::uint32_t frontier) {
  const auto found = frontiers_.find(frontier);
  if (found == frontiers_.end() || std::exchange(pursued_, true)) return;
  std::vector<std::uint32_t> unknown;
  for_each_unknown_beside(found->second, ground_.known(),
                          [&](std::uint32_t cell) { unknown.push_back(cell); });
  std::sort(unknown.begin(), unknown.end());
  unknown.erase(std::unique(unknown.begin(), unknown.end()), unknown.end());
  for (const std::uint32_t cell : unknown) {
    if (given_up(cell)) continue;
    ++pursuits_[cell];
    if (given_up(cell)) ground_.note_change(cell);
  }
}

void FrontierMap::sort_anew(const std::set<std::uint32_t>& groups, std::vector<std::uint32_t> cells) {
  std::map<std::uint32_t, std::uint32_t> former;  // ids of cells
  for (const std::uint32_t group : groups) {
    for (const std::uint32_t id : groups_.at(group)) {
      for (const std::uint32_t cell : frontiers_.at(id).cells) {
        if (owner_[cell] != id) continue;  // no more
        former.emplace(cell, id);
        cells.push_back(cell);
      }
      frontiers_.erase(id);
    }
    groups_.erase(group);
  }
  std::sort(cells.begin(), cells.end());
  Sorter sorter(frame(), owner_, options_.longest_m / frame().resolution_m);
  const std::vector<Parts> sorted = sorter.groups(std::move(cells));
  Parts all;
  for (const Parts& parts : sorted) all.insert(all.end(), parts.begin(), parts.end());
  std::vector<std::uint32_t> ids = inherited(all, former);
  std::size_t next = 0;
  for (const Parts& parts : sorted) {
    const std::size_t first = next;
    for (std::size_t i = 0; i < parts.size(); ++i, ++next) {
      if (ids[next] == 0) ids[next] = next_id_++;
      for (const std::uint32_t cell : all[next]) owner_[cell] = ids[next];
      Frontier frontier = frontier_of_cells(std::move(all[next]), frame());
      frontier.id = ids[next];
      frontiers_.emplace(ids[next], std::move(frontier));
    }
    const auto begin = ids.begin() + static_cast<std::ptrdiff_t>(first);
    const std::uint32_t group = *std::min_element(begin, ids.begin() + static_cast<std::ptrdiff_t>(next));
    groups_[group].assign(begin, ids.begin() + static_cast<std::ptrdiff_t>(next));
    for (const std::uint32_t id : groups_[group]) frontiers_.at(id).group = group;
  }
}

/// Cells are counted otherwise from now on.
void FrontierMap::reframe(const GridFrame& before, const TraversabilityGrid::Change& change) {
  owner_.assign(frame().size(), 0);
  pursuits_ = moved_cells(pursuits_, before, frame(), change.shift, std::uint16_t{0});
  std::map<std::uint32_t, Frontier> kept;
  kept.swap(frontiers_);
  if (change.new_lattice) {
    groups_.clear();
    return;
  }
  for (auto& [id, frontier] : kept) {
    for (std::uint32_t& cell : frontier.cells) {
      const Cell c = before.cell(cell);
      cell = static_cast<std::uint32_t>(frame().index({c.x + change.shift.x, c.y + change.shift.y}));
      owner_[cell] = id;
    }
    frontiers_.emplace(id, std::move(frontier));
  }
}

}  // namespace outrider
