#include "outrider/jobs/guard/yard/sightings_file.hpp"

#include <gtest/gtest.h>

namespace outrider {
namespace {

TEST(Sightings, AreReadByIdInTheOrderOfTime) {
  const auto tracks =
      sightings_from_text("t,id,x,y\n0,fox,1,2\n0.5, cat ,3,-4 # it comes\n\n1,fox,1.5,2\r\n", "h");
  ASSERT_TRUE(tracks.has_value()) << tracks.error().sentence;
  ASSERT_EQ(tracks->size(), 2U);
  ASSERT_EQ((*tracks)[0].size(), 2U);
  EXPECT_EQ((*tracks)[0][1].time_s, 1.0);
  EXPECT_EQ((*tracks)[0][1].position, (Vec2{1.5, 2.0}));
  EXPECT_EQ((*tracks)[1][0].position, (Vec2{3.0, -4.0}));
  EXPECT_TRUE(sightings_from_text("", "h")->empty());
}

TEST(Sightings, AreRefusedByLine) {
  for (const char* line :
       {"1,fox,2", "1,fox,2,3,4", "x,fox,2,3", "1,fox,nan,3", "1,,2,3", "1,fox,2,1e9", "1 fox 2 3"}) {
    const auto tracks = sightings_from_text(std::string("0,fox,0,0\n") + line + "\n", "past.csv");
    ASSERT_FALSE(tracks.has_value()) << line;
    EXPECT_EQ(tracks.error().where, "past.csv:2");
    EXPECT_NE(tracks.error().sentence.find("t,id,x,y"), std::string::npos);
  }
  const auto back = sightings_from_text("2,fox,0,0\n1,fox,0,0\n", "past.csv");
  ASSERT_FALSE(back.has_value());
  EXPECT_NE(back.error().sentence.find("sort"), std::string::npos);
}

TEST(Preferences, AreWeightsByName) {
  const std::vector<Target> targets = {{"pond", {}, {}, 0.0}, {"bench", {}, {}, 0.0}};
  EXPECT_EQ(*preferences_from_text("", targets), (std::vector<double>{1.0, 1.0}));
  EXPECT_EQ(*preferences_from_text(" bench=8 ", targets), (std::vector<double>{1.0, 8.0}));
  for (const char* word : {"bench", "bench=x", "bench=-1", "bench=inf", "bank=2", "=1"}) {
    const auto weights = preferences_from_text(word, targets);
    ASSERT_FALSE(weights.has_value()) << word;
    EXPECT_EQ(weights.error().where, "wander.prefers");
  }
  EXPECT_NE(preferences_from_text("bank=2", targets).error().sentence.find("there is no target"),
            std::string::npos);
}

}  // namespace
}  // namespace outrider
