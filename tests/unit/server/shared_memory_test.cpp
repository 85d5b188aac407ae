#include <gtest/gtest.h>

#include <thread>

#include "byte_budget.hpp"
#include "planning/workspace_pool.hpp"

namespace outrider::server {
namespace {

TEST(ByteBudget, GivesNoMoreThanThereIsAndTakesItBack) {
  ByteBudget budget(100);
  auto first = budget.take(60);
  ASSERT_TRUE(first);
  EXPECT_FALSE(budget.take(41));
  EXPECT_TRUE(budget.grow(*first, 40));
  EXPECT_FALSE(budget.grow(*first, 1));
  ByteBudget::Lease moved = std::move(*first);
  first.reset();
  EXPECT_FALSE(budget.take(1)) << "a lease that was moved still holds";
  moved = {};
  EXPECT_TRUE(budget.take(100));
  ByteBudget::Lease empty;
  EXPECT_TRUE(budget.grow(empty, 100));
  EXPECT_FALSE(budget.take(1));
}

TEST(ByteBudget, HoldsWhoeverTakes) {
  ByteBudget budget(1000);
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i) {
    threads.emplace_back([&] {
      for (int k = 0; k < 10'000; ++k) (void)budget.take(300);
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_TRUE(budget.take(1000)) << "all was given back";
}

struct Kept {
  int of = 0;
};

TEST(WorkspacePool, WhoComesBackFindsWhatWasBuiltForThem) {
  WorkspacePool pool(2);
  const int a = 0, b = 0, c = 0;
  const auto ask = [&](const void* user, int mark) {
    auto lease = pool.take(user, std::chrono::milliseconds(0), 0, {});
    return std::exchange(lease->workspace().get<Kept>().of, mark);
  };
  EXPECT_EQ(ask(&a, 1), 0);
  EXPECT_EQ(ask(&b, 2), 0);
  EXPECT_EQ(ask(&a, 1), 1);
  EXPECT_EQ(ask(&c, 3), 2) << "the one that was used least lately";
  EXPECT_EQ(ask(&a, 1), 1);
}

TEST(WorkspacePool, WaitsForAPlaceAsLongAsItIsTold) {
  using std::chrono::milliseconds;
  WorkspacePool pool(1);
  auto taken = pool.take(nullptr, milliseconds(0), 0, {});
  ASSERT_TRUE(taken);
  EXPECT_FALSE(pool.take(nullptr, milliseconds(10), 5, {})) << "the time is over";
  EXPECT_FALSE(pool.take(nullptr, std::chrono::hours(1), 0, {})) << "nobody else may wait";
  std::stop_source stop;
  std::thread stopper([&] { stop.request_stop(); });
  EXPECT_FALSE(pool.take(nullptr, std::chrono::hours(1), 5, stop.get_token()));
  stopper.join();
  std::thread giver([&, lease = std::move(*taken)]() mutable { const auto given_back = std::move(lease); });
  EXPECT_TRUE(pool.take(nullptr, std::chrono::hours(1), 5, {}));
  giver.join();
}

}  // namespace
}  // namespace outrider::server
