#include "scenarios/yard_things.hpp"

#include <cmath>

#include "app_fixture.hpp"

namespace outrider::server {
namespace {

const std::string yard_sdf = R"(<?xml version="1.0"?>
<sdf version="1.6"><world name="court"><gravity>0 0 -9.8</gravity>
<model name="floor"><static>true</static><link name="link"><collision name="c"><geometry><plane><normal>0 0 1</normal>
<size>20 20</size></plane></geometry></collision></link></model>
<model name="wall"><static>true</static><pose>0 4 0.5 0 0 0</pose><link name="link"><collision name="c"><geometry>
<box><size>10 0.2 1</size></box></geometry></collision></link></model>
<model name="bench"><static>true</static><pose>2 1 0 0 0 0.3</pose>
<link name="seat"><pose>0 0 0.1 0 0 0</pose><collision name="c"><geometry><box><size>1.5 0.4 0.2</size></box></geometry></collision></link>
<link name="back"><pose>0 0.3 0.5 0 0 0</pose><collision name="c"><geometry><box><size>1.5 0.1 1</size></box></geometry></collision></link></model>
<model name="lamp"><static>true</static><pose>-2 1 9 0 0 0</pose><link name="link"><collision name="c"><geometry>
<box><size>1 1 1</size></box></geometry></collision></link></model>
</world></sdf>
)";

class YardThingsTest : public AppTest {
 protected:
  void SetUp() override {
    write("yard.sdf", yard_sdf);
    write("targets.txt", "name=fox size=0.3,0.3,0.3 x=-3 y=2 rz=0.25\n");
    write("a.yaml", "job: guard\nworld: yard.sdf\ntargets: targets.txt\nstart: 0,-2,90\n");
  }
  Json shown(const std::string& name) { return json("GET", "/api/v1/scenarios/" + name); }
  Response save(const std::string& name, const std::string& more, const std::string& of = "a.yaml") {
    return ask("PUT", "/api/v1/scenarios/" + name,
               R"({"guard":{"scenario":")" + of +
                   R"(","start":[0,-2],"targets":[{"name":"fox","position":[-3,2]}])" + more + "}}");
  }
};

/// The polygons of a thing where it stands, as the page draws them.
std::vector<std::vector<Vec2>> outlines(const Json& thing) {
  std::vector<std::vector<Vec2>> polygons;
  const double c = std::cos(thing["turn_rad"].get<double>()), s = std::sin(thing["turn_rad"].get<double>());
  for (const Json& polygon : thing["polygons"]) {
    auto& corners = polygons.emplace_back();
    for (const Json& p : polygon) {
      const double u = p[0].get<double>() - thing["middle"][0].get<double>();
      const double v = p[1].get<double>() - thing["middle"][1].get<double>();
      corners.push_back(
          {thing["place"][0].get<double>() + c * u - s * v, thing["place"][1].get<double>() + s * u + c * v});
    }
  }
  return polygons;
}

/// The page draws exactly what stands in the way of the robot in the scenario.
void expect_drawn_as_it_is(const Json& yard) {
  std::vector<std::vector<Vec2>> drawn;
  for (const Json& polygon : yard["fixed"]) {
    auto& corners = drawn.emplace_back();
    for (const Json& p : polygon) corners.push_back({p[0].get<double>(), p[1].get<double>()});
  }
  for (const Json& thing : yard["things"]) {
    if (thing["removed"] == true) continue;
    for (auto& polygon : outlines(thing)) drawn.push_back(std::move(polygon));
  }
  const Json& obstacles = yard["map"]["polygons"]["obstacles"];
  ASSERT_EQ(drawn.size(), obstacles.size());
  for (const auto& polygon : drawn) {
    const auto same = [&](const Json& obstacle) {
      if (obstacle.size() != polygon.size()) return false;
      for (std::size_t shift = 0; shift < polygon.size(); ++shift) {
        double off = 0.0;
        for (std::size_t i = 0; i < polygon.size(); ++i) {
          const Json& p = obstacle[(i + shift) % polygon.size()];
          off =
              std::max(off, std::hypot(p[0].get<double>() - polygon[i].x, p[1].get<double>() - polygon[i].y));
        }
        if (off < 1e-9) return true;
      }
      return false;
    };
    EXPECT_TRUE(std::any_of(obstacles.begin(), obstacles.end(), same))
        << polygon.front().x << ", " << polygon.front().y;
  }
}

TEST_F(YardThingsTest, WhatStandsInTheWayCanBeMovedAsTheWorldNamesIt) {
  const Json yard = shown("a.yaml");
  std::vector<std::string> names;
  for (const Json& thing : yard["things"]) names.push_back(thing["name"]);
  EXPECT_EQ(names, (std::vector<std::string>{"wall", "bench"})) << "the lamp hangs above the robot";
  EXPECT_EQ(yard["things"][1]["polygons"].size(), 2U);
  EXPECT_EQ(yard["things"][1]["place"], yard["things"][1]["middle"]);
  expect_drawn_as_it_is(yard);
}

