#include "outrider/io/scenario/targets.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/data.hpp"

namespace outrider {
namespace {

std::string targets_fault(std::string_view text) {
  const auto targets = targets_from_text(text, "cats.txt");
  return targets ? "none" : to_string(targets.error());
}

TEST(Targets, StandOnTheFloorUnlessTheySayWhere) {
  World raised;
  raised.floor_z_m = 0.05;
  const auto targets = targets_from_text("type=1 x=1 y=2\ntype=1 x=1 y=2 z=0\n", "t", raised);
  ASSERT_TRUE(targets);
  EXPECT_EQ((*targets)[0].base.z, 0.05);
  EXPECT_EQ((*targets)[1].base.z, 0.0);
}

TEST(Targets, ReadsKeysInAnyOrderWithCommentsAndBlankLines) {
  const auto targets = targets_from_text(
      "# cats\n\n y=2\tx=+1 type=2 # on the roof\r\n  rz=-0.5 z=1.5 x=-3 y=4 type=1\ntype=2 x=0 y=0\n"
      "size=1,2,3 x=0 y=0\nname=fox size=0.1,0.2,0.3 type=4 x=1e1 y=.5",
      "cats.txt");
  ASSERT_TRUE(targets) << to_string(targets.error());
  ASSERT_EQ(targets->size(), 5U);
  const auto& all = *targets;
  EXPECT_EQ(all[0].name, "2_0");
  EXPECT_EQ(all[0].base, (Vec3{1, 2, 0}));
  EXPECT_EQ(all[0].size, (Vec3{0.46, 0.36, 0.178}));
  EXPECT_EQ(all[1].name, "1_0");
  EXPECT_EQ(all[1].base, (Vec3{-3, 4, 1.5}));
  EXPECT_EQ(all[1].yaw_rad, -0.5);
  EXPECT_EQ(all[2].name, "2_1");
  EXPECT_EQ(all[3].name, "target_0");
  EXPECT_EQ(all[3].size, (Vec3{1, 2, 3}));
  EXPECT_EQ(all[4].name, "fox");
  EXPECT_EQ(all[4].size, (Vec3{0.1, 0.2, 0.3}));
  EXPECT_EQ(all[4].base, (Vec3{10, 0.5, 0}));
}

TEST(Targets, FaultsNameTheLineTheTextAndTheRemedy) {
  EXPECT_EQ(targets_fault("type=1 x=1 y=1\ntype=1 x=1\n"), "cats.txt:2: y is missing; write y=<metres>");
  EXPECT_EQ(targets_fault("typ=1 x=1 y=1"), "cats.txt:1: 'typ' is no key of a target; did you mean 'type'?");
  EXPECT_EQ(targets_fault("type=7 x=1 y=1"), "cats.txt:1: type=7 is unknown; types are 1 to 4");
  EXPECT_EQ(targets_fault("type=1 x=1 y=nan"),
            "cats.txt:1: y=nan is not valid; expected a number from -1e6 to 1e6");
  for (const char* bad : {"type=1 x=1 y=inf", "type=1 x=1 y=1e7", "type=1 x=1 y=2 y=2", "type=1 x=1 y=2 3",
                          "x=1 y=1", "size=1,1 x=1 y=1", "size=1,1,0 x=1 y=1", "size=1,1,1,1 x=1 y=1",
                          "size=1,1,1e9 x=1 y=1", "type=1.5 x=1 y=1", "type= x=1 y=1", "type=1 x=1 y=1 name=",
                          "type=1 x=1 y=1 name=a\xff", "type=1 x=0x10 y=1", "type=1 x=+-1 y=1"}) {
    EXPECT_TRUE(targets_fault(bad).starts_with("cats.txt:1: ")) << bad << " -> " << targets_fault(bad);
  }
  EXPECT_TRUE(targets_fault("# nothing\n").starts_with("cats.txt: it holds no target"));
  EXPECT_TRUE(targets_fault("type=1 x=1 y=1 name=a\ntype=1 x=1 y=1 name=a").starts_with("cats.txt:2: "));
}

TEST(Targets, CountIsBounded) {
  std::string text;
  for (int i = 0; i <= 100'000; ++i) text += "type=1 x=1 y=1\n";
  EXPECT_NE(targets_fault(text).find("100000"), std::string::npos);
}

TEST(Targets, PublishedListHas24) {
  const auto path = test::data_folder() / "guard" / "goals_params.txt";
  OUTRIDER_NEEDS_DATA(path);
  const auto targets = load_targets(path.string());
  ASSERT_TRUE(targets) << to_string(targets.error());
  ASSERT_EQ(targets->size(), 24U);
  EXPECT_EQ(targets->front().name, "1_0");
  EXPECT_EQ(targets->front().base, (Vec3{-6.5, 6.5, 1.5}));
  EXPECT_EQ(targets->back().name, "4_5");
  EXPECT_EQ(targets->back().base, (Vec3{9, 2, 0}));
}

TEST(Targets, TextReadsBackAsTheSameTargets) {
  const auto targets =
      targets_from_text("type=1 x=-6.5 y=0.1 z=1.5 rz=3.1416\nsize=0.4,0.3,0.2 name=fox x=2e-7 y=1\n", "t");
  ASSERT_TRUE(targets);
  const auto back = targets_from_text(targets_text(*targets), "text");
  ASSERT_TRUE(back) << to_string(back.error());
  ASSERT_EQ(back->size(), targets->size());
  for (std::size_t i = 0; i < targets->size(); ++i) {
    const Target &one = (*targets)[i], &other = (*back)[i];
    EXPECT_EQ(other.name, one.name);
    EXPECT_EQ(other.base, one.base);
    EXPECT_EQ(other.size, one.size);
    EXPECT_EQ(other.yaw_rad, one.yaw_rad);
  }
}

TEST(Targets, SurvivesDamage) {
  Rng rng(1);
  const std::string good = "type=1 x=-6.5 y=6.5 z=1.5\n# a\nsize=0.4,0.3,0.2 name=fox x=2 y=1 rz=3.14\n";
  for (int i = 0; i < 20'000; ++i) {
    const auto targets = targets_from_text(test::damaged(good, rng), "t");
    if (!targets) continue;
    for (const Target& target : *targets) {
      EXPECT_GT(target.size.x, 0.0);
      EXPECT_TRUE(std::isfinite(target.base.x) && std::isfinite(target.yaw_rad));
    }
  }
}

}  // namespace
}  // namespace outrider
