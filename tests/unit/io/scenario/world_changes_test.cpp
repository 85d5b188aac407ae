#include "outrider/io/scenario/world_changes.hpp"

#include <gtest/gtest.h>

#include "outrider/core/units.hpp"

namespace outrider {
namespace {

TEST(WorldChanges, TheTextsReadBackToTheSame) {
  const WorldChanges changes{{{"box_-1.000,2=3", {{0.1, -2.5e-3}, pi / 2}}, {"a b", {{1e5, 2}, -0.3}}},
                             {"x", "y z"}};
  const auto again = changes_from_text(moved_text(changes.moved), removed_text(changes.removed));
  ASSERT_TRUE(again.has_value());
  ASSERT_EQ(again->moved.size(), 2U);
  EXPECT_EQ(again->removed, changes.removed);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(again->moved[i].name, changes.moved[i].name);
    EXPECT_EQ(again->moved[i].place.position, changes.moved[i].place.position);
    EXPECT_NEAR(again->moved[i].place.heading_rad, changes.moved[i].place.heading_rad, 1e-10);
  }
  EXPECT_NE(moved_text(changes.moved).find(",90;"), std::string::npos);
  EXPECT_EQ(moved_text({}), "");
}

TEST(WorldChanges, NamesMayHaveBlanksAroundThem) {
  const auto changes = changes_from_text("shed/side=0,0,0; bench_2 = 1,2,3", " bench ;");
  ASSERT_TRUE(changes.has_value()) << changes.error().sentence;
  ASSERT_EQ(changes->moved.size(), 2U);
  EXPECT_EQ(changes->moved[1].name, "bench_2");
  EXPECT_EQ(changes->removed, std::vector<std::string>{"bench"});
}

TEST(WorldChanges, WrongWordsAreRefusedWithTheKeyAndWhatWouldBeRight) {
  EXPECT_EQ(
      to_string(changes_from_text("bench", "").error()),
      "moved: 'bench' is not valid; write name=x,y,turn, such as bench=1.5,-2,90; several with ; between");
  EXPECT_EQ(to_string(changes_from_text("bench=1,2", "").error()),
            "moved: '1,2' is not valid; expected x,y,turn in m, m and degrees, such as bench=1.5,-2,90");
}

}  // namespace
}  // namespace outrider
