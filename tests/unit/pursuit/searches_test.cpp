// The searches that prove, each alone and under loose bounds, so that neither hides behind the other.
#include <gtest/gtest.h>

#include <array>

#include "bounds/reach.hpp"
#include "label_search.hpp"
#include "support/pursuit_oracle.hpp"
#include "support/random_cases.hpp"
#include "sweeps/backward_sweep.hpp"

namespace outrider {
namespace {

struct Prepared {
  explicit Prepared(const PursuitProblem& problem) : field(problem), reach(field) {
    BudgetMeter meter{Budget{}};
    while (!reach.complete) reach.next_catch(meter);
    if (reach.catches.empty()) return;
    const std::int64_t dearest = price_parts * std::int64_t{reach.cheapest};
    for (const std::int64_t price : {dearest, dearest - 5, -100 - dearest}) {
      relaxations.push_back(std::make_unique<Relaxation>(field, reach.cells, reach.catches, price));
      relaxations.back()->run(meter);
    }
  }
  PursuitField field;
  Reach reach;
  std::vector<std::unique_ptr<Relaxation>> relaxations;
};

/// Returns the cost of the steps of a way, and of its waits in its cheapest cell; the way leads to the
/// target.
std::uint64_t cost_of(const TimedWay& way, const PursuitField& field) {
  std::uint64_t cost = 0;
  std::uint32_t cheapest = field.costs[way.cells.back()];
  EXPECT_EQ(way.cells.front(), field.start);
  EXPECT_EQ(way.cells.back(), field.target[static_cast<std::size_t>(way.second)]);
  for (std::size_t i = 0; i + 1 < way.cells.size(); ++i) {
    const Cell a = field.cell(way.cells[i]), b = field.cell(way.cells[i + 1]);
    EXPECT_LE(std::max(std::abs(a.x - b.x), std::abs(a.y - b.y)), 1);
    cost += field.costs[way.cells[i]];
    cheapest = std::min(cheapest, field.costs[way.cells[i]]);
  }
  return cost + (static_cast<std::size_t>(way.second) + 1 - way.cells.size()) * cheapest;
}

/// Runs in slices of a few expansions; the bound after the last is the answer, and the last way has it.
template <class Search>
std::uint64_t cost_proven_by(Search& search, const PursuitField& field, std::uint64_t truth) {
  std::uint64_t bound = 0, found = 0;
  while (!search.exhausted()) {
    Budget slice;
    slice.expansions = 7;
    BudgetMeter meter(slice);
    if (const std::optional<TimedWay> way = search.next_better(meter)) found = cost_of(*way, field);
    EXPECT_GE(search.lower_bound(), bound);
    EXPECT_LE(search.lower_bound(), truth);
    bound = search.lower_bound();
  }
  EXPECT_EQ(found, truth);
  return search.lower_bound();
}

/// In slices of a few expansions; the way from the start has the least cost.
void expect_proven_by(BackwardSweep& sweep, const PursuitField& field, std::uint64_t truth,
                      std::uint64_t best) {
  while (sweep.second() > 0) {
    Budget slice;
    slice.expansions = 7;
    BudgetMeter meter(slice);
    sweep.advance(meter, best);
  }
  ASSERT_EQ(sweep.to_go(field.start), truth);
  EXPECT_EQ(cost_of(sweep.way_from(field.start), field), truth);
}

TEST(PursuitSearches, EachAloneProvesTheLeastCost) {
  Rng rng(81);
  int catches = 0;
  for (int k = 0; k < testing::cases(3000) && !::testing::Test::HasFailure(); ++k) {
    SCOPED_TRACE("case " + std::to_string(k));
    const PursuitProblem problem = testing::random_pursuit(rng, 8, 24);
    const auto truth = testing::slow_catch(problem);
    const Prepared with(problem);
    ASSERT_EQ(truth.has_value(), !with.reach.catches.empty());
    if (!truth) continue;
    ++catches;
    EXPECT_EQ(truth->earliest_s, problem.start_s + with.reach.catches.front());
    for (const auto& relaxation : with.relaxations) {
      EXPECT_LE(relaxation->bound(with.field.start, 0), price_parts * static_cast<std::int64_t>(truth->cost));
    }
    const std::uint64_t above = truth->cost + 1 + rng.below(100);
    LabelSearch labels(with.field, with.relaxations, above, std::uint64_t{1} << 40U);
    EXPECT_EQ(cost_proven_by(labels, with.field, truth->cost), truth->cost);
    const auto boxes = pursuit_boxes(with.field, with.reach.catches, with.field.start, 0);
    for (const Processor processor : {Processor::any, fastest_processor()}) {
      const std::uint64_t wider = std::array{0ULL, 1ULL << 17U, 1ULL << 33U}[rng.below(3)];  // than 16 bits
      const AnySweepMap map = sweep_map(with.field, with.reach.catches.front(), above + wider, processor);
      ForwardBound bound(with.field, with.reach.cells, with.field.start, 0, 0,
                         with.relaxations[rng.below(3)]->price());
      BudgetMeter unlimited{Budget{}};
      bound.run(unlimited);
      for (const ForwardBound* from_start : {static_cast<ForwardBound*>(nullptr), &bound}) {
        expect_proven_by(*full_sweep(map, boxes, from_start), with.field, truth->cost, above);
      }
      expect_proven_by(*stored_sweep(map, boxes), with.field, truth->cost, above);
    }
  }
  EXPECT_GT(catches, 500);
}

}  // namespace
}  // namespace outrider
