// sdformat with its own description of the whole format is the twin: what it reads from the same text must be
// what parse_sdf() reads with its description cut down.
#include "sdf_parse.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <filesystem>
#include <iostream>
#include <sdf/sdf.hh>
#include <sstream>
#include <thread>

#include "outrider/io/files.hpp"
#include "outrider/io/sdf.hpp"
#include "support/data.hpp"

namespace outrider {
namespace {

const std::string ball = "<geometry><sphere><radius>0.5</radius></sphere></geometry>";
const std::string link = "<link name='l'><collision name='c'>" + ball + "</collision></link>";

std::string world_with_floor(const std::string& content, const std::string& version = "1.9") {
  return "<sdf version='" + version +
         "'><world name='w'>\n<model name='floor'><link name='l'><collision name='c'>" +
         "<geometry><plane><normal>0 0 1</normal></plane></geometry></collision></link></model>\n" + content +
         "</world></sdf>";
}

std::string shape_model(const std::string& name, const std::string& shape) {
  return "<model name='" + name +
         "'><pose>1 2 3 0.1 0.2 0.3</pose><link name='l'><collision name='c'><geometry>" + shape +
         "</geometry></collision></link></model>\n";
}

std::string nested(int levels) {
  if (levels == 0) return link;
  return "<model name='m'><pose>1 0 0 0 0 0.5</pose>" + nested(levels - 1) + link + "</model>\n";
}

RepairedSdf repaired(const std::string& text, const std::string& name) {
  SdfWarnings warnings;
  auto result = repair_sdf(text, name, "", warnings);
  EXPECT_TRUE(result) << name << ": " << (result ? "" : to_string(result.error()));
  return result ? std::move(*result) : RepairedSdf{};
}

void describe_pose(std::ostringstream& out, const sdf::SemanticPose& pose) {
  ignition::math::Pose3d resolved;
  const auto errors = pose.Resolve(resolved);
  out << pose.RawPose() << " in '" << pose.RelativeTo() << "' is " << resolved
      << (errors.empty() ? "" : " unknown") << '\n';
}

void describe_model(std::ostringstream& out, const sdf::Model& model) {
  out << "model " << model.Name() << model.Static() << model.PlacementFrameName()
      << model.CanonicalLinkName();
  describe_pose(out, model.SemanticPose());
  for (std::uint64_t i = 0; i < model.LinkCount(); ++i) {
    out << "link " << model.LinkByIndex(i)->Name();
    describe_pose(out, model.LinkByIndex(i)->SemanticPose());
    for (std::uint64_t k = 0; k < model.LinkByIndex(i)->CollisionCount(); ++k) {
      const sdf::Collision& collision = *model.LinkByIndex(i)->CollisionByIndex(k);
      out << "collision " << collision.Name() << collision.Geom()->Element()->ToString("");
      describe_pose(out, collision.SemanticPose());
    }
  }
  for (std::uint64_t i = 0; i < model.FrameCount(); ++i) {
    out << "frame " << model.FrameByIndex(i)->Name() << model.FrameByIndex(i)->AttachedTo();
    describe_pose(out, model.FrameByIndex(i)->SemanticPose());
  }
  for (std::uint64_t i = 0; i < model.JointCount(); ++i)
    out << "joint " << model.JointByIndex(i)->Name() << '\n';
  for (std::uint64_t i = 0; i < model.ModelCount(); ++i) describe_model(out, *model.ModelByIndex(i));
  out << "end\n";
}

std::string described(const sdf::Root& root) {
  std::ostringstream out;
  for (std::uint64_t w = 0; w < root.WorldCount(); ++w) {
    const sdf::World& world = *root.WorldByIndex(w);
    out << "world " << world.Name() << ' ' << world.Gravity() << '\n';
    for (std::uint64_t i = 0; i < world.ModelCount(); ++i) describe_model(out, *world.ModelByIndex(i));
    for (std::uint64_t i = 0; i < world.FrameCount(); ++i) {
      out << "frame " << world.FrameByIndex(i)->Name();
      describe_pose(out, world.FrameByIndex(i)->SemanticPose());
    }
  }
  return out.str();
}

std::string read_whole(const std::string& text) {
  ::testing::internal::CaptureStderr();
  sdf::Root root;
  const sdf::Errors errors = root.LoadSdfString(text);
  (void)::testing::internal::GetCapturedStderr();
  if (errors.empty()) return described(root);
  const auto line = errors.front().LineNumber();
  return "w.sdf" + (line ? ":" + std::to_string(*line) : std::string()) +
         ": sdformat refuses it: " + errors.front().Message();
}

std::string read_cut_down(const RepairedSdf& text) {
  const auto root = parse_sdf(text, "w.sdf");
  return root ? described(*root) : to_string(root.error());
}

void expect_same(const std::string& text, const std::string& name = "w.sdf") {
  const RepairedSdf world = repaired(text, name);
  EXPECT_EQ(read_cut_down(world), read_whole(world.text)) << name;
}

std::size_t descriptions(const sdf::Element& element) {
  std::size_t count = 1;
  for (unsigned int i = 0; i < element.GetElementDescriptionCount(); ++i) {
    count += descriptions(*element.GetElementDescription(i));
  }
  return count;
}

TEST(SdfParse, EveryShapeAndVersionIsReadAsBefore) {
  std::string shapes;
  for (const char* shape :
       {"<box><size>1 2 3</size></box>", "<box/>", "<capsule><radius>1</radius><length>2</length></capsule>",
        "<cylinder><radius>1</radius><length>2</length></cylinder>",
        "<ellipsoid><radii>1 2 3</radii></ellipsoid>", "<sphere><radius>2</radius></sphere>",
        "<plane><normal>0 1 0</normal><size>1 2</size></plane>"}) {
    shapes += shape_model("m", shape);
  }
  for (const char* version : {"1.4", "1.5", "1.6", "1.7", "1.8", "1.9"}) {
    expect_same(world_with_floor(shapes, version));
    expect_same(
        world_with_floor("<physics type='ode'><gravity>0 0 -3</gravity></physics>" + nested(1), version));
    expect_same(world_with_floor("<gravity>0 0 -4</gravity>" + nested(2), version));
  }
}

TEST(SdfParse, FramesAndModelsThatReferToEachOtherAreReadAsBefore) {
  const std::string frames =
      "<frame name='f'><pose>1 2 3 0 0 1</pose></frame><frame name='g' attached_to='a::l'><pose "
      "relative_to='f'>0 0 1 0 0 "
      "0</pose></frame><model name='a' placement_frame='l'><pose relative_to='f'>1 0 0 0 0 0</pose>" +
      link +
      "</model><model name='b' canonical_link='k'><static>1</static><pose relative_to='a'>0 1 0 0 0 "
      "0</pose>" +
      link +
      "<link name='k'><pose relative_to='h'>1 1 1 0 0 0</pose></link><frame name='h' attached_to='j'/>"
      "<joint name='j' type='revolute'><pose>0 0 2 0 0 "
      "0</pose><parent>l</parent><child>k2</child><axis><xyz>0 0 1</xyz>"
      "<limit><lower>0</lower></limit></axis></joint><link name='k2'/></model>";
  expect_same(world_with_floor(frames));
  expect_same(world_with_floor(frames, "1.7"));
  expect_same(world_with_floor(
      "<model name='a'>" + link + "<link name='k'><pose frame='l'>1 2 3 0 0 0</pose></link></model>", "1.6"));
  expect_same(world_with_floor("<model name='o'>" + link +
                               "<frame name='f' attached_to='i::l'/><model name='i' placement_frame='l'>" +
                               "<pose relative_to='l'>1 2 3 0 0 0</pose>" + link + "</model></model>"));
  for (int levels = 1; levels <= 6; ++levels) expect_same(world_with_floor(nested(levels)));
}

TEST(SdfParse, FaultsAreTheSameWithTheirLines) {
  for (const std::string& content :
       {std::string("<model name='a'>" + link + "</model>\n<model>\n" + link + "</model>"),
        "<model name='a'>\n<link>" + link + "</link>" + link + "</model>",
        "<model name='a'><link name='l'><collision>" + ball + "</collision></link></model>",
        "<model name='a'><pose relative_to='nothing'>1 2 3 0 0 0</pose>" + link + "</model>",
        "<model name='a' placement_frame='nothing'>" + link + "</model>",
        "<model name='a'>" + link +
            "<frame name='f' attached_to='g'/><frame name='g' attached_to='f'/></model>",
        "<model name='a'>" + link + "<joint name='j' type='fixed'/><frame name='f' attached_to='j'/></model>",
        "\n\n" + shape_model("a", "<cylinder><radius>1</radius></cylinder>"), shape_model("a", "<sphere/>"),
        shape_model("a", "<box><size>a b c</size></box>"),
        shape_model("__a__", "<box><size>1 1 1</size></box>"), "<frame name='world'/>" + nested(1)}) {
    expect_same(world_with_floor(content));
  }
}

TEST(SdfParse, EveryWorldOfOursAndThePublishedAreReadAsBefore) {
  std::size_t worlds = 0;
  for (const auto& root : {std::filesystem::path(OUTRIDER_SOURCE_DIR) / "scenarios", test::data_folder()}) {
    if (!std::filesystem::exists(root)) continue;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root)) {
      if (entry.path().extension() != ".sdf" && entry.path().extension() != ".world") continue;
      expect_same(*read_file(entry.path().string()), entry.path().string());
      ++worlds;
    }
  }
  EXPECT_GE(worlds, 8U);
}

