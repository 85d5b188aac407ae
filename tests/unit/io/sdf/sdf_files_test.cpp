// The search for the models that a world names.
#include <gtest/gtest.h>

#include <cstdlib>

#include "outrider/io/sdf/sdf.hpp"
#include "sdf_solids.hpp"
#include "support/data.hpp"

namespace outrider {
namespace {

const std::string boxed_model =
    "<sdf version='1.6'><model name='tree'><link name='trunk'><collision name='c'><geometry><box><size>1 1 "
    "1</size></box>"
    "</geometry></collision></link></model></sdf>";

/// A world that includes models, each of an address and under a name.
std::string including(const std::vector<std::pair<std::string, std::string>>& models) {
  std::string text = "<sdf version='1.7'><world name='w'>\n";
  for (const auto& [uri, name] : models)
    text += "<include><uri>" + uri + "</uri><name>" + name + "</name></include>\n";
  return text + "</world></sdf>\n";
}

TEST(SdfFiles, ModelsAreFoundWhereSimulatorsFindThem) {
  const test::Folder folder;
  folder.write("above/models/tree/model.sdf", boxed_model);
  folder.write("far/bush/model.sdf", boxed_model);
  folder.write("cache/oak/model.sdf", boxed_model);
  const std::string fuel = "https://fuel.gazebosim.org/1.0/OpenRobotics/models/";
  const std::string path =
      folder.write("above/deep/worlds/w.sdf", including({{fuel + "Ground Plane", "plane"},
                                                         {fuel + "Sun", "sun"},
                                                         {"file://models/tree", "above"},
                                                         {"model://bush", "far"},
                                                         {"\n  " + fuel + "oak\n  ", "fuel"}}));
  ASSERT_EQ(setenv("GZ_SIM_RESOURCE_PATH", (folder.path / "cache").string().c_str(), 1), 0);
  const auto loaded = load_sdf(path, {(folder.path / "far").string()});
  unsetenv("GZ_SIM_RESOURCE_PATH");
  ASSERT_TRUE(loaded) << to_string(loaded.error());
  EXPECT_TRUE(loaded->warnings.empty()) << loaded->warnings[0];
  for (const char* name : {"above", "far", "fuel"}) solid(loaded->world, name);
  EXPECT_EQ(loaded->world.solids.size(), 4U);
  EXPECT_EQ(loaded->world.floor_z_m, 0.0);
  const auto without = load_sdf(path);
  ASSERT_TRUE(without) << to_string(without.error());
  EXPECT_EQ(without->warnings.size(), 2U);
}

/// A model of one box whose height tells where it comes from.
std::string model_at(const std::string& z) {
  return "<sdf version='1.6'><model name='m'><pose>0 0 " + z +
         " 0 0 0</pose><link name='l'><collision name='c'>" +
         "<geometry><box><size>1 1 1</size></box></geometry></collision></link></model></sdf>";
}

TEST(SdfFiles, FuelModelsAreFoundByVersion) {
  const test::Folder folder;
  const std::string cached = "cache/fuel.gazebosim.org/openrobotics/models/oak tree/";
  folder.write(cached + "2/model.sdf", model_at("2"));
  folder.write(cached + "10/model.sdf", model_at("10"));
  folder.write("cache/beech/3/model.sdf", model_at("3"));
  folder.write(cached + "2/meshes/a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const std::string fuel = "https://fuel.gazebosim.org/1.0/OpenRobotics/models/";
  const std::string path = folder.write(
      "w.sdf",
      "<sdf version='1.7'><world name='w'>\n<include><uri>model://ground_plane</uri></include>"
      "<include><uri>" +
          fuel + "Oak Tree/2</uri><name>two</name></include><include><uri>" + fuel +
          "Oak%20Tree</uri><name>newest</name></include><include><uri>" + fuel +
          "Oak Tree/tip</uri><name>tip</name></include><include><uri>" + fuel +
          "beech</uri><name>beech</name></include>\n<include><uri>" + fuel +
          "Oak Tree/7</uri></include><model name='mesh'><link name='l'><collision "
          "name='c'><geometry><mesh><uri>" +
          fuel +
          "Oak Tree/2/files/meshes/a.obj</uri></mesh></geometry></collision></link></model></world></sdf>");
  const auto loaded = load_sdf(path, {(folder.path / "cache").string()});
  ASSERT_TRUE(loaded) << to_string(loaded.error());
  for (const auto& [name, z] :
       std::vector<std::pair<std::string, double>>{{"two", 2}, {"newest", 10}, {"tip", 10}, {"beech", 3}})
    EXPECT_EQ(solid(loaded->world, name).world_T_solid.position.z, z) << name;
  solid(loaded->world, "mesh");
  ASSERT_EQ(loaded->warnings.size(), 1U);
  EXPECT_NE(loaded->warnings[0].find(
                "w.sdf:3: the include of 'https://fuel.gazebosim.org/1.0/OpenRobotics/models/Oak Tree/7' was "
                "not found"),
            std::string::npos)
      << loaded->warnings[0];
}

TEST(SdfFiles, ModelConfigPicksTheNewestVersionThatIsRead) {
  const test::Folder folder;
  for (const char* version : {"1.4", "1.9", "1.11", "9.0"})
    folder.write(std::string("m/") + version + ".sdf", model_at(version));
  const auto height = [&](const std::string& config) {
    folder.write("m/model.config", "<model>" + config + "</model>");
    const auto loaded =
        load_sdf(folder.write("w.sdf", including({{"model://ground_plane", "plane"}, {"model://m", "m"}})));
    EXPECT_TRUE(loaded) << to_string(loaded.error());
    return loaded ? solid(loaded->world, "m").world_T_solid.position.z : 0.0;
  };
  EXPECT_EQ(height("<sdf version='1.11'>1.11.sdf</sdf><sdf version='1.9'>1.9.sdf</sdf><sdf "
                   "version='9.0'>9.0.sdf</sdf>"),
            1.11);
  EXPECT_EQ(height("<sdf version='1.4'>1.4.sdf</sdf><sdf>1.9.sdf</sdf>"), 1.4);
  EXPECT_EQ(height("<sdf>1.4.sdf</sdf><sdf>1.9.sdf</sdf>"), 1.9) << "the last one where none has a version";
}

TEST(SdfFiles, ARefusalNamesTheModelThatIsMissing) {
  const test::Folder folder;
  folder.write("models/box/model.sdf", boxed_model);
  const std::string path =
      folder.write("w.sdf", including({{"model://asphalt", "asphalt"}, {"model://box", "box"}}));
  const auto refused = load_sdf(path);
  ASSERT_FALSE(refused);
  for (const char* word : {"no floor", "w.sdf:2: ", "'model://asphalt' was not found", "as model_path"})
    EXPECT_NE(refused.error().sentence.find(word), std::string::npos) << refused.error().sentence;
  const auto nowhere = load_sdf(path, {(folder.path / "nowhere").string()});
  ASSERT_FALSE(nowhere);
  EXPECT_EQ(nowhere.error().where, "model_path");
}

}  // namespace
}  // namespace outrider
