#include "exposure_bound.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <queue>

namespace outrider {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();
constexpr int block = 8;  // cells along a side that share a list of near edges
constexpr int most_marches = 8;
constexpr double good_excess = 1.0005;

struct MarchLattice {
  Vec2 origin;
  double cell_m = 1.0;
  int width = 0, height = 0;  ///< cells

  [[nodiscard]] std::size_t cell(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }
  [[nodiscard]] std::size_t node(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width + 1) + static_cast<std::size_t>(x);
  }
  [[nodiscard]] Vec2 at(double x, double y) const { return origin + cell_m * Vec2{x, y}; }
  /// Returns the cell of a point and where in it the point lies.
  [[nodiscard]] std::pair<std::array<int, 2>, Vec2> place(Vec2 p) const {
    const Vec2 q = (1.0 / cell_m) * (p - origin);
    const int x = std::clamp(static_cast<int>(std::floor(q.x)), 0, width - 1);
    const int y = std::clamp(static_cast<int>(std::floor(q.y)), 0, height - 1);
    return {{x, y}, q - Vec2{static_cast<double>(x), static_cast<double>(y)}};
  }
};

MarchLattice lattice_of(const PolygonGround& ground, int cells) {
  const Vec2 size = ground.bounds.size();
  MarchLattice lattice;
  lattice.cell_m = std::max(size.x, size.y) / cells;
  lattice.origin = ground.bounds.low;
  lattice.width = std::max(1, static_cast<int>(std::ceil(size.x / lattice.cell_m)));
  lattice.height = std::max(1, static_cast<int>(std::ceil(size.y / lattice.cell_m)));
  return lattice;
}

/// Returns an upper bound of the distance to the nearest edge within a cell, by the edges nearest to its
/// corners.
double most_clearance(const std::array<Vec2, 4>& corners, const std::array<const Segment*, 4>& nearest) {
  std::array<std::array<double, 4>, 4> away{};
  for (std::size_t k = 0; k < 4; ++k) {
    for (std::size_t c = 0; c < 4; ++c) away[k][c] = distance(corners[c], *nearest[k]);
  }
  double most = never;
  for (std::size_t k = 0; k < 4; ++k) {
    if (k > 0 && nearest[k] == nearest[k - 1]) continue;
    for (std::size_t l = k; l < 4; ++l) {
      if (l > k && nearest[l] == nearest[k]) continue;
      for (const double share : {0.5, 0.25, 0.75}) {
        double largest = 0.0;
        for (std::size_t c = 0; c < 4; ++c)
          largest = std::max(largest, (1.0 - share) * away[k][c] + share * away[l][c]);
        most = std::min(most, largest);
        if (l == k) break;
      }
    }
  }
  return most;
}

/// Returns for each cell the least cost of a metre in it, or 0 where no path keeps its clearance.
std::vector<double> least_costs(const ExposureQuestion& question, const MarchLattice& lattice) {
  const PolygonGround& ground = question.ground;
  std::vector<double> costs(lattice.cell(0, lattice.height), 0.0);
  const double half_diagonal = std::sqrt(0.5) * lattice.cell_m;
  std::vector<const Segment*> near;
  for (int by = 0; by < lattice.height && !question.stop.stop_requested(); by += block) {
    for (int bx = 0; bx < lattice.width; bx += block) {
      const Vec2 middle = lattice.at(bx + 0.5 * block, by + 0.5 * block);
      const double reach = ground.edge_distance(middle) + 2.001 * block * half_diagonal;
      near.clear();
      for (const Segment& edge : ground.edges) {
        if (distance(middle, edge) <= reach) near.push_back(&edge);
      }
      std::array<std::array<const Segment*, block + 1>, block + 1> nearest{};
      for (int y = 0; y <= block; ++y) {
        for (int x = 0; x <= block; ++x) {
          const Vec2 corner = lattice.at(bx + x, by + y);
          nearest[static_cast<std::size_t>(y)][static_cast<std::size_t>(x)] =
              *std::ranges::min_element(near, {}, [&](const Segment* s) { return distance(corner, *s); });
        }
      }
      for (int y = by; y < std::min(by + block, lattice.height); ++y) {
        for (int x = bx; x < std::min(bx + block, lattice.width); ++x) {
          const std::array<Vec2, 4> corners{lattice.at(x, y), lattice.at(x + 1, y), lattice.at(x + 1, y + 1),
                                            lattice.at(x, y + 1)};
          const auto u = static_cast<std::size_t>(x - bx), v = static_cast<std::size_t>(y - by);
          const double clearance = most_clearance(
              corners, {nearest[v][u], nearest[v][u + 1], nearest[v + 1][u + 1], nearest[v + 1][u]});
          if (clearance < question.least_m) continue;
          const Vec2 centre = lattice.at(x + 0.5, y + 0.5);
          const bool by_edge = std::ranges::any_of(
              near, [&](const Segment* s) { return distance(centre, *s) <= half_diagonal; });
          if (!by_edge && ground.solid(centre)) continue;
          costs[lattice.cell(x, y)] = 1.0 + question.weight_m / clearance;
        }
      }
    }
  }
  return costs;
}

/// The fast marching method from the corners of the cell of the start, until those of the goal are known.
class March {
 public:
  March(const MarchLattice& lattice, const std::vector<double>& costs) : lattice_(lattice), costs_(costs) {
    cost_.assign(lattice.node(0, lattice.height + 1), never);
    for_each_cell([&](int x, int y, double cost) {
      for (const std::size_t node : nodes_of(x, y)) cost_[node] = std::min(cost_[node], cost);
    });
  }