TEST(SdfParse, ManyThreadsReadAtATime) {
  const std::string yard = std::string(OUTRIDER_SOURCE_DIR) + "/scenarios/yard/yard.sdf";
  const auto alone = load_sdf(yard);
  ASSERT_TRUE(alone);
  std::streambuf* const errors = std::cerr.rdbuf();
  std::atomic<int> same = 0;
  std::vector<std::thread> threads;
  for (int i = 0; i < 8; ++i) {
    threads.emplace_back([&] {
      for (int k = 0; k < 5; ++k) {
        const auto loaded = load_sdf(yard);
        same += loaded && loaded->world.solids.size() == alone->world.solids.size() ? 1 : 0;
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(same, 40);
  EXPECT_EQ(std::cerr.rdbuf(), errors);
}

TEST(SdfParse, AModelCostsFewDescriptions) {
  const std::string text = world_with_floor(shape_model("m", "<box><size>1 1 1</size></box>"));
  const auto root = parse_sdf(repaired(text, "w.sdf"), "w.sdf");
  ASSERT_TRUE(root);
  EXPECT_LE(descriptions(*root->WorldByIndex(0)->ModelByIndex(1)->Element()), 30U);
}

TEST(SdfParse, WhatIsBeyondItsBoundsIsRefusedBeforeItIsRead) {
  const auto fault_of = [](const std::string& content) {
    const auto loaded = sdf_from_text(world_with_floor(content), "w.sdf");
    return loaded ? "none" : to_string(loaded.error());
  };
  std::string links;
  for (int i = 0; i < 20'000; ++i) links += "<link name='" + std::to_string(i) + "'/>";
  EXPECT_EQ(
      fault_of("<model name='m'>" + links + "</model>"),
      "w.sdf: it has 20004 models, links, collisions, frames and joints with what it includes, and at most "
      "20000 are read; join small shapes in a mesh, or cut the world in two");
  std::string tags;
  for (int i = 0; i < 2'000'000; ++i) tags += "<a/>";
  EXPECT_TRUE(
      fault_of(tags).starts_with("w.sdf: it has 2000016 tags with what it includes, and at most 2000000 "))
      << fault_of(tags);
  std::string towers;
  for (int i = 0; i < 30; ++i) towers += nested(4);
  EXPECT_EQ(
      fault_of(towers),
      "w.sdf: 60 of its models are more than 2 deep in other models, and at most 50 such models are read; "
      "put models beside each other");
}

TEST(SdfParse, ThousandsOfEqualNamesAreNumberedQuickly) {
  std::string models;
  for (int i = 0; i < 6000; ++i) models += shape_model("m", "<sphere><radius>1</radius></sphere>");
  const auto loaded = sdf_from_text(world_with_floor(models), "w.sdf");
  ASSERT_TRUE(loaded);
  EXPECT_EQ(loaded->world.solids.back().name, "m_6000");
}

}  // namespace
}  // namespace outrider
