#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <map>
#include <set>

#include "outrider/core/rng.hpp"
#include "outrider/search/best_first.hpp"
#include "outrider/search/compact_labels.hpp"
#include "outrider/search/workspace.hpp"

namespace outrider {
namespace {

TEST(BucketQueue, GivesOutInTheOrderOfOneBigHeap) {
  Rng rng = Rng(3).child("queue");
  BucketQueue queue;
  for (int round = 0; round < 200; ++round) {
    const double base = rng.uniform(-5.0, 5.0);
    const double spread = round % 3 == 0 ? 1e9 : rng.uniform(0.01, 300.0);
    const auto order = [](const QueueEntry& a, const QueueEntry& b) { return before(a, b); };
    std::multiset<QueueEntry, decltype(order)> twin(order);
    queue.begin(base);
    for (State i = 0; i < 400; ++i) {
      if (rng.below(3) != 0) {  // some ties, some below the lowest, some far beyond the last bucket
        const double f = base + std::floor(rng.uniform(-0.1, 1.0) * spread * 4.0) / 4.0;
        const auto g = static_cast<double>(rng.below(4));
        queue.push(f, g, i);
        twin.insert({f, g, i, 0});
        continue;
      }
      QueueEntry first;
      ASSERT_EQ(queue.pop(first), !twin.empty());
      if (twin.empty()) continue;
      ASSERT_EQ(first.f, twin.begin()->f);
      ASSERT_EQ(first.g, twin.begin()->g);
      ASSERT_EQ(first.state, twin.begin()->state);
      twin.erase(twin.begin());
    }
  }
}

TEST(BucketQueue, TakesInfinityAndStartsEmptyAgain) {
  BucketQueue queue;
  queue.begin(0.0);
  queue.push(std::numeric_limits<double>::infinity(), 0.0, 1);
  queue.push(2.0, 0.0, 2);
  QueueEntry first;
  ASSERT_TRUE(queue.pop(first));
  EXPECT_EQ(first.state, 2U);
  queue.begin(0.0);
  EXPECT_FALSE(queue.pop(first));
}

TEST(Labels, AreForgottenAtOnce) {
  Labels<double> labels;
  labels.begin(4);
  EXPECT_FALSE(labels.known(2));
  labels.open(2, 1, 5.0);
  EXPECT_TRUE(labels.known(2));
  EXPECT_FALSE(labels.closed(2));
  labels.close(2);
  EXPECT_TRUE(labels.closed(2));
  EXPECT_EQ(labels.parent(2), 1U);
  labels.begin(8);
  for (State s = 0; s < 8; ++s) EXPECT_FALSE(labels.known(s) || labels.closed(s));
}

TEST(CompactLabels, AreForgottenAtOnce) {
  CompactLabels<double> labels;
  labels.begin(4000);
  labels.open(2, 1, 5.0);
  labels.open(3999, 2, 6.0);
  EXPECT_TRUE(labels.known(2) && !labels.closed(2));
  labels.close(2);
  EXPECT_TRUE(labels.closed(2));
  EXPECT_EQ(labels.parent(2), 1U);
  EXPECT_EQ(labels.g(2), 5.0);
  EXPECT_EQ(labels.parent(3999), 2U);
  for (const std::size_t states : {4000U, 8000U}) {
    labels.begin(states);
    for (State s = 0; s < states; ++s) ASSERT_FALSE(labels.known(s) || labels.closed(s));
  }
}

TEST(CompactLabels, KeepTheCostOfAClosedStateUntilItsNeighboursHaveClosed) {
  CompactLabels<double, ClosedCosts::kept> labels;
  labels.begin(10);
  for (State s = 0; s < 3; ++s) {
    labels.open(s, 7, s + 0.5);
    labels.close(s);
    labels.keep_until(s, s);
  }
  EXPECT_EQ(labels.g(1), 1.5);
  EXPECT_EQ(labels.g(2), 2.5);
  labels.count_down(2);
  EXPECT_EQ(labels.g(2), 2.5);
  labels.count_down(2);
  labels.count_down(2);
  for (State s = 0; s < 3; ++s) EXPECT_TRUE(labels.closed(s) && labels.parent(s) == 7);
}

/// Random operations, beside labels of full size.
TEST(CompactLabels, AgreeWithLabels) {
  Rng rng = Rng(4).child("labels");
  CompactLabels<double> compact;
  Labels<double> labels;
  for (int round = 0; round < 200; ++round) {
    const std::size_t states = 1 + rng.below(2000);
    compact.begin(states);
    labels.begin(states);
    for (int i = 0; i < 400; ++i) {
      const auto s = static_cast<State>(rng.below(states)), parent = static_cast<State>(rng.below(states));
      int met = 0, met_compact = 0;
      const auto g = static_cast<double>(rng.below(50));
      ASSERT_EQ(compact.offer(s, parent, g, [&] { ++met_compact; }),
                labels.offer<false>(s, parent, g, [&] { ++met; }));
      ASSERT_EQ(met_compact, met);
      const auto other = static_cast<State>(rng.below(states));
      if (labels.known(other) && !labels.closed(other)) {
        ASSERT_EQ(compact.g(other), labels.g(other));
        compact.close(other);
        labels.close(other);
        ASSERT_EQ(compact.g(other), labels.g(other));
      }
      ASSERT_EQ(compact.known(other), labels.known(other));
      ASSERT_EQ(compact.closed(other), labels.closed(other));
      if (!labels.known(other)) continue;
      ASSERT_EQ(compact.parent(other), labels.parent(other));
    }
  }
}

TEST(Workspace, KeepsOneMemoryOfEachType) {
  Workspace workspace;
  workspace.get<std::vector<int>>().assign(3, 7);
  workspace.get<std::vector<double>>().assign(2, 1.0);
  EXPECT_EQ(workspace.get<std::vector<int>>(), std::vector<int>(3, 7));
  EXPECT_EQ(workspace.get<std::vector<double>>().size(), 2U);
}

/// A random directed graph with whole costs; state 0 to the last.
struct GraphPolicy {
  using Cost = std::int64_t;
  struct Edge {
    State to;
    Cost cost;
  };
  const std::vector<std::vector<Edge>>& edges;
  const std::vector<Cost>& to_goal;  ///< h
  const Labels<Cost>& labels;
  std::uint64_t expanded = 0;