  void run(Vec2 start, Vec2 goal, const std::stop_token& stop) {
    value_.assign(cost_.size(), never);
    known_.assign(cost_.size(), 0);
    heap_ = {};
    const auto [from, inside] = lattice_.place(start);
    const std::array<Vec2, 4> offsets{Vec2{0, 0}, Vec2{1, 0}, Vec2{1, 1}, Vec2{0, 1}};
    const auto sources = nodes_of(from[0], from[1]);
    for (std::size_t c = 0; c < 4; ++c)
      offer(sources[c], lattice_.cell_m * cost_[sources[c]] * distance(offsets[c], inside));
    const auto [to, there] = lattice_.place(goal);
    const auto goals = nodes_of(to[0], to[1]);
    double reached = 0.0;
    const auto arrived = [&] {
      return stop.stop_requested() ||
             std::ranges::all_of(goals, [&](std::size_t n) { return known_[n] != 0; });
    };
    while (!heap_.empty() && !arrived()) {
      const auto [value, node] = heap_.top();
      heap_.pop();
      if (known_[node] != 0) continue;
      known_[node] = 1;
      reached = value;
      const int x = static_cast<int>(node) % (lattice_.width + 1),
                y = static_cast<int>(node) / (lattice_.width + 1);
      for (const auto& [nx, ny] : {std::pair{x + 1, y}, {x - 1, y}, {x, y + 1}, {x, y - 1}}) update(nx, ny);
    }
    for (double& value : value_) value = std::min(value, reached);
  }

  /// Returns the largest slope in a cell, for a value bilinear in it.
  [[nodiscard]] double slope(int x, int y) const {
    const auto [a, b, c, d] = nodes_of(x, y);
    const auto most = [](double one, double other) { return std::max(std::abs(one), std::abs(other)); };
    return std::hypot(most(value_[b] - value_[a], value_[c] - value_[d]),
                      most(value_[d] - value_[a], value_[c] - value_[b])) /
           lattice_.cell_m;
  }
  /// Lowers the cost where the slope is above the least cost. Returns the largest ratio of the two.
  double relax() {
    double excess = 1.0;
    for_each_cell([&](int x, int y, double cost) {
      const double ratio = slope(x, y) / cost;
      excess = std::max(excess, ratio);
      if (ratio <= 1.0) return;
      for (const std::size_t node : nodes_of(x, y)) lower_.push_back({node, cost_[node] / ratio});
    });
    for (const auto& [node, cost] : lower_) cost_[node] = std::min(cost_[node], cost);
    lower_.clear();
    return excess;
  }
  [[nodiscard]] double value(Vec2 p) const {
    const auto [cell, in] = lattice_.place(p);
    const auto [a, b, c, d] = nodes_of(cell[0], cell[1]);
    return (1.0 - in.y) * ((1.0 - in.x) * value_[a] + in.x * value_[b]) +
           in.y * ((1.0 - in.x) * value_[d] + in.x * value_[c]);
  }

 private:
  template <class Visit>
  void for_each_cell(Visit visit) const {
    for (int y = 0; y < lattice_.height; ++y) {
      for (int x = 0; x < lattice_.width; ++x) {
        if (const double cost = costs_[lattice_.cell(x, y)]; cost > 0.0) visit(x, y, cost);
      }
    }
  }
  [[nodiscard]] std::array<std::size_t, 4> nodes_of(int x, int y) const {
    return {lattice_.node(x, y), lattice_.node(x + 1, y), lattice_.node(x + 1, y + 1),
            lattice_.node(x, y + 1)};
  }
  void offer(std::size_t node, double value) {
    if (!(value < value_[node])) return;
    value_[node] = value;
    heap_.push({value, node});
  }
  [[nodiscard]] double known(int x, int y) const {
    if (x < 0 || y < 0 || x > lattice_.width || y > lattice_.height) return never;
    const std::size_t node = lattice_.node(x, y);
    return known_[node] != 0 ? value_[node] : never;
  }
  void update(int x, int y) {
    if (x < 0 || y < 0 || x > lattice_.width || y > lattice_.height) return;
    const std::size_t node = lattice_.node(x, y);
    if (known_[node] != 0 || !(cost_[node] < never)) return;
    const double across = std::min(known(x - 1, y), known(x + 1, y));
    const double up = std::min(known(x, y - 1), known(x, y + 1));
    const double low = std::min(across, up), high = std::max(across, up);
    const double step = lattice_.cell_m * cost_[node];
    double value = low + step;
    if (high < value) value = 0.5 * (low + high + std::sqrt(2.0 * step * step - (high - low) * (high - low)));
    offer(node, value);
  }

  struct Entry {
    double value;
    std::size_t node;
    bool operator<(const Entry& other) const {  // the heap gives the largest first
      return value != other.value ? value > other.value : node > other.node;
    }
  };
  const MarchLattice& lattice_;
  const std::vector<double>& costs_;
  std::vector<double> cost_;   // of a metre at each node; infinite where none is near
  std::vector<double> value_;  // of u
  std::vector<std::uint8_t> known_;
  std::priority_queue<Entry> heap_;
  std::vector<std::pair<std::size_t, double>> lower_;
};

}  // namespace

double least_cost_bound(const ExposureQuestion& question, int cells) {
  const MarchLattice lattice = lattice_of(question.ground, cells);
  const std::vector<double> costs = least_costs(question, lattice);
  March march(lattice, costs);
  double best = 0.0;
  for (int round = 0; round < most_marches; ++round) {
    march.run(question.start, question.goal, question.stop);
    if (question.stop.stop_requested()) return 0.0;
    const double rise = march.value(question.goal) - march.value(question.start);
    const double excess = march.relax();
    if (std::isfinite(rise)) best = std::max(best, rise / excess);
    if (excess <= good_excess) break;
  }
  return best;
}

}  // namespace outrider