TEST_F(YardThingsTest, ASavedYardShowsWhatWasDrawn) {
  EXPECT_EQ(
      save(
          "b.yaml",
          R"(,"moved":[{"name":"bench","place":[-1.5,0.25],"turn_rad":2.1}],"removed":["wall"],"heading_rad":1)")
          .status,
      201);
  const Json yard = shown("b.yaml");
  EXPECT_EQ(yard["things"][1]["place"], Json({-1.5, 0.25}));
  EXPECT_NEAR(yard["things"][1]["turn_rad"].get<double>(), 2.1, 1e-9);
  EXPECT_EQ(yard["things"][0]["removed"], true);
  EXPECT_NEAR(yard["heading_rad"].get<double>(), 1.0, 1e-9);
  EXPECT_EQ(yard["targets"][0]["heading_rad"], 0.25) << "left out: as it was";
  EXPECT_EQ(yard["map"]["polygons"]["boundary"], shown("a.yaml")["map"]["polygons"]["boundary"]);
  expect_drawn_as_it_is(yard);
  // Saved again from that: nothing given keeps it, something given replaces it.
  EXPECT_EQ(save("c.yaml", "", "b.yaml").status, 201);
  EXPECT_EQ(shown("c.yaml")["things"], yard["things"]);
  EXPECT_EQ(save("d.yaml", R"(,"removed":["bench"])", "b.yaml").status, 201);
  const Json replaced = shown("d.yaml");
  EXPECT_EQ(replaced["things"][0]["removed"], false);
  EXPECT_EQ(replaced["things"][1]["removed"], true);
  expect_drawn_as_it_is(replaced);
}

TEST_F(YardThingsTest, AddedBoxesAreTurnedAndCanBeMovedLater) {
  EXPECT_EQ(save("b.yaml", R"(,"boxes":[[-1,-1,1,0,0.5],[2,-1,3,0]])").status, 201);
  const Json yard = shown("b.yaml");
  ASSERT_EQ(yard["things"].size(), 4U);
  double lowest = 0.0;
  for (const Json& p : yard["things"][2]["polygons"][0]) lowest = std::min(lowest, p[1].get<double>());
  EXPECT_NEAR(lowest, -0.5 - 0.5 * std::cos(0.5) - std::sin(0.5), 1e-9);
  const std::string name = yard["things"][2]["name"];
  EXPECT_EQ(save("c.yaml", R"(,"moved":[{"name":")" + name + R"(","place":[0,1],"turn_rad":-0.5}])", "b.yaml")
                .status,
            201);
  expect_drawn_as_it_is(shown("c.yaml"));
}

TEST_F(YardThingsTest, AThingWhosePartsAreNamedInTheScenarioStaysAsItSays) {
  write("p.yaml",
        "job: guard\nworld: yard.sdf\ntargets: targets.txt\nstart: 0,-2,90\nmoved: bench/back=0,0,10\n");
  const Json yard = shown("p.yaml");
  ASSERT_EQ(yard["things"].size(), 1U);
  EXPECT_EQ(yard["things"][0]["name"], "wall");
  EXPECT_EQ(yard["fixed"].size(), 2U);
  expect_drawn_as_it_is(yard);
  EXPECT_EQ(save("q.yaml", R"(,"moved":[{"name":"wall","place":[0,3]}])", "p.yaml").status, 201);
  const Json again = shown("q.yaml");
  EXPECT_EQ(again["fixed"], yard["fixed"]);
  expect_drawn_as_it_is(again);
}

TEST_F(YardThingsTest, WrongRequestsAreRefusedWithASentence) {
  for (const auto& [more, says] : std::vector<std::pair<std::string, std::string>>{
           {R"(,"removed":["bensh"])", "near to it are 'bench'"},
           {R"(,"removed":["floor"])", "is the ground"},
           {R"(,"removed":["bench","bench/back"])", "named twice"},
           {R"(,"removed":[3])", "names of things"},
           {R"(,"moved":[{"name":"bench"}])", "moved[0]"},
           {R"(,"moved":[{"name":"a;b","place":[0,0]}])", "moved"},
           {R"(,"moved":[{"name":"bench","place":[0,0],"turn_rad":99}])", "turn_rad"}}) {
    const Response response = save("x.yaml", more);
    EXPECT_EQ(response.status, 400) << more;
    EXPECT_NE(response.body.find(says), std::string::npos) << response.body;
    EXPECT_FALSE(std::filesystem::exists(path("x.yaml")));
  }
}

}  // namespace
}  // namespace outrider::server