  [[nodiscard]] std::size_t states() const { return edges.size(); }
  [[nodiscard]] static State start() { return 0; }
  [[nodiscard]] bool is_goal(State s) const { return s + 1 == edges.size(); }
  [[nodiscard]] Cost estimate(State s) const { return to_goal[s]; }
  [[nodiscard]] static double value(Cost cost) { return static_cast<double>(cost); }
  [[nodiscard]] static double priority(Cost g, Cost h) { return static_cast<double>(g + h); }
  static void settle(State /*s*/) {}
  template <class Relax>
  void expand(State s, Relax& relax) {
    ++expanded;
    for (const Edge& edge : edges[s]) relax(edge.to, s, labels.g(s) + edge.cost, to_goal[edge.to]);
  }
};

constexpr std::int64_t infinite = std::numeric_limits<std::int32_t>::max();

/// Bellman and Ford: cost from every state to the last.
std::vector<std::int64_t> costs_to_last(const std::vector<std::vector<GraphPolicy::Edge>>& edges) {
  std::vector<std::int64_t> cost(edges.size(), infinite);
  cost.back() = 0;
  for (std::size_t round = 0; round < edges.size(); ++round) {
    for (std::size_t s = 0; s < edges.size(); ++s) {
      for (const auto& edge : edges[s]) cost[s] = std::min(cost[s], edge.cost + cost[edge.to]);
    }
  }
  return cost;
}

/// When each state was first met, of what was expanded in which order; the last is not expanded.
std::map<State, std::uint32_t> first_met(const std::vector<std::vector<GraphPolicy::Edge>>& edges,
                                         const std::vector<Expansion>& expansions) {
  std::map<State, std::uint32_t> met{{0, 0}};
  for (std::size_t k = 0; k < expansions.size(); ++k) {
    if (expansions[k].state + 1 == edges.size()) continue;
    for (const auto& edge : edges[expansions[k].state])
      met.emplace(edge.to, static_cast<std::uint32_t>(k + 1));
  }
  return met;
}

std::map<State, std::uint32_t> openings_of(const Trace& trace) {
  std::map<State, std::uint32_t> met;
  for (const Opening& opening : trace.openings) EXPECT_TRUE(met.emplace(opening.state, opening.after).second);
  return met;
}

TEST(BestFirst, IsLeastOnRandomGraphsWithAnyConsistentEstimate) {
  Rng rng = Rng(5).child("graphs");
  SearchMemory<std::int64_t> memory;
  for (int i = 0; i < 1000; ++i) {
    std::vector<std::vector<GraphPolicy::Edge>> edges(2 + rng.below(20));
    for (auto& from : edges) {
      for (std::uint64_t k = rng.below(4); k > 0; --k) {
        from.push_back(
            {static_cast<State>(rng.below(edges.size())), static_cast<std::int64_t>(rng.below(50))});
      }
    }
    const auto exact = costs_to_last(edges);
    std::vector<std::int64_t> half(exact);
    const std::int64_t parts = 1 + static_cast<std::int64_t>(rng.below(3));
    for (auto& h : half) h = (h + parts - 1) / parts;  // consistent: rounding up keeps the triangle rule
    GraphPolicy policy{edges, half, memory.labels};
    BudgetMeter meter{Budget{}};
    Trace trace;
    const auto found = best_first(policy, memory, meter, &trace);
    ASSERT_EQ(openings_of(trace), first_met(edges, trace.expansions));
    ASSERT_EQ(found.has_value(), exact[0] < infinite);
    if (!found) {
      ASSERT_EQ(found.error().code, FaultCode::no_path);
      continue;
    }
    ASSERT_EQ(memory.labels.g(*found), exact[0]);
    const auto path = path_to(*found, memory.labels);
    ASSERT_EQ(path.front(), 0U);
    ASSERT_EQ(path.back(), edges.size() - 1);
    ASSERT_EQ(trace.expansions.size(), policy.expanded + 1);
    for (std::size_t k = 1; k < trace.expansions.size(); ++k) {
      ASSERT_GE(trace.expansions[k].f, trace.expansions[k - 1].f);
    }
  }
}

TEST(Trace, RecordsNoMoreThanItsMost) {
  Trace trace;
  trace.most = 2;
  for (State s = 0; s < 5; ++s) trace.record({s, s, 0.0, 0.0, 0.0});
  EXPECT_EQ(trace.expansions.size(), 2U);
  EXPECT_EQ(trace.expansions.back().state, 1U);
  trace.open(9);
  EXPECT_TRUE(trace.openings.empty());
}

}  // namespace
}  // namespace outrider
