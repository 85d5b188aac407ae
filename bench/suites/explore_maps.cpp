#include "explore_maps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "grids.hpp"
#include "outrider/core/rng.hpp"
#include "outrider/path/grid/from_occupancy.hpp"

namespace outrider::bench {
namespace {

constexpr double cell_m = 0.1;
constexpr Cell four_steps[] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};

/// A grid under construction, in cells.
struct Plan {
  Grid<std::uint8_t> solid;

  Plan(int width, int height, std::uint8_t value) : solid(GridFrame{{}, cell_m, width, height}, value) {
    border();
  }

  void fill(int x, int y, int wide, int high, std::uint8_t value) {
    for (int v = std::max(0, y); v < std::min(y + high, solid.frame.height); ++v) {
      for (int u = std::max(0, x); u < std::min(x + wide, solid.frame.width); ++u) solid[{u, v}] = value;
    }
  }
  void border() {
    const int w = solid.frame.width, h = solid.frame.height;
    fill(0, 0, w, 1, 1);
    fill(0, h - 1, w, 1, 1);
    fill(0, 0, 1, h, 1);
    fill(w - 1, 0, 1, h, 1);
  }
};

int between(Rng& rng, int low, int high) {
  return low + static_cast<int>(rng.below(static_cast<std::uint64_t>(high - low + 1)));
}

/// Furniture in a room: some boxes that leave ways around them.
void furnish(Plan& plan, Rng& rng, int x, int y, int wide, int high) {
  const int pieces = between(rng, 0, std::max(0, wide * high / 700));
  for (int i = 0; i < pieces; ++i) {
    const int w = between(rng, 3, 12), h = between(rng, 3, 12);
    if (wide < w + 14 || high < h + 14) continue;
    plan.fill(x + between(rng, 6, wide - w - 7), y + between(rng, 6, high - h - 7), w, h, 1);
  }
}

/// A long corridor with rooms to both sides, and one more across it in the middle.
Grid<std::uint8_t> office(Rng rng) {
  const int width = between(rng, 180, 260), half = between(rng, 45, 70), corridor = between(rng, 14, 22);
  Plan plan(width, 2 * half + corridor, 0);
  const int across = between(rng, width / 3, 2 * width / 3);
  plan.fill(0, half - 1, width, 1, 1);
  plan.fill(0, half + corridor, width, 1, 1);
  for (int side = 0; side < 2; ++side) {
    const int low = side == 0 ? 1 : half + corridor + 1, high = half - 2;
    const int wall = side == 0 ? half - 1 : half + corridor;
    for (int x = 1; x < width - 1;) {
      const bool aisle = x < across && x + 30 > across && rng.uniform() < 0.5;
      int wide = aisle ? corridor : between(rng, 25, 60);
      if (width - 1 - x - wide < 25) wide = width - 1 - x;
      plan.fill(x + wide, low, 1, high, 1);
      const int door = between(rng, 8, 12);
      plan.fill(x + between(rng, 3, std::max(3, wide - door - 3)), wall, door, 1, 0);
      if (x > 1 && rng.uniform() < 0.2) plan.fill(x - 1, low + between(rng, 4, high - 16), 1, 10, 0);
      furnish(plan, rng, x, low, wide, high);
      x += wide + 1;
    }
  }
  plan.border();
  return plan.solid;
}

/// Cuts a rectangle into rooms, with a door in each cut and a second one in some.
void cut(Plan& plan, Rng& rng, int x, int y, int wide, int high) {
  constexpr int least = 28;
  const bool upright = wide > high || (wide == high && rng.uniform() < 0.5);
  const int longer = upright ? wide : high, other = upright ? high : wide;
  if (longer < 2 * least + 1 || (longer < 100 && rng.uniform() < 0.15))
    return furnish(plan, rng, x, y, wide, high);
  const int at = between(rng, least, longer - least - 1);
  if (upright) {
    cut(plan, rng, x, y, at, high);
    cut(plan, rng, x + at + 1, y, wide - at - 1, high);
    plan.fill(x + at, y, 1, high, 1);
  } else {
    cut(plan, rng, x, y, wide, at);
    cut(plan, rng, x, y + at + 1, wide, high - at - 1);
    plan.fill(x, y + at, wide, 1, 1);
  }
  const int doors = rng.uniform() < 0.35 ? 2 : 1;
  for (int i = 0; i < doors; ++i) {
    const int size = between(rng, 8, 14), from = between(rng, 2, other - size - 2);
    // A door is free on both sides.
    if (upright)
      plan.fill(x + at - 6, y + from, 13, size, 0);
    else
      plan.fill(x + from, y + at - 6, size, 13, 0);
  }
}

Grid<std::uint8_t> rooms(Rng rng) {
  const int width = between(rng, 150, 220), height = between(rng, 130, 180);
  Plan plan(width, height, 0);
  cut(plan, rng, 1, 1, width - 2, height - 2);
  plan.border();
  return plan.solid;
}

/// A hall with pillars, long shelves and boxes.
Grid<std::uint8_t> hall(Rng rng) {
  const int width = between(rng, 180, 260), height = between(rng, 140, 200);
  Plan plan(width, height, 0);
  const int kind = between(rng, 0, 2);
  const int pitch = between(rng, 30, 45);
  for (int y = pitch; kind == 0 && y + 10 < height; y += pitch) {
    for (int x = pitch; x + 10 < width; x += pitch) plan.fill(x, y, 4, 4, 1);
  }
  for (int y = 15; kind == 1 && y + 20 < height; y += between(rng, 20, 28)) {
    const int gap = between(rng, width / 3, 2 * width / 3);
    plan.fill(15, y, gap - 22, 8, 1);
    plan.fill(gap + 8, y, width - gap - 23, 8, 1);
  }
  for (int i = 0; i < (kind == 2 ? 30 : 8); ++i) {
    plan.fill(between(rng, 8, width - 40), between(rng, 8, height - 40), between(rng, 3, 30),
              between(rng, 3, 30), 1);
  }
  return plan.solid;
}

/// A maze by depth-first search, with some walls taken out.
Grid<std::uint8_t> maze(Rng rng) {
  const int columns = between(rng, 9, 13), rows = between(rng, 8, 11), way = between(rng, 10, 16);
  Plan plan(columns * (way + 1) + 1, rows * (way + 1) + 1, 1);
  const auto open = [&](Cell a, Cell b) {
    const int x = std::min(a.x, b.x), y = std::min(a.y, b.y);
    plan.fill(1 + x * (way + 1), 1 + y * (way + 1), way + (a.x != b.x ? way + 1 : 0),
              way + (a.y != b.y ? way + 1 : 0), 0);
  };
  Grid<std::uint8_t> met(GridFrame{{}, 1.0, columns, rows}, 0);
  std::vector<Cell> stack{{between(rng, 0, columns - 1), between(rng, 0, rows - 1)}};
  met[stack[0]] = 1;
  while (!stack.empty()) {
    std::vector<Cell> next;
    for (const Cell step : four_steps) {
      const Cell to{stack.back().x + step.x, stack.back().y + step.y};
      if (met.contains(to) && met[to] == 0) next.push_back(to);
    }
    if (next.empty()) {
      stack.pop_back();
      continue;
    }
    const Cell to = next[rng.below(next.size())];
    open(stack.back(), to);
    met[to] = 1;
    stack.push_back(to);
  }
  for (int i = between(rng, 0, columns); i > 0; --i) {
    const Cell a{between(rng, 0, columns - 2), between(rng, 0, rows - 2)};
    open(a, rng.uniform() < 0.5 ? Cell{a.x + 1, a.y} : Cell{a.x, a.y + 1});
  }
  plan.border();
  return plan.solid;
}

/// A cave by a cellular automaton on cells of 0.4 m.
Grid<std::uint8_t> cave(Rng rng) {
  constexpr int side = 4;
  const int width = between(rng, 45, 60), height = between(rng, 38, 48);
  Plan coarse(width, height, 0);
  for (std::uint8_t& cell : coarse.solid.cells) cell = rng.uniform() < 0.44 ? 1 : 0;
  for (int round = 0; round < 4; ++round) {
    const Grid<std::uint8_t> before = coarse.solid;
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        int walls = 0;
        for (int k = 0; k < 9; ++k) {
          const Cell at{x + k % 3 - 1, y + k / 3 - 1};
          walls += !before.contains(at) || before[at] != 0 ? 1 : 0;
        }
        coarse.solid[{x, y}] = walls >= 5 ? 1 : 0;
      }
    }
  }
  coarse.border();
  Plan plan(side * width, side * height, 0);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) plan.fill(side * x, side * y, side, side, coarse.solid[{x, y}]);
  }
  return plan.solid;
}

