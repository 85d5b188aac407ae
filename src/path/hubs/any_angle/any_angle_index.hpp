// The index of the shortest paths in any direction: hub labels of all corners, or where these do not fit, the
// turns with landmarks.
//
// Thread rule: read-only after construction.
#pragma once

#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <stop_token>
#include <vector>

#include "hub_lists.hpp"
#include "hubs/hub_index.hpp"
#include "hubs/hub_kept.hpp"
#include "hubs/index_bytes.hpp"
#include "hubs/turns/guided_search.hpp"
#include "hubs/turns/taut_sight.hpp"

namespace outrider::hub_labelling {

/// Lengths in any direction; from landmarks in single precision.
struct AnyAngleMetric {
  using Cost = double;
  using Stored = float;
  static double between(Cell a, Cell b) { return length_between(a, b); }
  static double add(double cost, double leg) { return cost + leg; }
  static double cells(double cost) { return cost; }
  static double far() { return std::numeric_limits<double>::infinity(); }
  static Stored none() { return std::numeric_limits<float>::infinity(); }
  static Stored stored(double cost) { return static_cast<float>(cost); }
  static bool known(Stored stored) { return stored < none(); }
  static double length(Stored stored) { return static_cast<double>(stored); }
  static double lead(double a, double b) {
    constexpr double rounding = std::numeric_limits<float>::epsilon();
    return std::abs(a - b) - rounding * (a + b);
  }
};

/// Hub labels of all corners.
struct AnyAngleLabels {
  StoredArray<Cell> turns;
  StoredArray<HubTrees::HubNode> nodes;
  std::vector<TileRow> rows;

  /// Adds the shortest path that turns to `way`; returns false if there is none. O(labels + turns).
  bool find(Cell start, Cell goal, std::vector<Cell>& way) const;
};

/// The turns with landmarks, and the mesh on which a corner sees them.
struct AnyAngleTurns {
  NavigationMesh mesh;
  GuidedGraph<AnyAngleMetric> graph;
};

/// The index, as hub_memory.hpp asks for it.
struct AnyAngleIndex {
  static constexpr std::string_view planner = "hub_labels";
  std::optional<AnyAngleLabels> labels;
  std::unique_ptr<const AnyAngleTurns> turns;  ///< where there are no labels
  std::uint64_t work = 0;
  std::uint64_t work_of_search = 0;

  struct Scratch {
    std::optional<TautSight> sight;
    GuidedMemory<AnyAngleMetric> search;
  };

  /// Builds the index. Returns nothing if it does not fit, or if `stop` is requested. With `try_labels` false
  /// it is one of landmarks on any ground.
  static std::unique_ptr<const AnyAngleIndex> of(const GridMap& ground, std::size_t most_bytes,
                                                 const std::stop_token& stop, bool try_labels = true);
  void write(IndexWriter& writer) const;
  /// Returns nothing if the content contradicts itself or the ground.
  static std::unique_ptr<const AnyAngleIndex> read(IndexReader& reader, const GridMap& ground);

  static bool straight_on(const GridMap& ground, Cell start, Cell goal, std::vector<Cell>& way);
  static bool straight(const GridMap& ground, Cell start, Cell goal, std::vector<Cell>& way) {
    return straight_on(ground, start, goal, way);
  }
  Found find(const GridMap& ground, Cell start, Cell goal, std::vector<Cell>& way, Scratch& scratch,
             BudgetMeter& meter) const;
  static double length_of(const std::vector<Cell>& way);
  static bool none_shorter(std::span<const CellBox> boxes, const std::vector<Cell>& way) {
    return length_of(way) <= least_length_over(boxes, way.front(), way.back());
  }
};

}  // namespace outrider::hub_labelling
