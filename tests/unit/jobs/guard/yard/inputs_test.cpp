#include "outrider/jobs/guard/yard/inputs.hpp"

#include <gtest/gtest.h>

namespace outrider {
namespace {

const Box2 square{{-5, -5}, {5, 5}};

GuardProblem two_targets() {
  GuardProblem problem;
  problem.world.bounds = square;
  problem.targets = {{"garfield", {3, 4, 0}, {0.5, 0.2, 0.4}, 0.0}, {"tom", {0, 0, 0}, {0.5, 0.2, 0.4}, 0.0}};
  return problem;
}

Outcome<std::vector<Intruder>> read(const std::string& text) {
  const auto doors = entrances_from_text("gate=0,0 gap=-5,2", square);
  return arrivals_from_text(text, "list.txt", two_targets(), *doors, ArrivalOptions{});
}

TEST(Arrivals, AreReadInTheOrderOfEntering) {
  const auto list =
      read("# who comes\n\nt=12.5 at=garfield by=gate  # late\nby=gap at=tom t=3\nt=13 at=tom by=gate\n");
  ASSERT_TRUE(list.has_value()) << to_string(list.error());
  ASSERT_EQ(list->size(), 3U);
  EXPECT_EQ((*list)[0].name, "tom");
  EXPECT_EQ((*list)[0].entrance, "gap");
  EXPECT_EQ((*list)[1].name, "garfield");
  EXPECT_EQ((*list)[1].enters_s, 12.5);
  EXPECT_EQ((*list)[1].settles_s, 17.5);  // 5 m at 1 m/s
  EXPECT_EQ((*list)[2].name, "tom_2");
}

TEST(Arrivals, NameTheLineAndTheWord) {
  const std::vector<std::pair<std::string, std::string>> wrong = {
      {"t=-1 at=tom by=gate", "t=-1"},        {"t=soon at=tom by=gate", "t=soon"},
      {"t=1 at=tim by=gate", "'tim'"},        {"t=1 at=tom by=gat", "did you mean 'gate'"},
      {"t=1 at=tom", "something is missing"}, {"t=1 at=tom by=gate by=gap", "'by=gap'"},
      {"t=1 at=tom by=gate x=2", "'x=2'"},    {"t at=tom by=gate", "'t'"},
  };
  for (const auto& [line, part] : wrong) {
    const auto list = read("\n" + line + "\n");
    ASSERT_FALSE(list.has_value()) << line;
    EXPECT_EQ(list.error().where, "list.txt:2") << line;
    EXPECT_NE(list.error().sentence.find(part), std::string::npos) << list.error().sentence;
  }
}

TEST(Entrances, NameWhatIsWrong) {
  EXPECT_TRUE(entrances_from_text("", square)->empty());
  const std::vector<std::pair<std::string, std::string>> wrong = {
      {"gate", "name=x,y"},
      {"=1,2", "name=x,y"},
      {"gate=1", "name=x,y"},
      {"gate=1,2,3", "name=x,y"},
      {"gate=9,0", "outside the yard"},
      {"a=0,0 a=1,1", "twice"},
  };
  for (const auto& [text, part] : wrong) {
    const auto entrances = entrances_from_text(text, square);
    ASSERT_FALSE(entrances.has_value()) << text;
    EXPECT_EQ(entrances.error().where, "arrivals.entrances");
    EXPECT_NE(entrances.error().sentence.find(part), std::string::npos) << entrances.error().sentence;
  }
}

TEST(Arrivals, AScenarioWithoutThemHasNone) {
  EXPECT_TRUE(load_arrivals(two_targets(), ArrivalOptions{}, 1)->empty());
  ArrivalOptions options;
  options.policy = "whenever";
  EXPECT_EQ(load_arrivals(two_targets(), options, 1).error().where, "arrivals.policy");
  options = {};
  options.objective = "fun";
  EXPECT_EQ(load_arrivals(two_targets(), options, 1).error().where, "arrivals.objective");
}

TEST(Stations, AreReadWithWhatTheyGive) {
  const auto stations = stations_from_text("well=-2,3,water dock=0,+1.5,charge\thut=4,4,both", square);
  ASSERT_TRUE(stations) << stations.error().sentence;
  ASSERT_EQ(stations->size(), 3U);
  EXPECT_EQ((*stations)[0].name, "well");
  EXPECT_EQ((*stations)[0].position, (Vec2{-2.0, 3.0}));
  EXPECT_TRUE((*stations)[0].gives_water && !(*stations)[0].gives_charge);
  EXPECT_TRUE(!(*stations)[1].gives_water && (*stations)[1].gives_charge);
  EXPECT_TRUE((*stations)[2].gives_water && (*stations)[2].gives_charge);
  EXPECT_TRUE(stations_from_text("", square)->empty());
}

TEST(Stations, OfAnotherFormAreRefused) {
  for (const char* text : {"well", "well=1,2", "well=1,2,", "well=1,2,beer", "=1,2,water", "well=1,x,water",
                           "well=1,2,water,charge", "well=nan,2,water"}) {
    const auto stations = stations_from_text(text, square);
    ASSERT_FALSE(stations) << text;
    EXPECT_EQ(stations.error().where, "supplies.stations");
    EXPECT_NE(stations.error().sentence.find("name=x,y,water"), std::string::npos);
  }
  EXPECT_NE(stations_from_text("a=9,0,both", square).error().sentence.find("outside the yard"),
            std::string::npos);
  EXPECT_NE(stations_from_text("a=1,0,both a=2,0,water", square).error().sentence.find("twice"),
            std::string::npos);
}

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

std::string refusal(const std::string& text, std::int64_t robots) {
  const auto starts = parse_starts(text, robots);
  if (starts) return {};
  EXPECT_EQ(starts.error().code, FaultCode::bad_input);
  EXPECT_EQ(starts.error().where, "robot_starts");
  return starts.error().sentence;
}

TEST(ParseStarts, ReadsPosesAndCountsThem) {
  const auto starts = parse_starts("1,2,90; -3,0.5,-180", 3);
  ASSERT_TRUE(starts) << starts.error().sentence;
  ASSERT_EQ(starts->size(), 2U);
  EXPECT_EQ((*starts)[0].position, (Vec2{1, 2}));
  EXPECT_NEAR((*starts)[0].heading_rad, pi / 2, 1e-12);
  EXPECT_TRUE(parse_starts("", 4).value().empty());
  EXPECT_EQ(refusal("1,2,90", 3), "1 start for 3 robots, of which the first has start; give 2 or none");
  EXPECT_EQ(refusal("1,2,90", 1),
            "1 start for 1 robot, of which the first has start; leave robot_starts out or set robots");
  for (const char* wrong : {"1,2", "1,2,nan", "1,2,3,4", "; 1,2,90", "a", "1,2,1e99"})
    EXPECT_NE(refusal(wrong, 2).find("is not valid"), std::string::npos) << wrong;
}

}  // namespace
}  // namespace outrider
