#include "outrider/world/free_parts.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "outrider/core/rng.hpp"
#include "outrider/geometry/convex.hpp"
#include "outrider/world/occupancy.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

using Ring = std::vector<Vec2>;

/// Walls in any direction, specks of what is occupied and of what is unknown.
Grid<std::uint8_t> random_map(Rng& rng) {
  GridFrame frame;
  frame.origin = {rng.uniform(-30.0, 30.0), rng.uniform(-30.0, 30.0)};
  frame.resolution_m = rng.below(2) == 0 ? 0.05 : rng.uniform(0.01, 1.0);
  frame.width = 4 + static_cast<int>(rng.below(50));
  frame.height = 4 + static_cast<int>(rng.below(50));
  Grid<std::uint8_t> map(frame);
  const double specks = rng.below(3) == 0 ? 0.4 : rng.uniform(0.0, 0.05);
  for (auto& cell : map.cells) {
    if (rng.uniform() < specks) cell = rng.below(2) == 0 ? occupied_cell : unknown_cell;
  }
  for (std::uint64_t walls = rng.below(5); walls > 0; --walls) {
    const auto anywhere = [&] {
      return Vec2{rng.uniform(-5.0, frame.width + 5.0), rng.uniform(-5.0, frame.height + 5.0)};
    };
    const Segment wall{anywhere(), anywhere()};
    for (std::size_t i = 0; i < frame.size(); ++i) {
      const Cell cell = frame.cell(i);
      if (distance(Vec2{cell.x + 0.5, cell.y + 0.5}, wall) < 1.2) map.cells[i] = occupied_cell;
    }
  }
  return map;
}

/// Counts crossings of a ray to the right.
bool in_ring(const Ring& ring, Vec2 p) {
  bool inside = false;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2 a = ring[i], b = ring[(i + 1) % ring.size()];
    if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)) inside = !inside;
  }
  return inside;
}

std::vector<Ring> rings_of(const FreeOutline& outline) {
  std::vector<Ring> rings = outline.holes;
  rings.push_back(outline.boundary);
  return rings;
}

bool in_outline(const FreeOutline& outline, Vec2 p) {
  bool inside = false;
  for (const Ring& ring : rings_of(outline)) inside = inside != in_ring(ring, p);
  return inside;
}

double distance_to(const FreeOutline& outline, Vec2 p) {
  double least = in_outline(outline, p) ? 0.0 : 1e9;
  for (const Ring& ring : rings_of(outline)) {
    for (std::size_t i = 0; i < ring.size(); ++i)
      least = std::min(least, distance(p, Segment{ring[i], ring[(i + 1) % ring.size()]}));
  }
  return least;
}

/// Calls `look` at the points of a raster that is finer than the cells, which includes points near corners.
void each_point(const GridFrame& frame, const std::function<void(Vec2, Cell)>& look) {
  for (std::size_t i = 0; i < frame.size(); ++i) {
    const Cell cell = frame.cell(i);
    for (const double x : {0.01, 0.35, 0.65, 0.99}) {
      for (const double y : {0.01, 0.35, 0.65, 0.99})
        look(frame.corner(cell) + frame.resolution_m * Vec2{x, y}, cell);
    }
  }
}

TEST(FreeParts, OutlinesLieInsideTheFreeSpaceAndLoseLittle) {
  Rng rng = Rng(4).child("outlines");
  int cut = 0;
  for (int i = 0; i < testing::cases(150); ++i) {
    const Grid<std::uint8_t> map = random_map(rng);
    const double tolerance_m = i % 4 == 0 ? 0.0 : rng.uniform(0.0, 4.0) * map.frame.resolution_m;
    const FreeParts parts = free_parts(map);
    for (std::size_t part = 0; part < parts.cells.size() && part < 2; ++part) {
      const FreeOutline outline = outline_of(parts, part, tolerance_m);
      cut += tolerance_m > 0.0 && outline.boundary.size() < outline_of(parts, part, 0.0).boundary.size();
      each_point(map.frame, [&](Vec2 p, Cell cell) {
        const bool free = map[cell] == free_cell;
        const bool in_part = parts.part[cell] == static_cast<std::int32_t>(part);
        if (in_outline(outline, p)) {
          ASSERT_TRUE(free && in_part) << "map " << i << ": " << p.x << ", " << p.y;
        } else if (in_part) {
          ASSERT_LE(distance_to(outline, p), tolerance_m + 1e-9) << "map " << i;
        }
      });
    }
  }
  EXPECT_GT(cut, 20);
}

