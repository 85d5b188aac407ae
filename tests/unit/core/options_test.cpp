#include "outrider/core/options.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "outrider/core/units.hpp"

namespace outrider {
namespace {

struct Sample {
  double speed = 2.5;
  double pitch_rad = radians(45.0);
  std::int64_t tries = 3;
  bool strict = false;
  std::string planner = "a_star";
};

std::vector<Option> describe(Sample& sample) {
  return {{"speed", "m/s", 0.0, 10.0, "how fast", &sample.speed},
          {"pitch", "deg", -30.0, 45.0, "how steep", &sample.pitch_rad},
          {"tries", "", 1.0, 9.0, "how often", &sample.tries},
          {"strict", "", 0.0, 0.0, "whether to insist", &sample.strict},
          {"planner", "", 0.0, 0.0, "which one", &sample.planner}};
}

TEST(Options, ReadsEachType) {
  Sample sample;
  const auto options = describe(sample);
  EXPECT_TRUE(assign(options[0], "0.125"));
  EXPECT_TRUE(assign(options[1], "-30"));
  EXPECT_TRUE(assign(options[2], "9"));
  EXPECT_TRUE(assign(options[3], "true"));
  EXPECT_TRUE(assign(options[4], "theta_star"));
  EXPECT_EQ(sample.speed, 0.125);
  EXPECT_DOUBLE_EQ(sample.pitch_rad, -pi / 6);
  EXPECT_EQ(sample.tries, 9);
  EXPECT_TRUE(sample.strict);
  EXPECT_EQ(sample.planner, "theta_star");
}

TEST(Options, NamesTheTypes) {
  Sample sample;
  std::vector<std::string_view> types;
  for (const Option& option : describe(sample)) types.push_back(type_name(option));
  EXPECT_EQ(types, (std::vector<std::string_view>{"number", "number", "integer", "boolean", "string"}));
}

TEST(Options, TheEndsOfARangeBelongToIt) {
  Sample sample;
  const auto options = describe(sample);
  EXPECT_TRUE(assign(options[0], "0"));
  EXPECT_TRUE(assign(options[0], "10"));
  EXPECT_FALSE(assign(options[0], "10.000001"));
  EXPECT_FALSE(assign(options[0], "-0.000001"));
  EXPECT_TRUE(assign(options[2], "1"));
  EXPECT_FALSE(assign(options[2], "0"));
  EXPECT_FALSE(assign(options[2], "10"));
}

TEST(Options, RefusesWhatIsNoFiniteNumber) {
  for (const char* text : {"nan", "NaN", "-nan", "inf", "-inf", "infinity", "1e400", "", " ", " 1", "1 ",
                           "+1", "1,5", "1.5x", "0x10", "one", "--1", "1e"}) {
    Sample sample;
    const auto options = describe(sample);
    EXPECT_FALSE(assign(options[0], text)) << "'" << text << "'";
    EXPECT_FALSE(assign(options[1], text)) << "'" << text << "'";
    EXPECT_FALSE(assign(options[2], text)) << "'" << text << "'";
    EXPECT_FALSE(assign(options[3], text)) << "'" << text << "'";
    EXPECT_EQ(sample.speed, 2.5);
    EXPECT_EQ(sample.pitch_rad, radians(45.0));
    EXPECT_EQ(sample.tries, 3);
  }
}

TEST(Options, AWholeNumberTakesNoFractionAndNoOverflow) {
  for (const char* text : {"2.0", "2.5", "1e0", "99999999999999999999", "-99999999999999999999"}) {
    Sample sample;
    EXPECT_FALSE(assign(describe(sample)[2], text)) << text;
    EXPECT_EQ(sample.tries, 3);
  }
}

TEST(Options, ABooleanIsTrueOrFalse) {
  for (const char* text : {"yes", "1", "True", "TRUE", "on"}) {
    Sample sample;
    EXPECT_FALSE(assign(describe(sample)[3], text)) << text;
  }
}

TEST(Options, TheFaultNamesOptionValueRangeAndUnit) {
  Sample sample;
  const Status status = assign(describe(sample)[1], "50");
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().code, FaultCode::bad_input);
  EXPECT_EQ(to_string(status.error()), "pitch: '50' is not valid; expected a number from -30 to 45 deg");
}

TEST(Options, TextReadsBackTheSame) {
  Sample sample;
  const auto options = describe(sample);
  for (const double value : {0.0, 0.1, 1.0 / 3.0, 2.5, 1e-9, 9.999999999999998}) {
    sample.speed = value;
    ASSERT_TRUE(assign(options[0], value_text(options[0])));
    EXPECT_EQ(sample.speed, value);
  }
  EXPECT_EQ(value_text(options[2]), "3");
  EXPECT_EQ(value_text(options[3]), "false");
  EXPECT_EQ(value_text(options[4]), "a_star");
}

TEST(Options, DegreesReadAsTheyWereWritten) {
  Sample sample;
  const Option option = describe(sample)[1];
  for (const char* text : {"45", "-30", "0", "0.1", "12.345", "-29.999999999", "1e-09"}) {
    ASSERT_TRUE(assign(option, text)) << text;
    EXPECT_EQ(value_text(option), text);
  }
}

TEST(CheckRanges, NamesTheFirstValueOutOfRangeAndItsSection) {
  double speed = 1.0;
  double angle_rad = radians(200.0);
  const std::vector<Option> options = {{"speed", "m/s", 0.0, 2.0, "", &speed},
                                       {"angle", "deg", -180.0, 180.0, "", &angle_rad}};
  EXPECT_EQ(check_ranges(options).error().where, "angle");
  EXPECT_EQ(check_ranges(options, "robot").error().where, "robot.angle");
  angle_rad = radians(-180.0);
  EXPECT_TRUE(check_ranges(options));
  speed = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(check_ranges(options).error().where, "speed");
}

TEST(NearestName, FindsTheMisspelled) {
  const std::vector<std::string> known = {"radius", "resolution", "muzzle_speed", "theta_star"};
  EXPECT_EQ(nearest_name("radus", known), "radius");
  EXPECT_EQ(nearest_name("resolutoin", known), "resolution");
  EXPECT_EQ(nearest_name("muzle_sped", known), "muzzle_speed");
  EXPECT_EQ(nearest_name("thetastar", known), "theta_star");
  EXPECT_EQ(nearest_name("radius", known), "radius");
}

TEST(NearestName, SaysNothingWhenNothingIsClose) {
  EXPECT_EQ(nearest_name("xyzzyplugh", {"radius", "resolution"}), "");
  EXPECT_EQ(nearest_name("radius", {}), "");
}

TEST(NearestName, TheFirstOfEquallyNearWins) {
  EXPECT_EQ(nearest_name("bat", {"cat", "rat", "bar"}), "cat");
  EXPECT_EQ(nearest_name("bat", {"bar", "rat", "cat"}), "bar");
}

struct Row {
  std::string_view name;
  int value = 0;
};

TEST(FindRow, GivesTheRowOfThatName) {
  const std::vector<Row> rows = {{"dijkstra", 1}, {"a_star", 2}};
  const Outcome<Row> row = find_row(rows, "planner", "a_star", "planner");
  ASSERT_TRUE(row);
  EXPECT_EQ(row->value, 2);
}

TEST(FindRow, RefusesAnUnknownNameWithTheNearestOrAll) {
  const std::vector<Row> rows = {{"dijkstra", 1}, {"a_star", 2}};
  const Outcome<Row> misspelled = find_row(rows, "planner", "a_sta", "planner");
  ASSERT_FALSE(misspelled);
  EXPECT_EQ(misspelled.error().sentence, "there is no planner 'a_sta'; did you mean 'a_star'?");
  EXPECT_EQ(misspelled.error().where, "planner");
  const Outcome<Row> strange = find_row(rows, "planner", std::string(1000, 'x'), "planner");
  ASSERT_FALSE(strange);
  EXPECT_EQ(strange.error().sentence,
            "there is no planner '" + std::string(80, 'x') + "...'; take one of dijkstra, a_star");
  const Outcome<Row> many =
      find_row(std::vector<Row>(1000, {"dijkstra", 1}), "planner", "strange", "planner");
  ASSERT_FALSE(many);
  EXPECT_LT(many.error().sentence.size(), 400U);
}

}  // namespace
}  // namespace outrider
