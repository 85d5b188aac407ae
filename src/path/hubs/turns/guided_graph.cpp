#include "guided_graph.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace outrider::hub_labelling {
namespace {

/// Returns the number of the component with the most turns; the first of several.
std::uint32_t largest(const std::vector<std::uint32_t>& component) {
  std::vector<std::uint32_t> turns;
  for (const std::uint32_t number : component) {
    if (number >= turns.size()) turns.resize(number + 1, 0);
    ++turns[number];
  }
  return static_cast<std::uint32_t>(std::max_element(turns.begin(), turns.end()) - turns.begin());
}

}  // namespace

bool worth_guiding(const TurnGraph& graph) {
  constexpr std::size_t most_edges_a_turn = 40;
  std::size_t edges = 0;
  for (std::uint32_t turn = 0; turn < graph.turns(); ++turn) edges += graph.degree(turn);
  return edges <= most_edges_a_turn * graph.turns();
}

std::vector<std::uint32_t> components_of(const TurnGraph& graph) {
  std::vector<std::uint32_t> component(graph.turns(), no_number), stack;
  std::uint32_t count = 0;
  for (std::uint32_t root = 0; root < component.size(); ++root) {
    if (component[root] != no_number) continue;
    component[root] = count;
    stack.assign(1, root);
    while (!stack.empty()) {
      const std::uint32_t turn = stack.back();
      stack.pop_back();
      graph.onward(turn, {}, [&](const TurnGraph::Edge& edge) {
        if (component[edge.to] != no_number) return;
        component[edge.to] = count;
        stack.push_back(edge.to);
      });
    }
    ++count;
  }
  return component;
}

std::vector<std::uint32_t> landmarks_of(const std::vector<Cell>& at,
                                        const std::vector<std::uint32_t>& component) {
  if (at.empty()) return {};
  const std::uint32_t in = largest(component);
  double x = 0.0, y = 0.0, count = 0.0;
  for (std::size_t turn = 0; turn < at.size(); ++turn) {
    if (component[turn] != in) continue;
    x += at[turn].x;
    y += at[turn].y;
    ++count;
  }
  std::array<std::uint32_t, most_landmarks> farthest;
  std::array<double, most_landmarks> distance{};  // squared
  farthest.fill(no_number);
  for (std::uint32_t turn = 0; turn < at.size(); ++turn) {
    if (component[turn] != in) continue;
    const double dx = at[turn].x - x / count, dy = at[turn].y - y / count;
    const double sector = (std::atan2(dy, dx) / std::numbers::pi + 1.0) / 2.0 * farthest.size();
    const std::size_t k = std::min(static_cast<std::size_t>(sector), farthest.size() - 1);
    const double squared = dx * dx + dy * dy;
    if (farthest[k] != no_number && !(squared > distance[k])) continue;
    farthest[k] = turn;
    distance[k] = squared;
  }
  std::vector<std::uint32_t> landmarks(farthest.begin(), farthest.end());
  std::erase(landmarks, no_number);
  return landmarks;
}

}  // namespace outrider::hub_labelling
