#include "outrider/jobs/guard/plan/bound.hpp"

#include <gtest/gtest.h>

#include <map>

#include "support/random_cases.hpp"

namespace outrider {
namespace {

using testing::cases;

/// The least sum of completion times when one unit of some job is done, or nothing, in each unit of time.
int brute_force(const std::vector<int>& releases, std::vector<int> left, int now,
                std::map<std::pair<std::vector<int>, int>, int>& known) {
  if (std::all_of(left.begin(), left.end(), [](int w) { return w == 0; })) return 0;
  const auto [entry, fresh] = known.try_emplace({left, now}, 0);
  if (!fresh) return entry->second;
  int best = now < 30 ? brute_force(releases, left, now + 1, known) : 1'000'000;
  for (std::size_t i = 0; i < left.size(); ++i) {
    if (left[i] == 0 || releases[i] > now) continue;
    auto next = left;
    --next[i];
    const int ends = next[i] == 0 ? now + 1 : 0;
    best = std::min(best, ends + brute_force(releases, next, now + 1, known));
  }
  known[{left, now}] = best;
  return best;
}

TEST(LeastCompletionSum, IsTheOptimumOfInterruptibleJobs) {
  Rng rng(41);
  for (int i = 0; i < cases(100); ++i) {
    std::vector<int> releases;
    std::vector<int> works;
    std::vector<ReleasedWork> jobs;
    for (std::size_t k = 0; k < 1 + rng.below(4); ++k) {
      releases.push_back(static_cast<int>(rng.below(8)));
      works.push_back(1 + static_cast<int>(rng.below(4)));
      jobs.push_back({static_cast<double>(releases.back()), static_cast<double>(works.back())});
    }
    std::map<std::pair<std::vector<int>, int>, int> known;
    EXPECT_EQ(least_completion_sum(jobs), brute_force(releases, works, 0, known));
  }
  EXPECT_EQ(least_completion_sum({}), 0.0);
}

}  // namespace
}  // namespace outrider