/// Ground strewn with single blocks of 0.2 m.
Grid<std::uint8_t> strewn(Rng rng) {
  const int width = between(rng, 130, 180), height = between(rng, 110, 150);
  Plan plan(width, height, 0);
  const double dense = rng.uniform(0.01, 0.05);
  for (int y = 1; y + 2 < height; y += 2) {
    for (int x = 1; x + 2 < width; x += 2) {
      if (rng.uniform() < dense) plan.fill(x, y, 2, 2, 1);
    }
  }
  return plan.solid;
}

/// A square of a published grid, magnified and closed.
Grid<std::uint8_t> cut_out(const Grid<std::uint8_t>& blocked, int side, int magnified, Rng& rng) {
  const int wide = std::min(side, blocked.frame.width), high = std::min(side, blocked.frame.height);
  const int x0 = between(rng, 0, blocked.frame.width - wide),
            y0 = between(rng, 0, blocked.frame.height - high);
  Plan plan(magnified * wide + 2, magnified * high + 2, 0);
  for (int y = 0; y < high; ++y) {
    for (int x = 0; x < wide; ++x)
      plan.fill(1 + magnified * x, 1 + magnified * y, magnified, magnified,
                blocked[{x0 + x, y0 + y}] != 0 ? 1 : 0);
  }
  plan.border();
  return plan.solid;
}

}  // namespace

