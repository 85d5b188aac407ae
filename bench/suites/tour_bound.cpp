#include "tour_bound.hpp"

#include <algorithm>
#include <limits>

namespace outrider {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The length of the round that goes to the nearest stop first.
double greedy_round(const StopDistances& distances, std::vector<std::size_t> stops) {
  double length = 0.0;
  for (std::size_t i = 0; i + 1 < stops.size(); ++i) {
    const auto next = std::min_element(
        stops.begin() + static_cast<std::ptrdiff_t>(i) + 1, stops.end(),
        [&](std::size_t a, std::size_t b) { return distances[stops[i]][a] < distances[stops[i]][b]; });
    std::iter_swap(stops.begin() + static_cast<std::ptrdiff_t>(i) + 1, next);
    length += distances[stops[i]][stops[i + 1]];
  }
  return length + distances[stops.back()][stops.front()];
}

/// A least 1-tree under prices: its length with them, and the edges of each stop.
struct OneTree {
  double length = 0.0;
  std::vector<int> degree;
};

OneTree least_one_tree(const StopDistances& distances, const std::vector<std::size_t>& stops,
                       const std::vector<double>& price) {
  const std::size_t n = stops.size();
  OneTree tree{0.0, std::vector<int>(n, 0)};
  const auto edge = [&](std::size_t i, std::size_t j) {
    return distances[stops[i]][stops[j]] + price[i] + price[j];
  };
  std::vector<double> away(n, infinity);
  std::vector<std::size_t> from(n, 1);
  std::vector<bool> in(n, false);
  std::size_t last = 1;  // Prim's algorithm over all but stop 0
  for (std::size_t count = 2; count < n; ++count) {
    in[last] = true;
    std::size_t next = 0;
    for (std::size_t j = 1; j < n; ++j) {
      if (in[j]) continue;
      if (const double length = edge(last, j); length < away[j]) {
        away[j] = length;
        from[j] = last;
      }
      if (next == 0 || away[j] < away[next]) next = j;
    }
    tree.length += away[next];
    ++tree.degree[next];
    ++tree.degree[from[next]];
    last = next;
  }
  std::size_t a = 1, b = n > 2 ? 2 : 1;  // the two nearest of stop 0
  if (edge(0, b) < edge(0, a)) std::swap(a, b);
  for (std::size_t j = 3; j < n; ++j) {
    if (edge(0, j) < edge(0, a)) {
      b = a;
      a = j;
    } else if (edge(0, j) < edge(0, b)) {
      b = j;
    }
  }
  tree.length += edge(0, a) + edge(0, b);
  tree.degree[0] = 2;
  ++tree.degree[a];
  ++tree.degree[b];
  return tree;
}

}  // namespace

double tour_bound(const StopDistances& distances, const std::vector<std::size_t>& stops, int rounds) {
  std::vector<double> price(stops.size(), 0.0);
  const double most = greedy_round(distances, stops);
  double best = 0.0, ambition = 1.0;
  for (int round = 0; round < rounds; ++round) {
    const OneTree tree = least_one_tree(distances, stops, price);
    double bound = tree.length;
    int off = 0;
    for (std::size_t i = 0; i < stops.size(); ++i) {
      bound -= 2.0 * price[i];
      off += (tree.degree[i] - 2) * (tree.degree[i] - 2);
    }
    best = std::max(best, bound);
    if (off == 0) return best;  // a round, and the shortest
    const double step = ambition * std::max(0.0, most - bound) / off;
    for (std::size_t i = 0; i < stops.size(); ++i) price[i] += step * (tree.degree[i] - 2);
    ambition *= 0.96;
  }
  return best;
}

double best_tour_bound(const StopDistances& distances, std::vector<std::size_t>& stops) {
  constexpr int quick = 40, thorough = 200;
  double best = tour_bound(distances, stops, quick);
  for (bool better = true; better && stops.size() > 2;) {
    better = false;
    for (std::size_t i = stops.size() - 1; i > 0 && stops.size() > 2; --i) {
      std::vector<std::size_t> fewer = stops;
      fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(i));
      const double bound = tour_bound(distances, fewer, quick);
      if (bound <= best) continue;
      best = bound;
      stops = std::move(fewer);
      better = true;
    }
  }
  return std::max(best, tour_bound(distances, stops, thorough));
}

}  // namespace outrider
