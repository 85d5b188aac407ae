// Route: a tour as one sequence of nodes. Neighbours with the same stop are one visit, so a route is a
// path of the generalised travelling salesman problem, and a change of it is a splice.
#pragma once

#include <span>
#include <vector>

#include "instance.hpp"

namespace outrider::tour {

struct Route {
  std::vector<std::uint32_t> nodes;
  std::vector<State> after;              // position -> state once its node is served
  std::vector<double> step;              // position -> time from the one before
  std::vector<std::uint32_t> visit_end;  // position -> last position of its visit
  double cost = 0.0;

  [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(nodes.size()); }
};

/// Fills everything from `nodes`. O(n).
void refresh(const Instance& instance, Route& route);

/// The change of cost when the nodes at [begin, end) are replaced. The route is fresh. Exact: after the
/// next drive but one, headings and aims are as before. O(end - begin + size of replacement).
double splice_cost(const Instance& instance, const Route& route, std::uint32_t begin, std::uint32_t end,
                   std::span<const std::uint32_t> replacement);

/// Replaces the nodes at [begin, end) of a fresh route, and refreshes what changes. O(n) sums; drives and
/// aims only until all is as before.
void splice(const Instance& instance, Route& route, std::uint32_t begin, std::uint32_t end,
            std::span<const std::uint32_t> replacement);

struct Insertion {
  double cost = infinity;   // added to the route
  double score = infinity;  // what was minimised
  std::uint32_t position = 0;
  std::uint32_t node = none;
};

/// The best place and node for a goal: in a visit that can serve it, or in a new visit. The score of a
/// new visit is its cost divided by 1 + `sharing` times the number in `company` of its stop: how many
/// other goals that wait could join. `company` is indexed by stop. O(nodes of the goal * visits).
Insertion best_insertion(const Instance& instance, const Route& route, std::uint32_t goal, double sharing,
                         std::span<const std::uint32_t> company);

/// The same as far as it concerns the positions [begin, end), where `begin` and `end` are the first ones of
/// visits or the size of the route, and `end` is one more if the end of the route counts. Replaces `best`
/// where an insertion has a lower score.
void find_better(const Instance& instance, const Route& route, std::uint32_t goal, double sharing,
                 std::span<const std::uint32_t> company, std::uint32_t begin, std::uint32_t end,
                 Insertion& best);

}  // namespace outrider::tour
