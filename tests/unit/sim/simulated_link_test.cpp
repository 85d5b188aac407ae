#include "outrider/sim/simulated_link.hpp"

#include <gtest/gtest.h>

#include <set>
#include <vector>

namespace outrider {
namespace {

/// Returns what arrives of the messages 0 to 99, one of which is sent every 0.1 s.
std::vector<int> arrived(const LinkFaults& faults) {
  SimulatedLink<int> link(faults, Rng(1));
  std::vector<int> messages;
  for (int i = 0; i < 200; ++i) {
    if (i < 100) link.send(0.1 * i, i);
    while (const auto message = link.take(0.1 * i)) messages.push_back(*message);
  }
  return messages;
}

TEST(SimulatedLink, WithoutFaultsEachArrivesAtOnceInOrder) {
  const std::vector<int> messages = arrived({});
  ASSERT_EQ(messages.size(), 100u);
  EXPECT_TRUE(std::ranges::is_sorted(messages));
}

TEST(SimulatedLink, WhileItIsDownNothingArrives) {
  LinkFaults faults;
  faults.down_from_s = 2.0;
  faults.down_for_s = 3.0;
  const std::vector<int> messages = arrived(faults);
  EXPECT_EQ(messages.size(), 70u);
  EXPECT_TRUE(std::ranges::none_of(messages, [](int m) { return m > 20 && m < 50; }));
}

TEST(SimulatedLink, JitterKeepsTheOrder) {
  LinkFaults faults;
  faults.jitter_s = 1.0;
  const std::vector<int> messages = arrived(faults);
  EXPECT_EQ(messages.size(), 100u);
  EXPECT_TRUE(std::ranges::is_sorted(messages));
}

TEST(SimulatedLink, SomeArriveTwice) {
  LinkFaults faults;
  faults.repeated = 0.3;
  const std::vector<int> messages = arrived(faults);
  EXPECT_GT(messages.size(), 115u);
  EXPECT_LT(messages.size(), 145u);
  EXPECT_EQ(std::set<int>(messages.begin(), messages.end()).size(), 100u);
}

TEST(SimulatedLink, SomeAreOvertaken) {
  LinkFaults faults;
  faults.reordered = 0.3;
  const std::vector<int> messages = arrived(faults);
  EXPECT_EQ(messages.size(), 100u);
  EXPECT_FALSE(std::ranges::is_sorted(messages));
}

}  // namespace
}  // namespace outrider
