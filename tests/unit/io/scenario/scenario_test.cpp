#include "outrider/io/scenario/scenario.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "outrider/core/units.hpp"
#include "support/data.hpp"

namespace outrider {
namespace {

struct Settings {
  std::int64_t seed = 3;
  std::string world = "yard.sdf";
  double radius_m = 0.26;
  double pitch_rad = radians(45);
  bool block = false;

  std::vector<OptionGroup> groups() {
    return {{"",
             "The job.",
             {{"seed", "", 0, 1e18, "seed of every random draw", &seed},
              {"world", "", 0, 0, "world file: SDF | map", &world}}},
            {"robot",
             "The robot.",
             {{"radius", "m", 0.01, 10, "radius of the disk", &radius_m},
              {"pitch", "deg", -30, 60, "highest pitch", &pitch_rad},
              {"block", "", 0, 0, "targets block", &block}}},
            {"gun", "The gun.", {}}};
  }
};

std::string scenario_fault(const std::string& text) {
  Settings settings;
  const auto status = scenario_from_text(text, "s.yaml", settings.groups());
  return status ? "none" : to_string(status.error());
}

TEST(Scenario, AssignsByGroupAndKeepsTheRest) {
  Settings settings;
  const auto status =
      scenario_from_text("seed: 7\nrobot:\n  pitch: 30\n  block: true\ngun:\n", "s", settings.groups());
  ASSERT_TRUE(status) << to_string(status.error());
  EXPECT_EQ(settings.seed, 7);
  EXPECT_DOUBLE_EQ(settings.pitch_rad, radians(30));
  EXPECT_TRUE(settings.block);
  EXPECT_EQ(settings.radius_m, 0.26);
  EXPECT_TRUE(scenario_from_text("", "s", settings.groups()));
  EXPECT_TRUE(scenario_from_text("# only a comment\n", "s", settings.groups()));
  EXPECT_TRUE(scenario_from_text("world: 0,-9.5,90\n", "s", settings.groups()));
  EXPECT_EQ(settings.world, "0,-9.5,90");
}

TEST(Scenario, FaultsNameLineKeyAndRemedy) {
  EXPECT_EQ(scenario_fault("seed: 1\nsed: 2\n"), "s.yaml:2: 'sed' is no known key; did you mean 'seed'?");
  EXPECT_EQ(scenario_fault("robo:\n  radius: 1\n"),
            "s.yaml:1: 'robo' is no known key; did you mean 'robot'?");
  EXPECT_EQ(scenario_fault("robot:\n  radios: 1\n"),
            "s.yaml:2: 'robot.radios' is no known key; did you mean 'radius'?");
  EXPECT_EQ(scenario_fault("seed: 1\nseed: 2\n"), "s.yaml:2: the key 'seed' is given twice; leave one");
  EXPECT_EQ(scenario_fault("robot:\n  radius: 11\n"),
            "s.yaml:2: robot.radius: '11' is not valid; expected a number from 0.01 to 10 m");
}

TEST(Scenario, ALongListOfKnownKeysIsCut) {
  std::vector<std::int64_t> values(60);
  OptionGroup group{"", "The job.", {}};
  for (std::size_t i = 0; i < values.size(); ++i)
    group.options.push_back({fmt::format("alternative_{}", i), "", 0, 1e9, "a number", &values[i]});
  const auto status = scenario_from_text("quux: 1\n", "s", {group});
  ASSERT_FALSE(status);
  const std::string sentence = to_string(status.error());
  EXPECT_LT(sentence.size(), 300U) << sentence;
  EXPECT_NE(sentence.find("alternative_0, alternative_1, "), std::string::npos) << sentence;
  EXPECT_NE(sentence.find(" more"), std::string::npos) << sentence;
}

TEST(Scenario, RefusesWrongTypesAndValues) {
  for (const char* bad : {"robot:\n  radius: nan\n",
                          "robot:\n  radius: .inf\n",
                          "robot:\n  radius: 1e999\n",
                          "robot:\n  radius: x\n",
                          "robot:\n  radius: \"1\"\n",
                          "robot:\n  radius: [1]\n",
                          "robot:\n  radius: {a: 1}\n",
                          "robot:\n  radius:\n",
                          "robot:\n  block: 1\n",
                          "robot:\n  block: yes\n",
                          "seed: 1.5\n",
                          "seed: -1\n",
                          "seed: 99999999999999999999\n",
                          "robot: 3\n",
                          "robot: [1]\n",
                          "gun:\n  power: 1\n",
                          "world: \"a\\u0001b\"\n",
                          "- 1\n",
                          "3\n",
                          "robot:\n  radius: 1\n  radius: 1\n",
                          "a: b: c\n",
                          "? [a]\n: 1\n",
                          "seed: 1\n---\nseed: 2\n",
                          "robot: &a\n  radius: *a\n"}) {
    EXPECT_TRUE(scenario_fault(bad).starts_with("s.yaml")) << bad << " -> " << scenario_fault(bad);
  }
  EXPECT_NE(scenario_fault(std::string(2'000'000, '#')).find("1 MiB"), std::string::npos);
  EXPECT_NE(scenario_fault("seed: " + std::string(100'000, '[')), "none");
}

TEST(Scenario, FaultLeavesEveryOptionAsItWas) {
  Settings settings;
  ASSERT_FALSE(
      scenario_from_text("seed: 9\nworld: a\nrobot:\n  radius: 1\n  pitch: 10\n  block: true\n  x: 1\n", "s",
                         settings.groups()));
  EXPECT_EQ(settings.seed, 3);
  EXPECT_EQ(settings.world, "yard.sdf");
  EXPECT_EQ(settings.radius_m, 0.26);
  EXPECT_EQ(settings.pitch_rad, radians(45));
  EXPECT_FALSE(settings.block);
}

TEST(Scenario, TextReadsBackToTheSameValues) {
  Rng rng(11);
  for (int i = 0; i < 300; ++i) {
    Settings written;
    written.seed = static_cast<std::int64_t>(rng.below(1'000'000'000'000'000));
    written.radius_m = rng.uniform(0.01, 10.0);
    written.pitch_rad = radians(std::round(rng.uniform(-30.0, 60.0) * 1e6) / 1e6);
    written.block = rng.below(2) == 1;
    written.world.clear();
    const std::string letters = "ab: #'\"\\-[]{}|>&*!%@`~,\xc3\xa9 1.e";
    for (std::uint64_t n = rng.below(12); n > 0; --n) written.world += letters[rng.below(22)];
    if (rng.below(2) == 0) written.world += "\xc3\xa9";
    Settings read;
    const std::string text = scenario_text(written.groups());
    const auto status = scenario_from_text(text, "s", read.groups());
    ASSERT_TRUE(status) << to_string(status.error()) << "\n" << text;
    EXPECT_EQ(read.seed, written.seed);
    EXPECT_EQ(read.world, written.world);
    EXPECT_EQ(read.radius_m, written.radius_m);
    EXPECT_NEAR(read.pitch_rad, written.pitch_rad, 1e-15);
    EXPECT_EQ(read.block, written.block);
  }
}

TEST(Scenario, ChangesHoldWhatDiffersAndNoMore) {
  Settings usual, changed;
  EXPECT_EQ(scenario_changes(changed.groups(), usual.groups()), "");
  changed.world = "a \"b\".sdf";
  changed.pitch_rad = radians(30);
  const std::string text = scenario_changes(changed.groups(), usual.groups());
  EXPECT_EQ(text, "world: \"a \\\"b\\\".sdf\"\n\nrobot:\n  pitch: 30\n");
  Settings back;
  ASSERT_TRUE(scenario_from_text(text, "s.yaml", back.groups()));
  EXPECT_EQ(back.world, changed.world);
  EXPECT_EQ(back.pitch_rad, changed.pitch_rad);
  EXPECT_EQ(back.radius_m, usual.radius_m);
}

TEST(Scenario, TextExplainsItself) {
  Settings settings;
  const std::string text = scenario_text(settings.groups());
  EXPECT_NE(text.find("# seed of every random draw [0 to 1e+18]\nseed: 3\n"), std::string::npos) << text;
  EXPECT_NE(text.find("\n# The robot.\nrobot:\n  # radius of the disk [m, 0.01 to 10]\n  radius: 0.26\n"),
            std::string::npos)
      << text;
}

TEST(Scenario, SchemaSaysTypesRangesAndDefaults) {
  Settings settings;
  const auto schema = nlohmann::json::parse(scenario_schema(settings.groups(), "Guard a yard"));
  EXPECT_EQ(schema["$schema"], "https://json-schema.org/draft/2020-12/schema");
  EXPECT_EQ(schema["title"], "Guard a yard");
  EXPECT_EQ(schema["additionalProperties"], false);
  EXPECT_EQ(schema["properties"]["seed"]["type"], "integer");
  EXPECT_EQ(schema["properties"]["seed"]["maximum"], std::int64_t{1'000'000'000'000'000'000});
  EXPECT_EQ(schema["properties"]["world"]["default"], "yard.sdf");
  EXPECT_FALSE(schema["properties"]["world"].contains("minimum"));
  const auto& robot = schema["properties"]["robot"];
  EXPECT_EQ(robot["type"], "object");
  EXPECT_EQ(robot["additionalProperties"], false);
  EXPECT_EQ(robot["properties"]["pitch"]["default"], 45);
  EXPECT_EQ(robot["properties"]["pitch"]["maximum"], 60);
  EXPECT_EQ(robot["properties"]["radius"]["description"], "radius of the disk (m)");
  EXPECT_EQ(robot["properties"]["block"]["default"], false);
}

TEST(Scenario, MarkdownHasARowForEachOption) {
  Settings settings;
  const std::string text = options_markdown(settings.groups());
  EXPECT_NE(text.find("| `radius` | `0.26` | m | 0.01 to 10 | radius of the disk |"), std::string::npos)
      << text;
  EXPECT_NE(text.find("world file: SDF \\| map"), std::string::npos);
  EXPECT_NE(text.find("### `robot`"), std::string::npos);
  EXPECT_EQ(text.find("### `gun`"), std::string::npos);
}

TEST(Scenario, SurvivesDamage) {
  Rng rng(6);
  Settings settings;
  const std::string good = scenario_text(settings.groups());
  for (int i = 0; i < 3000; ++i) {
    (void)scenario_from_text(test::damaged(good, rng), "s", settings.groups());
    EXPECT_TRUE(settings.radius_m >= 0.01 && settings.radius_m <= 10.0);
  }
}

}  // namespace
}  // namespace outrider
