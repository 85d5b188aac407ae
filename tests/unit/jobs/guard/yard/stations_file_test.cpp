#include "outrider/jobs/guard/yard/stations_file.hpp"

#include <gtest/gtest.h>

namespace outrider {
namespace {

const Box2 bounds{{-5.0, -5.0}, {5.0, 5.0}};

TEST(Stations, AreReadWithWhatTheyGive) {
  const auto stations = stations_from_text("well=-2,3,water dock=0,+1.5,charge\thut=4,4,both", bounds);
  ASSERT_TRUE(stations) << stations.error().sentence;
  ASSERT_EQ(stations->size(), 3U);
  EXPECT_EQ((*stations)[0].name, "well");
  EXPECT_EQ((*stations)[0].position, (Vec2{-2.0, 3.0}));
  EXPECT_TRUE((*stations)[0].gives_water && !(*stations)[0].gives_charge);
  EXPECT_TRUE(!(*stations)[1].gives_water && (*stations)[1].gives_charge);
  EXPECT_TRUE((*stations)[2].gives_water && (*stations)[2].gives_charge);
  EXPECT_TRUE(stations_from_text("", bounds)->empty());
}

TEST(Stations, OfAnotherFormAreRefused) {
  for (const char* text : {"well", "well=1,2", "well=1,2,", "well=1,2,beer", "=1,2,water", "well=1,x,water",
                           "well=1,2,water,charge", "well=nan,2,water"}) {
    const auto stations = stations_from_text(text, bounds);
    ASSERT_FALSE(stations) << text;
    EXPECT_EQ(stations.error().where, "supplies.stations");
    EXPECT_NE(stations.error().sentence.find("name=x,y,water"), std::string::npos);
  }
  EXPECT_NE(stations_from_text("a=9,0,both", bounds).error().sentence.find("outside the yard"),
            std::string::npos);
  EXPECT_NE(stations_from_text("a=1,0,both a=2,0,water", bounds).error().sentence.find("twice"),
            std::string::npos);
}

}  // namespace
}  // namespace outrider