std::vector<ExploreMap> generated_explore_maps() {
  struct Kind {
    const char* group;
    Grid<std::uint8_t> (*make)(Rng);
  };
  constexpr Kind kinds[] = {{"office", office}, {"rooms", rooms}, {"hall", hall},
                            {"maze", maze},     {"cave", cave},   {"strewn", strewn}};
  constexpr std::uint64_t each = 5;
  const Rng rng(2040);
  std::vector<ExploreMap> maps;
  for (const Kind& kind : kinds) {
    for (std::uint64_t i = 1; i <= each; ++i)
      maps.push_back(
          {fmt::format("{}{}", kind.group, i), kind.group, kind.make(rng.child(kind.group).child(i))});
  }
  return maps;
}

Outcome<std::vector<ExploreMap>> published_explore_maps(const std::string& folder) {
  constexpr double clearance_m = 0.15;
  constexpr double least_m2 = 60.0;
  auto found = find_grids(folder);
  if (!found) return pass_on(found);
  std::vector<ExploreMap> maps;
  for (const GridFiles& files : *found) {
    auto grid = load_grid(files, 1, false);
    if (!grid) return pass_on(grid);
    Rng rng = Rng(2040).child(files.name);
    for (int i = 0; i < 20; ++i) {
      Grid<std::uint8_t> solid = cut_out(grid->blocked, 50, 4, rng);
      const double m2 = cell_m * cell_m * static_cast<double>(largest_part(solid, clearance_m).size());
      if (m2 < least_m2) continue;
      maps.push_back({files.name, "published", std::move(solid)});
      break;
    }
  }
  return maps;
}

std::vector<std::size_t> part_of(const Grid<std::uint8_t>& blocked, std::size_t from,
                                 Grid<std::uint8_t>& met) {
  std::vector<std::size_t> part{from};
  met.cells[from] = 1;
  for (std::size_t i = 0; i < part.size(); ++i) {
    const Cell at = blocked.frame.cell(part[i]);
    for (const Cell step : four_steps) {
      const Cell next{at.x + step.x, at.y + step.y};
      if (blocked.contains(next) && blocked[next] == 0 && std::exchange(met[next], std::uint8_t{1}) == 0)
        part.push_back(blocked.frame.index(next));
    }
  }
  return part;
}

std::vector<std::size_t> largest_part(const Grid<std::uint8_t>& solid, double clearance_m) {
  const auto blocked = inflated(solid, clearance_m);
  std::vector<std::size_t> largest;
  if (!blocked) return largest;
  Grid<std::uint8_t> met(solid.frame, 0);
  for (std::size_t i = 0; i < solid.cells.size(); ++i) {
    if (blocked->cells[i] != 0 || met.cells[i] != 0) continue;
    std::vector<std::size_t> part = part_of(*blocked, i, met);
    if (part.size() > largest.size()) largest = std::move(part);
  }
  return largest;
}

Vec2 explore_start(const Grid<std::uint8_t>& solid, double clearance_m, std::uint64_t seed) {
  const std::vector<std::size_t> part = largest_part(solid, clearance_m);
  Rng rng = Rng(seed).child("start");
  return part.empty() ? Vec2{} : solid.frame.centre(solid.frame.cell(part[rng.below(part.size())]));
}

}  // namespace outrider::bench
