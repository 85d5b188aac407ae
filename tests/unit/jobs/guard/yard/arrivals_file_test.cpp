#include "outrider/jobs/guard/yard/arrivals_file.hpp"

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

}  // namespace
}  // namespace outrider