TEST(FreeParts, PolygonsAreSimpleAndApart) {
  Rng rng = Rng(5).child("simple");
  for (int i = 0; i < testing::cases(60); ++i) {
    const Grid<std::uint8_t> map = random_map(rng);
    const FreeParts parts = free_parts(map);
    if (parts.cells.empty()) continue;
    const FreeOutline outline = outline_of(parts, 0, rng.uniform(0.0, 3.0) * map.frame.resolution_m);
    struct Edge {
      Segment segment;
      std::size_t ring, index, of;
    };
    std::vector<Edge> edges;
    const std::vector<Ring> rings = rings_of(outline);
    for (std::size_t r = 0; r < rings.size(); ++r) {
      ASSERT_GE(rings[r].size(), 3U);
      for (std::size_t k = 0; k < rings[r].size(); ++k)
        edges.push_back({{rings[r][k], rings[r][(k + 1) % rings[r].size()]}, r, k, rings[r].size()});
    }
    for (std::size_t a = 0; a < edges.size(); ++a) {
      for (std::size_t b = a + 1; b < edges.size(); ++b) {
        const bool follow =
            edges[a].ring == edges[b].ring && (edges[a].index + 1 == edges[b].index ||
                                               (edges[a].index == 0 && edges[b].index + 1 == edges[b].of));
        if (follow) continue;
        ASSERT_GT(distance(edges[a].segment, edges[b].segment), 1e-9) << "map " << i;
      }
    }
  }
}

TEST(FreeParts, CellsThatMeetAtACornerAreNotConnected) {
  GridFrame frame;
  frame.width = frame.height = 2;
  Grid<std::uint8_t> map(frame);
  map.cells = {free_cell, occupied_cell, unknown_cell, free_cell};
  const FreeParts parts = free_parts(map);
  ASSERT_EQ(parts.cells.size(), 1U);
  EXPECT_EQ(parts.cells[0], 1U);
}

TEST(FreeParts, AWallAlongADiagonalIsOneEdge) {
  GridFrame frame;
  frame.width = frame.height = 40;
  Grid<std::uint8_t> map(frame);
  for (std::size_t i = 0; i < frame.size(); ++i) map.cells[i] = frame.cell(i).x < frame.cell(i).y;
  EXPECT_GT(outline_of(free_parts(map), 0, 0.0).boundary.size(), 70U);
  EXPECT_LE(outline_of(free_parts(map), 0, 1.0).boundary.size(), 6U);
}

/// The disk at every point of a fine raster at which it lies in free space.
TEST(ReachOfDisk, LosesNothingThatTheDiskTouches) {
  Rng rng = Rng(6).child("reach");
  int gone = 0;
  for (int i = 0; i < testing::cases(40); ++i) {
    Grid<std::uint8_t> map = random_map(rng);
    const GridFrame& frame = map.frame;
    const double radius = rng.uniform(0.0, 4.0);  // cells
    const Grid<std::uint8_t> reached = reach_of_disk(map, radius * frame.resolution_m);
    const auto away = [](Vec2 p, Cell cell) {
      const double dx = std::max({cell.x - p.x, 0.0, p.x - cell.x - 1.0});
      const double dy = std::max({cell.y - p.y, 0.0, p.y - cell.y - 1.0});
      return std::hypot(dx, dy);
    };
    const auto each_near = [&](Vec2 p, const std::function<void(Cell)>& look) {
      for (int y = static_cast<int>(p.y - radius) - 1; y <= p.y + radius + 1; ++y) {
        for (int x = static_cast<int>(p.x - radius) - 1; x <= p.x + radius + 1; ++x) {
          if (away(p, {x, y}) < radius - 1e-9) look({x, y});
        }
      }
    };
    for (double y = 0.05; y < frame.height; y += 0.3) {
      for (double x = 0.05; x < frame.width; x += 0.3) {
        bool stands = true;
        each_near({x, y},
                  [&](Cell cell) { stands = stands && map.contains(cell) && map[cell] == free_cell; });
        if (!stands) continue;
        each_near({x, y}, [&](Cell cell) { ASSERT_EQ(reached[cell], free_cell) << "map " << i; });
      }
    }
    gone += map.cells != reached.cells;
    for (std::size_t k = 0; k < map.cells.size(); ++k) {
      if (map.cells[k] != free_cell) {
        ASSERT_EQ(reached.cells[k], map.cells[k]);
      }
    }
  }
  EXPECT_GT(gone, 10);
}

}  // namespace
}  // namespace outrider
